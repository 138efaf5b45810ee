//! Compensated sums.

use crate::Scalar;

/// $x \leftarrow x + y$ where `y` is small, with what rounding loses kept in `carry` (W. Kahan, 1965).
#[inline(always)]
pub(crate) fn add<S: Scalar>(x: &mut S, y: S, carry: &mut S) {
    let wanted = y + *carry;
    let sum = *x + wanted;
    *carry = wanted - (sum - *x);
    *x = sum;
}
