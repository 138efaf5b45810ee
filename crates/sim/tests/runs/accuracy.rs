//! What is asked holds at the end, or the run is refused.

use articulated_fluid::Scene;
use lie::{LieGroup, SO3, Tangent, Vec3};
use proptest::prelude::*;
use sim::{
    Choice, Frame, LARGEST_ACCURACY, Method, Plan, Report, Schedule, SimError, Simulation, distance,
};

use crate::{paper, scene};

/// The end of a run, without frames on the way.
fn end(scene: &Scene, choice: Choice, until: f64, full: bool) -> Result<(Frame, Report), SimError> {
    let plan = Plan {
        choice,
        until,
        schedule: Schedule::Steps(u64::MAX),
        full,
        ..Plan::default()
    };
    let mut simulation = Simulation::new(scene, &plan)?;
    let end = simulation.by_ref().last().expect("a frame")?;
    Ok((end, simulation.report()))
}

/// A free body with inertia (1, 1, c): its motion is known.
#[derive(Clone, Copy, Debug)]
struct Top {
    c: f64,
    omega: [f64; 3],
}

impl Top {
    fn scene(&self) -> Scene {
        let Self { c, omega } = self;
        let text = format!(
            "fluid.density = 0
             [[body]]
             name = 'top'
             mass = 1
             inertia = [1, 1, {c}]
             angular_velocity = {omega:?}"
        );
        Scene::parse(&text, "top.toml").unwrap()
    }

    /// $R(t) = \exp(t \mu) \exp(t \mu_3 (1/c - 1) e_3)$, by turns of less than a circle: their size keeps its digits.
    fn attitude(&self, t: f64) -> SO3 {
        let [x, y, z] = self.omega;
        let momentum = Vec3([x, y, self.c * z]);
        let precession = turn(momentum, t);
        let spin = turn(Vec3([0.0, 0.0, momentum.0[2] * (1.0 / self.c - 1.0)]), t);
        precession.compose(&spin)
    }
}

fn turn(rate: Vec3, t: f64) -> SO3 {
    let size = rate.norm();
    if size == 0.0 {
        return SO3::identity();
    }
    let angle = (size * t) % core::f64::consts::TAU;
    SO3::exp(&Tangent((rate * (angle / size)).0))
}

fn error(top: Top, accuracy: f64, until: f64) -> f64 {
    let (end, report) = end(&top.scene(), Choice::Accuracy(accuracy), until, false).unwrap();
    let mut exact = end.state.g.clone();
    exact.0[0] = top.attitude(until);
    let error = distance(&end.state.g, &exact);
    println!("{top:?}: {accuracy:e} over {until} s: {error:.1e}, {report:?}");
    error
}

/// The check over a short horizon alone was 1.43 rad off.
#[test]
fn a_symmetric_top_keeps_its_accuracy_for_ten_thousand_seconds() {
    let top = Top {
        c: 0.5,
        omega: [6.0, 0.0, 8.0],
    };
    assert!(error(top, 1e-3, 1e4) <= 2e-3);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    /// Between 1e-2 and 1e-8 rad, and between 10 and 1000 s.
    #[test]
    fn symmetric_tops_keep_any_accuracy(
        c in 0.2_f64..1.9,
        omega in prop::array::uniform3(-5.0_f64..5.0),
        digits in 2.0_f64..8.0,
        decades in 1.0_f64..3.0,
    ) {
        let (accuracy, top) = (10.0_f64.powf(-digits), Top { c, omega });
        let error = error(top, accuracy, 10.0_f64.powf(decades));
        prop_assert!(error <= 2.0 * accuracy);
    }
}

#[test]
fn an_accuracy_and_all_coordinates_go_together() {
    let exact = Choice::Method {
        method: Method::gauss(8).unwrap(),
        step: Some(0.05),
    };
    let (exact, _) = end(&paper(), exact, 20.0, false).unwrap();
    for full in [false, true] {
        let (end, report) = end(&paper(), Choice::Accuracy(1e-7), 20.0, full).unwrap();
        assert!(report.accuracy_estimate <= Some(1e-7));
        assert_eq!(report.accuracy_horizon_seconds, Some(20.0));
        assert!(report.accuracy_check_steps > Some(report.steps));
        assert!(distance(&end.state.g, &exact.state.g) <= 2e-7, "{full}");
    }
}

#[test]
fn more_than_a_radian_is_no_accuracy() {
    for accuracy in [1.5, 200.0, 1e9] {
        let error = end(&paper(), Choice::Accuracy(accuracy), 1.0, false).unwrap_err();
        assert_eq!(error, SimError::NoAccuracy { accuracy });
        assert!(error.to_string().contains("more than pi off"), "{error}");
    }
    assert!(end(&paper(), Choice::Accuracy(LARGEST_ACCURACY), 1.0, false).is_ok());
}

/// A body that turns over again and again multiplies rounding each time: the refusal says when, and to run until then is no refusal.
#[test]
fn what_rounding_outgrows_is_refused_with_the_time_until_which_it_holds() {
    let scene = scene("hard/one-body");
    let error = end(&scene, Choice::Accuracy(1e-6), 100.0, false).unwrap_err();
    let SimError::AccuracyOutOfReach { held, .. } = error else {
        panic!("{error}");
    };
    assert!(held > 10.0 && held < 100.0, "{error}");
    let message = error.to_string();
    let advised = message
        .split("run to ")
        .nth(1)
        .and_then(|rest| rest.split(' ').next());
    let advised: f64 = advised.expect("an advice").parse().expect("a number");
    assert!(advised >= 0.5 * held && advised <= held, "{message}");
    assert!(
        end(&scene, Choice::Accuracy(1e-6), advised, false).is_ok(),
        "{message}"
    );
}

/// States and works that three independent ways agree on to 1e-12: what is asked of a driven scene holds for the works too.
#[test]
fn driven_scenes_keep_an_accuracy_in_places_and_in_works() {
    let folder = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../articulated-fluid/tests/swim"
    );
    let vectors = std::fs::read_to_string(format!("{folder}/vectors.json")).unwrap();
    let vectors: serde_json::Value = serde_json::from_str(&vectors).unwrap();
    let numbers = |value: &serde_json::Value| -> Vec<f64> {
        let values = value.as_array().unwrap().iter();
        values.map(|x| x.as_f64().unwrap()).collect()
    };
    // Lengths from end to end.
    for (name, length) in [
        ("fish-prescribed", 40.0),
        ("eel-wave", 2.6),
        ("pendulum-hinges", 3.0),
        ("pendulum-balls", 3.0),
    ] {
        let scene = Scene::load(format!("{folder}/scenes/{name}.toml").as_ref()).unwrap();
        for told in vectors[name]["at"].as_array().unwrap() {
            let until = told["t"].as_f64().unwrap();
            let (end, report) = end(&scene, Choice::Accuracy(1e-9), until, false).unwrap();
            let bodies = end
                .bodies
                .attitudes
                .iter()
                .zip(told["R"].as_array().unwrap());
            for (r, told) in bodies {
                let told: Vec<Vec<f64>> = told.as_array().unwrap().iter().map(numbers).collect();
                for (row, told) in r.matrix().0.iter().zip(told) {
                    let off = row.iter().zip(told).map(|(a, b)| (a - b).abs());
                    assert!(off.fold(0.0, f64::max) < 2e-9, "{name} at {until} s");
                }
            }
            let x = numbers(&told["x"]);
            let off = (end.position() - Vec3([x[0], x[1], x[2]])).norm();
            assert!(off < 2e-9 * length, "{name} at {until} s: {off:e} m");
            let works: Vec<f64> = numbers(&told["joint_work"]);
            let works: Vec<f64> = works.into_iter().filter(|work| *work != 0.0).collect();
            assert_eq!(works.len(), end.drives.len());
            let scale = works
                .iter()
                .fold(report.energy_kinetic_max_joules, |m, x| m.max(x.abs()));
            for (drive, work) in end.drives.iter().zip(works) {
                let off = (drive.work - work).abs() / scale;
                assert!(off < 1e-9, "{name} at {until} s: work {off:e} off");
            }
            let energy = told["energy"].as_f64().unwrap();
            let off = (end.sample.energy - energy).abs() / scale;
            assert!(off < 1e-9, "{name} at {until} s: energy {off:e} off");
            let off = report.energy_error_max_joules / scale;
            assert!(off < 1e-9, "{name} at {until} s: balance {off:e} off");
        }
    }
}
