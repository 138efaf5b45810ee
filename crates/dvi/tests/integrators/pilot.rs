//! The pilot keeps its word, and says what to do where it cannot.

use dvi::{Context, ContinuousSystem, Integrator, Lagrangian, Pilot, PilotError, State, System};
use lie::{Cotangent, LieGroup, Mat3, Rn, SO3, Scalar, Tangent, VectorSpace};

use crate::common::{Top, top};

/// A free body with an axis of symmetry, whose motion is known: $R(t) = \exp(t L / a)\, R_0 \exp(t k e_3)$ with the angular
/// momentum $L$ in space and $k = \mu_3 (1/c - 1/a)$.
#[derive(Clone, Copy)]
struct Spinning;

/// $a$ and $c$, kg m².
const ACROSS: f64 = 2.0;
const ALONG: f64 = 0.5;

impl System for Spinning {
    type Group = SO3;
}

impl Lagrangian for Spinning {
    fn value<S: Scalar>(&self, _: Context<S>, _: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let omega = omega.vec3();
        omega
            .dot(Mat3::diagonal([ACROSS, ACROSS, ALONG]).lift() * omega)
            .times(0.5)
    }
}

fn spinning() -> State<SO3> {
    let turn = SO3::exp(&Tangent([0.4, -0.8, 0.3]));
    Spinning
        .state(0.0, turn, &Tangent([0.7, -0.4, 1.5]))
        .unwrap()
}

fn exact(t: f64) -> SO3 {
    let start = spinning();
    let momentum = start.g.rotate(start.mu.vec3());
    let about_itself = start.mu[2] * (1.0 / ALONG - 1.0 / ACROSS);
    let precession = SO3::exp(&(momentum * (t / ACROSS)).into());
    let spin = SO3::exp(&Tangent([0.0, 0.0, t * about_itself]));
    precession.compose(&start.g).compose(&spin)
}

/// The largest error of the pilot's run on the way, and how often the system was evaluated.
fn fly(pilot: &Pilot) -> (f64, usize) {
    let (mut state, mut worst, mut sweeps) = (spinning(), 0.0_f64, 0);
    let mut integrator = pilot.integrator(Spinning.hamiltonian());
    while state.t < pilot.horizon - 0.5 * pilot.h {
        let report = integrator.step(&mut state, pilot.h).expect("a step");
        sweeps += report.iterations as usize;
        let between = exact(state.t).inverse().compose(&state.g);
        let error = between.cayley_inverse().expect("close");
        worst = worst.max(error.max_magnitude());
    }
    (worst, pilot.stages * sweeps)
}

#[test]
fn the_accuracy_is_reached_and_not_paid_for_twice() {
    // An eighth of it, between two samples, holds several steps.
    const DURATION: f64 = 60.0;
    let mut cost = 0;
    for accuracy in [1e-3, 1e-6, 1e-9] {
        let system = Spinning.hamiltonian();
        let pilot = Pilot::run(&system, &spinning(), DURATION, accuracy).expect("a method");
        let (error, evaluations) = fly(&pilot);
        println!("{accuracy:e}: {error:.1e}, {evaluations} evaluations, {pilot:?}");
        assert!(error <= accuracy, "{error:e}");
        assert!(pilot.estimate <= accuracy, "{pilot:?}");
        // A step shorter by a fifth has a thirtieth of the error at order 16; and the plain iteration may bound it before
        // the accuracy does.
        assert!(error >= 1e-3 * accuracy, "{error:e}");
        // Whole steps to the end.
        let steps = pilot.horizon / pilot.h;
        assert_eq!(pilot.horizon, DURATION);
        assert!((steps - steps.round()).abs() < 1e-9 * steps, "{steps}");
        // More digits take more evaluations.
        assert!(evaluations > cost, "{evaluations}");
        cost = evaluations;
    }
}

#[test]
fn what_is_no_accuracy_or_no_time_is_named() {
    let system = Top.hamiltonian();
    for (duration, accuracy) in [
        (1.0, 0.0),
        (1.0, -1e-6),
        (1.0, f64::NAN),
        (0.0, 1e-6),
        (-1.0, 1e-6),
        (f64::INFINITY, 1e-6),
    ] {
        let error = Pilot::run(&system, &top(), duration, accuracy).expect_err("no method");
        assert!(matches!(error, PilotError::Input { .. }), "{error}");
        let message = error.to_string();
        assert!(
            message.contains(&format!("{accuracy} over {duration} s")),
            "{message}"
        );
        assert!(
            message.ends_with("must be positive and finite"),
            "{message}"
        );
    }
}

#[test]
fn out_of_reach_names_an_accuracy_that_is_not() {
    let system = Top.hamiltonian();
    let error = Pilot::run(&system, &top(), 5.0, 1e-17).expect_err("below rounding");
    let PilotError::OutOfReach {
        accuracy: 1e-17,
        horizon: 5.0,
        best,
    } = error
    else {
        panic!("{error}");
    };
    println!("{error}");
    // Rounding of a unit, over a few hundred steps at the most.
    assert!(best > 0.0 && best < 1e-12, "{best:e}");
    let message = error.to_string();
    let advice = message
        .split("ask for ")
        .nth(1)
        .and_then(|rest| rest.split(',').next());
    let accuracy: f64 = advice.expect("an advice").parse().expect("a number");
    assert!(message.ends_with("or for a shorter time"), "{message}");
    let pilot = Pilot::run(&system, &top(), 5.0, accuracy).expect("what was advised");
    assert!(pilot.estimate <= accuracy, "{pilot:?}");
}

/// A system that has no velocity.
#[derive(Clone)]
struct Nowhere;

impl System for Nowhere {
    type Group = Rn<1>;
}

impl ContinuousSystem for Nowhere {
    type Workspace<S: Scalar> = ();

    fn velocity_and_force<S: Scalar>(
        &self,
        _: Context<S>,
        _: &Rn<1, S>,
        _: &Cotangent<1, S>,
        (): &mut (),
        xi: &mut Tangent<1, S>,
        tau: &mut Cotangent<1, S>,
    ) {
        (xi[0], tau[0]) = (S::from_f64(f64::NAN), S::zero());
    }
}

#[test]
fn a_system_that_no_step_solves_is_refused_with_the_reason() {
    let state = State {
        t: 0.0,
        g: Rn([1.0]),
        mu: Cotangent([0.5]),
    };
    let error = Pilot::run(&Nowhere, &state, 3.0, 1e-6).expect_err("no velocity");
    assert!(matches!(error, PilotError::Unsolved { .. }), "{error}");
    let reason = core::error::Error::source(&error).expect("a reason");
    println!("{error}: {reason}");
}
