//! The checker on Lagrangians that are not defined everywhere: no false alarm, and mistakes caught as elsewhere.

use dvi::laws::{self, LawError};
use dvi::{
    Context, Derivatives, DiscreteLagrangian, Lagrangian, LeftTranslation, Quadrature, State,
    System,
};
use lie::{Rn, Scalar, Tangent};

use crate::laws::named;

const STEPS: [f64; 3] = [0.05, 0.1, 0.5];

/// A particle of mass 1 where the speed of light is 1: $L = -\sqrt{1 - v^2}$.
#[derive(Clone, Copy)]
struct Relativistic;

impl System for Relativistic {
    type Group = Rn<3>;
}

impl Lagrangian for Relativistic {
    fn value<S: Scalar>(&self, _: Context<S>, _: &Rn<3, S>, v: &Tangent<3, S>) -> S {
        let square = v.0.iter().fold(S::zero(), |sum, v| sum + *v * *v);
        -(S::one() - square).sqrt()
    }
}

fn flying(v: [f64; 3]) -> State<Rn<3>> {
    let state = Relativistic.state(0.0, Rn([1.0, -2.0, 0.5]), &Tangent(v));
    state.unwrap()
}

/// A particle of 1 kg that a wall at $x = 0$ repels: $L = v^2 / 2 + 10^{-3} \ln x$.
#[derive(Clone, Copy)]
struct Barrier;

const STRENGTH: f64 = 1e-3;

impl System for Barrier {
    type Group = Rn<1>;
}

impl Lagrangian for Barrier {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
        v[0] * v[0] * S::from_f64(0.5) + x.0[0].ln() * S::from_f64(STRENGTH)
    }
}

fn near(x: f64, v: f64) -> State<Rn<1>> {
    Barrier.state(0.0, Rn([x]), &Tangent([v])).unwrap()
}

fn passes<L: Lagrangian + Copy>(system: L, rule: Quadrature, state: &State<L::Group>, h: f64) {
    let states = [state.clone()];
    let discrete = system.discretise(rule);
    let named = |error| panic!("{}, h = {h}: {error}", rule.name());
    let report = laws::check(&discrete, &states, h).unwrap_or_else(named);
    // As for systems that are defined everywhere.
    assert!(report.worst < 0.3, "{}, h = {h}: {report:?}", rule.name());
    laws::check_consistency(&discrete, &system, &states).unwrap_or_else(named);
}

fn passes_by_every_rule<L: Lagrangian + Copy>(system: L, state: &State<L::Group>, h: f64) {
    for rule in Quadrature::ALL {
        passes(system, rule, state, h);
    }
}

#[test]
fn below_the_speed_of_light() {
    for v in [
        [0.3, -0.2, 0.5],
        [0.0, 0.95, 0.0],
        [0.5, 0.5, -0.5],
        [0.0; 3],
    ] {
        let state = flying(v);
        for h in STEPS {
            passes_by_every_rule(Relativistic, &state, h);
            passes_by_every_rule(Relativistic, &state, -h);
            let shift = LeftTranslation(Tangent([0.0, 1.0, 0.0]));
            let discrete = Relativistic.discretise(Quadrature::Midpoint);
            laws::check_symmetry(&discrete, &shift, std::slice::from_ref(&state), h).unwrap();
        }
    }
}

#[test]
fn before_a_wall() {
    for (x, v) in [(0.1, 1.0), (0.1, 0.2), (0.1, 0.0), (0.1, -0.1), (1e-2, 1.0)] {
        for h in STEPS {
            passes_by_every_rule(Barrier, &near(x, v), h);
        }
    }
}

const NONE: u8 = 0;
const SIGN_OF_D_F: u8 = 1;
const FACTOR_OF_D_F: u8 = 2;
const SIGN_OF_D_G: u8 = 3;
const FACTOR_OF_D_G: u8 = 4;
const LOST_IN_THE_VALUE: u8 = 5;

/// Of `d_f` and `d_g`.
fn factors<S: Scalar>(mistake: u8) -> [S; 2] {
    let factors = match mistake {
        SIGN_OF_D_F => [-1.0, 1.0],
        FACTOR_OF_D_F => [2.0, 1.0],
        SIGN_OF_D_G => [1.0, -1.0],
        FACTOR_OF_D_G => [1.0, 2.0],
        _ => [1.0; 2],
    };
    factors.map(S::from_f64)
}

struct RelativisticByHand<const MISTAKE: u8>;

impl<const M: u8> System for RelativisticByHand<M> {
    type Group = Rn<3>;
}

impl<const M: u8> DiscreteLagrangian for RelativisticByHand<M> {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, _: Context<S>, _: &Rn<3, S>, f: &Rn<3, S>, h: S) -> S {
        -(S::one() - speed_squared(f, h)).sqrt() * h
    }

    fn derivatives<S: Scalar>(
        &self,
        _: Context<S>,
        _: &Rn<3, S>,
        f: &Rn<3, S>,
        h: S,
        (): &mut (),
        out: &mut Derivatives<Rn<3>, S>,
    ) {
        let [factor, _] = factors::<S>(M);
        let root = (S::one() - speed_squared(f, h)).sqrt();
        out.d_f.0 = f.0.map(|x| factor * x / h / root);
        out.d_g.0 = [S::zero(); 3];
    }
}

fn speed_squared<S: Scalar>(f: &Rn<3, S>, h: S) -> S {
    f.0.iter().fold(S::zero(), |sum, x| sum + *x * *x) / (h * h)
}

struct BarrierByHand<const MISTAKE: u8>;

impl<const M: u8> System for BarrierByHand<M> {
    type Group = Rn<1>;
}

impl<const M: u8> DiscreteLagrangian for BarrierByHand<M> {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, f: &Rn<1, S>, h: S) -> S {
        let (x, f) = (x.0[0], f.0[0]);
        let x = match M {
            // A constant: duals do not see that it varies, and derivatives by hand that agree with them are wrong.
            LOST_IN_THE_VALUE => S::from_f64(x.magnitude()),
            _ => x,
        };
        f * f * S::from_f64(0.5) / h + h * x.ln() * S::from_f64(STRENGTH)
    }

    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        x: &Rn<1, S>,
        f: &Rn<1, S>,
        h: S,
        (): &mut (),
        out: &mut Derivatives<Rn<1>, S>,
    ) {
        if M == LOST_IN_THE_VALUE {
            return out.by_jets(self, at, x, f, h);
        }
        let [of_f, of_g] = factors::<S>(M);
        out.d_f.0 = [of_f * f.0[0] / h];
        out.d_g.0 = [of_g * h * S::from_f64(STRENGTH) / x.0[0]];
    }
}

#[test]
fn mistakes_in_derivatives_by_hand_are_caught() {
    let (d_f, d_g) = (
        "d_f = T*L_f D_f L_d, by duals",
        "d_g = T*L_g D_g L_d, by duals",
    );
    for h in STEPS {
        let fast = [flying([0.3, -0.2, 0.5]), flying([0.0, 0.95, 0.0])];
        laws::check(&RelativisticByHand::<NONE>, &fast, h).unwrap();
        for state in [&fast[..1], &fast[1..], &[flying([0.0; 3])]] {
            named(
                laws::check(&RelativisticByHand::<SIGN_OF_D_F>, state, h),
                d_f,
            );
            named(
                laws::check(&RelativisticByHand::<FACTOR_OF_D_F>, state, h),
                d_f,
            );
        }
        laws::check(&BarrierByHand::<NONE>, &[near(0.1, 1.0)], h).unwrap();
        for state in [near(0.1, 1.0), near(0.1, -0.1), near(0.1, 0.0)] {
            let state = [state];
            named(laws::check(&BarrierByHand::<SIGN_OF_D_F>, &state, h), d_f);
            named(laws::check(&BarrierByHand::<FACTOR_OF_D_F>, &state, h), d_f);
            named(laws::check(&BarrierByHand::<SIGN_OF_D_G>, &state, h), d_g);
            named(laws::check(&BarrierByHand::<FACTOR_OF_D_G>, &state, h), d_g);
            named(
                laws::check(&BarrierByHand::<LOST_IN_THE_VALUE>, &state, h),
                "d_g = T*L_g D_g L_d, by central differences",
            );
        }
    }
}

/// Claims coordinates to be cyclic.
#[derive(Clone, Copy)]
struct Claims<L>(L, [usize; 2]);

impl<L: Lagrangian> System for Claims<L> {
    type Group = L::Group;

    fn cyclic(&self) -> core::ops::Range<usize> {
        self.1[0]..self.1[1]
    }
}

impl<L: Lagrangian> Lagrangian for Claims<L> {
    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &lie::Over<L::Group, S>,
        xi: &lie::AlgebraOver<L::Group, S>,
    ) -> S {
        self.0.value(at, g, xi)
    }
}

#[test]
fn coordinates_that_are_not_cyclic_are_caught() {
    let shifted = "L_d(g exp(s e), f) = L_d(g, f) along cyclic()";
    let barrier = Claims(Barrier, [0, 1]).discretise(Quadrature::Midpoint);
    named(laws::check(&barrier, &[near(0.1, 1.0)], 0.1), shifted);
    let (driven, state) = (crate::common::Driven, crate::common::driven());
    for claim in [[0, 1], [1, 2], [0, 2]] {
        let verdict = laws::check(
            &Claims(driven, claim).discretise(Quadrature::Midpoint),
            std::slice::from_ref(&state),
            0.05,
        );
        named(verdict, shifted);
    }
    // Position enters nowhere, but its coordinates turn with the body: no factor of a direct product.
    let (free, state) = (Claims(Floating, [3, 6]), crate::common::sinking());
    let verdict = laws::check(&free.discretise(Quadrature::Midpoint), &[state], 0.05);
    named(
        verdict,
        "Ad_f e = e along cyclic(), a factor R^m of a direct product",
    );
    // All of them too, whose equations are not linear.
    for claim in [[0, 1], [1, 3], [3, 3], [0, 3]] {
        let honest = Claims(Relativistic, claim).discretise(Quadrature::Midpoint);
        let verdict = laws::check(&honest, &[flying([0.3, -0.2, 0.5])], 0.1);
        verdict.unwrap_or_else(|e| panic!("{claim:?}: {e}"));
    }
}

/// [`Sinking`](crate::common::Sinking) without its weight.
#[derive(Clone, Copy)]
struct Floating;

impl System for Floating {
    type Group = lie::SE3;
}

impl Lagrangian for Floating {
    fn value<S: Scalar>(&self, at: Context<S>, g: &lie::SE3<S>, xi: &Tangent<6, S>) -> S {
        crate::common::Sinking.value(at, g, xi) + g.translation[2] * S::from_f64(0.4)
    }
}

#[test]
fn coordinates_that_are_not_there_are_named() {
    for claim in [[0, 4], [3, 4], [9, 12]] {
        let (system, states) = (Claims(Relativistic, claim), [flying([0.3, -0.2, 0.5])]);
        let discrete = system.discretise(Quadrature::Midpoint);
        let shift = LeftTranslation(Tangent([0.0, 1.0, 0.0]));
        let expected = Err(LawError::Cyclic {
            cyclic: claim[0]..claim[1],
            dimension: 3,
        });
        assert_eq!(laws::check(&discrete, &states, 0.1), expected);
        let verdict = laws::check_symmetry(&discrete, &shift, &states, 0.1);
        assert_eq!(verdict, expected);
    }
}

/// A derivative along a coordinate that is declared cyclic, where the value has none.
struct Pushed;

impl System for Pushed {
    type Group = Rn<3>;

    fn cyclic(&self) -> core::ops::Range<usize> {
        0..3
    }
}

impl DiscreteLagrangian for Pushed {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, at: Context<S>, g: &Rn<3, S>, f: &Rn<3, S>, h: S) -> S {
        RelativisticByHand::<NONE>.value(at, g, f, h)
    }

    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Rn<3, S>,
        f: &Rn<3, S>,
        h: S,
        work: &mut (),
        out: &mut Derivatives<Rn<3>, S>,
    ) {
        RelativisticByHand::<NONE>.derivatives(at, g, f, h, work, out);
        out.d_g.0[1] = h * S::from_f64(1e-6);
    }
}

#[test]
fn a_force_along_a_cyclic_coordinate_is_caught() {
    let verdict = laws::check(&Pushed, &[flying([0.3, -0.2, 0.5])], 0.1);
    named(verdict, "d_g = 0 along cyclic()");
}
