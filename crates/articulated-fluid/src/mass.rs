//! What a body's mass is: a matrix in a fluid, a number without.

use core::fmt::Debug;

use lie::{Mat3, Scalar, Sym3, Vec3};

/// The mass of a body as a map from the velocity of its centre to its linear momentum, in its frame, kg.
///
/// In a fluid it is a matrix. Without one it is a number, and what turns it is not computed.
pub trait Mass: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// $M v$.
    fn apply<S: Scalar>(&self, v: Vec3<S>) -> Vec3<S>;

    /// $M$ as a matrix.
    fn matrix(&self) -> Mat3;

    /// $R M R^T$.
    fn turned<S: Scalar>(&self, r: &Mat3<S>) -> Sym3<S>;
}

impl Mass for Mat3 {
    #[inline(always)]
    fn apply<S: Scalar>(&self, v: Vec3<S>) -> Vec3<S> {
        Mat3::apply(*self, v)
    }

    #[inline(always)]
    fn matrix(&self) -> Mat3 {
        *self
    }

    #[inline(always)]
    fn turned<S: Scalar>(&self, r: &Mat3<S>) -> Sym3<S> {
        Sym3::upper(&self.lift()).turned(r)
    }
}

impl Mass for f64 {
    #[inline(always)]
    fn apply<S: Scalar>(&self, v: Vec3<S>) -> Vec3<S> {
        let [x, y, z] = v.0;
        Vec3([x.times(*self), y.times(*self), z.times(*self)])
    }

    #[inline(always)]
    fn matrix(&self) -> Mat3 {
        Mat3::diagonal([*self; 3])
    }

    #[inline(always)]
    fn turned<S: Scalar>(&self, _: &Mat3<S>) -> Sym3<S> {
        Sym3::isotropic(S::from_f64(*self))
    }
}
