//! Systems that the tests share.

use dvi::{Context, Force, Lagrangian, State, System};
use lie::{Cotangent, LieGroup, Mat3, Rn, SE3, SO3, Scalar, Tangent, Vec3, VectorSpace};

/// A heavy top without symmetry, by its value alone.
#[derive(Clone, Copy)]
pub struct Top;

/// $J$, kg m².
pub const INERTIA: [f64; 3] = [1.0, 2.0, 2.5];
/// Weight times the mass centre, N m.
pub const LEVER: Vec3 = Vec3([0.1, 0.2, 0.7]);

impl System for Top {
    type Group = SO3;
}

impl Lagrangian for Top {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let j = Mat3::diagonal(INERTIA).lift::<S>();
        let omega = omega.vec3();
        omega.dot(j * omega) * S::from_f64(0.5) - r.rotate(LEVER.lift())[2]
    }
}

pub fn top() -> State<SO3> {
    let turn = SO3::exp(&Tangent([0.4, -0.8, 0.3]));
    Top.state(0.0, turn, &Tangent([0.3, -0.5, 1.0])).unwrap()
}

/// A rigid body in a fluid under its own weight, on SE(3): inertia that couples, and a potential.
#[derive(Clone, Copy)]
pub struct Sinking;

impl System for Sinking {
    type Group = SE3;
}

impl Lagrangian for Sinking {
    fn value<S: Scalar>(&self, _: Context<S>, g: &SE3<S>, xi: &Tangent<6, S>) -> S {
        let (omega, v) = xi.split();
        let (j, m) = (
            Mat3::diagonal([1.0, 1.5, 2.0]),
            Mat3::diagonal([1.0, 3.0, 2.0]),
        );
        let coupling = Mat3([[0.1, 0.0, 0.2], [0.0, 0.3, 0.0], [0.1, 0.0, 0.0]]);
        let kinetic = omega.dot(j.lift() * omega) + v.dot(m.lift() * v);
        let half = S::from_f64(0.5);
        (kinetic * half + omega.dot(coupling.lift() * v)) - g.translation[2] * S::from_f64(0.4)
    }
}

pub fn sinking() -> State<SE3> {
    let g = SE3::exp(&Tangent([0.4, -0.8, 0.3, 1.0, 0.5, -0.2]));
    Sinking
        .state(0.0, g, &Tangent([0.3, -0.5, 1.0, 0.2, -0.3, 0.1]))
        .unwrap()
}

/// A particle of 1 kg, whose energy is no quadratic in its velocity, with a magnetic term and a force that depends on time.
#[derive(Clone, Copy)]
pub struct Driven;

impl System for Driven {
    type Group = Rn<2>;
}

impl Lagrangian for Driven {
    fn value<S: Scalar>(&self, at: Context<S>, x: &Rn<2, S>, v: &Tangent<2, S>) -> S {
        let ([x, y], [u, w]) = (x.0, v.0);
        let square = u * u + w * w;
        let kinetic = square * S::from_f64(0.5) + square * square * S::from_f64(0.25);
        let potential = (x * x + y * y) * S::from_f64(0.5) - x * at.t.sin_cos().0;
        kinetic + (x * w - y * u) * S::from_f64(0.3) - potential
    }
}

pub fn driven() -> State<Rn<2>> {
    Driven
        .state(0.2, Rn([1.0, -0.5]), &Tangent([0.4, 0.7]))
        .unwrap()
}

/// A torque that brakes the rotation, linear in it.
#[derive(Clone, Copy)]
pub struct Brake(pub f64);

impl Force for Brake {
    type Group = SO3;

    fn force<S: Scalar>(
        &self,
        _: Context<S>,
        _: &SO3<S>,
        omega: &Tangent<3, S>,
        out: &mut Cotangent<3, S>,
    ) {
        *out = Cotangent(omega.0.map(|x| x * S::from_f64(-self.0)));
    }
}

/// The larger of the turn between two configurations and the relative distance of their momenta.
pub fn distance<G: lie::RealGroup>(a: &State<G>, b: &State<G>) -> f64 {
    let turn = a.g.inverse().compose(&b.g).log().unwrap();
    let mut momentum = a.mu.clone();
    momentum.add_scaled(-1.0, &b.mu);
    let size = a.mu.norm_squared().sqrt();
    turn.norm_squared()
        .sqrt()
        .max(momentum.norm_squared().sqrt() / size)
}
