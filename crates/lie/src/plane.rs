//! Vectors of the plane, as pairs of numbers.

use crate::Scalar;

/// $x + y$.
#[inline(always)]
pub(crate) fn add<S: Scalar>([a, b]: [S; 2], [c, d]: [S; 2]) -> [S; 2] {
    [a + c, b + d]
}

/// $a x$.
#[inline(always)]
pub(crate) fn scale<S: Scalar>(a: S, x: [S; 2]) -> [S; 2] {
    x.map(|x| a * x)
}

/// $a J x$: the quarter turn $J (x_1, x_2) = (-x_2, x_1)$ times `a`.
#[inline(always)]
pub(crate) fn turn<S: Scalar>(a: S, [x, y]: [S; 2]) -> [S; 2] {
    [-(a * y), a * x]
}

/// $x \times y = x_1 y_2 - x_2 y_1 = y \cdot J x$.
#[inline(always)]
pub(crate) fn cross<S: Scalar>([a, b]: [S; 2], [c, d]: [S; 2]) -> S {
    a * d - b * c
}
