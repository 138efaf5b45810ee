//! `lgvi chart` as its users run it, over a short time.

use std::fs;

use super::{SCENE, directory, fails, files, json, lgvi, text};

#[test]
fn two_methods_give_three_files_and_a_table() {
    let directory = directory();
    let args = [
        "chart",
        "--until",
        "1",
        "--methods",
        "composition-2,dp853,composition-2",
    ];
    let output = lgvi(directory.path(), &args);
    assert_eq!(text(&output.stderr), "");
    assert_eq!(output.status.code(), Some(0));
    let told = text(&output.stdout);
    for words in [
        "attitude error",
        "of dp853's",
        "keeping the structure",
        "confirms to",
        "failed: composition-2",
        "no solution found for h",
        "written: chart.svg, chart.png, chart.csv",
    ] {
        assert!(told.contains(words), "{words}: {told}");
    }
    assert_eq!(
        files(directory.path()),
        ["chart.csv", "chart.png", "chart.svg"]
    );
    let drawn = fs::read_to_string(directory.path().join("chart.svg")).unwrap();
    assert!(drawn.contains("composition-2") && drawn.contains("unknown below"));
}

#[test]
fn all_numbers_are_in_the_json_and_in_the_table() {
    let directory = directory();
    let args = [
        "chart",
        "--until",
        "1",
        "--methods",
        "dp853",
        "--out",
        "c.1.svg",
        "--json",
    ];
    let object = json(directory.path(), &args);
    assert_eq!(object["cheapest"][0]["cheapest"]["method"], "dp853");
    assert_eq!(object["cheapest"][0]["cheapest"]["time_of_dp853"], 1.0);
    assert!(object["cheapest"][0]["cheapest_keeping_structure"].is_null());
    assert!(
        object["reference"]["attitude_uncertainty_radians"]
            .as_f64()
            .unwrap()
            < 1e-12
    );
    let points = object["methods"][0]["points"].as_array().unwrap();
    assert!(
        points
            .iter()
            .all(|point| point["seconds"].as_f64().unwrap() > 0.0)
    );
    let table = fs::read_to_string(directory.path().join("c.1.csv")).unwrap();
    assert_eq!(table.lines().count(), points.len() + 1);
}

#[test]
fn what_is_asked_wrongly_is_refused_before_any_run() {
    fails(
        &["chart", "--methods", "dp45"],
        2,
        &["dp45", "dp54", "rkmk4-plain", "gauss-8"],
    );
    fails(&["chart", "--until", "0"], 2, &["> 0"]);
    fails(&["chart", "--out", "-"], 2, &["./-"]);
    fails(&["chart", "--out", "there/"], 2, &["directory"]);
    fails(
        &["chart", "--out", "absent/chart"],
        1,
        &["no file can be made in absent"],
    );
    fails(&["chart", "absent.toml"], 2, &["absent.toml"]);

    let directory = directory();
    fs::write(directory.path().join("s.csv"), SCENE).unwrap();
    let output = lgvi(directory.path(), &["chart", "s.csv", "--out", "s"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(
        fs::read_to_string(directory.path().join("s.csv")).unwrap(),
        SCENE
    );
    assert_eq!(files(directory.path()), ["s.csv"]);
}
