//! An integrator that was reset steps as a new one, bit by bit.

use dvi::{
    Composition, Context, Gauss, Integrator, Lagrangian, Quadrature, State, System, Variational,
};
use lie::{LieGroup, Mat3, R3, SO3, Scalar, Tangent};

/// A body in a field: what runs before leaves guesses, matrices and compensations behind.
#[derive(Clone, Copy)]
struct Body;

impl System for Body {
    type Group = (SO3, R3);
}

impl Lagrangian for Body {
    fn value<S: Scalar>(
        &self,
        _: Context<S>,
        g: &(SO3<S>, R3<S>),
        xi: &(Tangent<3, S>, Tangent<3, S>),
    ) -> S {
        let (omega, v) = (xi.0.vec3(), g.0.inverse_rotate(xi.1.vec3()));
        let j = Mat3::diagonal([1.0, 1.5, 2.0]).lift::<S>();
        let m = Mat3::diagonal([1.0, 3.0, 2.0]).lift::<S>();
        (omega.dot(j * omega) + v.dot(m * v)).times(0.5) - g.1.vec3().norm_squared().times(0.1)
    }
}

fn start(speed: f64) -> State<(SO3, R3)> {
    let g = (
        SO3::exp(&Tangent([0.4, -0.8, 0.3])),
        R3::from(lie::Vec3([0.5, 0.1, -0.3])),
    );
    let xi = (Tangent([0.3, -0.5, speed]), Tangent([0.2, speed, 0.1]));
    Body.state(0.0, g, &xi).unwrap()
}

/// Steps of several sizes, one that is refused, and looks ahead.
fn run<I: Integrator<Group = (SO3, R3)>>(integrator: &mut I, speed: f64) -> Vec<State<(SO3, R3)>> {
    let mut state = start(speed);
    let mut states = vec![];
    for k in 0..40 {
        let h = if k % 7 == 3 { 0.013 } else { 0.02 };
        let _ = integrator.peek(&state, 0.4 * h);
        let _ = integrator.step(&mut state, if k == 20 { 1e3 } else { h });
        states.push(state.clone());
    }
    states
}

fn check<I: Integrator<Group = (SO3, R3)>>(name: &str, make: impl Fn() -> I) {
    let expected = run(&mut make(), 1.0);
    let mut used = make();
    run(&mut used, -2.3);
    let unlike = run(&mut used, 1.0);
    let mut used = make();
    run(&mut used, -2.3);
    used.reset();
    let states = run(&mut used, 1.0);
    assert_eq!(states, expected, "{name}");
    // The control: without a reset, what ran before shows.
    assert_ne!(unlike, expected, "{name}");
}

#[test]
fn what_ran_before_does_not_change_a_bit() {
    check("midpoint", || {
        Variational::new(Body.discretise(Quadrature::Midpoint))
    });
    check("composition", || {
        Composition::new::<4>(Body.discretise(Quadrature::LeftPoint))
    });
    check("gauss", || Gauss::new::<3>(Body.hamiltonian()));
}
