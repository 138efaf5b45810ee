//! Compensated sums, and a maximum that sees what is not a number.

use crate::Scalar;

/// $x \leftarrow x + y$ where `y` is small, with what rounding loses kept in `carry` (W. Kahan, 1965).
#[inline(always)]
pub(crate) fn add_compensated<S: Scalar>(x: &mut S, y: S, carry: &mut S) {
    let wanted = y + *carry;
    let sum = *x + wanted;
    *carry = wanted - (sum - *x);
    *x = sum;
}

/// The same entry by entry.
#[inline(always)]
pub(crate) fn add_all_compensated<S: Scalar, const N: usize>(
    x: &mut [S; N],
    y: [S; N],
    carry: &mut [S; N],
) {
    for i in 0..N {
        add_compensated(&mut x[i], y[i], &mut carry[i]);
    }
}

/// The larger of the two, NaN where one is.
#[inline(always)]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}
