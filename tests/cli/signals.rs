//! Signals: a command ends soon, and leaves nothing; what a killed one leaves goes at the next run.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::{command, directory, files, lgvi, table, text};

/// A run without end.
const RUN: [&str; 7] = ["run", "--until", "1e6", "--every", "1000", "--out", "a.csv"];

/// Starts a command; it is at work once there are so many files.
fn started(directory: &Path, mut command: Command, count: usize) -> Child {
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = child.spawn().unwrap();
    wait(|| files(directory).len() >= count);
    child
}

/// Looks again and again, for ten minutes at most.
fn wait(mut is_so: impl FnMut() -> bool) {
    for _ in 0..60_000 {
        if is_so() {
            return;
        }
        sleep(Duration::from_millis(10));
    }
    panic!("it took too long");
}

fn send(signal: &str, child: &Child) {
    let id = child.id().to_string();
    let kill = Command::new("kill").args([signal, &id]).status().unwrap();
    assert!(kill.success());
}

#[track_caller]
fn ends(child: Child, code: i32, words: &str) -> String {
    let output = child.wait_with_output().unwrap();
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{message}");
    assert!(message.contains(words), "{message}");
    assert_eq!(text(&output.stdout), "");
    message.to_owned()
}

const SIGNALS: [(&str, i32); 3] = [("-INT", 130), ("-TERM", 143), ("-HUP", 129)];

#[test]
fn an_interrupted_run_leaves_nothing() {
    for (signal, code) in SIGNALS {
        let directory = directory();
        let child = started(directory.path(), command(directory.path(), &RUN), 1);
        send(signal, &child);
        let message = ends(child, code, "interrupted at t = ");
        let (_, t) = message.split_once("t = ").unwrap();
        let t: f64 = t.split(' ').next().unwrap().parse().unwrap();
        assert!((0.0..1e6).contains(&t), "{message}");
        assert_eq!(files(directory.path()), [""; 0]);
    }
}

/// Each would take hours: it ends in the midst of its work.
#[cfg(feature = "chart")]
#[test]
fn an_interrupted_experiment_leaves_nothing() {
    let chart = ["chart", "--until", "1e5"];
    let stability = [
        "stability",
        "--until",
        "1e9",
        "--budget",
        "1e6",
        "--values",
        "1",
    ];
    for (args, (signal, code)) in [&chart[..], &stability].into_iter().zip(SIGNALS) {
        let directory = directory();
        let child = started(directory.path(), command(directory.path(), args), 3);
        send(signal, &child);
        ends(child, code, "interrupted; nothing was written");
        assert_eq!(files(directory.path()), [""; 0]);
    }
}

/// As under `nohup`.
#[test]
fn a_signal_that_the_caller_ignores_stays_ignored() {
    let directory = directory();
    let mut shell = Command::new("sh");
    let line = "trap '' HUP; exec \"$@\"";
    let args = [&["-c", line, "sh", env!("CARGO_BIN_EXE_lgvi")], &RUN[..]].concat();
    shell.current_dir(directory.path()).args(args);
    let child = started(directory.path(), shell, 1);
    send("-HUP", &child);
    let part = directory.path().join(&files(directory.path())[0]);
    let size = || fs::metadata(&part).unwrap().len();
    let before = size();
    // Some hundreds of thousands of steps later.
    wait(|| size() > before + 200_000);
    send("-TERM", &child);
    ends(child, 143, "interrupted at t =");
}

#[test]
fn the_part_of_a_killed_run_goes_at_the_next_and_that_of_a_running_one_stays() {
    let directory = directory();
    let path = directory.path();
    let mut killed = started(path, command(path, &RUN), 1);
    killed.kill().unwrap();
    killed.wait().unwrap();
    let stale = files(path);
    assert!(stale.len() == 1 && stale[0].ends_with(".part"), "{stale:?}");

    let running = started(path, command(path, &RUN), 1);
    wait(|| files(path).len() == 1 && files(path) != stale);
    let part = files(path);
    let done = lgvi(path, &["run", "--until", "0.1", "--out", "b.csv"]);
    assert!(done.status.success());
    assert_eq!(files(path), [part[0].as_str(), "b.csv"]);
    assert!(table(&path.join("b.csv")).1.len() > 1);

    send("-INT", &running);
    ends(running, 130, "interrupted");
    assert_eq!(files(path), ["b.csv"]);
    fs::remove_file(path.join("b.csv")).unwrap();
}
