//! `lgvi gait`: what a stroke does, and the best one.

use super::*;

fn scene(name: &str) -> String {
    format!("{}/scenes/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// A stroke leads as far as the run of the scene does.
#[test]
fn strokes_lead_where_a_run_does() {
    let directory = directory();
    let links = scene("swim/three-links.toml");
    let told = json(
        directory.path(),
        &["gait", &links, "--strokes", "3", "--json"],
    );
    assert_eq!(told["swims"], "without-momentum");
    assert_eq!(told["period_seconds"], 2.0);
    let run = [
        "run", &links, "--until", "6", "--method", "gauss-8", "--step", "0.05",
    ];
    let output = lgvi(
        directory.path(),
        &[&run[..], &["--out", "run.csv"]].concat(),
    );
    assert!(output.status.success(), "{}", text(&output.stderr));
    let (_, rows) = table(&directory.path().join("run.csv"));
    let end = numbers(&rows[rows.len() - 1]);
    for (i, x) in end[1..4].iter().enumerate() {
        let known = told["path_metres"][3][i].as_f64().unwrap();
        assert!((x - known).abs() < 1e-8, "{x} {known}");
    }
}

#[test]
fn what_is_told_of_a_stroke_has_its_hint() {
    let output = lgvi(directory().path(), &["gait", &scene("swim/fish.toml")]);
    let told = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    for word in [
        "5 s, repeats from 5 s on",
        "helix",
        "cost of transport",
        "after 10 strokes",
        "coupling through the fluid",
    ] {
        assert!(told.contains(word), "{word}: {told}");
    }
}

#[test]
fn the_best_stroke_is_a_scene_that_swims_so() {
    let directory = directory();
    let links = scene("swim/three-links.toml");
    let best = [
        "gait",
        &links,
        "--best",
        "advance-per-length",
        "--order",
        "1",
        "--starts",
        "2",
        "--angle",
        "1.5",
        "--out",
        "best.toml",
        "--json",
    ];
    let found = json(directory.path(), &best);
    let value = found["best"].as_f64().unwrap();
    assert!(value > found["own"].as_f64().unwrap());
    let told = json(
        directory.path(),
        &["gait", "best.toml", "--strokes", "200", "--json"],
    );
    let length = told["length"].as_f64().unwrap();
    let ratio = |strokes: usize| {
        let end = told["path_metres"][strokes].as_array().unwrap().iter();
        let squared: f64 = end.map(|x| x.as_f64().unwrap().powi(2)).sum();
        squared.sqrt() / strokes as f64 / length
    };
    // What turns comes less far: the distance counts on a way that is longer than a stroke, and shorter than 15 lengths of 3.2 m.
    // Both by quadratures that are a part in a million off at most.
    let (one, many) = (ratio(1) * (1.0 + 3e-6), ratio(200) * (1.0 - 3e-6));
    assert!(many < value && value < one, "{many} {value} {one}");
    assert!(many > 0.99 * one, "{many} {one}");
    assert_eq!(files(directory.path()), ["best.toml"]);
}

#[cfg(feature = "chart")]
#[test]
fn maps_are_three_files() {
    let directory = directory();
    let links = scene("swim/three-links.toml");
    let output = lgvi(directory.path(), &["gait", &links, "--maps", "heights"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert_eq!(
        files(directory.path()),
        ["heights.csv", "heights.png", "heights.svg"]
    );
    let (header, rows) = table(&directory.path().join("heights.csv"));
    assert_eq!((header.len(), rows.len()), (8, 61 * 61));
}

#[test]
fn what_is_no_gait_is_refused() {
    let held = scene("loads/arm.toml");
    fails(&["gait", &held], 2, &["held by the world"]);
    let paper = scene("fish-chain.toml");
    fails(&["gait", &paper], 2, &["stay where they are"]);
    fails(
        &[
            "gait",
            &scene("swim/fish.toml"),
            "--best",
            "speed",
            "--out",
            "b.toml",
        ],
        2,
        &["advance-per-work"],
    );
    fails(
        &["gait", &scene("swim/fish.toml"), "--best", "turn"],
        2,
        &["--out"],
    );
}
