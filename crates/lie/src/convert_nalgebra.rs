//! Conversions to and from `nalgebra`.

use nalgebra::{
    Isometry2, Isometry3, Matrix3, Rotation3, SVector, Scalar as Number, Translation2,
    Translation3, UnitComplex, UnitQuaternion, Vector3,
};

use crate::{Cotangent, Mat3, R3, SE2, SE3, SO2, SO3, Tangent, Vec3};

impl<S: Number> From<Vec3<S>> for Vector3<S> {
    fn from(x: Vec3<S>) -> Self {
        Self::from(x.0)
    }
}

impl<S: Number + Copy> From<Vector3<S>> for Vec3<S> {
    fn from(x: Vector3<S>) -> Self {
        Self(x.into())
    }
}

impl<S: Number + Copy> From<Vector3<S>> for R3<S> {
    fn from(x: Vector3<S>) -> Self {
        Self(x.into())
    }
}

impl<S: Number + Copy> From<Mat3<S>> for Matrix3<S> {
    fn from(m: Mat3<S>) -> Self {
        Self::from_fn(|i, j| m[(i, j)])
    }
}

impl<S: Number + Copy> From<Matrix3<S>> for Mat3<S> {
    fn from(m: Matrix3<S>) -> Self {
        Self([0, 1, 2].map(|i| [0, 1, 2].map(|j| m[(i, j)])))
    }
}

impl<const N: usize, S: Number> From<Tangent<N, S>> for SVector<S, N> {
    fn from(xi: Tangent<N, S>) -> Self {
        Self::from(xi.0)
    }
}

impl<const N: usize, S: Number> From<Cotangent<N, S>> for SVector<S, N> {
    fn from(mu: Cotangent<N, S>) -> Self {
        Self::from(mu.0)
    }
}

impl From<SO3> for Rotation3<f64> {
    fn from(r: SO3) -> Self {
        Self::from_matrix_unchecked((*r.matrix()).into())
    }
}

impl From<Rotation3<f64>> for SO3 {
    fn from(r: Rotation3<f64>) -> Self {
        Self::from_matrix_unchecked((*r.matrix()).into())
    }
}

impl From<SE3> for Isometry3<f64> {
    fn from(g: SE3) -> Self {
        let rotation = UnitQuaternion::from_rotation_matrix(&g.rotation.into());
        Self::from_parts(Translation3::from(Vector3::from(g.translation)), rotation)
    }
}

impl From<Isometry3<f64>> for SE3 {
    fn from(g: Isometry3<f64>) -> Self {
        Self::new(
            g.rotation.to_rotation_matrix().into(),
            g.translation.vector.into(),
        )
    }
}

impl From<SO2> for UnitComplex<f64> {
    fn from(r: SO2) -> Self {
        Self::from_cos_sin_unchecked(r.cos(), r.sin())
    }
}

impl From<UnitComplex<f64>> for SO2 {
    fn from(r: UnitComplex<f64>) -> Self {
        Self::from_cos_sin_unchecked(r.re, r.im)
    }
}

impl From<SE2> for Isometry2<f64> {
    fn from(g: SE2) -> Self {
        Self::from_parts(Translation2::from(g.translation), g.rotation.into())
    }
}

impl From<Isometry2<f64>> for SE2 {
    fn from(g: Isometry2<f64>) -> Self {
        Self::new(g.rotation.into(), g.translation.vector.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LieGroup;

    #[test]
    fn a_displacement_survives_the_round_trip() {
        let g = SE3::exp(&Tangent([0.3, -0.4, 1.2, 0.5, 0.1, -0.7]));
        let back = SE3::from(Isometry3::from(g));
        approx::assert_abs_diff_eq!(g, back, epsilon = 1e-15);
        let moved = Isometry3::from(g) * nalgebra::Point3::new(1.0, 2.0, 3.0);
        let expected = g.rotation.rotate(Vec3([1.0, 2.0, 3.0])) + g.translation;
        approx::assert_abs_diff_eq!(Vec3::from(moved.coords), expected, epsilon = 1e-15);
    }

    #[test]
    fn a_displacement_of_the_plane_survives_the_round_trip() {
        let g = SE2::exp(&Tangent([0.3, -0.4, 1.2]));
        assert_eq!(SE2::from(Isometry2::from(g)), g);
        let moved = Isometry2::from(g) * nalgebra::Point2::new(1.0, 2.0);
        let (turned, shift) = (g.rotation.rotate([1.0, 2.0]), g.translation);
        approx::assert_abs_diff_eq!(moved.x, turned[0] + shift[0], epsilon = 1e-15);
        approx::assert_abs_diff_eq!(moved.y, turned[1] + shift[1], epsilon = 1e-15);
    }
}
