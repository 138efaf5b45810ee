//! The reference on other systems: with forces, of run-time size, on products, backwards.

use articulated_fluid::Scene;
use articulated_fluid::scene::EXAMPLE;
use dvi::{Context, Force, Forced, Lagrangian, State, System};
use lie::{Cotangent, LieGroup, Rn, SO3, Scalar, Tangent, VectorSpace};
use study::baseline::on_group::{self, ReferenceError};
use study::baseline::{Motion, Pair, Tolerance};
use study::problems::{FreeRigidBody, Pendulum, Solution};

use super::{TIGHT, distance};

/// A particle of 1 kg on a spring of 1 N/m.
struct Spring;

impl System for Spring {
    type Group = Rn<1>;
}

impl Lagrangian for Spring {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
        (v[0] * v[0] - x.0[0] * x.0[0]) * S::from_f64(0.5)
    }
}

/// A drag of 0.2 kg/s and a drive that is 1 N in resonance at time zero.
struct DragAndDrive;

impl Force for DragAndDrive {
    type Group = Rn<1>;
    fn force<S: Scalar>(
        &self,
        at: Context<S>,
        _: &Rn<1, S>,
        v: &Tangent<1, S>,
        out: &mut Cotangent<1, S>,
    ) {
        let (_, cos) = at.t.sin_cos();
        out[0] = cos - v[0] * S::from_f64(0.2);
    }
}

#[test]
fn forces_and_time() {
    // x'' + 0.2 x' + x = cos t: x = 5 sin t + e^{-t/10} (a cos wt + b sin wt).
    let w = 0.99_f64.sqrt();
    let decay = |t: f64| (-0.1 * t).exp() * ((w * t).cos() - 4.9 / w * (w * t).sin());
    let system = Forced::new(Spring.hamiltonian(), DragAndDrive);
    let start = State {
        t: 0.0,
        g: Rn([1.0]),
        mu: Cotangent([0.0]),
    };
    let times: Vec<f64> = (1..=10).map(|k| 2.3 * f64::from(k)).collect();
    let states = on_group::sample(&system, &start, &times, TIGHT).expect("a reference");
    for state in &states {
        let exact = 5.0 * state.t.sin() + decay(state.t);
        assert!(
            (state.g.0[0] - exact).abs() < 1e-11,
            "{}",
            state.g.0[0] - exact
        );
    }
    let back = on_group::integrate(&system, &states[9], 0.0, TIGHT).expect("a way back");
    assert!(distance(&back, &start) < 1e-10);
}

#[test]
fn there_and_back_on_a_rotation() {
    let body = FreeRigidBody::new([1.0, 1.7, 2.6]).expect("a body");
    let problem = body
        .problem(SO3::identity(), [0.4, -0.5, 1.2])
        .expect("a motion");
    let times = [7.0, -3.0, 0.0];
    let states =
        on_group::sample(&body.hamiltonian(), &problem.start, &times, TIGHT).expect("a reference");
    for state in states {
        let exact = problem.exact.at(state.t).expect("a state");
        assert!(distance(&state, &exact) < 1e-11);
    }
}

#[test]
fn a_start_at_rest() {
    let pendulum = Pendulum::new([0.9, 1.3, 0.7], 9.0, [0.3, 0.0, 0.4]).expect("a pendulum");
    let problem = pendulum.swing(1, 2.0, 0.0).expect("a swing");
    let t = 20.3 * problem.time;
    let end =
        on_group::integrate(&pendulum.hamiltonian(), &problem.start, t, TIGHT).expect("an end");
    assert!(distance(&end, &problem.exact.at(t).expect("a state")) < 1e-10);
}

#[test]
fn the_chain_of_run_time_size_as_on_raw_entries() {
    let scene = Scene::parse(EXAMPLE, "example.toml").expect("the example");
    let (model, start) = (
        scene.model().expect("a model"),
        scene.initial_state().expect("a state"),
    );
    let (until, tolerance) = (2.0, Tolerance::uniform(1e-13));
    let end = on_group::integrate(&model, &start, until, tolerance).expect("a reference");
    let motion = Motion::new(&Pair::DP853, &model, &start, until, tolerance);
    let mut motion = motion.expect("a start");
    let error = distance(&end, motion.at(until).expect("a state"));
    println!("fish chain, {until} s: {error:.1e} from the raw entries");
    assert!(error < 1e-10);
}

#[test]
fn what_does_not_fit_is_refused() {
    let body = FreeRigidBody::new([1.0, 1.7, 2.6]).expect("a body");
    let start = body
        .state(0.0, SO3::identity(), &Tangent([0.4, -0.5, 1.2]))
        .expect("a state");
    let refused = on_group::integrate(&body.hamiltonian(), &start, f64::NAN, TIGHT);
    assert!(matches!(refused, Err(ReferenceError::Time { .. })));
    let mut lost = start.clone();
    lost.mu.set(0, f64::INFINITY);
    let refused = on_group::integrate(&body.hamiltonian(), &lost, 1.0, TIGHT);
    assert!(matches!(refused, Err(ReferenceError::Integration { .. })));
    let same = on_group::integrate(&body.hamiltonian(), &start, 0.0, TIGHT).expect("the start");
    assert_eq!(same, start);
    assert!(start.g.is_finite());
}
