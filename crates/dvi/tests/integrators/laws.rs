//! The checker on right systems, and on wrong ones that it must catch by name.

use dvi::laws::{self, LawError};
use dvi::{
    Cause, Context, Derivatives, DiscreteLagrangian, Discretised, Gauss, Integrator, Lagrangian,
    LeftTranslation, Quadrature, RightTranslation, State, StepError, StepReport, System,
    Variational, legendre_plus,
};
use lie::{Cayley, Exp, LieGroup, Mat3, Retraction, SO3, Scalar, Tangent, VectorSpace};

use crate::common::{Driven, INERTIA, LEVER, Sinking, Top, driven, sinking, top};

const VERTICAL: LeftTranslation<Tangent<3>> = LeftTranslation(Tangent([0.0, 0.0, 1.0]));

fn prove<L: Lagrangian + Copy, R: Retraction>(
    system: L,
    rule: Quadrature,
    state: &State<L::Group>,
    until: f64,
) {
    let discrete = system.discretise(rule).with_retraction::<R>();
    let states = [state.clone()];
    for h in [0.05, -0.02] {
        let report = laws::check(&discrete, &states, h).unwrap_or_else(|e| panic!("{e}"));
        assert!(report.comparisons > 10);
        // Tolerances are worth something while the systems here come close to them, and safe while not too close.
        assert!(report.worst < 0.3, "{report:?}");
    }
    laws::check_consistency(&discrete, &system, &states).unwrap_or_else(|e| panic!("{e}"));
    let steps = [64, 128, 256, 512];
    let order = laws::check_order(|| Variational::new(&discrete), state, until, &steps);
    let order = order.unwrap_or_else(|e| panic!("{e}"));
    println!("{} {}: order {:.3}", rule.name(), R::NAME, order.slope);
}

macro_rules! prove {
    ($($name:ident: $system:expr, $state:expr, $until:expr;)+) => { $(
        #[test]
        fn $name() {
            fn with<R: Retraction>() {
                for rule in Quadrature::ALL {
                    prove::<_, R>($system, rule, &$state, $until);
                }
            }
            with::<Cayley>();
            with::<Exp>();
        }
    )+ };
}

prove! {
    every_rule_of_a_top: Top, top(), 1.0;
    every_rule_on_se3: Sinking, sinking(), 1.0;
    every_rule_of_a_driven_particle: Driven, driven(), 1.0;
}

#[test]
fn symmetries_of_a_top() {
    let discrete = Top.discretise(Quadrature::Midpoint);
    laws::check_symmetry(&discrete, &VERTICAL, &[top()], 0.05).unwrap();
    let error = laws::check_symmetry(
        &discrete,
        &LeftTranslation(Tangent([1.0, 0.0, 0.0])),
        &[top()],
        0.05,
    );
    named(error, "L_d(a g, (a g)^-1 a (g f)) = L_d(g, f)");
    let error = laws::check_symmetry(
        &discrete,
        &RightTranslation(Tangent([0.0, 0.0, 1.0])),
        &[top()],
        0.05,
    );
    named(error, "L_d(a g, (a g)^-1 a (g f)) = L_d(g, f)");
}

#[track_caller]
pub fn named<T: std::fmt::Debug>(verdict: Result<T, LawError>, law: &str) {
    match verdict {
        Err(LawError::Law(lie::laws::LawError::Violated {
            formula,
            left,
            right,
            tolerance,
            ..
        })) => {
            println!("{formula}: {left:.3e}, {right:.3e}, tolerance {tolerance:.1e}");
            assert_eq!(formula, law);
        }
        other => panic!("the mistake was not caught: {other:?}"),
    }
}

const NONE: u8 = 0;
const SIGN_OF_D_G: u8 = 1;
const FACTOR_OF_D_F: u8 = 2;
const SIGN_OF_POTENTIAL: u8 = 3;
const FACTOR_OF_KINETIC: u8 = 4;
const CLAIMS_SYMMETRY: u8 = 5;
const CLAIMS_ORDER: u8 = 6;
const MISSING_TERM: u8 = 7;

/// The top at the left point with derivatives by hand, as (23), (30) and (33) have them, and one deliberate mistake.
struct Hand<const MISTAKE: u8>;

impl<const M: u8> System for Hand<M> {
    type Group = SO3;
}

impl<const M: u8> DiscreteLagrangian for Hand<M> {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, f: &SO3<S>, h: S) -> S {
        let kinetic = -(f.symmetric_minus_identity() * jd()).trace() / h;
        let factor = if M == FACTOR_OF_KINETIC { 0.5 } else { 1.0 };
        let sign = if M == SIGN_OF_POTENTIAL { -1.0 } else { 1.0 };
        kinetic * S::from_f64(factor) - h * r.rotate(LEVER.lift())[2] * S::from_f64(sign)
    }

    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        r: &SO3<S>,
        f: &SO3<S>,
        h: S,
        (): &mut (),
        out: &mut Derivatives<SO3, S>,
    ) {
        if M == SIGN_OF_POTENTIAL || M == FACTOR_OF_KINETIC {
            return out.by_jets(self, at, r, f, h);
        }
        let factor = if M == FACTOR_OF_D_F { 2.0 } else { 1.0 };
        let momentum = (jd::<S>() * f.minus_identity()).skew_vee();
        out.d_f = (momentum * (S::from_f64(factor) / h)).into();
        let up = r.matrix().row(2);
        let sign = if M == SIGN_OF_D_G { -1.0 } else { 1.0 };
        let torque = up.cross(LEVER.lift()) * (h * S::from_f64(sign));
        out.d_g = torque.into();
        if M == MISSING_TERM {
            out.d_g[2] = S::zero();
        }
    }

    fn order(&self) -> u32 {
        if M == CLAIMS_ORDER { 2 } else { 1 }
    }

    fn is_symmetric(&self) -> bool {
        M == CLAIMS_SYMMETRY
    }
}

fn jd<S: Scalar>() -> Mat3<S> {
    let trace: f64 = INERTIA.iter().sum();
    Mat3::diagonal(INERTIA.map(|j| 0.5 * trace - j)).lift()
}

fn verdict<const M: u8>() -> Result<laws::Report, LawError> {
    laws::check(&Hand::<M>, &[top()], 0.05)?;
    laws::check_consistency(&Hand::<M>, &Top, &[top()])
}

#[test]
fn derivatives_by_hand_pass() {
    verdict::<NONE>().unwrap();
}

#[test]
fn mistakes_are_caught_and_named() {
    let law = "d_g = T*L_g D_g L_d, by duals";
    named(verdict::<SIGN_OF_D_G>(), law);
    named(verdict::<MISSING_TERM>(), law);
    named(verdict::<FACTOR_OF_D_F>(), "d_f = T*L_f D_f L_d, by duals");
    let law = "L_d(g, exp(h xi), h) / h = L(g, xi) + O(h)";
    named(verdict::<SIGN_OF_POTENTIAL>(), law);
    named(verdict::<FACTOR_OF_KINETIC>(), law);
    let law = "L_d(t, g, f, h) = -L_d(t + h, g f, f^-1, -h)";
    named(verdict::<CLAIMS_SYMMETRY>(), law);
    let integrator = || Variational::new(Hand::<CLAIMS_ORDER>);
    let error = laws::check_order(integrator, &top(), 1.0, &[64, 128, 256]);
    let Err(LawError::Order {
        declared: 2,
        observed,
        ..
    }) = error
    else {
        panic!("{error:?}");
    };
    assert!((observed - 1.0).abs() < 0.1, "{observed}");
}

/// Wrong derivatives, taken at their word, make a map that is not symplectic.
#[test]
fn a_step_with_a_wrong_derivative_is_not_symplectic() {
    let defect = laws::symplectic_defect(&mut Variational::new(Hand::<MISSING_TERM>), &top(), 0.05);
    let defect = defect.unwrap();
    assert!(defect > 1e-3, "{defect:e}");
    let verdict =
        laws::check_symplecticity(&mut Variational::new(Hand::<MISSING_TERM>), &[top()], 0.05);
    named(verdict, "omega(dF a, dF b) = omega(a, b)");
}

/// Solves a step to `tolerance` and derives the momentum anew from it, in place of carrying it.
struct Rederived(Variational<Discretised<Top>>);

impl Integrator for Rederived {
    type Group = SO3;

    fn order(&self) -> u32 {
        1
    }
    fn is_symmetric(&self) -> bool {
        false
    }
    fn is_symplectic(&self) -> bool {
        true
    }
    fn reset(&mut self) {
        self.0.reset();
    }
    fn step(&mut self, state: &mut State<SO3>, h: f64) -> Result<StepReport, StepError> {
        let f = self.0.displacement(state, h)?;
        state.mu = legendre_plus(self.0.lagrangian(), state.t, &state.g, &f, h);
        state.g = state.g.compose(&f);
        state.t += h;
        Ok(StepReport::default())
    }
}

#[test]
fn a_momentum_derived_from_an_unsolved_step_is_caught() {
    let discrete = || Top.discretise(Quadrature::LeftPoint);
    let loose = |tolerance| Rederived(Variational::new(discrete()).with_tolerance(tolerance));
    laws::check_step(&mut loose(1e-13), &discrete(), &[top()], 0.05).unwrap();
    let verdict = laws::check_step(&mut loose(1e-3), &discrete(), &[top()], 0.05);
    named(verdict, "F^- L_d (g_k, f_k) = mu_k");
    // The carried momentum of an equally loose step fails the other transform.
    let mut carried = Variational::new(discrete()).with_tolerance(1e-3);
    let verdict = laws::check_step(&mut carried, &discrete(), &[top()], 0.05);
    named(verdict, "F^- L_d (g_k, f_k) = mu_k");
}

#[test]
fn no_examples_do_not_pass() {
    let none: [State<SO3>; 0] = [];
    let discrete = Top.discretise(Quadrature::Midpoint);
    let verdicts = [
        laws::check(&discrete, &none, 0.1),
        laws::check_consistency(&discrete, &Top, &none),
        laws::check_symmetry(&discrete, &VERTICAL, &none, 0.1),
        laws::check_step(&mut Variational::new(&discrete), &discrete, &none, 0.1),
        laws::check_symplecticity(&mut Variational::new(&discrete), &none, 0.1),
        laws::check_reversibility(&mut Variational::new(&discrete), &none, 0.1),
    ];
    for verdict in verdicts {
        assert!(
            matches!(
                verdict,
                Err(LawError::Law(lie::laws::LawError::NoExamples { .. }))
            ),
            "{verdict:?}"
        );
    }
    let order = laws::check_order(|| Variational::new(&discrete), &top(), 1.0, &[64]);
    assert!(
        matches!(order, Err(LawError::TooFewRuns { .. })),
        "{order:?}"
    );
}

/// No inertia about the third axis: a momentum there has no velocity.
struct Needle;

impl System for Needle {
    type Group = SO3;
}

impl Lagrangian for Needle {
    fn value<S: Scalar>(&self, _: Context<S>, _: &SO3<S>, omega: &Tangent<3, S>) -> S {
        (omega[0] * omega[0] + omega[1] * omega[1]) * S::from_f64(0.5)
    }
}

/// A point mass on a rod: its weight pulls in the direction that has no inertia too.
struct PointMass;

impl System for PointMass {
    type Group = SO3;
}

impl Lagrangian for PointMass {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let rod = LEVER.lift();
        let speed = omega.vec3().cross(rod);
        speed.norm_squared().times(0.5) - r.rotate(rod)[2]
    }
}

#[test]
fn a_potential_does_not_hide_a_missing_inertia() {
    let verdict = laws::check(&PointMass.discretise(Quadrature::Midpoint), &[top()], 0.05);
    assert!(
        matches!(verdict, Err(LawError::Degenerate { .. })),
        "{verdict:?}"
    );
}

#[test]
fn a_refused_step_is_passed_on_and_the_degenerate_is_named() {
    let verdict = laws::check_step(
        &mut Variational::new(Needle.discretise(Quadrature::Midpoint)),
        &Needle.discretise(Quadrature::Midpoint),
        &[top()],
        0.05,
    );
    let degenerate = laws::check(&Needle.discretise(Quadrature::Midpoint), &[top()], 0.05);
    assert!(
        matches!(degenerate, Err(LawError::Degenerate { .. })),
        "{degenerate:?}"
    );
    let Err(LawError::Step(error)) = verdict else {
        panic!("{verdict:?}");
    };
    let error_of_gauss = Gauss::new::<2>(Needle.hamiltonian())
        .step(&mut top(), 0.05)
        .unwrap_err();
    assert_eq!(error_of_gauss, error);
    assert!(
        matches!(error.cause, Cause::Degenerate { coordinate: 2 }),
        "{error}"
    );
}

/// Legendre's transform of a state at rest has no size to divide by.
#[test]
fn a_system_at_rest_passes() {
    let mut rest = top();
    rest.mu.set_zero();
    laws::check(&Top.discretise(Quadrature::Midpoint), &[rest], 0.05).unwrap();
}
