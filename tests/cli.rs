//! The command as its users run it.
#![cfg(feature = "cli")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use lgvi::sim::Method;
use serde_json::Value;
use tempfile::TempDir;

#[path = "cli/bounds.rs"]
mod bounds;
#[cfg(feature = "chart")]
#[path = "cli/chart.rs"]
mod chart;
#[path = "cli/columns.rs"]
mod columns;
#[path = "cli/gait.rs"]
mod gait;
#[path = "cli/import.rs"]
mod import;
#[path = "cli/outputs.rs"]
mod outputs;
#[cfg(unix)]
#[path = "cli/signals.rs"]
mod signals;
#[cfg(feature = "chart")]
#[path = "cli/stability.rs"]
mod stability;

const SCENE: &str = include_str!("../scenes/fish-chain.toml");
const BODIES: [&str; 3] = ["head", "tail-1", "tail-2"];

fn command(directory: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lgvi"));
    command.current_dir(directory).args(args);
    command
}

fn lgvi(directory: &Path, args: &[&str]) -> Output {
    command(directory, args).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

fn directory() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn files(directory: &Path) -> Vec<String> {
    let name = |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name();
    let names = fs::read_dir(directory).unwrap().map(name);
    let mut names: Vec<_> = names.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    names
}

/// Runs in an empty directory; the run ends with `code`, says all of `words`, and leaves no file.
#[track_caller]
fn fails(args: &[&str], code: i32, words: &[&str]) {
    let directory = directory();
    let output = lgvi(directory.path(), args);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {message}");
    assert!(message.starts_with("error: "), "{args:?}: {message}");
    for word in words {
        assert!(message.contains(word), "{args:?}: {word:?}: {message}");
    }
    assert_eq!(text(&output.stdout), "", "{args:?}");
    assert_eq!(files(directory.path()), [""; 0], "{args:?}");
}

/// Runs a scene; it is refused with all of `words`.
#[track_caller]
fn refuses(scene: &str, words: &[&str]) {
    let directory = directory();
    fs::write(directory.path().join("s.toml"), scene).unwrap();
    let args = ["run", "s.toml", "--until", "1", "--out", "a.csv"];
    let output = lgvi(directory.path(), &args);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.starts_with("error: s.toml:"), "{message}");
    for word in words {
        assert!(message.contains(word), "{word:?}: {message}");
    }
    assert_eq!(files(directory.path()), ["s.toml"]);
}

/// The header and the rows of a CSV file.
fn table(path: &Path) -> (Vec<String>, Vec<Vec<String>>) {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.ends_with('\n'));
    let split = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let mut lines = text.lines().map(split);
    (lines.next().unwrap(), lines.collect())
}

fn numbers(row: &[String]) -> Vec<f64> {
    row.iter().map(|field| field.parse().unwrap()).collect()
}

fn json(directory: &Path, args: &[&str]) -> Value {
    let output = lgvi(directory, args);
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn expected_header() -> Vec<String> {
    let columns = ["qw", "qx", "qy", "qz", "wx", "wy", "wz"];
    let body = |body| columns.map(|column| format!("{body}.{column}"));
    let last = "energy,px,py,pz,lx,ly,lz,orthogonality";
    let ends = |text: &'static str| text.split(',').map(str::to_owned);
    let bodies = BODIES.into_iter().flat_map(body);
    ends("t,x,y,z").chain(bodies).chain(ends(last)).collect()
}

#[test]
fn the_built_in_scene_gives_a_table_and_a_summary() {
    let directory = directory();
    let args = ["run", "--until", "2", "--out", "fish.csv"];
    let output = lgvi(directory.path(), &args);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(text(&output.stderr), "");
    let summary = text(&output.stdout);
    for word in [
        "three ellipsoids",
        "2000",
        "0.001 s",
        "fish.csv",
        "time per step",
    ] {
        assert!(summary.contains(word), "{word}: {summary}");
    }
    assert!(!summary.contains("as asked"), "{summary}");
    assert_eq!(files(directory.path()), ["fish.csv"]);

    let (header, rows) = table(&directory.path().join("fish.csv"));
    assert_eq!(header, expected_header());
    assert_eq!(rows.len(), 201);
    assert_eq!(numbers(&rows[0])[0], 0.0);
    assert_eq!(numbers(&rows[1])[0], 0.01);
    assert_eq!(numbers(&rows[200])[0], 2.0);
    assert!(rows.iter().all(|row| row.len() == header.len()));
}

#[test]
fn the_start_is_the_scene_s() {
    let directory = directory();
    lgvi(
        directory.path(),
        &["run", "--until", "0.01", "--out", "a.csv"],
    );
    let (header, rows) = table(&directory.path().join("a.csv"));
    let first = numbers(&rows[0]);
    let at = |name: &str| first[header.iter().position(|column| column == name).unwrap()];
    for (name, value) in [
        ("x", 0.0),
        ("head.qw", 1.0),
        ("head.wz", 0.5),
        ("tail-1.wy", -0.3),
        ("tail-2.wz", -0.6),
        ("energy", 9.203_817_003_436),
        ("py", -1.1316e-4),
        ("lz", 51.545_892),
    ] {
        assert!((at(name) - value).abs() < 1e-7, "{name}: {}", at(name));
    }
}

#[test]
fn the_table_is_physical_and_has_all_digits() {
    let directory = directory();
    lgvi(
        directory.path(),
        &["run", "--until", "20", "--out", "a.csv"],
    );
    let (header, rows) = table(&directory.path().join("a.csv"));
    let digits = |field: &String| {
        field
            .split('e')
            .next()
            .unwrap()
            .replace(['-', '.'], "")
            .len()
    };
    assert!(rows.iter().flatten().all(|field| digits(field) == 17));

    let rows: Vec<_> = rows.iter().map(|row| numbers(row)).collect();
    let column = |name: &str| header.iter().position(|column| column == name).unwrap();
    let (energy, start) = (column("energy"), rows[0][column("energy")]);
    let error = |row: &Vec<f64>| (row[energy] / start - 1.0).abs();
    assert!(rows.iter().map(error).fold(0.0, f64::max) < 1e-3);
    assert!(rows.iter().all(|row| row[column("orthogonality")] < 1e-13));
    for body in BODIES {
        let q = column(&format!("{body}.qw"));
        let length = |row: &Vec<f64>| row[q..q + 4].iter().map(|x| x * x).sum::<f64>();
        assert!(rows.iter().all(|row| (length(row) - 1.0).abs() < 1e-13));
        for pair in rows.windows(2) {
            let jump = (q..q + 4).map(|i| (pair[1][i] - pair[0][i]).abs());
            assert!(jump.fold(0.0, f64::max) < 0.1, "{body}");
        }
    }
}

#[test]
fn the_end_is_sampled_whatever_the_interval() {
    let directory = directory();
    let path = directory.path();
    lgvi(
        path,
        &["run", "--until", "0.25", "--every", "100", "--out", "a.csv"],
    );
    let (_, rows) = table(&path.join("a.csv"));
    let times: Vec<f64> = rows.iter().map(|row| numbers(row)[0]).collect();
    assert_eq!(times, [0.0, 0.1, 0.2, 0.25]);

    let every = u64::MAX.to_string();
    lgvi(
        path,
        &[
            "run", "--until", "0.25", "--every", &every, "--out", "a.csv",
        ],
    );
    assert_eq!(table(&path.join("a.csv")).1.len(), 2);
}

#[test]
fn the_summary_as_json() {
    let directory = directory();
    let summary = json(directory.path(), &["run", "--until", "5", "--json"]);
    let number = |key: &str| summary[key].as_f64().unwrap_or_else(|| panic!("{key}"));
    assert_eq!(number("bodies"), 3.0);
    assert_eq!(number("steps"), 5000.0);
    assert_eq!(number("step_seconds"), 0.001);
    assert_eq!(number("until_seconds"), 5.0);
    assert_eq!(number("samples"), 501.0);
    assert_eq!(number("sample_every_steps"), 10.0);
    assert_eq!(number("method_order"), 1.0);
    assert!((number("energy_initial_joules") - 9.203_817_003_436).abs() < 1e-9);
    for (key, least, most) in [
        ("time_per_step_us", 1e-3, 1e5),
        ("energy_error_max_relative", 1e-9, 1e-3),
        ("energy_slope_per_second", -1e-3, 1e-3),
        ("linear_momentum_deviation_max", 0.0, 1e-13),
        ("angular_momentum_deviation_max", 0.0, 1e-11),
        ("angular_momentum_deviation_max_relative", 0.0, 1e-12),
        ("orthogonality_error_max", 0.0, 1e-13),
        ("solver_residual_max", 0.0, 1e-13),
        ("solver_iterations_max", 1.0, 60.0),
        ("solver_iterations_mean", 1.0, 10.0),
    ] {
        let value = number(key);
        assert!((least..=most).contains(&value), "{key}: {value}");
    }
    assert!(summary["csv"].is_null());
    assert!(summary["sample_every_seconds"].is_null());
    assert_eq!(summary["method"], "lgvi");
}

#[test]
fn the_methods_are_listed() {
    let directory = directory();
    let methods = json(directory.path(), &["methods", "--json"]);
    let methods = methods.as_array().unwrap();
    assert_eq!(methods.len(), Method::all().len());
    // The order that a name tells, if it does.
    let order = |name: &str| match name.split_once('-')? {
        ("gauss", stages) => Some(2 * stages.parse::<u32>().unwrap()),
        ("composition", order) => order.parse().ok(),
        _ => None,
    };
    let text = lgvi(directory.path(), &["methods"]).stdout;
    let text = String::from_utf8(text).unwrap();
    for (method, listed) in methods.iter().zip(Method::all()) {
        let name = method["name"].as_str().unwrap();
        assert_eq!(name, listed.name());
        assert_eq!(method["order"], listed.order(), "{name}");
        assert_eq!(listed.order(), order(name).unwrap_or(listed.order()));
        assert_eq!(method["symmetric"], listed.is_symmetric(), "{name}");
        assert_eq!(method["symplectic"], true, "{name}");
        assert!(method["default_step_seconds"].as_f64().unwrap() > 0.0);
        assert!(method["evaluations_per_step"].as_u64().unwrap() > 1);
        let row = |line: &str| line.split_whitespace().next() == Some(name);
        assert!(text.lines().any(row), "{name}: {text}");
    }
    let names: Vec<_> = methods
        .iter()
        .map(|m| m["name"].as_str().unwrap())
        .collect();
    let gauss = (1..=8).map(|stages| format!("gauss-{stages}"));
    let compositions = [2, 4, 6, 8].map(|order| format!("composition-{order}"));
    let of_orders: Vec<_> = compositions.into_iter().chain(gauss).collect();
    assert!(of_orders.iter().all(|name| names.contains(&&name[..])));
}

#[test]
fn every_family_of_methods_keeps_what_the_motion_keeps() {
    let directory = directory();
    for (method, order, step, energy) in [
        ("lgvi-adjoint", 1, 0.001, 1e-3),
        ("composition-4", 4, 0.05, 1e-5),
        ("gauss-4", 8, 0.1, 1e-8),
    ] {
        let args = ["run", "--until", "20", "--json", "--method", method];
        let summary = json(directory.path(), &args);
        let number = |key: &str| summary[key].as_f64().unwrap_or_else(|| panic!("{key}"));
        assert_eq!(summary["method"], method);
        assert_eq!(summary["method_order"], order, "{method}");
        assert_eq!(number("step_seconds"), step, "{method}");
        for (key, least, most) in [
            ("energy_error_max_relative", 1e-14, energy),
            ("linear_momentum_deviation_max", 0.0, 1e-13),
            ("angular_momentum_deviation_max", 0.0, 1e-11),
            ("orthogonality_error_max", 0.0, 1e-13),
            ("solver_residual_max", 0.0, 1e-9),
            ("solver_iterations_mean", 2.0, 1000.0),
        ] {
            let value = number(key);
            assert!((least..=most).contains(&value), "{method}: {key}: {value}");
        }
    }
}

#[test]
fn the_summary_names_the_method_and_what_its_iterations_are() {
    let directory = directory();
    for (method, words) in [
        (
            "lgvi",
            [
                "lgvi, order 1",
                "0.001 s, the method's default",
                "solver iterations",
            ],
        ),
        (
            "composition-2",
            [
                "composition-2, order 2",
                "0.01 s, the method's default",
                "in 2 substeps",
            ],
        ),
        (
            "gauss-3",
            [
                "gauss-3, order 6",
                "0.1 s, the method's default",
                "over 3 stages",
            ],
        ),
    ] {
        let output = lgvi(
            directory.path(),
            &["run", "--until", "1", "--method", method],
        );
        let summary = text(&output.stdout);
        for word in words {
            assert!(summary.contains(word), "{word}: {summary}");
        }
    }
    let args = ["run", "--until", "0.25", "--method", "gauss-3"];
    let output = lgvi(directory.path(), &args);
    assert!(text(&output.stdout).contains("not the default 0.1 s"));
}

#[test]
fn unknown_methods_are_refused() {
    let words = [
        "--method",
        "gaus-4",
        "similar",
        "'gauss-4'",
        "lgvi-adjoint",
        "composition-8",
    ];
    fails(&["run", "--method", "gaus-4", "--out", "a.csv"], 2, &words);
    fails(&["run", "--method", "", "--out", "a.csv"], 2, &["--method"]);
}

/// The times, and the first numbers of the head's row, of a run that samples as `args` say.
fn trajectory(directory: &Path, args: &[&str]) -> Vec<Vec<f64>> {
    let output = lgvi(directory, &[&["run", "--out", "a.csv"], args].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let (_, rows) = table(&directory.join("a.csv"));
    rows.iter().map(|row| numbers(row)[..11].to_vec()).collect()
}

fn farthest(a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    assert_eq!(a.len(), b.len());
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn rows_at_times_that_the_step_does_not_choose() {
    let directory = directory();
    let run = |args: &[&str]| trajectory(directory.path(), &[&["--until", "2"], args].concat());
    let exact = run(&["--method", "gauss-8", "--step", "0.05", "--every", "3"]);
    let times: Vec<f64> = (0..14).map(|k| f64::from(k) * 0.15).chain([2.0]).collect();
    let every = ["--every-seconds", "0.15"];
    for (method, step, error) in [
        ("lgvi", "0.001", 5e-3),
        ("lgvi", "0.0004", 2e-3),
        ("composition-4", "0.08", 1e-4),
        ("gauss-4", "0.1", 1e-8),
        ("gauss-8", "0.25", 1e-11),
        ("gauss-8", "2e-1", 1e-11),
    ] {
        let rows = run(&[&["--method", method, "--step", step], &every[..]].concat());
        let found: Vec<f64> = rows.iter().map(|row| row[0]).collect();
        assert_eq!(found, times, "{method}, {step}");
        let worst = farthest(&rows, &exact);
        assert!(worst < error, "{method}, {step}: {worst:e}");
        assert!(
            method != "lgvi" || worst > error / 100.0,
            "{step}: {worst:e}"
        );
    }
}

#[test]
fn rows_between_steps_leave_the_steps_as_they_are() {
    let directory = directory();
    for method in ["lgvi", "composition-2", "gauss-6"] {
        let run = |every: &[&str]| {
            let args = [&["--until", "3", "--method", method], every].concat();
            trajectory(directory.path(), &args).pop().unwrap()
        };
        let (plain, sampled) = (run(&[]), run(&["--every-seconds", "0.0037"]));
        let worst = farthest(&[plain], &[sampled]);
        assert!(worst < 1e-11, "{method}: {worst:e}");
    }
}

#[test]
fn samples_are_asked_for_in_one_way() {
    let both = [
        "run",
        "--every",
        "2",
        "--every-seconds",
        "0.1",
        "--out",
        "a.csv",
    ];
    fails(&both, 2, &["--every <N>", "--every-seconds"]);
    let directory = directory();
    let args = ["run", "--until", "1", "--every-seconds", "0.3", "--json"];
    let summary = json(directory.path(), &args);
    assert_eq!(summary["sample_every_seconds"], 0.3);
    assert!(summary["sample_every_steps"].is_null());
    assert_eq!(summary["samples"], 5);
    let output = lgvi(directory.path(), &args[..5]);
    assert!(text(&output.stdout).contains("5, every 0.3 s"));
}

/// The step that a refused one's hint names.
fn hinted(message: &str) -> &str {
    let (_, hint) = message.split_once("try a smaller step, such as ").unwrap();
    hint.trim().strip_suffix(" s").unwrap()
}

#[test]
fn a_step_too_long_is_refused_with_one_that_is_not() {
    let directory = directory();
    let run = |method: &str, step: &str| {
        let args = ["run", "--until", "100", "--method", method, "--step", step];
        lgvi(directory.path(), &args)
    };
    for (method, step) in [
        ("lgvi", "20"),
        ("gauss-1", "20"),
        ("gauss-4", "10"),
        ("gauss-8", "2"),
    ] {
        let mut step = step.to_owned();
        // The hint is for the step that failed; the motion may be faster later.
        for _ in 0..10 {
            let output = run(method, &step);
            if output.status.success() {
                break;
            }
            assert_eq!(output.status.code(), Some(1), "{method}");
            let shorter = hinted(text(&output.stderr)).to_owned();
            assert!(shorter.parse::<f64>().unwrap() < step.parse().unwrap());
            step = shorter;
        }
        assert!(run(method, &step).status.success(), "{method}: {step}");
    }
}

#[test]
fn the_step_shrinks_where_it_does_not_divide_the_time() {
    let directory = directory();
    let args = ["run", "--until", "1", "--step", "0.003", "--out", "a.csv"];
    let output = lgvi(directory.path(), &args);
    let summary = text(&output.stdout);
    assert!(summary.contains("not 0.003 s as asked"), "{summary}");
    let (_, rows) = table(&directory.path().join("a.csv"));
    assert_eq!(numbers(rows.last().unwrap())[0], 1.0);

    let args = ["run", "--until", "1", "--step", "0.003", "--json"];
    let summary = json(directory.path(), &args);
    assert_eq!(summary["steps"], 334);
    assert_eq!(summary["step_seconds"], 1.0 / 334.0);
    assert_eq!(summary["step_asked_seconds"], 0.003);
}

#[test]
fn scenes_from_files() {
    let directory = directory();
    let rest = "[fluid]\ndensity = 1000\n[[body]]\nname = 'b'\nsemi_axes = [2, 1, 0.5]\n";
    fs::write(directory.path().join("rest.toml"), rest).unwrap();
    let summary = json(
        directory.path(),
        &["run", "rest.toml", "--until", "1", "--json"],
    );
    assert_eq!(summary["scene"], "rest.toml");
    assert!(summary["title"].is_null());
    assert_eq!(summary["bodies"], 1);
    assert_eq!(summary["energy_error_max_relative"], 0.0);
    assert_eq!(summary["energy_slope_per_second"], 0.0);
}

#[test]
fn bad_numbers_are_refused() {
    for value in ["0", "-1", "nan", "inf", "-inf", "soon"] {
        let words = [value, "expected a finite number > 0, in seconds"];
        for option in ["--step", "--until", "--every-seconds"] {
            let args = ["run", option, value, "--out", "a.csv"];
            fails(&args, 2, &[&words[..], &[option]].concat());
        }
    }
    for value in ["0", "-3", "1.5"] {
        let args = ["run", "--every", value, "--out", "a.csv"];
        fails(&args, 2, &["--every", "expected a whole number >= 1"]);
    }
}

#[test]
fn absurdly_many_steps_are_refused() {
    let words = ["steps", "--step", "--until"];
    fails(&["run", "--step", "1e-20", "--out", "a.csv"], 2, &words);
    fails(&["run", "--until", "1e300", "--out", "a.csv"], 2, &words);
    let words = ["samples", "--every-seconds", "--until"];
    fails(
        &["run", "--every-seconds", "1e-20", "--out", "a.csv"],
        2,
        &words,
    );
}

#[test]
fn unknown_arguments_are_refused() {
    fails(&["run", "--untill", "3"], 2, &["--untill", "--until"]);
    fails(&["ran"], 2, &["ran"]);
}

#[test]
fn unwritable_outputs_are_found_before_the_run() {
    // Long enough to be noticed if it ran first.
    let run = |out| ["run", "--until", "1e8", "--out", out];
    fails(
        &run("no/a.csv"),
        1,
        &["--out no/a.csv", "directory that exists"],
    );
    fails(&run("."), 2, &["directory", "name of a file"]);
    fails(&run("new/"), 2, &["directory", "name of a file"]);
    let long = format!("{}.csv", "a".repeat(300));
    fails(&run(&long), 2, &["another name"]);
    #[cfg(unix)]
    fails(&run("/dev/null"), 2, &["no ordinary file"]);
}

#[test]
fn an_output_is_not_written_over_its_scene() {
    let directory = directory();
    let path = directory.path().join("s.toml");
    fs::write(&path, SCENE).unwrap();
    let args = ["run", "s.toml", "--until", "1", "--out", "./s.toml"];
    assert_eq!(lgvi(directory.path(), &args).status.code(), Some(2));
    assert_eq!(fs::read_to_string(path).unwrap(), SCENE);
}

#[test]
fn bad_scenes_are_refused() {
    let ellipsoid = include_str!("../scenes/one-ellipsoid.toml");
    let negative = ellipsoid.replace("[0.5, 0.2, 0.3]", "[0.5, -0.2, 0.3]");
    refuses(&negative, &["body.semi_axes", "-0.2", "> 0"]);
    let nan = SCENE.replace("[0, -0.4142, -0.59]", "[0, nan, -0.59]");
    refuses(&nan, &["start.velocity", "NaN", "finite"]);
    let unknown = SCENE.replace("angular_velocity", "angular_speed");
    refuses(
        &unknown,
        &["angular_speed", "unknown key", "angular_velocity"],
    );
    let joint = SCENE.replace("child = \"tail-2\"", "child = \"tail-3\"");
    refuses(&joint, &["joint.child", "tail-3"]);
    refuses("[fluid", &["s.toml:1:"]);
    fails(
        &["run", "nothing.toml"],
        2,
        &["nothing.toml", "cannot be read"],
    );
}

#[test]
fn a_step_that_fails_leaves_the_old_table() {
    let words = [
        "step 0 at t = 0 s",
        "no solution found for h = 5 s",
        "try a smaller step",
    ];
    fails(&["run", "--step", "5", "--out", "a.csv"], 1, &words);

    let directory = directory();
    let path = directory.path().join("a.csv");
    fs::write(&path, "old").unwrap();
    let args = ["run", "--step", "5", "--out", "a.csv"];
    assert_eq!(lgvi(directory.path(), &args).status.code(), Some(1));
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(files(directory.path()), ["a.csv"]);

    let args = ["run", "--until", "0.01", "--out", "a.csv"];
    assert_eq!(lgvi(directory.path(), &args).status.code(), Some(0));
    assert_eq!(table(&path).1.len(), 2);
}

#[test]
fn velocities_beyond_all_numbers_are_a_typed_failure() {
    let directory = directory();
    let scene = SCENE.replace("[0.2, 0.1, 0.5]", "[1e200, 0.1, 0.5]");
    fs::write(directory.path().join("s.toml"), scene).unwrap();
    let output = lgvi(directory.path(), &["run", "s.toml", "--out", "a.csv"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("too large"));
    assert_eq!(files(directory.path()), ["s.toml"]);
}

#[test]
fn help_tells_keys_columns_and_exit_codes() {
    let directory = directory();
    let output = lgvi(directory.path(), &["run", "--help"]);
    assert_eq!(output.status.code(), Some(0));
    let help = text(&output.stdout);
    for word in [
        "fluid.density: a finite number >= 0, in kg/m^3",
        "NAME.qw",
        "Exit codes",
        "Examples",
        "--every-seconds",
        "composition-4",
        "order 16",
    ] {
        assert!(help.contains(word), "{word}: {help}");
    }
    assert!(text(&lgvi(directory.path(), &["--help"]).stdout).contains("lgvi run"));
    let version = lgvi(directory.path(), &["--version"]);
    let expected = concat!("lgvi ", env!("CARGO_PKG_VERSION"), "\n");
    assert_eq!(text(&version.stdout), expected);
    assert_eq!(lgvi(directory.path(), &[]).status.code(), Some(2));
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let directory = directory();
    for args in [
        &["run", "--until", "0.01"][..],
        &["run", "--until", "0.01", "--json"],
        &["run", "--help"],
        &["methods"],
    ] {
        let mut child = command(directory.path(), args)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{args:?}");
        assert_eq!(text(&output.stderr), "");
    }
}

/// A scene of the collection, by its name.
fn shipped(name: &str) -> String {
    format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn inspect_tells_the_smallest_exact_model_and_why() {
    let directory = directory();
    let expected = [
        (
            "fish-chain",
            "SO(3) x R^3 x SO(3)^2",
            [12, 9],
            "translation weight",
        ),
        (
            "one-ellipsoid",
            "SO(3) x R^3",
            [6, 3],
            "translation joints weight",
        ),
        (
            "eel",
            "SO(3) x R^3 x SO(3)^29",
            [93, 90],
            "translation weight root",
        ),
        (
            "branching-robot",
            "SO(3) x R^3 x SO(3)^10",
            [36, 33],
            "translation",
        ),
        (
            "dry-chain",
            "SO(3) x R^3 x SO(3)^2",
            [12, 9],
            "translation weight",
        ),
        (
            "planar-fish",
            "SO(2) x R^2 x SO(2)^2",
            [5, 3],
            "translation weight root plane",
        ),
    ];
    for (name, group, [dimension, unknowns], reductions) in expected {
        let told = json(directory.path(), &["inspect", &shipped(name), "--json"]);
        assert_eq!(told["group"], group, "{name}");
        assert_eq!(told["dimension"], dimension, "{name}");
        assert_eq!(told["unknowns"], unknowns, "{name}");
        assert_eq!(told["overlaps"], Value::Array(vec![]), "{name}");
        let all = told["reductions"].as_array().unwrap();
        let taken = all.iter().filter(|reduction| reduction["taken"] == true);
        let taken: Vec<_> = taken
            .map(|reduction| reduction["name"].as_str().unwrap())
            .collect();
        assert_eq!(taken.join(" "), reductions, "{name}");
        assert!(
            all.iter()
                .all(|reduction| !reduction["why"].as_str().unwrap().is_empty())
        );
    }
}

#[test]
fn inspect_tells_what_acts_and_what_is_kept() {
    let directory = directory();
    let told = |name: &str| json(directory.path(), &["inspect", &shipped(name), "--json"]);
    let vehicle = told("loads/vehicle");
    assert_eq!(
        vehicle["acts"],
        serde_json::json!(["drag on vehicle", "thrust on vehicle"])
    );
    assert_eq!(vehicle["keeps"], serde_json::json!(["energy less work"]));
    // Drag is not linear in the velocity: the displacement stays among the unknowns.
    assert_eq!(vehicle["unknowns"], vehicle["full_dimension"]);
    let translation = &vehicle["reductions"][0];
    assert_eq!(
        (&translation["name"], &translation["taken"]),
        (&"translation".into(), &false.into())
    );
    let fish = told("fish-chain");
    assert_eq!(fish["acts"], serde_json::json!([]));
    let all = [
        "energy",
        "symplectic form",
        "linear momentum",
        "angular momentum",
    ];
    assert_eq!(fish["keeps"], serde_json::json!(all));
}

#[test]
fn inspect_tells_what_was_corrected_in_the_file() {
    let directory = directory();
    let scene = "fluid.density = 1
body = [{ name = 'hull', semi_axes = [1, 1, 1], attitude = [1.0004, 0, 0, 0] }]";
    fs::write(directory.path().join("s.toml"), scene).unwrap();
    let told = json(directory.path(), &["inspect", "s.toml", "--json"]);
    let note = &told["notes"][0];
    assert_eq!(note["body"], "hull");
    assert_eq!(note["key"], "body.attitude");
    assert_eq!(note["line"], 2);
    assert_eq!(note["correction"], "normalised");
    assert!(
        (note["off"].as_f64().unwrap() - 4e-4).abs() < 1e-12,
        "{note}"
    );
    assert_eq!(told["notes"].as_array().unwrap().len(), 1);
    let text = lgvi(directory.path(), &["inspect", "s.toml"]).stdout;
    let line = "note  line 2: body.attitude of \"hull\" was normalised: its length differed from 1 by 4.0e-4";
    assert!(self::text(&text).ends_with(&format!("\n\n{line}\n")));
    let exact = json(
        directory.path(),
        &["inspect", &shipped("fish-chain"), "--json"],
    );
    assert_eq!(exact["notes"], Value::Array(vec![]));
}

#[test]
fn a_reduction_that_would_be_approximate_is_refused_with_its_defect() {
    let directory = directory();
    let scene = fs::read_to_string(shipped("planar-fish")).unwrap();
    let tilted = scene.replace("joint_rate = [0, 0, 1.5]", "joint_rate = [0, 1.5e-3, 1.5]");
    assert_ne!(tilted, scene);
    fs::write(directory.path().join("s.toml"), tilted).unwrap();
    let output = lgvi(directory.path(), &["inspect", "s.toml"]);
    let told = text(&output.stdout);
    assert!(told.contains("unknowns of a step  9 of 12"), "{told}");
    for word in [
        "no motion in a coordinate plane",
        "an angular velocity is not along the normal (\"tail\")",
        "1.0e-3",
        "N m",
    ] {
        assert!(told.contains(word), "{word}: {told}");
    }
}

#[test]
fn the_motion_is_the_same_without_reductions() {
    let directory = directory();
    // On another root lgvi is another method, by its own error.
    let accurate = ["--method", "gauss-8", "--step", "0.05"].as_slice();
    let papers = ["--method", "lgvi", "--step", "0.001"].as_slice();
    let scenes = [
        ("fish-chain", papers),
        ("one-ellipsoid", papers),
        ("dry-chain", papers),
        ("planar-fish", accurate),
    ];
    for (name, method) in scenes {
        let scene = shipped(name);
        let run = |out: &str, more: &[&str]| {
            let args = [
                "run", &scene, "--until", "10", "--every", "1000", "--out", out,
            ];
            let summary = json(
                directory.path(),
                &[&args, method, more, &["--json"]].concat(),
            );
            let (_, rows) = table(&directory.path().join(out));
            (summary, numbers(rows.last().unwrap()))
        };
        let (reduced, full) = (run("reduced.csv", &[]), run("full.csv", &["--full"]));
        assert!(
            reduced.0["unknowns"].as_u64() < full.0["unknowns"].as_u64(),
            "{name}"
        );
        // What two forms of one method differ by after 10 s.
        for (a, b) in reduced.1.iter().zip(&full.1) {
            assert!((a - b).abs() < 1e-9, "{name}: {a} {b}");
        }
    }
}

#[test]
fn another_scene_than_the_papers_is_run_at_an_accuracy() {
    let directory = directory();
    let run = |args: &[&str]| {
        let args = [&["run", "--until", "5"], args].concat();
        let output = lgvi(directory.path(), &args);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout).to_owned()
    };
    let (papers, other) = (shipped("fish-chain"), shipped("one-ellipsoid"));
    for args in [&[][..], &[papers.as_str()]] {
        let summary = run(args);
        assert!(
            summary.contains("0.001 s, the method's default"),
            "{summary}"
        );
        assert!(
            summary.contains("not estimated; --estimate does"),
            "{summary}"
        );
    }
    let summary = run(&[&other]);
    for words in [
        "1e-6 by default for this scene",
        "more steps",
        "--method lgvi --step 0.001",
    ] {
        assert!(summary.contains(words), "{words}: {summary}");
    }
    let summary = run(&[&other, "--method", "lgvi", "--step", "0.01", "--estimate"]);
    assert!(
        summary.contains("by steps of twice and four times"),
        "{summary}"
    );
    let summary = run(&[&other, "--accuracy", "1e-4", "--full"]);
    assert!(summary.contains("1e-4 asked for"), "{summary}");
}

#[test]
fn what_is_no_accuracy_is_refused() {
    for value in ["0", "-1", "nan", "inf", "2e2", "1.5"] {
        fails(
            &["run", "--accuracy", value, "--out", "a.csv"],
            2,
            &["--accuracy", "pi"],
        );
    }
    let scene = shipped("hard/one-body");
    let args = ["run", &scene, "--accuracy", "1e-6", "--out", "a.csv"];
    fails(
        &args,
        1,
        &["--accuracy", "out of reach", "holds up to t =", "run to"],
    );
}

/// The methods' own steps suit the paper's scene: these two were refused.
#[test]
fn a_default_step_suits_the_scene() {
    let directory = directory();
    for (name, method) in [("eel", "gauss-8"), ("branching-robot", "gauss-4")] {
        let args = ["run", &shipped(name), "--until", "3", "--method", method];
        let output = lgvi(directory.path(), &args);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let summary = text(&output.stdout);
        assert!(summary.contains("shortened for this scene"), "{summary}");
    }
}

#[test]
fn bodies_in_one_place_are_warned_of() {
    let directory = directory();
    // The sign of the tails' joints as the paper prints it.
    let slipped = SCENE
        .replace("at_child = [-5.5, 0, 0]", "at_child = [5.5, 0, 0]")
        .replace(
            "at_parent = [-8.8, 0, 0]\nat_child = [5.5, 0, 0]",
            "at_parent = [-8.8, 0, 0]\nat_child = [-5.5, 0, 0]",
        );
    fs::write(directory.path().join("s.toml"), slipped).unwrap();
    for args in [
        &["run", "s.toml", "--until", "0.1"][..],
        &["inspect", "s.toml"],
    ] {
        let output = lgvi(directory.path(), args);
        let warnings = text(&output.stderr);
        assert!(output.status.success(), "{warnings}");
        let first = r#"warning: bodies "head" and "tail-1" overlap by 9.7 m"#;
        assert!(warnings.starts_with(first), "{warnings}");
    }
}

#[test]
fn under_gravity_the_summary_judges_what_is_kept() {
    let directory = directory();
    let scene = shipped("branching-robot");
    let summary = json(directory.path(), &["run", &scene, "--until", "2", "--json"]);
    assert_eq!(summary["gravity_acts"], true);
    assert_eq!(summary["reductions"], serde_json::json!(["translation"]));
    let of = |key: &str| summary[key].as_f64().unwrap();
    // Momenta grow to 4e1 kg m/s in 2000 steps: their rounding is a random walk.
    assert!(of("linear_momentum_deviation_max") < 1e-11, "{summary}");
    assert!(of("angular_momentum_deviation_max") < 1e-11, "{summary}");
    let text = lgvi(directory.path(), &["run", &scene, "--until", "0.1"]).stdout;
    let text = self::text(&text);
    for words in ["plus weight times time", "about the vertical"] {
        assert!(text.contains(words), "{text}");
    }
}

#[test]
fn a_dash_is_no_file() {
    fails(
        &["run", "--until", "1", "--out", "-"],
        2,
        &["stdout", "./-"],
    );
}
