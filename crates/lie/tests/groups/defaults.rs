//! Every default of the trait, on a group that is neither nilpotent nor compact: SE(3) by its required items.

use lie::{Cotangent, LieGroup, NotUnique, Over, SE3, Scalar, Tangent, laws};

/// SE(3) without its closed forms.
#[derive(Clone, Debug, PartialEq)]
struct Bare<S = f64>(SE3<S>);

impl<S: Scalar> LieGroup for Bare<S> {
    type Scalar = S;
    type Algebra = Tangent<6, S>;
    type Dual = Cotangent<6, S>;
    type WithScalar<T: Scalar> = Bare<T>;

    fn zero_algebra(&self) -> Tangent<6, S> {
        Tangent::zero()
    }
    fn zero_dual(&self) -> Cotangent<6, S> {
        Cotangent::zero()
    }
    fn convert<A: Scalar, B: Scalar>(g: &Bare<A>, f: impl Fn(A) -> B + Copy) -> Over<Self, B> {
        Bare(<SE3<S> as LieGroup>::convert(&g.0, f))
    }
    fn compose(&self, h: &Self) -> Self {
        Self(self.0.compose(&h.0))
    }
    fn inverse(&self) -> Self {
        Self(self.0.inverse())
    }
    fn exp(xi: &Tangent<6, S>) -> Self {
        Self(SE3::exp(xi))
    }
    fn log(&self) -> Result<Tangent<6, S>, NotUnique<Tangent<6, S>>> {
        self.0.log()
    }
    fn adjoint(&self, xi: &Tangent<6, S>) -> Tangent<6, S> {
        self.0.adjoint(xi)
    }
    fn bracket(xi: &Tangent<6, S>, eta: &Tangent<6, S>) -> Tangent<6, S> {
        SE3::bracket(xi, eta)
    }
    fn normalize(&mut self) {
        self.0.normalize();
    }
}

#[test]
fn the_defaults_obey_the_laws() {
    let velocities = [
        Tangent([0.3, -0.4, 1.2, 0.5, 0.1, -0.7]),
        Tangent([-1.5, 0.2, 0.1, 0.3, -2.0, 0.4]),
        Tangent([0.0, 3.0, 0.0, 1e-8, 0.0, 0.2]),
        Tangent([1e-8, 0.0, 2e-8, 0.0, 1e-8, 0.0]),
    ];
    let elements = velocities.map(|xi| Bare::exp(&xi));
    let report = laws::check(&elements, &velocities).unwrap();
    assert!(report.worst < 0.5, "{report:?}");
}
