//! A step that leaves the domain of its Lagrangian is refused, though derivatives are finite outside.

use dvi::{
    Cause, Composition, Context, Gauss, Integrator, Lagrangian, Quadrature, State, StepError,
    System, Variational,
};
use lie::{Rn, Scalar, Tangent};

/// A particle of 1 kg that falls onto a logarithmic barrier at $x = 0$, so low that long steps pass it.
#[derive(Clone, Copy)]
struct Barrier;

impl System for Barrier {
    type Group = Rn<1>;
}

impl Lagrangian for Barrier {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
        let [x] = x.0;
        v[0] * v[0] * S::from_f64(0.5) + x.ln().times(1e-3) - x.times(9.81)
    }
}

/// Every state that a step calls solved is in the domain, and a step is refused because it would leave.
fn stays_or_refuses(mut integrator: impl Integrator<Group = Rn<1>>, h: f64) {
    let mut state = Barrier.state(0.0, Rn([1.0]), &Tangent([0.0])).unwrap();
    for step in 0..200 {
        let before = state.clone();
        match integrator.step(&mut state, h) {
            Ok(_) => assert!(state.g.0[0] > 0.0, "step {step}: {state:?}"),
            Err(StepError {
                cause: Cause::NotFinite | Cause::NotConverged { .. },
                ..
            }) => {
                assert_eq!(state, before);
                // Free fall takes 0.4515 s, and the method of order 1 is a step early.
                let early = before.t < 0.4515 - 2.5 * h;
                assert!(!early, "h = {h}: refused at {} s already", before.t);
                return;
            }
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn gauss_names_the_step_that_leaves_the_domain() {
    let mut integrator = Gauss::new::<3>(Barrier.hamiltonian());
    let mut state = Barrier.state(0.0, Rn([1.0]), &Tangent([0.0])).unwrap();
    let refused = (0..200).find_map(|_| integrator.step(&mut state, 0.01).err());
    let cause = |error: StepError| error.cause;
    assert_eq!(refused.map(cause), Some(Cause::NotFinite));
    // Free fall takes 0.4515 s.
    assert!(
        (0.44..0.46).contains(&state.t) && state.g.0[0] > 0.0,
        "{state:?}"
    );
    let peeked = integrator.peek(&state, 0.01);
    assert_eq!(peeked.map_err(cause), Err(Cause::NotFinite));
}

#[test]
fn no_integrator_calls_a_state_outside_the_domain_solved() {
    for h in [0.003, 0.01, 0.05] {
        stays_or_refuses(Gauss::new::<1>(Barrier.hamiltonian()), h);
        stays_or_refuses(Gauss::new::<4>(Barrier.hamiltonian()), h);
        stays_or_refuses(
            Variational::new(Barrier.discretise(Quadrature::LeftPoint)),
            h,
        );
        stays_or_refuses(
            Variational::new(Barrier.discretise(Quadrature::Midpoint)),
            h,
        );
        stays_or_refuses(
            Variational::new(Barrier.discretise(Quadrature::Trapezoid)),
            h,
        );
        stays_or_refuses(
            Composition::new::<4>(Barrier.discretise(Quadrature::Midpoint)),
            h,
        );
    }
}

#[test]
fn a_start_outside_the_domain_is_refused() {
    let outside = State {
        t: 0.0,
        g: Rn([-1.0]),
        mu: lie::Cotangent([0.3]),
    };
    let refuses = |mut integrator: Box<dyn Integrator<Group = Rn<1>>>| {
        let error = integrator.step(&mut outside.clone(), 0.01).unwrap_err();
        assert!(matches!(error.cause, Cause::NotFinite), "{error}");
    };
    refuses(Box::new(Gauss::new::<3>(Barrier.hamiltonian())));
    refuses(Box::new(Variational::new(
        Barrier.discretise(Quadrature::Midpoint),
    )));
    refuses(Box::new(Variational::new(
        Barrier.discretise(Quadrature::LeftPoint),
    )));
}
