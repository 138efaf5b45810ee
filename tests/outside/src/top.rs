//! A heavy top on the unit quaternions, and the same one on the rotations.

use lgvi::dvi::{Context, Lagrangian, System};
use lgvi::lie::{Mat3, SO3, Scalar, Tangent, Vec3};

use crate::UnitQuaternion;

/// The inertia about the fixed point in the body's frame, kg m²: no two moments are alike.
const INERTIA: [f64; 3] = [1.0, 2.0, 2.5];
/// Weight times the mass centre in the body's frame, N m.
const LEVER: Vec3 = Vec3([0.1, 0.2, 0.7]);

fn kinetic<S: Scalar>(omega: &Tangent<3, S>) -> S {
    let j = Mat3::diagonal(INERTIA).lift();
    omega.vec3().dot(j * omega.vec3()) * S::from_f64(0.5)
}

/// A heavy top whose attitude is a unit quaternion.
#[derive(Clone, Copy, Debug)]
pub struct QuaternionTop;

impl System for QuaternionTop {
    type Group = UnitQuaternion;
}

impl Lagrangian for QuaternionTop {
    fn value<S: Scalar>(&self, _: Context<S>, q: &UnitQuaternion<S>, omega: &Tangent<3, S>) -> S {
        kinetic(omega) - q.rotate(LEVER.lift())[2]
    }
}

/// The same top, its attitude a matrix of `lie`.
#[derive(Clone, Copy, Debug)]
pub struct MatrixTop;

impl System for MatrixTop {
    type Group = SO3;
}

impl Lagrangian for MatrixTop {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        kinetic(omega) - r.rotate(LEVER.lift())[2]
    }
}
