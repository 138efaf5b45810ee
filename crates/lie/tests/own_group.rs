//! A user's own group: the required items alone, proved by the law suite; and wrong ones, caught by it.

use lie::laws::{self, LawError};
use lie::{Cotangent, LieGroup, NotUnique, Over, SE3, Scalar, Tangent};

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

/// SE(3) without closed forms of the retractions' differentials, and with one deliberate mistake.
#[derive(Clone, Debug, PartialEq)]
struct Slow<const MISTAKE: u8, S = f64>(SE3<S>);

const NONE: u8 = 0;
const COADJOINT: u8 = 1;
const BRACKET: u8 = 2;
const DIFFERENTIAL: u8 = 3;
const INVERSE: u8 = 4;
const ADJOINT: u8 = 5;

impl<const M: u8, S: Scalar> LieGroup for Slow<M, S> {
    type Scalar = S;
    type Algebra = Tangent<6, S>;
    type Dual = Cotangent<6, S>;
    type WithScalar<T: Scalar> = Slow<M, T>;

    fn zero_algebra(&self) -> Tangent<6, S> {
        Tangent::zero()
    }
    fn zero_dual(&self) -> Cotangent<6, S> {
        Cotangent::zero()
    }
    fn convert<A: Scalar, B: Scalar>(g: &Slow<M, A>, f: impl Fn(A) -> B + Copy) -> Over<Self, B> {
        Slow(<SE3<S> as LieGroup>::convert(&g.0, f))
    }
    fn compose(&self, h: &Self) -> Self {
        Self(self.0.compose(&h.0))
    }
    fn inverse(&self) -> Self {
        let mut inverse = self.0.inverse();
        if M == INVERSE {
            inverse.translation = -self.0.translation;
        }
        Self(inverse)
    }
    fn exp(xi: &Tangent<6, S>) -> Self {
        Self(SE3::exp(xi))
    }
    fn log(&self) -> Result<Tangent<6, S>, NotUnique<Tangent<6, S>>> {
        self.0.log()
    }
    fn adjoint(&self, xi: &Tangent<6, S>) -> Tangent<6, S> {
        if M == ADJOINT {
            self.0.inverse().adjoint(xi)
        } else {
            self.0.adjoint(xi)
        }
    }
    fn bracket(xi: &Tangent<6, S>, eta: &Tangent<6, S>) -> Tangent<6, S> {
        if M == BRACKET {
            SE3::bracket(eta, xi)
        } else {
            SE3::bracket(xi, eta)
        }
    }
    fn coadjoint(&self, mu: &Cotangent<6, S>) -> Cotangent<6, S> {
        if M == COADJOINT {
            self.0.inverse().coadjoint(mu)
        } else {
            self.0.coadjoint(mu)
        }
    }
    fn dcay(xi: &Tangent<6, S>, eta: &Tangent<6, S>) -> Tangent<6, S> {
        // The right-trivialised one in place of the left, at which one guesses wrong half the time.
        if M == DIFFERENTIAL {
            SE3::dexp(&-*xi, eta)
        } else {
            Self::dexp(xi, eta)
        }
    }
}

fn examples() -> [Tangent<6>; 3] {
    [
        Tangent([0.3, -0.4, 1.2, 0.5, 0.1, -0.7]),
        Tangent([-1.5, 0.2, 0.1, 0.3, -2.0, 0.4]),
        Tangent([0.0, 3.0, 0.0, 1e-8, 0.0, 0.2]),
    ]
}

fn verdict<const M: u8>() -> Result<laws::Report, LawError> {
    laws::check(&examples().map(|xi| Slow::<M>::exp(&xi)), &examples())
}

fn broken_law<const M: u8>() -> &'static str {
    match verdict::<M>() {
        Err(LawError::Violated { formula, .. }) => formula,
        other => panic!("the mistake was not caught: {other:?}"),
    }
}

#[test]
fn defaults_agree_with_closed_forms() {
    verdict::<NONE>().unwrap();
}

#[test]
fn mistakes_are_caught_and_named() {
    assert_eq!(broken_law::<COADJOINT>(), "<Ad*_g mu, xi> = <mu, Ad_g xi>");
    assert_eq!(
        broken_law::<BRACKET>(),
        "ad_xi eta = d/ds Ad_exp(s xi) eta, by duals"
    );
    assert_eq!(
        broken_law::<DIFFERENTIAL>(),
        "dcay_xi eta = cay(-xi) d/ds cay(xi + s eta), by duals"
    );
    assert_eq!(broken_law::<INVERSE>(), "g e = g");
    assert_eq!(broken_law::<ADJOINT>(), "Ad_gh xi = Ad_g Ad_h xi");
}
