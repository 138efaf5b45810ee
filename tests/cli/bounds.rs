//! Inputs of any size and any numbers: the answer is short, and soon there.

use std::fs;
use std::process::Output;

use super::{SCENE, directory, fails, json, lgvi, refuses, text};

/// The longest text of a scene.
const MOST_BYTES: usize = articulated_fluid::scene::MOST_BYTES;

#[test]
fn a_scene_without_end_is_refused() {
    let directory = directory();
    let path = directory.path().join("s.toml");
    let refused = |scene: &str| {
        let output = lgvi(directory.path(), &["run", scene]);
        assert_eq!(output.status.code(), Some(2));
        let message = text(&output.stderr);
        assert!(message.contains("larger than 16 MB"), "{message}");
    };
    for byte in [b'\n', b'#', 0xff, 0] {
        fs::write(&path, vec![byte; MOST_BYTES + 1]).unwrap();
        refused("s.toml");
    }
    if cfg!(unix) {
        refused("/dev/zero");
    }
    fs::write(
        &path,
        SCENE.to_owned() + &"\n".repeat(MOST_BYTES - SCENE.len()),
    )
    .unwrap();
    let output = lgvi(directory.path(), &["run", "s.toml", "--until", "0.01"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
}

/// `count` spheres in one place.
fn star(count: usize) -> String {
    let body = |i| format!("[[body]]\nname = 'b{i}'\nsemi_axes = [1, 1, 1]\n");
    let joint = |i| {
        format!(
            "[[joint]]\nparent = 'b0'\nchild = 'b{i}'\nat_parent = [0, 0, 0]\nat_child = [0, 0, 0]\n"
        )
    };
    let bodies: String = (0..count).map(body).collect();
    let joints: String = (1..count).map(joint).collect();
    format!("fluid.density = 1\n{bodies}{joints}")
}

#[test]
fn many_overlaps_are_told_in_a_few_lines() {
    let directory = directory();
    fs::write(directory.path().join("s.toml"), star(300)).unwrap();
    let output = lgvi(directory.path(), &["inspect", "s.toml"]);
    let warnings: Vec<&str> = text(&output.stderr).lines().collect();
    assert_eq!(warnings.len(), 11, "{warnings:?}");
    assert!(warnings[0].starts_with("warning: bodies \"b0\" and \"b1\" overlap"));
    // 300 times 299 halves, less ten.
    let rest = "warning: and 44840 more pairs of bodies overlap";
    assert_eq!(warnings[10], rest);
    let told = json(directory.path(), &["inspect", "s.toml", "--json"]);
    assert_eq!(told["overlaps"].as_array().unwrap().len(), 10);
    assert_eq!(told["more_overlaps"], 44840);
}

#[test]
fn a_place_too_far_is_told_as_one() {
    let directory = directory();
    let far = SCENE
        .replace("[0, 0, 0]  ", "[1e308, 0, 0]")
        .replace("-0.4142", "-41.42");
    fs::write(directory.path().join("s.toml"), far).unwrap();
    let output = lgvi(directory.path(), &["run", "s.toml"]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    for word in ["at t = 0 s", "angular momentum", "position"] {
        assert!(message.contains(word), "{word}: {message}");
    }
    assert!(!message.contains("inertia"), "{message}");
}

/// No control character but the ends of lines.
#[track_caller]
fn is_plain(output: &Output) {
    for text in [text(&output.stdout), text(&output.stderr)] {
        let control = text.chars().find(|c| c.is_control() && *c != '\n');
        assert_eq!(control, None, "{text:?}");
    }
}

#[test]
fn what_a_terminal_would_obey_is_written_out() {
    let directory = directory();
    let path = directory.path();
    let name = "a\u{1b}[2J\u{7}\u{9b}";
    let file = format!("{name}.toml");
    for args in [
        &["run", &file][..],
        &["run", "--step", name],
        &["run", "--method", name],
        &[name],
        &["run", "--out", &format!("{name}/x.csv")],
        &["inspect", &file],
    ] {
        let output = lgvi(path, args);
        assert!(!output.status.success());
        assert!(text(&output.stderr).contains("[2J"), "{args:?}");
        is_plain(&output);
    }
    if cfg!(unix) {
        fs::write(
            path.join(&file),
            SCENE.replace("[8, 1.5, 2]", "[80, 15, 20]"),
        )
        .unwrap();
        let output = format!("{name}.csv");
        let args = ["run", &file, "--until", "0.01", "--out", &output];
        let done = lgvi(path, &args);
        assert!(done.status.success(), "{}", text(&done.stderr));
        is_plain(&done);
        is_plain(&lgvi(path, &["inspect", &file]));
    }
}

/// No number has more digits than a double.
#[track_caller]
fn has_short_numbers(told: &str) {
    let digits = told.split(|c: char| !c.is_ascii_digit());
    assert!(digits.map(str::len).max() < Some(20), "{told}");
}

#[cfg(feature = "chart")]
#[test]
fn large_numbers_are_told_with_exponents() {
    let directory = directory();
    let rest = "fluid.density = 1\nbody = [{ name = 'b', semi_axes = [2, 1, 0.5] }]";
    fs::write(directory.path().join("rest.toml"), rest).unwrap();
    for (args, words) in [
        (&["--values", "1e300"][..], "1e300"),
        (&["--values", "1e300", "--parameter", "stiffness"], "1e300"),
        (&["--values", "1e-300", "--parameter", "spin"], "1e-300"),
        (
            &[
                "rest.toml",
                "--until",
                "1e300",
                "--steps",
                "1e299",
                "--parameter",
                "spin",
            ],
            "1e300",
        ),
    ] {
        let rest = ["--methods", "rk4", "--budget", "0.1", "--out", "m"];
        let small: &[&str] = if args.contains(&"--until") {
            &[]
        } else {
            &["--until", "1", "--steps", "0.5"]
        };
        let args = [&["stability"], args, small, &rest].concat();
        let output = lgvi(directory.path(), &args);
        let told = [text(&output.stdout), text(&output.stderr)].concat();
        assert!(told.contains(words), "{args:?}: {told}");
        has_short_numbers(&told);
        if let Ok(table) = fs::read_to_string(directory.path().join("m.csv")) {
            has_short_numbers(&table);
        }
    }
    let long = ["run", "--until", "1e300", "--step", "1e299"];
    let output = lgvi(directory.path(), &long);
    has_short_numbers(&[text(&output.stdout), text(&output.stderr)].concat());
}

#[cfg(feature = "chart")]
#[test]
fn no_run_of_a_map_goes_beyond_its_end() {
    let directory = directory();
    let args = [
        "stability",
        "--until",
        "1",
        "--steps",
        "0.3,0.4,0.5,1",
        "--values",
        "1",
        "--methods",
        "rk4",
        "--json",
    ];
    let told = json(directory.path(), &args);
    let runs = told["methods"][0]["runs"].as_array().unwrap().iter();
    let ends: Vec<f64> = runs
        .map(|run| run["time_seconds"].as_f64().unwrap())
        .collect();
    for (end, expected) in ends.iter().zip([0.9, 0.8, 1.0, 1.0]) {
        assert!((end - expected).abs() < 1e-12, "{ends:?}");
    }
    let args = ["stability", "--until", "1", "--steps", "0.5,2"];
    fails(&args, 2, &["--steps", "2 s", "--until", "1 s"]);
    fails(
        &["stability", "--until", "1e-3"],
        2,
        &["--steps", "0.004 s"],
    );

    // Of the usual steps, those that fit.
    let args = [
        "stability",
        "--until",
        "0.05",
        "--values",
        "1",
        "--methods",
        "rk4",
        "--json",
    ];
    let told = json(directory.path(), &args);
    let steps = serde_json::json!([0.004, 0.0063, 0.01, 0.016, 0.025, 0.04]);
    assert_eq!(told["steps_seconds"], steps);
}

#[cfg(feature = "chart")]
#[test]
fn no_more_stiffness_is_the_scene_itself() {
    let directory = directory();
    let args = [
        "stability",
        "--until",
        "5",
        "--steps",
        "0.05",
        "--methods",
        "gauss-4",
        "--json",
    ];
    let of = |more: &[&str]| {
        let told = json(directory.path(), &[&args, more].concat());
        told["methods"][0]["runs"][0].clone()
    };
    let none = of(&["--parameter", "stiffness", "--values", "0"]);
    let own = of(&["--parameter", "spin", "--values", "1"]);
    for key in ["class", "energy_error_relative", "attitude_error_radians"] {
        assert_eq!(none[key], own[key], "{key}");
    }
    for parameter in ["spin", "mass-ratio"] {
        let args = ["stability", "--parameter", parameter, "--values", "0"];
        fails(&args, 2, &[parameter, "the value 0", "> 0"]);
    }
}

#[test]
fn a_long_scene_is_refused_as_any_other() {
    refuses(&"[".repeat(100_000), &["TOML"]);
}
