//! What is written, and what of it when something fails.

use std::fs;

use super::{directory, fails, files, lgvi, text};

/// Before the run, which would take for ever.
#[test]
fn an_ending_that_tells_no_format_is_refused() {
    for name in ["x.htm", "x.svg", "x.json", "x.html.dat", "x", ".csv"] {
        let args = ["run", "--until", "1e8", "--out", "a.csv", "--out", name];
        fails(&args, 2, &["--out", name, ".csv, .html, .glb or .npz"]);
    }
}

#[test]
fn a_name_that_is_given_twice_is_refused() {
    let args = [
        "run", "--until", "1e8", "--out", "a.csv", "--out", "./a.csv",
    ];
    fails(&args, 2, &["--out ./a.csv is given twice"]);
}

#[test]
fn a_second_method_needs_a_page() {
    let args = ["run", "--beside", "gauss-4", "--out", "a.csv"];
    fails(&args, 2, &["--beside needs a page", ".html"]);
    fails(
        &["run", "--beside", "gauss-4x", "--out", "a.html"],
        2,
        &["--beside"],
    );
}

/// Of what moves as told there is nothing that a method could do better or worse.
#[cfg(feature = "chart")]
#[test]
fn a_second_method_needs_something_to_solve() {
    let directory = directory();
    let scene = "
        fluid.density = 1000
        body = [{ name = 'a', semi_axes = [1, 0.3, 0.3] }]
        [[joint]]
        parent = 'world'
        child = 'a'
        at_parent = [0, 0, 0]
        at_child = [0.5, 0, 0]
        type = 'hinge'
        axis = [0, 0, 1]
        motion = { amplitude = 0.5, frequency = 1 }
    ";
    fs::write(directory.path().join("s.toml"), scene).unwrap();
    let args = [
        "run", "s.toml", "--until", "1", "--beside", "dp54", "--out", "a.html",
    ];
    let output = lgvi(directory.path(), &args);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("all bodies move as told"));
    assert_eq!(files(directory.path()), ["s.toml"]);
}

/// Each by its ending, from one run, with as many samples.
#[test]
fn a_run_is_written_in_several_formats_at_once() {
    let directory = directory();
    let path = directory.path();
    let mut args = vec!["run", "--until", "0.5", "--every-seconds", "0.1", "--json"];
    let names = ["a.CSV", "a.glb", "a.html", "a.npz"];
    args.extend(names.iter().flat_map(|name| ["--out", name]));
    let summary = crate::json(path, &args);
    assert_eq!(summary["csv"], "a.CSV");
    assert_eq!(summary["written"], serde_json::json!(names));
    assert_eq!(files(path), names);
    let read = |name: &str| fs::read(path.join(name)).unwrap();
    assert_eq!(text(&read("a.CSV")).lines().count(), 7);
    assert!(text(&read("a.html")).contains("\"frames\":6,"));
    assert_eq!(
        (&read("a.glb")[..4], &read("a.npz")[..2]),
        (&b"glTF"[..], &b"PK"[..])
    );
}

/// Samples enough for the eye, unless others are asked for.
#[test]
fn a_page_has_samples_of_its_own() {
    let directory = directory();
    let path = directory.path();
    for (more, samples) in [(&[][..], 2501), (&["--every", "100"][..], 6)] {
        let args = ["run", "--until", "0.5", "--json", "--out", "a.html"];
        let summary = crate::json(path, &[&args, more].concat());
        assert_eq!(summary["samples"], samples, "{more:?}");
    }
}

#[test]
fn a_second_method_is_on_the_page() {
    let directory = directory();
    let path = directory.path();
    let mut methods = vec!["composition-2"];
    if cfg!(feature = "chart") {
        methods.extend(["dp54", "rk4"]);
    }
    for method in methods {
        let args = [
            "run", "--until", "0.5", "--out", "a.html", "--beside", method,
        ];
        let output = lgvi(path, &args);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let page = fs::read_to_string(path.join("a.html")).unwrap();
        assert!(page.contains(&format!("\"name\":\"{method}\"")), "{method}");
    }
}

/// What is no name of a file is an argument that is wrong, for every command.
#[test]
fn what_is_no_name_of_a_file_has_one_exit_code() {
    for out in ["-", ".", "..", "no/"] {
        fails(&["run", "--until", "1", "--out", out], 2, &["--out"]);
    }
    #[cfg(feature = "chart")]
    for (command, out) in [("chart", "-"), ("chart", "no/"), ("stability", "no/")] {
        fails(&[command, "--out", out], 2, &["--out"]);
    }
}

/// With a browser, and without: the page is there in any case.
#[cfg(target_os = "linux")]
#[test]
fn a_page_is_opened_where_there_is_a_browser() {
    use std::os::unix::fs::PermissionsExt;
    let directory = directory();
    let path = directory.path();
    let browsers = path.join("bin");
    fs::create_dir(&browsers).unwrap();
    let view = || {
        let mut view = crate::command(path, &["view", "--until", "0.1"]);
        view.env("PATH", &browsers).output().unwrap()
    };
    let output = view();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(text(&output.stdout), "written: fish-chain.html\n");
    assert!(text(&output.stderr).contains("open the page yourself"));
    assert_eq!(files(path), ["bin", "fish-chain.html"]);
    let opener = browsers.join("xdg-open");
    fs::write(&opener, "#!/bin/sh\necho \"$1\" > opened\n").unwrap();
    fs::set_permissions(&opener, fs::Permissions::from_mode(0o755)).unwrap();
    assert_eq!(text(&view().stderr), "");
    // The browser goes on by itself.
    let opened = || fs::read_to_string(path.join("opened")).unwrap_or_default();
    for _ in 0..500 {
        if opened().ends_with('\n') {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    assert_eq!(opened(), "fish-chain.html\n");
}

#[cfg(target_os = "linux")]
mod full {
    use std::fs::{File, OpenOptions};
    use std::process::Output;

    use super::*;
    use crate::command;

    fn to_full(directory: &std::path::Path, args: &[&str]) -> Output {
        let full: File = OpenOptions::new().write(true).open("/dev/full").unwrap();
        command(directory, args).stdout(full).output().unwrap()
    }

    #[test]
    fn a_summary_that_cannot_be_written_leaves_the_old_files() {
        let directory = directory();
        let path = directory.path();
        let run = ["run", "--until", "1", "--out", "o.csv"];
        let stability = [
            "stability",
            "--until",
            "1",
            "--values",
            "1",
            "--steps",
            "0.5",
            "--methods",
            "rk4",
            "--out",
            "o",
        ];
        let mut commands = vec![&run[..]];
        if cfg!(feature = "chart") {
            commands.push(&stability);
        }
        for args in commands {
            fs::write(path.join("o.csv"), "old").unwrap();
            let output = to_full(path, args);
            let message = text(&output.stderr);
            assert_eq!(output.status.code(), Some(1), "{args:?}: {message}");
            assert!(message.contains("stdout cannot be written"), "{message}");
            assert_eq!(fs::read_to_string(path.join("o.csv")).unwrap(), "old");
            assert_eq!(files(path), ["o.csv"], "{args:?}");
        }
    }

    #[test]
    fn help_that_cannot_be_written_is_a_failure() {
        let directory = directory();
        for args in [
            &["--help"][..],
            &["run", "--help"],
            &["--version"],
            &["methods"],
        ] {
            let output = to_full(directory.path(), args);
            assert_eq!(output.status.code(), Some(1), "{args:?}");
            assert!(text(&output.stderr).contains("stdout cannot be written"));
        }
    }

    /// The limit of open files is no fault of the directory.
    #[cfg(feature = "chart")]
    #[test]
    fn what_the_system_refuses_is_told_as_it_says() {
        let directory = directory();
        // Three standard ones, and one of the three to be written.
        let line = "ulimit -n 4; exec \"$@\"";
        let args = ["-c", line, "sh", env!("CARGO_BIN_EXE_lgvi"), "chart"];
        let mut shell = std::process::Command::new("sh");
        let output = shell.current_dir(directory.path()).args(args).output();
        let output = output.unwrap();
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(message.contains("--out chart.png"), "{message}");
        assert!(message.contains("Too many open files"), "{message}");
        assert!(!message.contains("give a directory"), "{message}");
        assert_eq!(files(directory.path()), [""; 0]);
    }
}
