//! Variational Gauss: order, symplecticity, momenta, and how it refuses.

use dvi::{
    Cause, Context, FirstVariation, Force, Forced, Gauss, Hint, Integrator, Lagrangian,
    LeftTranslation, State, StepError, Variation, laws, momentum_map,
};
use lie::{Cayley, Cotangent, Exp, LieGroup, Retraction, SE3, SO3, Scalar, Tangent, VectorSpace};

use crate::common::{self, Brake, Driven, Sinking, Top, driven, sinking, top};

const VERTICAL: LeftTranslation<Tangent<3>> = LeftTranslation(Tangent([0.0, 0.0, 1.0]));

fn order<L: Lagrangian + Copy + 'static, const S: usize, R: Retraction>(
    lagrangian: &L,
    state: &State<L::Group>,
    steps: &[u32],
    tolerance: f64,
) {
    let integrator = || Gauss::new::<S>((*lagrangian).hamiltonian()).with_retraction::<R>();
    let order = laws::observed_order(integrator, state, 2.0, steps).unwrap();
    println!(
        "{} stages, {}: order {:.3} {:?}",
        S,
        R::NAME,
        order.slope,
        order.errors
    );
    assert!(
        (order.slope - 2.0 * S as f64).abs() < tolerance,
        "{order:?}"
    );
}

macro_rules! orders {
    ($($name:ident: $system:expr, $state:expr, $fourth:expr, $tolerance:expr;)+) => { $(
        #[test]
        fn $name() {
            fn with<R: Retraction>() {
                order::<_, 1, R>(&$system, &$state, &[64, 128, 256], 0.1);
                order::<_, 2, R>(&$system, &$state, &[16, 32, 64], 0.1);
                order::<_, 3, R>(&$system, &$state, &[16, 24, 32], 0.1);
                order::<_, 4, R>(&$system, &$state, &$fourth, $tolerance);
            }
            with::<Cayley>();
            with::<Exp>();
        }
    )+ };
}

orders! {
    orders_of_a_top: Top, top(), [7, 9, 11], 0.2;
    orders_on_se3: Sinking, sinking(), [7, 9, 11], 0.2;
    // Rounding comes before the order is reached: 7.75 at the shortest steps that show it.
    orders_of_a_driven_particle: Driven, driven(), [10, 12, 14], 0.3;
}

fn laws_of<L: Lagrangian + Copy + 'static, const S: usize, R: Retraction>(
    lagrangian: &L,
    state: &State<L::Group>,
) {
    let mut integrator = Gauss::new::<S>((*lagrangian).hamiltonian()).with_retraction::<R>();
    for h in [0.1, -0.3] {
        let defect = laws::symplectic_defect(&mut integrator, state, h).unwrap();
        println!("{S} stages, {}, h = {h}: defect {defect:.1e}", R::NAME);
        assert!(defect < 1e-11, "{defect:e}");
    }
}

#[test]
fn steps_are_symplectic() {
    fn with<const S: usize>() {
        laws_of::<_, S, Cayley>(&Top, &top());
        laws_of::<_, S, Exp>(&Top, &top());
        laws_of::<_, S, Cayley>(&Sinking, &sinking());
        laws_of::<_, S, Exp>(&Driven, &driven());
    }
    with::<1>();
    with::<2>();
    with::<3>();
    with::<4>();
    with::<5>();
    with::<6>();
    with::<7>();
    with::<8>();
}

#[test]
fn momentum_does_not_feel_the_tolerance() {
    let mut integrator = Gauss::new::<3>(Top.hamiltonian()).with_tolerance(1e-6);
    let (mut state, mut residual) = (top(), 0.0_f64);
    let map = |s: &State<SO3>| momentum_map(&VERTICAL, &s.g, &s.mu);
    let start = map(&state);
    for _ in 0..10_000 {
        residual = residual.max(integrator.step(&mut state, 0.05).unwrap().residual);
    }
    assert!(residual > 1e-9, "the tolerance was not used: {residual:e}");
    let drift = (map(&state) - start).abs() / start.abs();
    println!("momentum {drift:.1e}, residual {residual:.1e}");
    // A random walk of rounding, 10 eps sqrt(N).
    assert!(drift < 10.0 * f64::EPSILON * 100.0, "{drift:e}");
}

#[test]
fn a_force_enters_at_the_order() {
    let system = || Forced::new(Top.hamiltonian(), Brake(0.3));
    let integrator = || Gauss::new::<3>(system());
    assert!(!integrator().is_symplectic());
    let order = laws::observed_order(integrator, &top(), 2.0, &[16, 24, 32]).unwrap();
    assert!((order.slope - 6.0).abs() < 0.2, "{order:?}");
}

/// A constant force in the body's frame.
struct Constant(Cotangent<6>);

impl Force for Constant {
    type Group = SE3;

    fn force<S: Scalar>(
        &self,
        _: Context<S>,
        _: &SE3<S>,
        _: &Tangent<6, S>,
        out: &mut Cotangent<6, S>,
    ) {
        *out = Cotangent(self.0.0.map(S::from_f64));
    }
}

/// Columns of the state's variations, and of a force that acts at the stages.
#[test]
fn variations_are_those_of_differences() {
    let units = [
        Variation::basis(&sinking().g),
        Variation::forces(&sinking().g),
    ]
    .concat();
    let (mut state, mut carried) = (sinking(), units.clone());
    let mut integrator = Gauss::new::<3>(Sinking.hamiltonian());
    for _ in 0..20 {
        integrator
            .step_varied(&mut state, &mut carried, 0.1)
            .unwrap();
    }
    let width = 1e-4;
    for (unit, carried) in units.iter().zip(&carried) {
        let [ahead, behind] = [width, -width].map(|s| {
            let (mut state, eta) = (sinking(), unit.eta * s);
            state.g = state.g.compose(&SE3::exp(&eta));
            state.mu.add_scaled(s, &unit.mu);
            let force = Constant(unit.force * s);
            let mut integrator = Gauss::new::<3>(Forced::new(Sinking.hamiltonian(), force));
            for _ in 0..20 {
                integrator.step(&mut state, 0.1).unwrap();
            }
            state
        });
        let to = |end: &State<SE3>| state.g.inverse().compose(&end.g).log().unwrap();
        let (a, b) = (to(&ahead), to(&behind));
        let size = carried.eta.max_magnitude() + carried.mu.max_magnitude();
        for i in 0..6 {
            let slope = (a[i] - b[i]) / (2.0 * width);
            assert!((slope - carried.eta[i]).abs() < 1e-6 * size);
            let slope = (ahead.mu[i] - behind.mu[i]) / (2.0 * width);
            assert!((slope - carried.mu[i]).abs() < 1e-6 * size);
        }
    }
}

/// Far from the origin $x \times p$ must not take the digits of the momentum with it.
#[test]
fn the_origin_may_be_far() {
    let near = sinking();
    let mut far = near.clone();
    far.g = SE3::exp(&Tangent([0.0, 0.0, 0.0, 1e6, -2e6, 0.0])).compose(&near.g);
    let (mut a, mut b) = (near, far);
    let integrator = || Gauss::new::<3>(Sinking.hamiltonian());
    let (mut here, mut there) = (integrator(), integrator());
    for _ in 0..100 {
        here.step(&mut a, 0.1).unwrap();
        there.step(&mut b, 0.1).unwrap();
    }
    let turn = a.g.rotation.inverse().compose(&b.g.rotation).log().unwrap();
    println!(
        "attitudes near and far from the origin: {:.1e}",
        turn.max_magnitude()
    );
    assert!(turn.max_magnitude() < 1e-11, "{turn:?}");
}

/// A step that only Newton's method solves is solved to rounding: another, started from the solution, is the same.
#[test]
fn a_long_step_is_solved_to_rounding() {
    let fast = Top.state(0.0, top().g, &Tangent([0.6, -1.0, 2.0])).unwrap();
    let mut residual = 0.0_f64;
    for h in [0.4, 0.5, 0.6] {
        let mut integrator = Gauss::new::<1>(Top.hamiltonian());
        integrator.step(&mut fast.clone(), h).unwrap();
        let defect = laws::symplectic_defect(&mut integrator, &fast, h).unwrap();
        println!("h = {h}: defect {defect:.1e}");
        residual = residual.max(defect);
    }
    assert!(residual < 1e-11, "{residual:e}");
}

#[test]
fn a_refused_step_changes_nothing_and_names_shorter_ones_until_one_would_do() {
    let (mut state, mut integrator) = (top(), Gauss::new::<4>(Top.hamiltonian()));
    integrator.step(&mut state, 0.1).unwrap();
    let before = state.clone();
    let error = integrator.step(&mut state, 50.0).unwrap_err();
    let shorter = |error: &StepError| match error.cause {
        Cause::NotConverged {
            hint: Hint::SmallerStep { h } | Hint::AnotherBranch { h },
            ..
        } => h,
        _ => panic!("{error}"),
    };
    assert_eq!(state, before);
    let mut h = shorter(&error);
    // To 0.8 s, which the top takes.
    for _ in 0..5 {
        match Gauss::new::<4>(Top.hamiltonian()).step(&mut before.clone(), h) {
            Err(error) => h = shorter(&error),
            Ok(_) => return,
        }
    }
    panic!("no step that would do, down to {h}");
}

#[test]
fn what_is_wrong_before_the_step_is_named() {
    let mut integrator = Gauss::new::<2>(Top.hamiltonian());
    for h in [0.0, f64::NAN, f64::INFINITY] {
        let error = integrator.step(&mut top(), h).unwrap_err();
        assert!(matches!(error.cause, Cause::InvalidStep), "{error}");
    }
    let mut state = top();
    state.mu[1] = f64::NAN;
    let error = integrator.step(&mut state, 0.1).unwrap_err();
    assert!(matches!(error.cause, Cause::NotFinite), "{error}");
    let mut rest = top();
    rest.mu.set_zero();
    integrator.step(&mut rest, 0.1).unwrap();
}

/// Output between steps is of the method's order, and the steps go on as if nobody had looked.
#[test]
fn a_peek_is_of_the_method_s_order_and_no_step() {
    let error = |h: f64| {
        let mut integrator = Gauss::new::<3>(Top.hamiltonian());
        let mut state = top();
        integrator.step(&mut state, h).unwrap();
        let ahead = integrator.peek(&state, 0.37 * h).unwrap();
        let mut exact = top();
        let mut fine = Gauss::new::<8>(Top.hamiltonian());
        for _ in 0..10 {
            fine.step(&mut exact, 0.137 * h).unwrap();
        }
        common::distance(&ahead, &exact)
    };
    let order = (error(0.4) / error(0.2)).log2();
    println!("a step and a peek: order {order:.2}");
    assert!(
        (order - 7.0).abs() < 0.5,
        "the local error is of order 7: {order}"
    );

    let integrator = || Gauss::new::<3>(Top.hamiltonian());
    let (mut a, mut b, mut plain, mut watched) = (top(), top(), integrator(), integrator());
    for _ in 0..20 {
        plain.step(&mut a, 0.1).unwrap();
        let ahead = watched.peek(&b, 0.04).unwrap();
        watched.step(&mut b, 0.1).unwrap();
        assert!(ahead.t < b.t);
    }
    assert!(common::distance(&a, &b) < 1e-14);
}
