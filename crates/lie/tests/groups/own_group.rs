//! A user's own group: the required items alone, proved by the law suite; and wrong ones, caught by it.

use core::cell::Cell;

use lie::laws::{self, LawError};
use lie::{
    Cayley, Chart, Cotangent, Exp, LieGroup, NotUnique, OutsideChart, Over, Retraction, SE3, SO3,
    Scalar, Tangent, Vec3, VectorSpace, dexp,
};

/// The Heisenberg group of upper triangular 3×3 matrices with ones on the diagonal, by its entries.
#[derive(Clone, Debug, PartialEq)]
struct Heisenberg<S = f64> {
    a: S,
    b: S,
    c: S,
}

impl<S: Scalar> LieGroup for Heisenberg<S> {
    type Scalar = S;
    type Algebra = Tangent<3, S>;
    type Dual = Cotangent<3, S>;
    type WithScalar<T: Scalar> = Heisenberg<T>;

    fn zero_algebra(&self) -> Tangent<3, S> {
        Tangent::zero()
    }
    fn zero_dual(&self) -> Cotangent<3, S> {
        Cotangent::zero()
    }
    fn convert<A: Scalar, B: Scalar>(
        g: &Heisenberg<A>,
        f: impl Fn(A) -> B + Copy,
    ) -> Over<Self, B> {
        Heisenberg {
            a: f(g.a),
            b: f(g.b),
            c: f(g.c),
        }
    }
    fn compose(&self, h: &Self) -> Self {
        Self {
            a: self.a + h.a,
            b: self.b + h.b,
            c: self.c + h.c + self.a * h.b,
        }
    }
    fn inverse(&self) -> Self {
        Self {
            a: -self.a,
            b: -self.b,
            c: self.a * self.b - self.c,
        }
    }
    fn exp(xi: &Tangent<3, S>) -> Self {
        let [a, b, c] = xi.0;
        Self {
            a,
            b,
            c: c + a * b * S::from_f64(0.5),
        }
    }
    fn log(&self) -> Result<Tangent<3, S>, NotUnique<Tangent<3, S>>> {
        Ok(Tangent([
            self.a,
            self.b,
            self.c - self.a * self.b * S::from_f64(0.5),
        ]))
    }
    fn adjoint(&self, xi: &Tangent<3, S>) -> Tangent<3, S> {
        Tangent([xi[0], xi[1], xi[2] + self.a * xi[1] - self.b * xi[0]])
    }
    fn bracket(xi: &Tangent<3, S>, eta: &Tangent<3, S>) -> Tangent<3, S> {
        Tangent([S::zero(), S::zero(), xi[0] * eta[1] - xi[1] * eta[0]])
    }
}

#[test]
fn the_required_items_alone_make_a_group() {
    let velocities = [
        Tangent([0.3, -0.4, 1.2]),
        Tangent([-1.5, 0.2, 0.1]),
        Tangent([1e-8, 2e-8, 0.0]),
    ];
    let elements = velocities.map(|xi| Heisenberg::exp(&xi));
    let report = laws::check(&elements, &velocities).unwrap();
    assert!(report.worst < 1.0 && report.comparisons > 500, "{report:?}");
}

/// The algebra of SE(3), with one deliberate mistake.
#[derive(Clone, Debug, PartialEq)]
struct Twist<S = f64>(Tangent<6, S>);

/// The dual of it, likewise.
#[derive(Clone, Debug, PartialEq)]
struct Wrench<S = f64>(Cotangent<6, S>);

/// SE(3) without closed forms of the exponential's differential, and with one deliberate mistake.
#[derive(Clone, Debug, PartialEq)]
struct Slow<S = f64>(SE3<S>);

thread_local! {
    /// The mistake that is made in this test's thread: at run time, so that the laws are compiled once.
    static MISTAKE: Cell<u8> = const { Cell::new(NONE) };
}

fn mistake() -> u8 {
    MISTAKE.get()
}

const NONE: u8 = 0;
const COADJOINT: u8 = 1;
const BRACKET: u8 = 2;
const DIFFERENTIAL: u8 = 3;
const INVERSE: u8 = 4;
const ADJOINT: u8 = 5;
const NO_BRACKET: u8 = 6;
const COADJOINT_BRACKET: u8 = 7;
const CAYLEY_TWICE: u8 = 8;
const DIFFERENTIAL_TWICE: u8 = 9;
const NO_CAYLEY_INVERSE: u8 = 10;
const LOG_ZERO_FAR: u8 = 11;
const LOG_LONG_WAY: u8 = 12;
const LOG_NEVER_UNIQUE: u8 = 13;
const LOG_INFINITE: u8 = 14;
const NORMALIZE_AWAY: u8 = 15;
const NORMALIZE_NOT: u8 = 16;
const ZERO_ALGEBRA: u8 = 17;
const ZERO_DUAL: u8 = 18;
const CONVERT_INTO: u8 = 20;
const COMPOSE_INTO: u8 = 21;
const COADJOINT_INTO: u8 = 22;
const EXP_INTO: u8 = 23;
const CAYLEY_INTO: u8 = 24;
const ROOT_NOT: u8 = 25;
const ROOT_FAR: u8 = 26;
const DUAL_DIFFERENTIAL: u8 = 27;
const DUAL_INVERSE: u8 = 28;
const CAYLEY_DUAL_DIFFERENTIAL: u8 = 29;
const CAYLEY_DUAL_INVERSE: u8 = 30;
const GRADIENT: u8 = 31;
const CAYLEY_GRADIENT: u8 = 32;
const INVERSE_INTO: u8 = 33;
const INVERSE_COADJOINT_INTO: u8 = 34;
const ADVANCE_BESIDE: u8 = 35;
const CHART_END: u8 = 36;
const CHART_RATES: u8 = 37;
const ROOT_INTO: u8 = 38;
const CHART_INTO: u8 = 39;
/// Mistakes of the algebra from here on, those of the dual from [`DUAL`] on.
const ALGEBRA: u8 = 40;
const DUAL: u8 = 60;
const WRITE: u8 = 0;
const READ: u8 = 1;
const SET_ZERO: u8 = 2;
const ADD_SCALED: u8 = 3;
const SET_SUM: u8 = 4;
const NORM: u8 = 5;
const MAX: u8 = 6;
const SCALE: u8 = 7;

/// A vector space by its coordinates, with the mistake `M - $first`.
macro_rules! mistaken_vectors {
    ($name:ident, $first:ident) => {
        impl<S: Scalar> VectorSpace for $name<S> {
            type Scalar = S;
            fn dim(&self) -> usize {
                6
            }
            fn get(&self, i: usize) -> S {
                self.0.get(i)
            }
            fn set(&mut self, i: usize, value: S) {
                self.0.set(i, value);
            }
            fn write(&self, out: &mut [S]) {
                if mistake() != $first + WRITE {
                    self.0.write(out);
                }
            }
            fn read(&mut self, from: &[S]) {
                if mistake() != $first + READ {
                    self.0.read(from);
                }
            }
            fn set_zero(&mut self) {
                if mistake() != $first + SET_ZERO {
                    self.0.set_zero();
                }
            }
            fn scale(&mut self, a: S) {
                if mistake() != $first + SCALE {
                    self.0.scale(a);
                }
            }
            fn add_scaled(&mut self, a: S, y: &Self) {
                if mistake() != $first + ADD_SCALED {
                    self.0.add_scaled(a, &y.0);
                }
            }
            fn set_sum(&mut self, x: &Self, a: S, y: &Self) {
                if mistake() != $first + SET_SUM {
                    self.0.set_sum(&x.0, a, &y.0);
                }
            }
            fn norm_squared(&self) -> f64 {
                let wrong = f64::from(mistake() == $first + NORM);
                self.0.norm_squared() + wrong
            }
            fn max_magnitude(&self) -> f64 {
                let wrong = f64::from(mistake() == $first + MAX);
                self.0.max_magnitude() + wrong
            }
        }
    };
}

mistaken_vectors!(Twist, ALGEBRA);
mistaken_vectors!(Wrench, DUAL);

fn times<S: Scalar>(a: f64, xi: Tangent<6, S>) -> Tangent<6, S> {
    xi * S::from_f64(a)
}

/// $1 - 2\pi/\theta$, which takes a logarithm the other way round where $\theta > 1$.
fn long_way<S: Scalar>(xi: &Tangent<6, S>) -> S {
    let square = xi.split().0.norm_squared();
    let far = S::one().less(square);
    let theta = S::select(far, square, S::one()).sqrt();
    let factor = S::one() - S::from_f64(2.0 * core::f64::consts::PI) / theta;
    S::select(far, factor, S::one())
}

impl<S: Scalar> Slow<S> {
    /// The logarithm of $\exp\xi$ the other way round where $\theta > 1$.
    fn long_logarithm(xi: Tangent<6, S>) -> Tangent<6, S> {
        let (w, v) = xi.split();
        let turned = w * long_way(&xi);
        let x = SE3::exp(&xi).translation;
        let straight = SO3::d_right_inv::<Exp>(&turned.into(), &x.into());
        let far = w.norm_squared().magnitude() > 1.0;
        (turned, if far { straight.vec3() } else { v }).into()
    }

    /// The logarithm of SE(3), with the mistake.
    fn mistaken_log(xi: Tangent<6, S>) -> Tangent<6, S> {
        let (w, _) = xi.split();
        match mistake() {
            LOG_ZERO_FAR if w.norm_squared().magnitude() > 2.0 => Tangent::zero(),
            LOG_LONG_WAY => Self::long_logarithm(xi),
            LOG_INFINITE if w.norm_squared().magnitude() > 1.0 => times(f64::INFINITY, xi),
            _ => xi,
        }
    }
}

impl<S: Scalar> LieGroup for Slow<S> {
    type Scalar = S;
    type Algebra = Twist<S>;
    type Dual = Wrench<S>;
    type WithScalar<T: Scalar> = Slow<T>;

    fn zero_algebra(&self) -> Twist<S> {
        Twist(Tangent(
            [S::from_f64(f64::from(mistake() == ZERO_ALGEBRA)); 6],
        ))
    }
    fn zero_dual(&self) -> Wrench<S> {
        Wrench(Cotangent(
            [S::from_f64(f64::from(mistake() == ZERO_DUAL)); 6],
        ))
    }
    fn identity_like(&self) -> Self {
        Self(SE3::identity())
    }
    fn convert<A: Scalar, B: Scalar>(g: &Slow<A>, f: impl Fn(A) -> B + Copy) -> Over<Self, B> {
        Slow(<SE3<S> as LieGroup>::convert(&g.0, f))
    }
    fn compose(&self, h: &Self) -> Self {
        Self(self.0.compose(&h.0))
    }
    fn inverse(&self) -> Self {
        let mut inverse = self.0.inverse();
        if mistake() == INVERSE {
            inverse.translation = -self.0.translation;
        }
        Self(inverse)
    }
    fn exp(xi: &Twist<S>) -> Self {
        Self(SE3::exp(&xi.0))
    }
    fn log(&self) -> Result<Twist<S>, NotUnique<Twist<S>>> {
        match self.0.log() {
            Ok(xi) if mistake() != LOG_NEVER_UNIQUE => Ok(Twist(Self::mistaken_log(xi))),
            Ok(representative) | Err(NotUnique { representative }) => Err(NotUnique {
                representative: Twist(representative),
            }),
        }
    }
    fn adjoint(&self, xi: &Twist<S>) -> Twist<S> {
        Twist(match mistake() {
            ADJOINT => self.0.inverse().adjoint(&xi.0),
            _ => self.0.adjoint(&xi.0),
        })
    }
    fn bracket(xi: &Twist<S>, eta: &Twist<S>) -> Twist<S> {
        Twist(match mistake() {
            BRACKET => SE3::bracket(&eta.0, &xi.0),
            NO_BRACKET => Tangent::zero(),
            _ => SE3::bracket(&xi.0, &eta.0),
        })
    }
    fn coadjoint(&self, mu: &Wrench<S>) -> Wrench<S> {
        Wrench(match mistake() {
            COADJOINT => self.0.inverse().coadjoint(&mu.0),
            _ => self.0.coadjoint(&mu.0),
        })
    }
    fn coadjoint_bracket(xi: &Twist<S>, mu: &Wrench<S>) -> Wrench<S> {
        let right = SE3::coadjoint_bracket(&xi.0, &mu.0);
        Wrench(match mistake() {
            BRACKET => -right,
            NO_BRACKET => Cotangent::zero(),
            // Pairs to zero with the velocity whose coordinates are those of mu in reverse.
            COADJOINT_BRACKET => {
                let ([a, b, c, ..], w) = (mu.0.0, xi.0.split().0);
                let wrong = Vec3([c, b, a]).cross(w) * S::from_f64(7.0);
                right + (wrong, Vec3::zero()).into()
            }
            _ => right,
        })
    }
    fn cayley(xi: &Twist<S>) -> Self {
        match mistake() {
            CAYLEY_TWICE => Self(SE3::exp(&times(2.0, xi.0))),
            _ => Self::exp(xi),
        }
    }
    fn cayley_inverse(&self) -> Result<Twist<S>, OutsideChart> {
        let log = self.log().map_err(|_| OutsideChart)?;
        match mistake() {
            NO_CAYLEY_INVERSE => Err(OutsideChart),
            CAYLEY_TWICE => Ok(Twist(times(0.5, log.0))),
            _ => Ok(log),
        }
    }
    fn d_left<R: Retraction>(xi: &Twist<S>, eta: &Twist<S>) -> Twist<S> {
        let (dexp, twice) = (dexp::<Self>, |x: &Twist<S>| Twist(times(2.0, x.0)));
        match (R::CHART, mistake()) {
            // The right-trivialised one in place of the left, at which one guesses wrong half the time.
            (Chart::Cayley, DIFFERENTIAL) => dexp(&Twist(-xi.0), eta),
            (Chart::Cayley, CAYLEY_TWICE) => dexp(&twice(xi), &twice(eta)),
            (Chart::Cayley, DIFFERENTIAL_TWICE) => dexp(xi, &twice(eta)),
            _ => dexp(xi, eta),
        }
    }
    fn d_left_dual<R: Retraction>(xi: &Twist<S>, mu: &Wrench<S>) -> Wrench<S> {
        Wrench(match (R::CHART, mistake()) {
            (Chart::Exp, DUAL_DIFFERENTIAL) => SE3::d_left_dual::<Exp>(&-xi.0, &mu.0),
            (Chart::Cayley, CAYLEY_DUAL_DIFFERENTIAL) => mu.0,
            _ => SE3::d_left_dual::<Exp>(&xi.0, &mu.0),
        })
    }
    fn d_left_inv_dual<R: Retraction>(xi: &Twist<S>, mu: &Wrench<S>) -> Wrench<S> {
        Wrench(match (R::CHART, mistake()) {
            (Chart::Exp, DUAL_INVERSE) => SE3::d_left_dual::<Exp>(&xi.0, &mu.0),
            (Chart::Cayley, CAYLEY_DUAL_INVERSE) => SE3::d_left_inv_dual::<Cayley>(&xi.0, &mu.0),
            _ => SE3::d_left_inv_dual::<Exp>(&xi.0, &mu.0),
        })
    }
    fn d_left_inv_gradient<R: Retraction>(
        xi: &Twist<S>,
        mu: &Wrench<S>,
        eta: &Twist<S>,
    ) -> Wrench<S> {
        let (xi, mu, eta) = (&xi.0, &mu.0, &eta.0);
        Wrench(match (R::CHART, mistake()) {
            (Chart::Exp, GRADIENT) => Cotangent::zero(),
            (Chart::Cayley, CAYLEY_GRADIENT) => SE3::d_left_inv_gradient::<Cayley>(xi, mu, eta),
            _ => SE3::d_left_inv_gradient::<Exp>(xi, mu, eta),
        })
    }
    fn inverse_into(&self, out: &mut Self) {
        if mistake() != INVERSE_INTO {
            *out = self.inverse();
        }
    }
    fn inverse_coadjoint_into(&self, mu: &Wrench<S>, out: &mut Wrench<S>) {
        *out = match mistake() {
            INVERSE_COADJOINT_INTO => self.coadjoint(mu),
            _ => self.inverse().coadjoint(mu),
        };
    }
    fn advance(&mut self, f: &Self, carry: &mut Self) {
        self.0.advance(&f.0, &mut carry.0);
        if mistake() == ADVANCE_BESIDE {
            self.0.translation += Vec3([S::from_f64(1e-9); 3]);
        }
    }
    fn zero_carry(&self) -> Self {
        Self(self.0.zero_carry())
    }
    fn chart_leave_into<R: Retraction>(
        c: &Twist<S>,
        momentum: &Wrench<S>,
        (f, mu, pi): (&mut Self, &mut Wrench<S>, &mut Wrench<S>),
    ) {
        Self::retract_into::<R>(c, f);
        *mu = f.coadjoint(momentum);
        *pi = match mistake() {
            CHART_END => Self::d_left_inv_dual::<R>(c, mu),
            _ => Self::d_left_dual::<R>(c, mu),
        };
    }
    fn chart_rates_into<R: Retraction>(
        (c, pi): (&Twist<S>, &Wrench<S>),
        (xi, tau): (&Twist<S>, &Wrench<S>),
        (c_dot, pi_dot): (&mut Twist<S>, &mut Wrench<S>),
    ) {
        *c_dot = Self::d_left_inv::<R>(c, xi);
        *pi_dot = Self::d_left_dual::<R>(c, tau);
        let sign = S::from_f64(if mistake() == CHART_RATES { 1.0 } else { -1.0 });
        pi_dot.add_scaled(sign, &Self::d_left_inv_gradient::<R>(c, pi, xi));
    }
    fn sqrt(&self) -> Self {
        Self(match mistake() {
            ROOT_NOT => self.0,
            ROOT_FAR => {
                let log = self.0.log().unwrap_or_else(|e| e.representative);
                SE3::exp(&times(0.5, Self::long_logarithm(log)))
            }
            _ => self.0.sqrt(),
        })
    }
    fn normalize(&mut self) {
        let (before, mut after) = (self.0, self.0);
        after.normalize();
        let (r, s) = (*before.rotation.matrix(), *after.rotation.matrix());
        self.0.rotation = match mistake() {
            NORMALIZE_AWAY => SO3::from_matrix_unchecked(r - (s - r)),
            NORMALIZE_NOT => before.rotation,
            _ => after.rotation,
        };
    }
    fn compose_into(&self, h: &Self, out: &mut Self) {
        if mistake() != COMPOSE_INTO {
            *out = self.compose(h);
        }
    }
    fn coadjoint_into(&self, mu: &Wrench<S>, out: &mut Wrench<S>) {
        if mistake() != COADJOINT_INTO {
            *out = self.coadjoint(mu);
        }
    }
    fn retract_into<R: Retraction>(xi: &Twist<S>, out: &mut Self) {
        match (R::CHART, mistake()) {
            (Chart::Exp, EXP_INTO) | (Chart::Cayley, CAYLEY_INTO) => {}
            _ => *out = Self::retract::<R>(xi),
        }
    }
    fn retract_inverse_into<R: Retraction>(&self, out: &mut Twist<S>) -> Result<(), OutsideChart> {
        let xi = self.retract_inverse::<R>()?;
        if mistake() != CHART_INTO {
            *out = xi;
        }
        Ok(())
    }
    fn sqrt_into(&self, out: &mut Self) {
        if mistake() != ROOT_INTO {
            *out = self.sqrt();
        }
    }
    fn convert_into<A: Scalar, B: Scalar>(
        g: &Slow<A>,
        f: impl Fn(A) -> B + Copy,
        out: &mut Over<Self, B>,
    ) {
        if mistake() != CONVERT_INTO {
            *out = Self::convert(g, f);
        }
    }
}

fn examples() -> [Twist; 3] {
    [
        [0.3, -0.4, 1.2, 0.5, 0.1, -0.7],
        [-1.5, 0.2, 0.1, 0.3, -2.0, 0.4],
        [0.0, 3.0, 0.0, 1e-8, 0.0, 0.2],
    ]
    .map(|xi| Twist(Tangent(xi)))
}

fn verdict(mistake: u8, velocities: &[Twist]) -> Result<laws::Report, LawError> {
    MISTAKE.set(mistake);
    let elements: Vec<_> = velocities.iter().map(Slow::exp).collect();
    laws::check(&elements, velocities)
}

fn broken(mistake: u8) -> (&'static str, String) {
    match verdict(mistake, &examples()) {
        Err(LawError::Violated { formula, case, .. }) => (formula, case),
        Err(LawError::Undefined { formula, case, .. }) => (formula, case),
        other => panic!("the mistake was not caught: {other:?}"),
    }
}

fn broken_law(mistake: u8) -> &'static str {
    broken(mistake).0
}

/// The law that is broken, asserted to be so for this retraction.
#[track_caller]
fn broken_law_of<R: Retraction>(mistake: u8) -> &'static str {
    let (law, case) = broken(mistake);
    assert!(case.starts_with(&format!("{}, ", R::NAME)), "{case}");
    law
}

#[test]
fn defaults_agree_with_closed_forms() {
    verdict(NONE, &examples()).unwrap();
}

#[test]
fn mistakes_in_the_group_are_caught_and_named() {
    assert_eq!(broken_law(INVERSE), "g e = g");
    let law = "p p^-1 = e + O(delta^2) for p normalised";
    assert_eq!(broken_law(NORMALIZE_NOT), law);
    let law = "normalize(normalize p) = normalize p + O(delta^2)";
    assert_eq!(broken_law(NORMALIZE_AWAY), law);
    assert_eq!(broken_law(ZERO_ALGEBRA), "zero_algebra = 0");
    assert_eq!(broken_law(ZERO_DUAL), "zero_dual = 0");
}

#[test]
fn mistakes_in_the_adjoint_action_are_caught_and_named() {
    assert_eq!(broken_law(ADJOINT), "Ad_gh xi = Ad_g Ad_h xi");
    assert_eq!(broken_law(COADJOINT), "<Ad*_g mu, xi> = <mu, Ad_g xi>");
    let law = "<ad*_xi mu, eta> = <mu, ad_xi eta>";
    assert_eq!(broken_law(COADJOINT_BRACKET), law);
    let law = "ad_xi eta = d/ds Ad_exp(s xi) eta, by duals";
    assert_eq!(broken_law(BRACKET), law);
    assert_eq!(broken_law(NO_BRACKET), law);
}

#[test]
fn a_missing_bracket_is_caught_with_one_velocity() {
    let verdict = verdict(NO_BRACKET, &examples()[..1]);
    assert!(matches!(verdict, Err(LawError::Violated { .. })));
}

#[test]
fn mistakes_in_the_maps_are_caught_and_named() {
    assert_eq!(broken_law(CAYLEY_TWICE), "cay xi = exp xi + O(xi^3)");
    let law = "cay^-1(cay xi) = xi for |xi| <= 1/2";
    assert_eq!(broken_law(NO_CAYLEY_INVERSE), law);
    assert_eq!(broken_law(LOG_ZERO_FAR), "exp(log g) = g");
    assert_eq!(broken_law(LOG_LONG_WAY), "|log(exp xi)| <= |xi|");
    let law = "log(exp xi) = xi for |xi| <= 1/2";
    assert_eq!(broken_law(LOG_NEVER_UNIQUE), law);
    assert_eq!(broken_law(LOG_INFINITE), "g e = g");
    let law = "dtau_0 eta = eta";
    assert_eq!(broken_law_of::<Cayley>(DIFFERENTIAL_TWICE), law);
    let law = "dtau_xi eta = tau(-xi) d/ds tau(xi + s eta), by duals";
    assert_eq!(broken_law_of::<Cayley>(DIFFERENTIAL), law);
}

#[test]
fn mistakes_in_the_square_root_are_caught_and_named() {
    assert_eq!(broken_law(ROOT_NOT), "sqrt(g) sqrt(g) = g");
    assert_eq!(broken_law(ROOT_FAR), "log(sqrt g) = log(g)/2");
}

#[test]
fn mistakes_in_the_transposed_differentials_are_caught_and_named() {
    let law = "<(dtau_xi)* mu, eta> = <mu, dtau_xi eta>";
    assert_eq!(broken_law_of::<Exp>(DUAL_DIFFERENTIAL), law);
    assert_eq!(broken_law_of::<Cayley>(CAYLEY_DUAL_DIFFERENTIAL), law);
    let law = "<(dtau^-1_xi)* mu, eta> = <mu, dtau^-1_xi eta>";
    assert_eq!(broken_law_of::<Exp>(DUAL_INVERSE), law);
    assert_eq!(broken_law_of::<Cayley>(CAYLEY_DUAL_INVERSE), law);
}

#[test]
fn mistakes_in_the_gradients_are_caught_and_named() {
    let law = "d_left_inv_gradient = d/dxi <mu, dtau^-1_xi eta>, by duals";
    assert_eq!(broken_law_of::<Exp>(GRADIENT), law);
    assert_eq!(broken_law_of::<Cayley>(CAYLEY_GRADIENT), law);
}

#[test]
fn mistakes_in_the_charts_are_caught_and_named() {
    let law = "inverse_coadjoint_into = Ad*_(g^-1)";
    assert_eq!(broken_law(INVERSE_COADJOINT_INTO), law);
    let law = "advance by exp(xi/n), n times = g exp(xi)";
    assert_eq!(broken_law(ADVANCE_BESIDE), law);
    let law = "chart_leave_into: pi = (dtau_c)* mu";
    assert_eq!(broken_law(CHART_END), law);
    let law = "chart_rates_into: pi' = (dtau_c)* tau - d/dc <pi, dtau^-1_c xi>";
    assert_eq!(broken_law(CHART_RATES), law);
}

#[test]
fn methods_that_write_nothing_are_caught_and_named() {
    assert_eq!(broken_law(CONVERT_INTO), "convert_into = convert");
    assert_eq!(broken_law(COMPOSE_INTO), "compose_into = compose");
    assert_eq!(broken_law(COADJOINT_INTO), "coadjoint_into = coadjoint");
    assert_eq!(broken_law(INVERSE_INTO), "inverse_into = inverse");
    assert_eq!(broken_law_of::<Exp>(EXP_INTO), "retract_into = tau");
    assert_eq!(broken_law_of::<Cayley>(CAYLEY_INTO), "retract_into = tau");
    assert_eq!(broken_law(ROOT_INTO), "sqrt_into = sqrt");
    assert_eq!(broken_law(CHART_INTO), "retract_inverse_into = tau^-1");
}

macro_rules! vector_mistakes_are_caught {
    ($test:ident, $first:ident) => {
        #[test]
        fn $test() {
            assert_eq!(broken_law($first + WRITE), "write(x)_i = x_i");
            assert_eq!(broken_law($first + READ), "read(write(x)) = x");
            assert_eq!(broken_law($first + SET_ZERO), "set_zero = 0");
            assert_eq!(broken_law($first + SCALE), "scale: a x");
            let law = "add_scaled: x + a y";
            assert_eq!(broken_law($first + ADD_SCALED), law);
            assert_eq!(broken_law($first + SET_SUM), "set_sum = x + a y");
            assert_eq!(broken_law($first + NORM), "|x|^2 = sum of x_i^2");
            let law = "max_magnitude = max |x_i|";
            assert_eq!(broken_law($first + MAX), law);
        }
    };
}

vector_mistakes_are_caught!(mistakes_in_the_algebra_are_caught_and_named, ALGEBRA);
vector_mistakes_are_caught!(mistakes_in_the_dual_are_caught_and_named, DUAL);
