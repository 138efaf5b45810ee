//! What is written, and what of it when something fails.

use std::fs;

use super::{directory, fails, files, lgvi, text};

#[test]
fn a_name_of_another_format_is_refused() {
    for name in ["x.html", "x.HTM", "x.svg", "x.json"] {
        let args = ["run", "--until", "1", "--out", name];
        fails(&args, 2, &["--out", name, "CSV", "ends in .csv"]);
    }
    let directory = directory();
    let args = ["run", "--until", "0.01", "--out", "x.html.dat"];
    assert_eq!(lgvi(directory.path(), &args).status.code(), Some(0));
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
