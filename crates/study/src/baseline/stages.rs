//! The stages of a step on vectors.

use lie::Batch;

use super::tableau::{Row, sum};

/// $f$ in $\dot y = f(t, y)$: writes every entry of its last argument.
pub trait RightHandSide: FnMut(f64, &[f64], &mut [f64]) {}

impl<F: FnMut(f64, &[f64], &mut [f64])> RightHandSide for F {}

/// The rates of the stages that these rows make, the first of which is known; `argument` is room for what they are evaluated at.
pub(super) fn evaluate<S: Batch>(
    rows: &[Row],
    rhs: &mut impl RightHandSide,
    (t, y): (f64, &[f64]),
    h: f64,
    argument: &mut [f64],
    k: &mut [Vec<f64>],
) {
    for (i, row) in rows.iter().enumerate() {
        combine::<S>(argument, y, h, row, k);
        rhs(t + sum(row) * h, argument, &mut k[i + 1]);
    }
}

/// $y + h \sum_j a_j k_j$.
pub(super) fn combine<S: Batch>(out: &mut [f64], y: &[f64], h: f64, row: Row, k: &[Vec<f64>]) {
    S::run(
        #[inline(always)]
        || {
            out.copy_from_slice(y);
            for (j, a) in row {
                let weight = h * a;
                for (out, k) in out.iter_mut().zip(&k[*j]) {
                    *out += weight * k;
                }
            }
        },
    );
}

/// Whether every number is finite.
pub(super) fn is_finite<S: Batch>(x: &[f64]) -> bool {
    S::run(
        #[inline(always)]
        || x.iter().fold(true, |finite, x| finite & x.is_finite()),
    )
}
