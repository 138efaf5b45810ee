//! The table.

use articulated_fluid::scene::{Form, SceneBody};
use articulated_fluid::{Ellipsoid, Scene};
use lie::Vec3;
use proptest::prelude::*;
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
        let bodies = scene.bodies.iter().zip(
            frame
                .bodies
                .attitudes
                .iter()
                .zip(frame.bodies.rates.iter().copied()),
        );
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
    assert!(frames.iter().any(|frame| {
        frame
            .bodies
            .attitudes
            .iter()
            .any(|r| r.to_quaternion()[0] < 0.1)
    }));
}

/// A scene with every kind of column.
/// A scene that has something of every column: hinges, a drive, drag and thrust.
fn loaded() -> Scene {
    let text = "
        fluid.density = 1000
        body = [{ name = 'a', semi_axes = [0.3, 0.05, 0.1], drag = { linear = [1, 2, 3] }, thrust = { force = [1, 0, 0] } },
                { name = 'b', semi_axes = [0.2, 0.03, 0.1] }, { name = 'c', semi_axes = [0.2, 0.03, 0.1] }]
        joint = [{ parent = 'a', child = 'b', at_parent = [-0.32, 0, 0], at_child = [0.22, 0, 0], type = 'hinge', axis = [0, 0, 1], damping = 0.1 },
                 { parent = 'b', child = 'c', at_parent = [-0.22, 0, 0], at_child = [0.22, 0, 0], motion = { amplitude = [0, 0.2, 0.5], frequency = 1 } }]
    ";
    Scene::parse(text, "loaded.toml").unwrap()
}

#[test]
fn each_column_is_told_of_and_named_once() {
    let mut table = Table::with_all_columns(vec![], &loaded()).unwrap();
    let plan = Plan {
        until: 0.1,
        ..Plan::default()
    };
    let mut simulation = Simulation::new(&loaded(), &plan).unwrap();
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
    for name in ["b.work", "c.work", "drag_work", "thrust_work"] {
        assert!(header.contains(&name), "{name}");
    }
    let labels: Vec<_> = COLUMNS.iter().map(|column| column.label()).collect();
    assert_eq!(labels[1..4], ["x,y,z", "vx,vy,vz", "NAME.qw,.qx,.qy,.qz"]);
}

#[test]
fn a_frame_of_another_scene_is_no_row() {
    let mut table = Table::new(vec![], &falling()).unwrap();
    let mut simulation = Simulation::new(&paper(), &Plan::default()).unwrap();
    let frame = simulation.next().unwrap().unwrap();
    let error = table.row(&frame).unwrap_err();
    assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput);
}

/// The numbers of the extra columns follow from those that are always there, and from the scene.
#[test]
fn the_extra_columns_are_those_of_the_motion() {
    for scene in [paper(), falling()] {
        let plan = Plan {
            until: 2.0,
            schedule: Schedule::Seconds(1e-4),
            ..Plan::default()
        };
        let frames = Simulation::new(&scene, &plan).unwrap();
        let mut table = Table::with_all_columns(vec![], &scene).unwrap();
        frames.for_each(|frame| table.row(&frame.unwrap()).unwrap());
        let text = String::from_utf8(table.into_inner()).unwrap();
        let (header, rows) = read(&text);
        let index = |name: String| header.iter().position(|column| *column == name).unwrap();
        let three =
            |row: &[f64], names: [&str; 3]| Vec3(names.map(|name| row[index(name.to_owned())]));
        let body = |row: &[f64], i: usize| {
            let name = &scene.bodies[i].name;
            Vec3(["x", "y", "z"].map(|axis| row[index(format!("{name}.{axis}"))]))
        };
        for row in &rows {
            let (c, l) = (
                three(row, ["cx", "cy", "cz"]),
                three(row, ["lx", "ly", "lz"]),
            );
            let (p, about) = (
                three(row, ["px", "py", "pz"]),
                three(row, ["lcx", "lcy", "lcz"]),
            );
            // The carried momentum and that of the velocities differ by the rounding of the steps.
            assert!((l - c.cross(p) - about).norm() <= 1e-11 * (1.0 + l.norm()));
            let (mut sum, mut masses) = (Vec3::zero(), 0.0);
            for (i, scene_body) in scene.bodies.iter().enumerate() {
                let total = [0, 1, 2].map(|k| scene_body.total_mass[k][k]);
                let mass = scene_body.mass().unwrap_or(total.iter().sum::<f64>() / 3.0);
                (sum, masses) = (sum + body(row, i) * mass, masses + mass);
            }
            assert!((sum * (1.0 / masses) - c).norm() <= 1e-13 * (1.0 + c.norm()));
        }
        for three_rows in rows.windows(3) {
            let [before, now, after] = three_rows else {
                continue;
            };
            let moved = (body(after, 0) - body(before, 0)) * (1.0 / (after[0] - before[0]));
            let v = three(now, ["vx", "vy", "vz"]);
            // The rows' own step and that of the method, both of 1e-4 to 1e-3 s.
            assert!(
                (moved - v).norm() < 1e-2 * (1.0 + v.norm()),
                "{moved:?} {v:?}"
            );
        }
    }
}

/// The fields of a line of CSV, as RFC 4180 has them.
fn fields(line: &str) -> Vec<String> {
    let (mut fields, mut is_quoted) = (vec![String::new()], false);
    let mut rest = line.chars().peekable();
    while let Some(c) = rest.next() {
        let field = fields.last_mut().unwrap();
        match c {
            '"' if is_quoted && rest.peek() == Some(&'"') => field.extend(rest.next()),
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(String::new()),
            c => field.push(c),
        }
    }
    fields
}

fn named(names: &[String]) -> Scene {
    let shape = Ellipsoid::new([3.0, 2.0, 1.0]).unwrap();
    let body = |name: &String| SceneBody::ellipsoid(name, &shape, 1.0, 0.0);
    Scene {
        bodies: names.iter().map(body).collect(),
        joints: vec![],
        ..paper()
    }
}

proptest! {
    /// Whatever the bodies of a scene made by hand are called: what follows a column's last dot is the column, and the rest is the name.
    #[test]
    fn any_name_is_read_back(names in prop::collection::vec("[a-c,\"\n./ _é-]{0,8}", 1..4)) {
        let table = Table::with_all_columns(vec![], &named(&names)).unwrap();
        let text = String::from_utf8(table.into_inner()).unwrap();
        let found = fields(text.strip_suffix('\n').unwrap());
        let found = found.iter().filter_map(|field| field.rsplit_once('.'));
        let expected: Vec<&str> = names.iter().flat_map(|name| [name.as_str(); 10]).collect();
        prop_assert_eq!(found.map(|(name, _)| name).collect::<Vec<_>>(), expected);
    }
}

#[test]
fn the_centre_is_that_of_the_own_masses_if_all_are_known() {
    let mut scene = named(&["a".into(), "b".into()]);
    let shape = Ellipsoid::new([3.0, 2.0, 1.0]).unwrap();
    scene.bodies[1] = SceneBody::ellipsoid("b", &shape, 3.0, 100.0);
    assert_eq!(scene.centre_masses(), [1.0, 3.0]);
    scene.bodies[1].total_mass = [[4.0, 0.0, 0.0], [0.0, 5.0, 0.0], [0.0, 0.0, 9.0]];
    let given = |mass| Form::Given {
        shape: None,
        mass,
        inertia: None,
    };
    scene.bodies[1].form = given(Some(2.0));
    assert_eq!(scene.centre_masses(), [1.0, 2.0]);
    scene.bodies[1].form = given(None);
    assert_eq!(scene.centre_masses(), [1.0, 6.0]);
}
