//! Numbers over time.

use core::fmt::Debug;

use lie::Scalar;

/// `N` smooth functions of time: angles in rad, rotation vectors in rad, or places in m.
pub trait Law<const N: usize>: Debug + Send + Sync {
    /// The `k`-th derivatives at `t` seconds, per second to the power of `k`; where one is not known, not a number.
    fn derivative(&self, t: f64, k: u32) -> [f64; N];

    /// From when to when it is told, s; a table is not for ever. Beyond, it goes on somehow.
    fn told(&self) -> [f64; 2] {
        [f64::NEG_INFINITY, f64::INFINITY]
    }

    /// Whether nothing moves.
    fn is_constant(&self) -> bool {
        false
    }
}

/// The values of a law.
#[inline(always)]
pub(crate) fn value<const N: usize, S: Scalar>(law: &dyn Law<N>, t: S) -> [S; N] {
    t.smooth(&|t, k| law.derivative(t, k))
}

/// The values of a law, and their rates.
#[inline(always)]
pub(crate) fn at<const N: usize, S: Scalar>(law: &dyn Law<N>, t: S) -> [[S; N]; 2] {
    [value(law, t), t.smooth(&|t, k| law.derivative(t, k + 1))]
}
