//! The laws of the loop.

use articulated_fluid::Scene;
use dvi::Integrator;
use sim::{CHUNK, Choice, Clock, Frame, Method, Plan, Run, Schedule, SimError, Simulation};

use crate::{falling, paper};

/// A method in steps of a size, by its name.
fn of(name: &str, step: f64) -> Choice {
    let step = Some(step);
    let method = name.parse().unwrap();
    Choice::Method { method, step }
}

fn frames(scene: &Scene, plan: &Plan) -> Vec<Frame> {
    let simulation = Simulation::new(scene, plan).unwrap();
    simulation.map(Result::unwrap).collect()
}

#[test]
fn frames_begin_at_zero_and_end_exactly_at_the_end() {
    for until in [0.7, 1.0, 1.1] {
        for (step, schedule, count) in [
            (0.003, Schedule::Steps(50), None),
            (0.1, Schedule::Steps(u64::MAX), Some(2)),
            (
                0.07,
                Schedule::Seconds(0.1),
                Some((until * 10.0) as usize + 1),
            ),
            (5.0, Schedule::Seconds(1e300), Some(2)),
        ] {
            let choice = of("gauss-6", f64::min(step, 0.25));
            let plan = Plan {
                choice,
                until,
                schedule,
                ..Plan::default()
            };
            let mut simulation = Simulation::new(&paper(), &plan).unwrap();
            let times: Vec<f64> = simulation
                .by_ref()
                .map(|frame| frame.unwrap().t())
                .collect();
            assert_eq!((times[0], times[times.len() - 1]), (0.0, until), "{plan:?}");
            assert!(times.is_sorted_by(|a, b| a < b), "{times:?}");
            assert!(
                count.is_none_or(|count| times.len() == count),
                "{plan:?}: {times:?}"
            );
            assert!(simulation.is_done() && simulation.next().is_none());
            assert_eq!(simulation.state().t, until);
            assert_eq!(simulation.report().samples, times.len() as u64);
        }
    }
}

#[test]
fn a_state_does_not_depend_on_the_frames_before() {
    for scene in [paper(), falling()] {
        let every = |schedule| {
            let choice = of("lgvi", 0.001);
            let plan = Plan {
                choice,
                until: 0.7,
                schedule,
                ..Plan::default()
            };
            frames(&scene, &plan)
        };
        let each = every(Schedule::Steps(1));
        for n in [3, 7, 100, 350, 699] {
            for (k, frame) in every(Schedule::Steps(n)).iter().enumerate() {
                assert_eq!(*frame, each[(k * n as usize).min(700)], "{n}: {k}");
            }
        }
    }
}

#[test]
fn a_run_does_not_depend_on_its_chunks() {
    let scene = falling();
    let run = |chunk: u64| {
        let integrator = Method::default().integrator_of_smallest(&scene.smallest().unwrap());
        let clock = Clock::new(0.7, 0.001).unwrap();
        let mut run = Run::new(integrator, scene.initial_state().unwrap(), clock);
        for stop in (chunk..=700).step_by(chunk as usize).chain([700]) {
            run.advance(stop).unwrap();
        }
        (run.state().clone(), run.cost().iterations, run.cost().steps)
    };
    let whole = run(700);
    assert_eq!((whole.0.t, whole.2), (0.7, 700));
    for chunk in [1, 7, 100, 699] {
        assert_eq!(run(chunk), whole, "{chunk}");
    }
}

#[test]
fn a_run_that_is_stopped_says_where_it_is() {
    let scene = paper();
    let plan = Plan {
        schedule: Schedule::Steps(1_000_000),
        ..Plan::default()
    };
    let mut simulation = Simulation::new(&scene, &plan).unwrap();
    assert_eq!(
        simulation.advance().unwrap().map(|frame| frame.t()),
        Some(0.0)
    );
    for call in 1..=3 {
        assert_eq!(simulation.advance().unwrap(), None);
        assert_eq!(simulation.steps(), call * CHUNK);
    }
    let report = simulation.report();
    assert_eq!(
        (report.steps, report.samples, report.until_seconds),
        (300, 1, 100.0)
    );
    assert!(!simulation.is_done());

    let mut integrator = Method::default().integrator_of_smallest(&scene.smallest().unwrap());
    let mut state = scene.initial_state().unwrap();
    for _ in 0..300 {
        integrator.step(&mut state, 0.001).unwrap();
    }
    state.t = 0.3;
    assert_eq!(*simulation.state(), state);
}

#[test]
fn a_refused_step_leaves_the_last_good_state_and_ends_the_run() {
    // Solved for a while, until the motion is too fast for it.
    let plan = Plan {
        choice: of("lgvi", 0.16),
        schedule: Schedule::Steps(1),
        ..Plan::default()
    };
    let mut simulation = Simulation::new(&paper(), &plan).unwrap();
    let mut last = None;
    let error = loop {
        match simulation.next().expect("a frame or an error") {
            Ok(frame) => last = Some(frame.state),
            Err(error) => break error,
        }
    };
    let SimError::Step {
        step,
        t,
        ref source,
    } = error
    else {
        panic!("{error}");
    };
    assert!(step > 0 && t > 0.0, "{error}");
    assert_eq!(error.to_string(), source.to_string());
    assert_eq!(
        (simulation.steps(), simulation.report().steps),
        (step, step)
    );
    assert_eq!(Some(simulation.state()), last.as_ref());
    assert_eq!(simulation.state().t, t);
    assert!((t - 0.16 * step as f64).abs() < 1e-9 * t);
    assert!(simulation.is_done() && simulation.next().is_none());
    assert_eq!(simulation.advance(), Ok(None));
}

#[test]
fn what_makes_no_run_is_refused() {
    let refused = |plan: Plan| Simulation::new(&paper(), &plan).err().expect("an error");
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for plan in [
            Plan {
                until: value,
                ..Plan::default()
            },
            Plan {
                choice: of("lgvi", value),
                ..Plan::default()
            },
            Plan {
                schedule: Schedule::Seconds(value),
                ..Plan::default()
            },
        ] {
            let error = refused(plan);
            assert!(matches!(error, SimError::NotPositive { .. }), "{error}");
        }
        let choice = Choice::Accuracy(value);
        let error = refused(Plan {
            choice,
            ..Plan::default()
        });
        assert!(matches!(error, SimError::Pilot(_)), "{error}");
    }
    let schedule = Schedule::Steps(0);
    let error = refused(Plan {
        schedule,
        ..Plan::default()
    });
    assert!(matches!(error, SimError::NotPositive { .. }), "{error}");
    let error = refused(Plan {
        choice: of("lgvi", 1e-20),
        ..Plan::default()
    });
    assert!(matches!(error, SimError::TooManySteps { .. }), "{error}");
    let schedule = Schedule::Seconds(1e-20);
    let error = refused(Plan {
        schedule,
        ..Plan::default()
    });
    assert!(matches!(error, SimError::TooManySamples { .. }), "{error}");
}

#[test]
fn a_start_beyond_all_numbers_is_refused() {
    let mut scene = paper();
    scene.bodies[0].angular_velocity[0] = 1e200;
    let error = Simulation::new(&scene, &Plan::default()).err();
    assert_eq!(
        error,
        Some(SimError::NotFinite {
            t: 0.0,
            quantity: "energy"
        })
    );
}

#[test]
fn an_accuracy_and_all_coordinates_give_the_same_motion() {
    let run = |choice, full| {
        let plan = Plan {
            choice,
            until: 5.0,
            full,
            ..Plan::default()
        };
        let mut simulation = Simulation::new(&paper(), &plan).unwrap();
        let end = simulation.by_ref().last().unwrap().unwrap();
        (end, simulation.report())
    };
    let (exact, _) = run(of("gauss-8", 0.05), false);
    for full in [false, true] {
        let (end, report) = run(Choice::Accuracy(1e-8), full);
        assert_eq!(report.accuracy_asked, Some(1e-8));
        assert!(report.accuracy_estimate < Some(1e-8));
        assert_eq!(
            (report.unknowns, report.reductions.is_empty()),
            if full { (12, true) } else { (9, false) }
        );
        for (a, b) in end.bodies.attitudes.iter().zip(&exact.bodies.attitudes) {
            assert!((*a.matrix() - *b.matrix()).frobenius() < 1e-7);
        }
    }
}

#[test]
fn a_report_is_one_object_of_numbers_with_their_units() {
    let plan = Plan {
        until: 0.1,
        ..Plan::default()
    };
    let mut simulation = Simulation::new(&paper(), &plan).unwrap();
    assert!(simulation.by_ref().all(|frame| frame.is_ok()));
    let report = serde_json::to_value(simulation.report()).unwrap();
    for (key, value) in [
        ("method", "lgvi".into()),
        ("method_order", 1.into()),
        ("steps", 100.into()),
        ("step_seconds", 0.001.into()),
        ("samples", 11.into()),
        ("sample_every_steps", 10.into()),
        ("sample_every_seconds", serde_json::Value::Null),
        (
            "evaluation",
            "derivatives of the discrete Lagrangian".into(),
        ),
        ("reductions", ["translation", "weight"].as_slice().into()),
    ] {
        assert_eq!(report[key], value, "{key}");
    }
    let method = serde_json::to_value(simulation.method()).unwrap();
    assert_eq!(
        (&method["name"], &method["stages"]),
        (&"lgvi".into(), &serde_json::Value::Null)
    );
}

#[test]
fn a_simulation_goes_to_another_thread() {
    let plan = Plan {
        until: 0.1,
        ..Plan::default()
    };
    let simulation = Simulation::new(&paper(), &plan).unwrap();
    let frames = std::thread::spawn(move || simulation.count()).join();
    assert_eq!(frames.unwrap(), 11);
}

#[test]
fn a_run_beyond_the_end_of_a_table_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(
        directory.path().join("stroke.csv"),
        "t,angle\n0,0\n1,0.5\n2,0.1\n",
    )
    .unwrap();
    let text = "
        fluid.density = 1000
        body = [{ name = 'head', semi_axes = [0.3, 0.05, 0.1] }, { name = 'tail', semi_axes = [0.2, 0.03, 0.1] }]
        joint = [{ parent = 'head', child = 'tail', at_parent = [-0.32, 0, 0], at_child = [0.22, 0, 0], type = 'hinge', axis = [0, 0, 1],
          motion = { file = 'stroke.csv' } }]
    ";
    let path = directory.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    let scene = Scene::load(&path).unwrap();
    let run = |until: f64| {
        let plan = Plan {
            choice: Choice::Accuracy(1e-6),
            until,
            ..Plan::default()
        };
        Simulation::new(&scene, &plan).map(|mut run| run.by_ref().all(|frame| frame.is_ok()))
    };
    let refused = run(2.5).expect_err("no motion is told there");
    assert!(
        matches!(refused, SimError::Untold { to: 2.0, .. }),
        "{refused}"
    );
    assert_eq!(run(2.0), Ok(true));
}

/// A hinge that flaps at 1 Hz, and later than a default step looks at turns by 9 rad in a twentieth of a second.
///
/// Without momentum the motion is regular: another rounding does not lead to where an earlier step is not solved.
fn spike() -> Scene {
    let directory = tempfile::tempdir().unwrap();
    let folder = directory.path();
    let row = |k: i32| {
        let t = 0.01 * f64::from(k);
        format!(
            "{t},{}\n",
            0.3 * (6.0 * t).sin() + 4.5 * ((t - 105.0) / 0.02).tanh()
        )
    };
    let rows: String = (0..=11_000).map(row).collect();
    std::fs::write(folder.join("spike.csv"), format!("t,angle\n{rows}")).unwrap();
    let text = "
        fluid.density = 1000
        start.momentum = 'zero'
        body = [{ name = 'a', semi_axes = [0.3, 0.05, 0.1] }, { name = 'b', semi_axes = [0.2, 0.03, 0.1] },
                { name = 'c', semi_axes = [0.2, 0.03, 0.1] }]
        joint = [{ parent = 'a', child = 'b', at_parent = [-0.32, 0, 0], at_child = [0.22, 0, 0], type = 'hinge', axis = [0, 0.2, 1], motion = { file = 'spike.csv' } },
                 { parent = 'b', child = 'c', at_parent = [-0.22, 0, 0], at_child = [0.22, 0, 0], type = 'fixed' }]
    ";
    std::fs::write(folder.join("spike.toml"), text).unwrap();
    Scene::load(&folder.join("spike.toml")).unwrap()
}

/// The frames are those of the schedule, none twice, and the works add up, wherever the step was halved.
#[test]
fn a_default_step_that_is_not_solved_is_halved_on_the_way() {
    let scene = spike();
    for schedule in [Schedule::Seconds(0.37), Schedule::Steps(1)] {
        let plan = Plan {
            choice: Method::gauss(8).unwrap().into(),
            until: 110.0,
            schedule,
            ..Plan::default()
        };
        let mut simulation = Simulation::new(&scene, &plan).unwrap();
        let frames: Vec<_> = simulation.by_ref().collect::<Result<_, _>>().unwrap();
        let report = simulation.report();
        let halved = report.step_shortened_at_seconds;
        assert!(halved.is_some_and(|t| t > 103.0 && t < 105.5), "{halved:?}");
        assert!(report.step_halvings > 0 && simulation.is_done());
        assert_eq!(report.samples, frames.len() as u64);
        for pair in frames.windows(2) {
            assert!(pair[1].t() > pair[0].t());
            let gained = pair[1].drives[0].work - pair[0].drives[0].work;
            let mean = pair[1].drives[0].power * (pair[1].t() - pair[0].t());
            assert!((gained - mean).abs() < 1e-9 * (1.0 + gained.abs()));
        }
        assert_eq!(frames.last().unwrap().t(), 110.0);
        if let Schedule::Seconds(every) = schedule {
            assert_eq!(frames.len(), (110.0_f64 / every) as usize + 2);
            for (k, frame) in frames.iter().rev().skip(1).rev().enumerate() {
                assert_eq!(frame.t(), k as f64 * every);
            }
        }
    }
}

/// The pose of what has no unknown is exact at any step: what is asked holds for the work too.
#[test]
fn an_accuracy_of_a_scene_without_unknowns_is_that_of_its_work() {
    let text = "
        fluid.density = 1000
        body = [{ name = 'a', semi_axes = [0.3, 0.05, 0.1] }, { name = 'b', semi_axes = [0.2, 0.03, 0.1] }]
        joint = [{ parent = 'world', child = 'a', at_parent = [0, 0, 0], at_child = [0.1, 0, 0], type = 'fixed', place = { amplitude = [0, 0.1, 0.05], frequency = 8 } },
                 { parent = 'a', child = 'b', at_parent = [-0.32, 0, 0], at_child = [0.22, 0, 0], motion = { amplitude = [0.2, 0.3, 0.5], frequency = 8, phase = [0, 1, 2] } }]
    ";
    let scene = Scene::parse(text, "driven.toml").unwrap();
    for choice in [Choice::Accuracy(1e-6), Method::gauss(8).unwrap().into()] {
        let plan = Plan {
            choice,
            until: 2.0,
            ..Plan::default()
        };
        let mut simulation = Simulation::new(&scene, &plan).unwrap();
        assert!(simulation.by_ref().all(|frame| frame.is_ok()));
        let off = simulation.report().energy_error_max_relative.unwrap();
        assert!(off < 2e-6, "{choice:?}: {off:e}");
    }
}
