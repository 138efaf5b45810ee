//! `lgvi stability` as its users run it, on small grids over a short time.

use std::fs;

use super::{SCENE, directory, fails, files, json, lgvi, text};

const SMALL: [&str; 9] = [
    "stability",
    "--until",
    "20",
    "--values",
    "1,2",
    "--steps",
    "1,0.05",
    "--methods",
    "lgvi,rk4,lgvi",
];

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&SMALL, more].concat()
}

#[test]
fn two_methods_give_three_files_and_a_table() {
    let directory = directory();
    let output = lgvi(directory.path(), &SMALL);
    assert_eq!(text(&output.stderr), "");
    assert_eq!(output.status.code(), Some(0));
    let told = text(&output.stdout);
    for words in [
        "largest good step",
        "mass-ratio",
        "0.05 equation",
        "none: structure",
        "lgvi, mass-ratio 1: in steps of 1 s a step is refused",
        "8 runs: 2 good",
        "written: stability.svg, stability.png, stability.csv",
    ] {
        assert!(told.contains(words), "{words}: {told}");
    }
    assert_eq!(
        files(directory.path()),
        ["stability.csv", "stability.png", "stability.svg"]
    );
    let drawn = fs::read_to_string(directory.path().join("stability.svg")).unwrap();
    assert!(drawn.contains("lgvi, order 1") && drawn.contains("mass of tails to head"));
    let table = fs::read_to_string(directory.path().join("stability.csv")).unwrap();
    assert_eq!(table.lines().count(), 9);
}

#[test]
fn all_numbers_are_in_the_json() {
    let directory = directory();
    let object = json(
        directory.path(),
        &with(&["--json", "--out", "m.1", "--parameter", "spin"]),
    );
    assert_eq!(object["parameter"], "spin");
    assert_eq!(object["steps_seconds"], serde_json::json!([0.05, 1.0]));
    let lgvi = &object["methods"][0];
    assert_eq!(lgvi["limits"][0]["largest_good_step_seconds"], 0.05);
    assert_eq!(lgvi["limits"][0]["wall"], "equation");
    assert_eq!(lgvi["limits"][0]["next_step_seconds"], 1.0);
    let runs = lgvi["runs"].as_array().unwrap();
    assert_eq!((runs.len(), &runs[1]["class"]), (4, &"refused".into()));
    assert!(
        runs[1]["failure"]
            .as_str()
            .unwrap()
            .contains("no solution found for h")
    );
    assert_eq!(object["methods"].as_array().unwrap().len(), 2);
    assert_eq!(files(directory.path()), ["m.1.csv", "m.1.png", "m.1.svg"]);
}

#[test]
fn what_has_no_time_is_told() {
    let directory = directory();
    let args = [
        "stability",
        "--budget",
        "0.2",
        "--until",
        "1e9",
        "--values",
        "1",
        "--steps",
        "0.01",
        "--methods",
        "lgvi",
    ];
    let output = lgvi(directory.path(), &args);
    let told = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0));
    assert!(
        told.contains("none: unknown") && told.contains("1 runs: 1 not-run"),
        "{told}"
    );
}

#[test]
fn what_is_asked_wrongly_is_refused_before_any_run() {
    let refused: [(&[&str], i32, &[&str]); 10] = [
        (
            &["--methods", "dp853"],
            2,
            &["dp853", "rkmk4-plain", "gauss-8"],
        ),
        (
            &["--parameter", "length"],
            2,
            &["length", "mass-ratio", "stiffness"],
        ),
        (
            &["--parameter", "aspect"],
            2,
            &["--parameter: body \"head\"", "semi_axes"],
        ),
        (&["--values", "1,-2"], 2, &["-2", "> 0"]),
        (&["--steps", "0"], 2, &["> 0"]),
        (&["--until", "inf"], 2, &["finite"]),
        (&["--budget", "0"], 2, &["> 0"]),
        (&["--out", "-"], 2, &["./-"]),
        (
            &["--out", "absent/map"],
            1,
            &["no file can be made in absent"],
        ),
        (&["absent.toml"], 2, &["absent.toml"]),
    ];
    for (args, code, words) in refused {
        fails(&[&["stability"], args].concat(), code, words);
    }

    let directory = directory();
    fs::write(directory.path().join("s.csv"), SCENE).unwrap();
    let output = lgvi(directory.path(), &["stability", "s.csv", "--out", "s"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(files(directory.path()), ["s.csv"]);
}

/// Its energy is not kept, which is no fault of a method.
#[test]
fn a_driven_fish_has_good_steps() {
    let directory = directory();
    let fish = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/swim/fish.toml");
    let args = [
        "stability",
        fish,
        "--until",
        "2",
        "--methods",
        "composition-2,gauss-4",
        "--steps",
        "0.01,0.02",
        "--values",
        "1",
    ];
    let output = lgvi(directory.path(), &args);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let told = text(&output.stdout);
    assert!(told.contains("energy is not judged"), "{told}");
    assert!(told.contains("4 runs: 4 good"), "{told}");
}

/// What is told, whatever is compared: where all moves as told, and where a table ends before the run.
#[test]
fn methods_are_not_compared_where_they_solve_nothing_or_beyond_a_table() {
    let directory = directory();
    let scene = |motion: &str| {
        format!(
            "fluid.density = 0
             body = [{{ name = 'a', mass = 1, inertia = [1, 1, 1] }}{}]
             joint = [{{ parent = 'world', child = 'a', at_parent = [0, 0, 0], at_child = [0, 0, 0], {motion} }}{}]",
            if motion.contains("file") { ", { name = 'b', mass = 1, inertia = [1, 1, 1] }" } else { "" },
            if motion.contains("file") { ", { parent = 'a', child = 'b', at_parent = [1, 0, 0], at_child = [0, 0, 1] }" } else { "" },
        )
    };
    let write = |name: &str, text: &str| fs::write(directory.path().join(name), text).unwrap();
    write(
        "told.toml",
        &scene("motion = { amplitude = [0, 0, 1], frequency = 1 }"),
    );
    write(
        "ends.toml",
        &scene("type = 'hinge', axis = [0, 0, 1], motion = { file = 'ends.csv' }"),
    );
    write("ends.csv", "t,angle\n0,0\n0.5,1\n1,0\n");
    for command in ["chart", "stability"] {
        for (name, words) in [
            ("told.toml", "all bodies move as told"),
            ("ends.toml", "told from 0 s to 1 s"),
        ] {
            let output = lgvi(directory.path(), &[command, name, "--until", "2"]);
            assert_eq!(output.status.code(), Some(2), "{command} {name}");
            assert!(
                text(&output.stderr).contains(words),
                "{}",
                text(&output.stderr)
            );
        }
    }
    assert_eq!(
        files(directory.path()),
        ["ends.csv", "ends.toml", "told.toml"]
    );
}
