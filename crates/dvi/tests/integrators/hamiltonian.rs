//! Hamilton's equations from the value alone.

use dvi::{Context, ContinuousSystem, HamiltonianSystem, Lagrangian, State, System};
use lie::{Jet, LieGroup, Mat3, Rn, SO3, Scalar, Tangent, VectorSpace};

use crate::common::{Driven, INERTIA, LEVER, Sinking, Top, driven, sinking, top};

type Answer<G> = (<G as LieGroup>::Algebra, <G as LieGroup>::Dual);

fn evaluate<L: Lagrangian>(
    system: &HamiltonianSystem<L>,
    state: &State<L::Group>,
) -> Answer<L::Group> {
    let State { t, g, mu } = state;
    let (at, mut work) = (Context::new(*t, system.parameters()), Default::default());
    let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
    system.velocity_and_force::<f64>(at, g, mu, &mut work, &mut xi, &mut tau);
    (xi, tau)
}

#[test]
fn velocity_and_torque_of_a_top() {
    let (omega, torque) = evaluate(&Top.hamiltonian(), &top());
    let expected = Mat3::diagonal(INERTIA).inverse() * top().mu.vec3();
    assert!((omega.vec3() - expected).norm() < 1e-15);
    let expected = top().g.matrix().row(2).cross(LEVER);
    assert!((torque.vec3() - expected).norm() < 1e-15);
}

fn inverts<L: Lagrangian + Copy>(lagrangian: L, state: &State<L::Group>) {
    let (xi, _) = evaluate(&lagrangian.hamiltonian(), state);
    let again = lagrangian.state(state.t, state.g.clone(), &xi).unwrap();
    for i in 0..xi.dim() {
        assert!((again.mu.get(i) - state.mu.get(i)).abs() < 1e-14);
    }
}

#[test]
fn the_velocity_inverts_the_legendre_transform() {
    inverts(Top, &top());
    inverts(Sinking, &sinking());
    inverts(Driven, &driven());
}

/// Over dual numbers the iteration must go on until the derivatives have converged too.
#[test]
fn derivatives_of_the_velocity_are_those_of_differences() {
    type J = <f64 as Scalar>::Jet;
    let (system, state) = (Driven.hamiltonian(), driven());
    for i in 0..2 {
        let g = Rn(state.g.0.map(J::constant));
        let mut mu = lie::Cotangent(state.mu.0.map(J::constant));
        mu.set(i, mu.get(i) + J::variable(0.0, 0));
        let (at, mut work) = (Context::new(J::constant(state.t), &[]), Default::default());
        let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
        system.velocity_and_force::<J>(at, &g, &mu, &mut work, &mut xi, &mut tau);
        let width = 1e-5;
        let [ahead, behind] = [width, -width].map(|s| {
            let mut state = state.clone();
            state.mu.set(i, state.mu.get(i) + s);
            evaluate(&system, &state)
        });
        for k in 0..2 {
            let slope = (ahead.0[k] - behind.0[k]) / (2.0 * width);
            assert!((xi[k].partial(0) - slope).abs() < 1e-9, "{slope}");
            let slope = (ahead.1[k] - behind.1[k]) / (2.0 * width);
            assert!((tau[k].partial(0) - slope).abs() < 1e-9, "{slope}");
        }
    }
}

/// No inertia about the third axis: no velocity for a momentum there.
struct Needle;

impl System for Needle {
    type Group = SO3;
}

impl Lagrangian for Needle {
    fn value<S: Scalar>(&self, _: Context<S>, _: &SO3<S>, omega: &Tangent<3, S>) -> S {
        (omega[0] * omega[0] + omega[1] * omega[1]) * S::from_f64(0.5)
    }
}

#[test]
fn a_degenerate_lagrangian_has_no_velocity() {
    let state = State {
        t: 0.0,
        g: SO3::identity(),
        mu: lie::Cotangent([1.0, 0.0, 1.0]),
    };
    let (xi, _) = evaluate(&Needle.hamiltonian(), &state);
    assert!(xi.0.iter().any(|x| !x.is_finite()), "{xi:?}");
}

/// A relativistic particle: speeds stay below one, and Newton's first correction does not.
#[derive(Clone, Copy)]
pub struct Relativistic;

impl System for Relativistic {
    type Group = Rn<1>;
}

impl Lagrangian for Relativistic {
    fn value<S: Scalar>(&self, _: Context<S>, _: &Rn<1, S>, v: &Tangent<1, S>) -> S {
        -(S::one() - v[0] * v[0]).sqrt()
    }
}

#[test]
fn a_lagrangian_with_a_domain_is_inverted_with_its_derivatives() {
    type J = <f64 as Scalar>::Jet;
    let system = Relativistic.hamiltonian();
    for p in [0.3, 0.594, 0.967, 1.5, 20.0] {
        let gamma = (1.0_f64 + p * p).sqrt();
        let state = State {
            t: 0.0,
            g: Rn([0.0]),
            mu: lie::Cotangent([p]),
        };
        let v = system.velocity(&state)[0];
        assert!((v - p / gamma).abs() < 1e-14, "{p}: {v}");
        let (g, mu) = (Rn([J::constant(0.0)]), lie::Cotangent([J::variable(p, 0)]));
        let (at, mut work) = (Context::new(J::constant(0.0), &[]), Default::default());
        let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
        system.velocity_and_force::<J>(at, &g, &mu, &mut work, &mut xi, &mut tau);
        let slope = xi[0].partial(0) * gamma.powi(3);
        // The inverse of a mass that grows as the cube.
        assert!((slope - 1.0).abs() < 1e-14 * gamma.powi(3), "{p}: {slope}");
    }
}

/// A term linear in the velocity, of a size that a small velocity is rounding beside.
#[test]
fn a_small_velocity_beside_a_large_linear_term_is_found() {
    #[derive(Clone, Copy)]
    struct Magnetic;
    impl System for Magnetic {
        type Group = Rn<3>;
    }

    impl Lagrangian for Magnetic {
        fn value<S: Scalar>(&self, _: Context<S>, _: &Rn<3, S>, v: &Tangent<3, S>) -> S {
            let j = Mat3([[1.3, 0.4, 0.2], [0.4, 2.1, 0.3], [0.2, 0.3, 0.9]]);
            let v = v.vec3();
            v.dot(j.apply(v)).times(0.5) + lie::Vec3([0.7, -1.1, 0.4]).pair(v)
        }
    }
    for k in 0..300 {
        let size = 10_f64.powi(-6 - k % 7);
        let xi = Tangent([0.3, -0.7, 1.0].map(|x: f64| size * (x + 0.01 * f64::from(k)).sin()));
        let state = Magnetic.state(0.0, Rn([0.0; 3]), &xi).unwrap();
        let found = Magnetic.hamiltonian().velocity(&state);
        assert!((found - xi).max_magnitude() < 1e-15, "{xi:?} {found:?}");
    }
}
