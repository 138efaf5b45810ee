//! The pendulum in space.

use std::f64::consts::PI;

use dvi::State;
use lie::{LieGroup, SO3, Tangent};
use study::problems::{Pendulum, ProblemError, Solution};

use super::{TIGHT, distance, measure};

fn pendulum() -> Pendulum {
    Pendulum::new([0.9, 1.3, 0.7], 9.0, [0.3, 0.0, 0.4]).expect("a pendulum")
}

#[test]
fn swings_and_turns() {
    for (angle, rate) in [
        (0.3, 0.0),
        (-2.0, 1.0),
        (0.0, 3.0),
        (1.0, 5.0),
        (7.0, -4.5),
        (2.5, -8.0),
    ] {
        let problem = pendulum().swing(1, angle, rate).expect("a swing");
        let measured = measure(&problem, 5.0);
        assert!(measured.reference < 2e-11);
        assert!(measured.conserved < 2e-13);
        assert!(measured.equations < 1e-9);
        let after: State<SO3> = problem.exact.at(problem.time).expect("a state");
        assert!(distance(&after, &problem.start) < 1e-13);
    }
}

#[test]
fn small_swings_are_harmonic() {
    let problem = pendulum().swing(1, 1e-4, 0.0).expect("a swing");
    let natural = (9.0 * 0.5 / 1.3_f64).sqrt();
    // The period grows by 1 + q^2 / 16.
    assert!((problem.time * natural / (2.0 * PI) - 1.0 - 1e-8 / 16.0).abs() < 1e-14);
    assert!(!problem.exact.rotates());
}

#[test]
fn rest_at_the_bottom() {
    let problem = pendulum().swing(1, 0.0, 0.0).expect("a swing");
    let state = problem.exact.at(3.0).expect("a state");
    assert_eq!(state.g, problem.start.g);
}

#[test]
fn a_general_start_has_a_reference() {
    let attitude = SO3::exp(&Tangent([0.4, -1.1, 0.7]));
    let problem = pendulum()
        .problem(attitude, [0.5, -1.0, 2.0], TIGHT)
        .expect("a pendulum");
    let state = problem.exact.at(3.0 * problem.time).expect("a state");
    let change = problem.energy(&state) - problem.energy(&problem.start);
    let turn = problem.momenta(&state)[0] - problem.momenta(&problem.start)[0];
    println!("pendulum in space, 3 periods: energy {change:.1e}, momentum {turn:.1e}");
    assert!(change.abs() < 1e-12 && turn.abs() < 1e-12);
}

#[test]
fn what_is_no_planar_swing_is_refused() {
    let swing = |axis| pendulum().swing(axis, 0.3, 0.0).err();
    assert_eq!(swing(0), Some(ProblemError::NotPlanar { offset: 0.3 }));
    assert_eq!(swing(3), Some(ProblemError::NoSuchAxis { axis: 3 }));
    let resting = pendulum().swing(1, 0.0, f64::INFINITY).err();
    assert!(matches!(resting, Some(ProblemError::NotFinite { .. })));
    assert!(Pendulum::new([1.0; 3], 9.0, [0.0; 3]).is_err());
}
