//! Compositions: order, symmetry, symplecticity.

use dvi::{
    Adjoint, Cause, Composition, Context, DiscreteLagrangian, Integrator, Lagrangian, Quadrature,
    State, System, Variational, laws,
};
use lie::{Cotangent, SO3, Scalar};

use crate::common::{self, Brake, Driven, INERTIA, Sinking, Top, driven, sinking, top};

fn order<L: DiscreteLagrangian + Clone, const P: u32>(
    lagrangian: &L,
    state: &State<L::Group>,
    steps: &[u32],
) {
    let integrator = || Composition::new::<P>(lagrangian.clone());
    let order = laws::observed_order(integrator, state, 2.0, steps).unwrap();
    println!("order {P}: {:.3} {:?}", order.slope, order.errors);
    assert!((order.slope - f64::from(P)).abs() < 0.2, "{order:?}");
}

macro_rules! compositions {
    ($($name:ident: $lagrangian:expr, $state:expr, $eighth:expr;)+) => { $(
        #[test]
        fn $name() {
            let (lagrangian, state) = ($lagrangian, $state);
            order::<_, 2>(&lagrangian, &state, &[64, 128, 256]);
            order::<_, 4>(&lagrangian, &state, &[32, 64, 128]);
            order::<_, 6>(&lagrangian, &state, &[16, 24, 32]);
            order::<_, 8>(&lagrangian, &state, &$eighth);
            let mut integrator = Composition::new::<8>(lagrangian);
            let states = [state];
            laws::check_symplecticity(&mut integrator, &states, 0.1).unwrap();
            laws::check_reversibility(&mut integrator, &states, 0.1).unwrap();
        }
    )+ };
}

compositions! {
    of_a_one_sided_rule_on_so3: Top.discretise(Quadrature::LeftPoint), top(), [8, 10, 12];
    of_a_symmetric_rule_on_so3: Top.discretise(Quadrature::Midpoint), top(), [12, 14, 16];
    of_a_one_sided_rule_on_se3: Sinking.discretise(Quadrature::LeftPoint), sinking(), [10, 12, 14];
    of_a_driven_particle: Driven.discretise(Quadrature::LeftPoint), driven(), [12, 14, 16];
}

#[test]
fn a_force_is_composed_too() {
    order::<_, 2>(
        &Top.discretise(Quadrature::LeftPoint).with_force(Brake(0.3)),
        &top(),
        &[64, 128, 256],
    );
    order::<_, 4>(
        &Top.discretise(Quadrature::LeftPoint).with_force(Brake(0.3)),
        &top(),
        &[32, 64, 128],
    );
}

#[test]
fn the_adjoint_is_the_inverse_of_the_step_backwards() {
    let discrete = Sinking.discretise(Quadrature::LeftPoint);
    laws::check(&Adjoint(discrete), &[sinking()], 0.1).unwrap();
    let mut state = sinking();
    Variational::new(Adjoint(discrete))
        .step(&mut state, 0.1)
        .unwrap();
    Variational::new(discrete).step(&mut state, -0.1).unwrap();
    assert!(common::distance(&state, &sinking()) < 1e-12);
}

/// The free rigid body of Moser and Veselov: about an axis the balance is $h p = J \sin\theta$, without a solution for $h p > J$.
#[derive(Clone, Copy)]
struct FreeBody;

impl System for FreeBody {
    type Group = SO3;
}

impl DiscreteLagrangian for FreeBody {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, _: Context<S>, _: &SO3<S>, f: &SO3<S>, h: S) -> S {
        let minus_identity = f.minus_identity();
        let entry =
            |i: usize| minus_identity[(i, i)].times(0.5 * INERTIA.iter().sum::<f64>() - INERTIA[i]);
        -(entry(0) + entry(1) + entry(2)) / h
    }
}

#[test]
fn a_refused_part_undoes_the_parts_before() {
    let mu = Cotangent([0.0, 0.0, INERTIA[2]]);
    let mut state = State {
        t: 0.0,
        g: SO3::identity(),
        mu,
    };
    let mut integrator = Composition::new::<4>(FreeBody);
    integrator.step(&mut state, 0.1).unwrap();
    let before = state.clone();
    // Half of the first part is 0.83 s long, half of the third, which goes back in time, 1.3 s: beyond 1 s there is no solution.
    let error = integrator.step(&mut state, 4.0).unwrap_err();
    assert!(matches!(error.cause, Cause::NotConverged { .. }), "{error}");
    assert_eq!(state, before);
    integrator.step(&mut state, 1.0).unwrap();
}

/// Its parts count their steps, and a look ahead is none.
#[test]
fn a_peek_is_not_counted() {
    let integrator = || Composition::new::<4>(Top.discretise(Quadrature::LeftPoint));
    let (mut plain, mut watched) = (integrator(), integrator());
    let (mut a, mut b) = (top(), top());
    for _ in 0..40 {
        plain.step(&mut a, 0.05).unwrap();
        let ahead = watched.peek(&b, 0.02).unwrap();
        assert!(ahead.t > b.t);
        watched.step(&mut b, 0.05).unwrap();
    }
    // By what the tolerance of the parts leaves.
    assert!(common::distance(&a, &b) < 1e-11);
    let refused = watched.step(&mut b, f64::NAN).unwrap_err();
    assert!(
        matches!((refused.step, refused.cause), (40, Cause::InvalidStep)),
        "{refused}"
    );
}
