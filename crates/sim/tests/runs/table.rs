//! The table, and the file it is in.

use std::fs;
use std::io::Write;

use sim::file::{AtomicFile, FileError, is_same};
use sim::table::COLUMNS;
use sim::{Frame, Plan, Schedule, Simulation, Table};

use crate::{falling, paper};

/// The header, and the rows as numbers.
fn read(text: &str) -> (Vec<&str>, Vec<Vec<f64>>) {
    let mut lines = text.lines();
    let header = lines.next().unwrap().split(',').collect();
    let numbers = |line: &str| {
        line.split(',')
            .map(|field| field.parse().unwrap())
            .collect()
    };
    (header, lines.map(numbers).collect())
}

#[test]
fn the_columns_are_the_frames_to_the_last_digit() {
    let scene = paper();
    let plan = Plan {
        until: 20.0,
        schedule: Schedule::Seconds(0.5),
        ..Plan::default()
    };
    let simulation = Simulation::new(&scene, &plan).unwrap();
    let frames: Vec<Frame> = simulation.map(Result::unwrap).collect();
    let mut table = Table::new(vec![], &scene).unwrap();
    frames.iter().for_each(|frame| table.row(frame).unwrap());
    let text = String::from_utf8(table.into_inner()).unwrap();
    let (header, rows) = read(&text);
    assert_eq!(rows.len(), frames.len());
    let mut last = vec![[0.0; 4]; 3];
    for (row, frame) in rows.iter().zip(&frames) {
        assert_eq!(row.len(), header.len());
        let at = |name: &str| row[header.iter().position(|column| *column == name).unwrap()];
        let three = |names: [&str; 3]| names.map(at);
        assert_eq!(at("t"), frame.state.t);
        assert_eq!(three(["x", "y", "z"]), frame.state.g.1[0].0);
        assert_eq!(at("energy"), frame.sample.energy);
        assert_eq!(three(["px", "py", "pz"]), frame.sample.linear.0);
        assert_eq!(three(["lx", "ly", "lz"]), frame.sample.angular.0);
        assert_eq!(at("orthogonality"), frame.sample.orthogonality);
        let bodies = scene
            .bodies
            .iter()
            .zip(frame.attitudes().iter().zip(frame.rates()));
        for ((body, (attitude, rate)), last) in bodies.zip(&mut last) {
            let of = |column: &str| at(&format!("{}.{column}", body.name));
            assert_eq!(["wx", "wy", "wz"].map(of), rate.0);
            let (found, q) = (["qw", "qx", "qy", "qz"].map(of), attitude.to_quaternion());
            assert!(found == q || found == q.map(|x| -x));
            let turn: f64 = found.iter().zip(&*last).map(|(a, b)| a * b).sum();
            assert!(turn >= 0.0);
            *last = found;
        }
    }
    assert!(
        frames
            .iter()
            .any(|frame| frame.attitudes().iter().any(|r| r.to_quaternion()[0] < 0.1))
    );
}

#[test]
fn each_column_is_told_of_and_named_once() {
    let mut table = Table::new(vec![], &falling()).unwrap();
    let plan = Plan {
        until: 0.1,
        ..Plan::default()
    };
    let mut simulation = Simulation::new(&falling(), &plan).unwrap();
    table.row(&simulation.next().unwrap().unwrap()).unwrap();
    let text = String::from_utf8(table.into_inner()).unwrap();
    let (header, _) = read(&text);
    let mut names = header.clone();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), header.len());
    for column in COLUMNS {
        assert!(!column.meaning.is_empty(), "{column:?}");
        for name in column.names {
            let is_of = |found: &&str| found == name || found.ends_with(&format!(".{name}"));
            assert!(header.iter().any(is_of), "{name}");
        }
    }
    let labels: Vec<_> = COLUMNS.iter().map(|column| column.label()).collect();
    assert_eq!(labels[1..3], ["x,y,z", "NAME.qw,.qx,.qy,.qz"]);
}

#[test]
fn a_frame_of_another_scene_is_no_row() {
    let mut table = Table::new(vec![], &falling()).unwrap();
    let mut simulation = Simulation::new(&paper(), &Plan::default()).unwrap();
    let frame = simulation.next().unwrap().unwrap();
    let error = table.row(&frame).unwrap_err();
    assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput);
}

#[test]
fn a_file_is_whole_or_not_there() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.csv");
    let write = |text: &str| {
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(text.as_bytes()).unwrap();
        file
    };
    drop(write("lost"));
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
    write("old").finish().unwrap();
    drop(write("lost"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    write("new").finish().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    assert!(is_same(&path, &directory.path().join("./a.csv")));
    let error = AtomicFile::create(directory.path()).err().unwrap();
    assert!(matches!(error, FileError::Directory), "{error}");
}
