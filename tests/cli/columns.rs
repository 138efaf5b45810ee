//! The columns of the table: those of every table, and those asked for.

use std::fs;

use super::{BODIES, SCENE, directory, expected_header, lgvi, numbers, table, text};

/// The columns of `--all-columns` beyond those of every table, of a scene of these bodies.
fn extra(bodies: &[&str]) -> Vec<String> {
    let whole = "vx,vy,vz,cx,cy,cz,lcx,lcy,lcz".split(',');
    let place = |body: &&str| ["x", "y", "z"].map(|axis| format!("{body}.{axis}"));
    let places = bodies.iter().flat_map(place);
    whole.map(str::to_owned).chain(places).collect()
}

#[test]
fn all_columns_are_those_of_every_table_and_more() {
    let directory = directory();
    let path = directory.path();
    let run = |out: &str, more: &[&str]| {
        let args = ["run", "--until", "1", "--out", out];
        let output = lgvi(path, &[&args, more].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        table(&path.join(out))
    };
    let (usual, all) = (run("a.csv", &[]), run("b.csv", &["--all-columns"]));
    assert_eq!(usual.0, expected_header());
    let (mut found, mut expected) = (all.0.clone(), [usual.0.clone(), extra(&BODIES)].concat());
    found.sort();
    expected.sort();
    assert_eq!(found, expected);
    let at = |name: &str| all.0.iter().position(|column| column == name).unwrap();
    assert_eq!(usual.1.len(), all.1.len());
    for (usual_row, all_row) in usual.1.iter().zip(&all.1) {
        for (name, number) in usual.0.iter().zip(usual_row) {
            assert_eq!(*number, all_row[at(name)], "{name}");
        }
        for axis in ["x", "y", "z"] {
            assert_eq!(all_row[at(axis)], all_row[at(&format!("head.{axis}"))]);
        }
    }
    let start = numbers(&all.1[0]);
    // The velocity is solved for from the momentum.
    assert!((start[at("vy")] + 0.4142).abs() < 1e-14);
    assert!((start[at("vz")] + 0.59).abs() < 1e-14);
    assert!((start[at("tail-1.x")] - 14.3).abs() < 1e-14);
}

#[test]
fn names_of_ros_are_names_of_bodies() {
    let directory = directory();
    let path = directory.path();
    let scene = SCENE
        .replace("\"head\"", "\"base_link/body.0\"")
        .replace("\"tail-1\"", "\"base_link/arm.1\"");
    fs::write(path.join("s.toml"), scene).unwrap();
    let args = ["run", "s.toml", "--until", "0.1", "--out", "a.csv"];
    let output = lgvi(path, &args);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let (header, rows) = table(&path.join("a.csv"));
    assert!(
        header.contains(&"base_link/arm.1.qw".to_owned()),
        "{header:?}"
    );
    assert!(rows.iter().all(|row| row.len() == header.len()));
}

#[test]
fn help_tells_every_column_and_which_are_asked_for() {
    let directory = directory();
    let output = lgvi(directory.path(), &["run", "--help"]);
    let help = text(&output.stdout);
    for word in [
        "+  NAME.x,.y,.z",
        "+  vx,vy,vz",
        "+  cx,cy,cz",
        "+  lcx,lcy,lcz",
        "bodies' own masses, without added mass",
        "what follows the last",
        "--all-columns",
        "letters a-z A-Z, digits, - _ / and .",
    ] {
        assert!(help.contains(word), "{word}: {help}");
    }
}

#[test]
fn a_driven_run_tells_the_work_of_its_joints() {
    let directory = directory();
    let fish = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/swim/fish.toml");
    let args = [
        "run",
        fish,
        "--until",
        "1",
        "--every-seconds",
        "0.1",
        "--out",
        "f.csv",
        "--all-columns",
    ];
    let told = lgvi(directory.path(), &args);
    assert_eq!(told.status.code(), Some(0), "{}", text(&told.stderr));
    let told = text(&told.stdout);
    assert!(told.contains(" J by ") && told.contains("energy less work, error"));
    let table = fs::read_to_string(directory.path().join("f.csv")).unwrap();
    let names: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let column = |name: &str| -> Vec<f64> {
        let at = names
            .iter()
            .position(|n| *n == name)
            .unwrap_or_else(|| panic!("{name} in {names:?}"));
        table
            .lines()
            .skip(1)
            .map(|row| row.split(',').nth(at).unwrap().parse().unwrap())
            .collect()
    };
    let works: Vec<_> = names
        .iter()
        .filter(|name| name.ends_with(".work"))
        .copied()
        .collect();
    assert!(!works.is_empty());
    let energy = column("energy");
    for k in 0..energy.len() {
        let work: f64 = works.iter().map(|name| column(name)[k]).sum();
        // An accuracy of 1e-6 is the default.
        assert!(
            (energy[k] - energy[0] - work).abs() < 1e-5 * energy[0].abs().max(1.0),
            "row {k}"
        );
    }
    for name in &works {
        let joint = name.trim_end_matches(".work");
        let (work, power) = (column(name), column(&format!("{joint}.power")));
        let t = column("t");
        for k in 1..t.len() {
            let mean = (work[k] - work[k - 1]) / (t[k] - t[k - 1]);
            assert!((power[k] - mean).abs() < 1e-9 * (1.0 + mean.abs()));
        }
        assert!(column(&format!("{joint}.tz")).iter().any(|x| x.abs() > 0.0));
    }
}
