//! What the inverse maps answer where they have no single value.

use core::fmt::Debug;

use thiserror::Error;

/// The logarithm exists but is not unique: a rotation by the angle $\pi$ has two of equal length.
///
/// The angle counts as $\pi$ within rounding, $4 \varepsilon$ of the scalar.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "the logarithm is not unique (a rotation by pi): take `representative`, or the one of opposite rotation"
)]
pub struct NotUnique<A: Debug> {
    /// One logarithm of the shortest length; $\exp$ of it is the element.
    pub representative: A,
}

/// The element has no image in the retraction's chart: a rotation by the angle $\pi$ under the Cayley map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the element lies outside the Cayley chart (a rotation by pi): use the logarithm instead")]
pub struct OutsideChart;

/// The matrix is no rotation.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "not a rotation: ||I - R^T R|| = {defect:.3e}, det R = {determinant:.6}; expected below {tolerance:.0e} and 1 (orthonormalise it first)"
)]
pub struct NotARotation {
    /// $\lVert I - R^T R \rVert_F$.
    pub defect: f64,
    /// $\det R$.
    pub determinant: f64,
    /// The largest defect that is accepted.
    pub tolerance: f64,
}
