//! The stepping map on small systems: what it keeps, and how it refuses.

use std::ops::Range;

use dvi::{
    Cause, Context, DiscreteLagrangian, Gauss, Hint, Integrator, Lagrangian, State, StepError,
    System, Variational, legendre_minus, legendre_plus,
};
use lie::{
    AlgebraOver, Cotangent, LieGroup, Mat3, Over, Power, R3, Rn, SO3, Scalar, Tangent, Vec3,
    VectorSpace,
};

/// Any number of heavy tops that do not feel each other, on a power of run-time size.
struct Tops;

/// $J$ of a top, kg m².
const INERTIA: [f64; 3] = [1.0, 2.0, 3.5];
/// Weight times the mass centre, N m.
const LEVER: Vec3 = Vec3([0.1, 0.2, 0.7]);

fn top<S: Scalar>(r: &SO3<S>, f: &SO3<S>, h: S) -> S {
    let trace: f64 = INERTIA.iter().sum();
    let jd = Mat3::diagonal(INERTIA.map(|j| 0.5 * trace - j)).lift::<S>();
    -(f.symmetric_minus_identity() * jd).trace() / h - h * r.rotate(LEVER.lift())[2]
}

impl System for Tops {
    type Group = Power<SO3>;
}

impl DiscreteLagrangian for Tops {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, _: Context<S>, g: &Power<SO3<S>>, f: &Power<SO3<S>>, h: S) -> S {
        g.iter()
            .zip(f.iter())
            .fold(S::zero(), |sum, (r, f)| sum + top(r, f, h))
    }
}

/// A body whose position is that of a point off its mass centre: translation is cyclic, and coupled to the rotation.
struct OffCentre;

const OFFSET: Vec3 = Vec3([0.5, -0.3, 0.2]);

impl System for OffCentre {
    type Group = (SO3, R3);

    fn cyclic(&self) -> Range<usize> {
        3..6
    }
}

impl DiscreteLagrangian for OffCentre {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, _: Context<S>, g: &(SO3<S>, R3<S>), f: &(SO3<S>, R3<S>), h: S) -> S {
        let moved = f.1.vec3() + g.0.rotate(f.0.minus_identity() * OFFSET.lift());
        moved.norm_squared() / (h + h) + top(&SO3::identity(), &f.0, h)
    }
}

impl Lagrangian for OffCentre {
    fn value<S: Scalar>(
        &self,
        _: Context<S>,
        g: &Over<(SO3, R3), S>,
        xi: &AlgebraOver<(SO3, R3), S>,
    ) -> S {
        let (omega, v) = (xi.0.vec3(), xi.1.vec3());
        let moved = v + g.0.rotate(omega.cross(OFFSET.lift()));
        let spin = Mat3::diagonal(INERTIA).lift::<S>() * omega;
        (moved.norm_squared() + omega.dot(spin)) * S::from_f64(0.5)
    }
}

fn tops(n: usize) -> State<Power<SO3>> {
    let turn = |i: usize| SO3::exp(&Tangent([0.3 * i as f64, 0.1, -0.2]));
    let spin = |i: usize| Cotangent([0.5, -1.0 + i as f64, 4.0]);
    State {
        t: 0.0,
        g: (0..n).map(turn).collect(),
        mu: (0..n).map(spin).collect(),
    }
}

fn off_centre() -> State<(SO3, R3)> {
    let g = (SO3::exp(&Tangent([0.4, -1.0, 0.3])), Rn([1.0, 2.0, 3.0]));
    let xi = (Tangent([0.3, -0.5, 1.0]), Tangent([0.2, 0.1, -0.4]));
    OffCentre.state(0.0, g, &xi).unwrap()
}

#[test]
fn the_default_legendre_transform_differentiates() {
    let (state, xi) = (
        off_centre(),
        [Vec3([0.3, -0.5, 1.0]), Vec3([0.2, 0.1, -0.4])],
    );
    let moved = xi[1] + state.g.0.rotate(xi[0].cross(OFFSET));
    let spin = Mat3::diagonal(INERTIA) * xi[0] + OFFSET.cross(state.g.0.inverse_rotate(moved));
    assert!((state.mu.1.vec3() - moved).norm() < 1e-15);
    assert!((state.mu.0.vec3() - spin).norm() < 1e-15);
}

#[test]
fn a_vertical_field_keeps_the_vertical_momentum() {
    let (mut state, mut integrator) = (tops(3), Variational::new(Tops));
    let vertical = |s: &State<Power<SO3>>| {
        let spins =
            s.g.iter()
                .zip(s.mu.iter())
                .map(|(r, mu)| r.rotate(mu.vec3())[2]);
        spins.collect::<Vec<_>>()
    };
    let start = vertical(&state);
    for _ in 0..2000 {
        integrator.step(&mut state, 0.01).unwrap();
    }
    for (now, start) in vertical(&state).iter().zip(start) {
        // A random walk of rounding, 10 eps sqrt(N), of a momentum of 4.
        assert!((now - start).abs() < 4.0 * 10.0 * f64::EPSILON * 2000_f64.sqrt());
    }
}

/// Loose tolerance, tight cyclic equations: position and rotation exchange momentum to rounding.
#[test]
fn cyclic_coordinates_are_solved_to_rounding() {
    let mut integrator = Variational::new(OffCentre).with_tolerance(1e-5);
    let mut state = off_centre();
    let angular =
        |s: &State<(SO3, R3)>| s.g.1.vec3().cross(s.mu.1.vec3()) + s.g.0.rotate(s.mu.0.vec3());
    let (start, mut residual) = (state.clone(), 0.0_f64);
    for _ in 0..2000 {
        residual = residual.max(integrator.step(&mut state, 0.01).unwrap().residual);
    }
    assert!(residual > 1e-9, "the tolerance was not used: {residual:e}");
    assert_eq!(state.mu.1, start.mu.1);
    let drift = (angular(&state) - angular(&start)).norm() / angular(&start).norm();
    assert!(drift < 10.0 * f64::EPSILON * 2000_f64.sqrt(), "{drift:e}");
}

#[test]
fn the_legendre_transforms_invert_the_displacement() {
    let (state, mut integrator) = (tops(2), Variational::new(Tops));
    let f = integrator.displacement(&state, 0.02).unwrap();
    let mut next = state.clone();
    integrator.step(&mut next, 0.02).unwrap();
    let minus = legendre_minus(&Tops, 0.0, &state.g, &f, 0.02);
    let plus = legendre_plus(&Tops, 0.0, &state.g, &f, 0.02);
    for i in 0..2 {
        assert!((minus[i].vec3() - state.mu[i].vec3()).norm() < 1e-12);
        assert!((plus[i].vec3() - next.mu[i].vec3()).norm() < 1e-12);
        assert!((state.g[i].compose(&f[i]).matrix().0) == next.g[i].matrix().0);
    }
}

/// For this $L_d$ the step of $-h$ is not the inverse of the step of $h$, but of its adjoint; both exist and are solved.
#[test]
fn time_runs_backwards_too() {
    let (mut state, start) = (tops(1), tops(1));
    let mut integrator = Variational::new(Tops);
    for h in [1e-3, -1e-3] {
        for _ in 0..100 {
            integrator.step(&mut state, h).unwrap();
        }
    }
    let back = state.g[0]
        .inverse()
        .compose(&start.g[0])
        .log()
        .unwrap()
        .vec3()
        .norm();
    // The method's own error, of the order of h t.
    assert!(back < 1e-3, "{back:e}");
    assert!(state.t.abs() < 1e-15);
}

#[test]
fn a_body_at_rest_stays_at_rest() {
    let mut state = off_centre();
    state.mu = state.g.zero_dual();
    let start = state.clone();
    let mut integrator = Variational::new(OffCentre);
    for _ in 0..10 {
        let report = integrator.step(&mut state, 0.1).unwrap();
        assert_eq!(report.residual, 0.0);
    }
    assert_eq!((state.g, state.mu), (start.g, start.mu));
}

#[test]
fn the_shape_may_change_and_may_be_empty() {
    let mut integrator = Variational::new(Tops);
    for n in [2, 3, 1, 0, 2] {
        integrator.step(&mut tops(n), 0.01).unwrap();
    }
}

#[test]
fn what_is_wrong_before_the_step_is_named() {
    let mut integrator = Variational::new(Tops);
    for h in [0.0, f64::NAN, f64::INFINITY] {
        let (mut state, start) = (tops(1), tops(1));
        let error = integrator.step(&mut state, h).unwrap_err();
        assert!(
            matches!((error.step, error.cause), (0, Cause::InvalidStep)),
            "{error}"
        );
        assert_eq!(state, start);
    }
    let mut state = State {
        mu: tops(3).mu,
        ..tops(2)
    };
    let error = integrator.step(&mut state, 0.01).unwrap_err();
    assert!(
        matches!(
            error.cause,
            Cause::Shape {
                expected: 6,
                found: 9
            }
        ),
        "{error}"
    );
    let mut state = tops(1);
    state.mu[0][1] = f64::NAN;
    let error = integrator.step(&mut state, 0.01).unwrap_err();
    assert!(matches!(error.cause, Cause::NotFinite), "{error}");
    let mut state = tops(1);
    state.g[0] = SO3::from_matrix_unchecked(Mat3([[f64::INFINITY; 3]; 3]));
    let error = integrator.step(&mut state, 0.01).unwrap_err();
    assert!(matches!(error.cause, Cause::NotFinite), "{error}");
}

#[test]
fn a_refused_step_changes_nothing_and_says_what_to_try() {
    let (mut state, mut integrator) = (tops(1), Variational::new(Tops));
    integrator.step(&mut state, 0.01).unwrap();
    let before = state.clone();
    let error = integrator.step(&mut state, 20.0).unwrap_err();
    let StepError {
        step,
        h,
        cause:
            Cause::NotConverged {
                hint: Hint::SmallerStep { h: smaller },
                ..
            },
        ..
    } = error
    else {
        panic!("{error}");
    };
    assert!(step == 1 && h == 20.0 && smaller < h);
    assert_eq!(state, before);
    // The refusal leaves no trace: the next step is that of an integrator that never saw it.
    let (mut other, mut fresh) = (before, Variational::new(Tops));
    let reports = [
        integrator.step(&mut state, 0.01),
        fresh.step(&mut other, 0.01),
    ];
    assert_eq!(reports[0], reports[1]);
    assert_eq!(state, other);
}

/// A matrix left over from a state a thousand times faster must not spoil the next step.
#[test]
fn a_wild_state_does_not_poison_the_integrator() {
    let (mut wild, mut integrator) = (tops(1), Variational::new(Tops));
    wild.mu[0] = wild.mu[0] * 1e3;
    integrator.step(&mut wild, 0.1).unwrap_err();
    let (mut state, mut other) = (tops(1), tops(1));
    integrator.step(&mut state, 0.1).unwrap();
    Variational::new(Tops).step(&mut other, 0.1).unwrap();
    assert_eq!(state, other);
}

/// Looking ahead is no step: what follows is the same, to the number of iterations.
#[test]
fn a_displacement_leaves_the_integrator_as_it_was() {
    let (mut a, mut b) = (tops(1), tops(1));
    let (mut asked, mut plain) = (Variational::new(Tops), Variational::new(Tops));
    for _ in 0..50 {
        asked.displacement(&a, 0.01).unwrap();
        let reports = [asked.step(&mut a, 0.01), plain.step(&mut b, 0.01)];
        assert_eq!(
            reports[0].unwrap().iterations,
            reports[1].unwrap().iterations
        );
    }
}

/// The cyclic equation of this Lagrangian cannot be solved by its own block, which is singular.
struct Singular;

impl System for Singular {
    type Group = Rn<2>;

    fn cyclic(&self) -> Range<usize> {
        0..1
    }
}

impl DiscreteLagrangian for Singular {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, _: Context<S>, _: &Rn<2, S>, f: &Rn<2, S>, h: S) -> S {
        let [a, b] = f.0.map(|x| x / h);
        h * (a * b * S::from_f64(0.7) + a * b * b * b * S::from_f64(0.3))
    }
}

#[test]
fn no_number_that_is_not_finite_leaves_as_ok() {
    let mut state = State {
        t: 0.0,
        g: Rn([0.0, 0.0]),
        mu: Cotangent([0.3, 0.2]),
    };
    let mut integrator = Variational::new(Singular);
    for _ in 0..5 {
        if let Ok(report) = integrator.step(&mut state, 0.01) {
            assert!(report.residual.is_finite());
        }
        assert!(state.g.is_finite() && state.mu.max_magnitude().is_finite());
    }
    let mut state = off_centre();
    state.g.1.0[0] = f64::NAN;
    let error = Variational::new(OffCentre)
        .step(&mut state, 0.01)
        .unwrap_err();
    assert!(matches!(error.cause, Cause::NotFinite), "{error}");
    let error = Variational::new(OffCentre).peek(&state, 0.01).unwrap_err();
    assert!(matches!(error.cause, Cause::NotFinite), "{error}");
    let gauss = Gauss::new::<2>(OffCentre.hamiltonian()).peek(&state, 0.01);
    assert_eq!(gauss.unwrap_err().cause, Cause::NotFinite);
    let mut pair = Variational::new(OffCentre)
        .pair(&off_centre(), 0.01)
        .unwrap();
    pair.g.1.0[0] = f64::NAN;
    let before = format!("{pair:?}");
    let error = Variational::new(OffCentre)
        .step_pair(&mut pair)
        .unwrap_err();
    assert!(matches!(error.cause, Cause::NotFinite), "{error}");
    assert_eq!(format!("{pair:?}"), before);
    let mut state = State {
        t: f64::NAN,
        ..off_centre()
    };
    let error = Variational::new(OffCentre)
        .step(&mut state, 0.01)
        .unwrap_err();
    assert!(matches!(error.cause, Cause::NotFinite), "{error}");
}

/// Momenta whose squares are no numbers any more.
#[test]
fn tiny_and_huge_momenta_are_stepped() {
    for scale in [1e-170, 1e-100, 1e100] {
        let mut state = State {
            g: (SO3::identity(), R3::identity()),
            ..off_centre()
        };
        state.mu = (state.mu.0 * scale, state.mu.1 * scale);
        let h = if scale > 1.0 { 1e-2 / scale } else { 1e-2 };
        let report = Variational::new(OffCentre).step(&mut state, h).unwrap();
        assert!(report.residual <= 1e-13);
        assert!(state.g.1.0.iter().all(|x| *x != 0.0), "it moved");
    }
}

#[test]
fn an_unreachable_tolerance_is_told_from_a_step_too_long() {
    let mut integrator = Variational::new(Tops).with_tolerance(1e-19);
    let error = integrator.step(&mut tops(1), 0.01).unwrap_err();
    let Cause::NotConverged {
        hint: Hint::LooserTolerance { tolerance },
        ..
    } = error.cause
    else {
        panic!("{error}");
    };
    Variational::new(Tops)
        .with_tolerance(tolerance)
        .step(&mut tops(1), 0.01)
        .unwrap();
}

/// A body that turns about a fixed axis; its balance is $\sin\theta = h \omega$.
fn spin(omega: f64) -> State<Power<SO3>> {
    State {
        t: 0.0,
        g: Power::new(vec![SO3::identity()]),
        mu: Power::new(vec![Cotangent([0.0, 0.0, INERTIA[2] * omega])]),
    }
}

struct Free;

impl System for Free {
    type Group = Power<SO3>;
}

impl DiscreteLagrangian for Free {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, _: Context<S>, _: &Power<SO3<S>>, f: &Power<SO3<S>>, h: S) -> S {
        let free = |f| top(&SO3::identity(), f, h);
        f.iter().fold(S::zero(), |sum, f| sum + free(f))
    }
}

/// What a loose tolerance takes for rounding must not be a root, nor end the search for one.
#[test]
fn a_loose_tolerance_finds_the_root_that_the_default_finds() {
    for (h, tolerance) in [(0.9, 1e-13), (0.9, 5e-4), (-0.9, 1e-13)] {
        let mut state = spin(1.0);
        let mut integrator = Variational::new(Free).with_tolerance(tolerance);
        integrator.step(&mut state, h).unwrap();
        let turn = state.g[0].log().unwrap()[2];
        // The slope of the sine there is 0.44.
        assert!((turn - h.asin()).abs() < 3.0 * tolerance + 1e-12, "{turn}");
    }
}

#[test]
fn beyond_the_fold_there_is_no_step() {
    let before = spin(1.0);
    let mut state = before.clone();
    let error = Variational::new(Free).step(&mut state, 1.01).unwrap_err();
    assert!(matches!(error.cause, Cause::NotConverged { .. }), "{error}");
    assert_eq!(state, before);
}
