//! `lgvi import`: a robot as a scene.

use super::*;

fn turtle() -> String {
    format!("{}/scenes/urdf/turtle.urdf", env!("CARGO_MANIFEST_DIR"))
}

/// The scene that an import prints.
fn imported(args: &[&str]) -> String {
    let output = lgvi(directory().path(), &[&["import"], args].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    text(&output.stdout).to_owned()
}

#[test]
fn a_robot_becomes_a_scene_that_runs() {
    let directory = directory();
    let output = lgvi(directory.path(), &["import", &turtle(), "--fluid", "1000"]);
    let told = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{told}");
    assert!(
        told.starts_with("note: limits are not enforced, of joints"),
        "{told}"
    );
    assert_eq!(told.lines().count(), 1, "{told}");
    let mut scene = text(&output.stdout).to_owned();
    for comment in [
        "\"hull\", with what is fixed to it: \"camera\"",
        "\"camera\" displaces the ellipsoid of its collision sphere: semi-axes 0.04, 0.04, 0.04 m",
        "Not enforced: -1.0 to 1.0 rad, 20.0 N m, 6.0 rad/s",
        "free, as the root link has a mass",
    ] {
        assert!(scene.contains(comment), "{comment}: {scene}");
    }
    // The stroke of the guide.
    let stroke = turtle().replace("turtle.urdf", "turtle.stroke");
    scene += &fs::read_to_string(stroke).unwrap();
    fs::write(directory.path().join("turtle.toml"), scene).unwrap();
    let run = [
        "run",
        "turtle.toml",
        "--until",
        "3.5",
        "--method",
        "gauss-4",
        "--step",
        "0.05",
        "--out",
        "t.csv",
        "--json",
    ];
    let report = json(directory.path(), &run);
    assert_eq!(report["bodies"], 7);
    assert_eq!(report["drives"].as_array().unwrap().len(), 6);
    // Forward, and not to the side.
    let (_, rows) = table(&directory.path().join("t.csv"));
    let [start, end] = [&rows[0], &rows[rows.len() - 1]].map(|row| numbers(row));
    assert!(end[1] - start[1] > 0.1, "{end:?}");
    assert!((end[2] - start[2]).abs() < 1e-12, "{end:?}");
}

#[test]
fn options_choose_the_base_and_the_shapes() {
    let free = imported(&[&turtle()]);
    assert!(free.contains("fluid.density = 0.0") && !free.contains("added_mass"));
    let held = imported(&[&turtle(), "--base", "world"]);
    assert!(held.contains("parent = \"world\"") && !held.contains("[start]"));
    let by_inertia = imported(&[&turtle(), "--fluid", "1000", "--shape-from", "inertia"]);
    assert!(by_inertia.contains("of its inertia") && !by_inertia.contains("of its collision"));
}

#[test]
fn what_is_no_robot_is_refused() {
    fails(
        &["import", "none.urdf"],
        2,
        &["none.urdf", "cannot be read"],
    );
    fails(&["import", &shipped("eel")], 2, &["eel.toml", "as a URDF"]);
    fails(
        &["import", &turtle(), "--fluid", "-1"],
        2,
        &["--fluid", "kg/m^3"],
    );
    let directory = directory();
    let sliding = fs::read_to_string(turtle()).unwrap();
    let sliding = sliding.replacen("revolute", "prismatic", 1);
    fs::write(directory.path().join("s.urdf"), sliding).unwrap();
    let output = lgvi(directory.path(), &["import", "s.urdf"]);
    assert_eq!(output.status.code(), Some(2));
    let message = text(&output.stderr);
    assert!(
        message.starts_with("error: s.urdf: joint \"left/flap\" is prismatic"),
        "{message}"
    );
    assert_eq!(text(&output.stdout), "");
}
