//! What a report says of errors.

use sim::{Choice, Method, Plan, Report, Schedule, Simulation, distance};

use crate::{paper, scene};

fn of(name: &str, step: Option<f64>) -> Choice {
    let method = name.parse().unwrap();
    Choice::Method { method, step }
}

fn report(name: &str, plan: Plan) -> Report {
    let mut simulation = Simulation::new(&scene(name), &plan).unwrap();
    assert!(simulation.by_ref().all(|frame| frame.is_ok()));
    simulation.report()
}

/// By samples alone the robot's error was 5.3e-1 J of every step, and 3.9e-1 J of every hundredth.
#[test]
fn errors_are_over_all_steps_whatever_is_sampled() {
    let of = |schedule| {
        let choice = of("lgvi", Some(0.001));
        let plan = Plan {
            choice,
            until: 2.0,
            schedule,
            ..Plan::default()
        };
        let mut report = report("branching-robot", plan);
        (
            report.samples,
            report.sample_every_steps,
            report.sample_every_seconds,
        ) = (0, None, None);
        report.time_per_step_us = 0.0;
        report
    };
    let each = of(Schedule::Steps(1));
    assert!(each.energy_error_max_joules > 0.0);
    for schedule in [
        Schedule::Steps(10),
        Schedule::Steps(1999),
        Schedule::Steps(u64::MAX),
    ] {
        assert_eq!(of(schedule), each, "{schedule:?}");
    }
}

/// At the start and at the end of a period all is at rest.
#[test]
fn an_error_is_relative_to_the_largest_kinetic_energy_of_the_run() {
    let choice = of("gauss-4", None);
    let plan = Plan {
        choice,
        until: 5.0,
        schedule: Schedule::Steps(u64::MAX),
        ..Plan::default()
    };
    let report = report("hard/from-rest", plan);
    assert_eq!(report.samples, 2);
    let ratio = report.energy_error_max_joules / report.energy_kinetic_max_joules;
    assert_eq!(report.energy_error_max_relative, Some(ratio));
    assert!(ratio < 1e-2, "{ratio}");
}

/// A trajectory that is 0.7 rad off, with an energy to rounding, has an estimate that says so.
#[test]
fn an_estimate_is_near_the_error() {
    for (name, method, step, until) in [
        ("one-ellipsoid", "lgvi", 0.05, 20.0),
        ("one-ellipsoid", "lgvi", 0.001, 20.0),
        ("one-ellipsoid", "composition-4", 0.1, 20.0),
        ("fish-chain", "lgvi", 0.001, 10.0),
        ("fish-chain", "gauss-2", 0.05, 10.0),
    ] {
        let run = |choice| {
            let plan = Plan {
                choice,
                until,
                estimate: true,
                schedule: Schedule::Steps(1),
                ..Plan::default()
            };
            let mut simulation = Simulation::new(&scene(name), &plan).unwrap();
            let states: Vec<_> = simulation
                .by_ref()
                .map(|frame| frame.unwrap().state)
                .collect();
            (states, simulation.report())
        };
        let (states, report) = run(of(method, Some(step)));
        let (exact, _) = run(of("gauss-8", Some(step)));
        let pairs = states.iter().zip(&exact);
        let error = pairs.map(|(a, b)| distance(&a.g, &b.g)).fold(0.0, f64::max);
        let estimate = report.trajectory_error_estimate.expect("an estimate");
        println!("{name}, {method} at {step} s: {error:.2e}, estimated {estimate:.2e}");
        assert!(
            (0.5..3.0).contains(&(estimate / error)),
            "{name}, {method}: {error:e}, {estimate:e}"
        );
        // Three quarters of the steps, but for those inside of others.
        let extra = report.estimate_steps.expect("steps") as f64 / report.steps as f64;
        assert!((0.7..0.8).contains(&extra), "{extra}");
    }
}

#[test]
fn a_default_step_follows_from_the_scene() {
    for (name, method) in [
        ("eel", "gauss-8"),
        ("branching-robot", "gauss-4"),
        ("fish-chain", "gauss-8"),
    ] {
        let plan = Plan {
            choice: of(method, None),
            until: 2.0,
            ..Plan::default()
        };
        let simulation = Simulation::new(&scene(name), &plan).unwrap();
        let method: Method = method.parse().unwrap();
        let halvings = (method.default_step() / simulation.clock().asked()).log2();
        assert_eq!(halvings, halvings.round());
        assert_eq!(
            halvings == 0.0,
            scene(name) == paper(),
            "{name}: {halvings}"
        );
        assert!(simulation.last().unwrap().is_ok(), "{name}");
    }
}

/// Newton's matrices, of steps too long for sweeps, are the most of what such steps cost.
#[test]
fn evaluations_of_newtons_matrices_are_counted() {
    let evaluations = |step| {
        let method: Method = "gauss-4".parse().unwrap();
        let plan = Plan {
            choice: of("gauss-4", Some(step)),
            until: 4.0,
            ..Plan::default()
        };
        let report = report("fish-chain", plan);
        let of_sweeps =
            report.solver_iterations_mean * f64::from(method.evaluations_per_iteration());
        (report.evaluations_per_step_mean, of_sweeps)
    };
    let (all, sweeps) = evaluations(0.1);
    assert!((all - sweeps).abs() < 1e-9 * all, "{all} {sweeps}");
    let (all, sweeps) = evaluations(0.4);
    assert!(all > 2.0 * sweeps, "{all} {sweeps}");
}
