//! The free rigid body.

use lie::{LieGroup, SO3, Tangent, Vec3};
use study::baseline::on_group;
use study::problems::{FreeRigidBody, FreeRotation, Problem, ProblemError, Solution};

use super::{TIGHT, distance, measure};

type Body = Problem<FreeRigidBody, FreeRotation>;

fn body(moments: [f64; 3], omega: [f64; 3]) -> Body {
    let attitude = SO3::exp(&Tangent([0.4, -1.1, 0.7]));
    let body = FreeRigidBody::new(moments).expect("a body");
    body.problem(attitude, omega).expect("a periodic motion")
}

/// Above and below the separatrix, all orders and senses of the axes.
fn bodies() -> Vec<Body> {
    const ORDERS: [[usize; 3]; 6] = [
        [0, 1, 2],
        [1, 2, 0],
        [2, 0, 1],
        [0, 2, 1],
        [2, 1, 0],
        [1, 0, 2],
    ];
    let mut bodies = Vec::new();
    for order in ORDERS {
        for omega in [[0.4, -0.5, 1.2], [-1.3, 0.6, 0.4], [0.5, 0.3, -1.0]] {
            let moments = [1.0, 1.7, 2.6];
            bodies.push(body(order.map(|i| moments[i]), order.map(|i| omega[i])));
        }
    }
    bodies
}

#[test]
fn the_solution_is_the_motion() {
    for problem in bodies() {
        let measured = measure(&problem, 5.0);
        assert!(measured.reference < 2e-12);
        assert!(measured.conserved < 1e-14);
        assert!(measured.equations < 1e-10);
    }
}

#[test]
fn the_momentum_has_the_period() {
    for problem in bodies() {
        let after = problem.exact.at(problem.time).expect("a state");
        assert!((after.mu - problem.start.mu).vec3().norm() < 1e-14);
        let half = problem.exact.at(0.5 * problem.time).expect("a state");
        assert!((half.mu - problem.start.mu).vec3().norm() > 0.1);
    }
}

#[test]
fn a_hundred_periods() {
    for problem in [
        body([1.0, 1.7, 2.6], [0.4, -0.5, 1.2]),
        body([1.0, 1.7, 2.6], [1.3, 0.6, 0.4]),
    ] {
        let system = problem.lagrangian;
        let spatial = |t: f64| {
            let state = problem.exact.at(t).expect("a state");
            state.g.rotate(state.mu.vec3())
        };
        let momentum = spatial(0.0);
        let turned = |k: u32| (spatial(0.0737 * f64::from(k) * problem.time) - momentum).norm();
        let worst = (0..=1357).map(turned).fold(0.0, f64::max);
        let t = 100.0 * problem.time;
        let [end, once] = [t, problem.time].map(|t| problem.exact.at(t).expect("a state"));
        let momentum_error = (end.mu - problem.start.mu).vec3().norm();
        // A period turns the body about the momentum by one and the same angle.
        let turn = once.g.compose(&problem.start.g.inverse());
        let mut g = problem.start.g;
        for _ in 0..100 {
            g = turn.compose(&g);
        }
        let attitude_error = (*g.matrix() - *end.g.matrix()).frobenius();
        let reference = on_group::integrate(
            &dvi::Lagrangian::hamiltonian(system),
            &problem.start,
            t,
            TIGHT,
        )
        .expect("a reference");
        let error = distance(&end, &reference);
        println!(
            "100 periods: R mu {worst:.1e}, period {momentum_error:.1e}, turn {attitude_error:.1e}, reference {error:.1e}"
        );
        assert!(worst < 1e-12);
        assert!(momentum_error < 1e-12 && attitude_error < 1e-12);
        // The reference takes some ten thousand steps at 1e-14.
        assert!(error < 2e-10);
    }
}

#[test]
fn a_symmetric_body_turns_evenly() {
    // The axis of symmetry precesses at L / A about the momentum, the body spins at (1/C - 1/A) M_3 about it.
    let problem = body([2.0, 2.0, 3.0], [0.3, 0.0, 1.0]);
    let length = problem.start.mu.vec3().norm();
    assert!((problem.exact.mean_precession_rate() - length / 2.0).abs() < 1e-15);
    let spin = (1.0_f64 / 2.0 - 1.0 / 3.0) * 3.0;
    assert!((problem.time - 2.0 * std::f64::consts::PI / spin).abs() < 1e-14);
    assert!(measure(&problem, 5.0).reference < 2e-12);
}

#[test]
fn steady_rotation_about_a_stable_axis() {
    for axis in [0, 2] {
        let mut omega = Tangent::zero();
        omega[axis] = -1.3;
        let problem = body([1.0, 1.7, 2.6], omega.0);
        for t in [0.0, 0.7, 31.0] {
            let exact = problem.exact.at(t).expect("a state");
            let g = problem.start.g.compose(&SO3::exp(&(omega * t)));
            assert!((*g.matrix() - *exact.g.matrix()).frobenius() < 4e-14);
            assert!((exact.mu - problem.start.mu).vec3().norm() < 1e-15);
        }
    }
}

#[test]
fn close_to_the_separatrix() {
    // 1 - m about 1e-6: the body tumbles over and stays long near the middle axis.
    let problem = body([1.0, 2.0, 3.0], [1e-3, 1.0, 5e-4]);
    let measured = measure(&problem, 2.0);
    assert!(measured.conserved < 1e-14 && measured.equations < 1e-8);
    // The reference's own error of the energy, 1e-13, over 1 - m.
    assert!(measured.reference < 1e-7);
}

#[test]
fn what_has_no_period_is_refused() {
    let body = FreeRigidBody::new([1.0, 2.0, 3.0]).expect("a body");
    for omega in [[0.0; 3], [0.0, 1.0, 0.0]] {
        let refused = body.problem(SO3::identity(), omega);
        assert_eq!(refused.err(), Some(ProblemError::NoPeriod));
    }
    let refused = body.problem(SO3::identity(), [f64::NAN, 0.0, 0.0]);
    assert!(matches!(refused, Err(ProblemError::NotFinite { .. })));
    let ball = FreeRigidBody::new([1.0; 3]).expect("a body");
    assert!(
        ball.problem(SO3::identity(), Vec3([1.0, 2.0, 3.0]).0)
            .is_err()
    );
    assert!(FreeRigidBody::new([1.0, -2.0, 3.0]).is_err());
}
