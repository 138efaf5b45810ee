//! Numbers over time.

use core::fmt::Debug;
use std::sync::Arc;

use lie::Scalar;

/// `N` smooth functions of time: angles in rad, rotation vectors in rad, or places in m.
pub trait Law<const N: usize>: Debug + Send + Sync {
    /// The `k`-th derivatives at `t` seconds, per second to the power of `k`; where one is not known, not a number.
    fn derivative(&self, t: f64, k: u32) -> [f64; N];

    /// From when to when it is told, s; a table is not for ever. Beyond, it goes on somehow.
    fn told(&self) -> [f64; 2] {
        [f64::NEG_INFINITY, f64::INFINITY]
    }

    /// From when on it repeats itself, and after how long, s; none where it never does. What is constant repeats after 0 s.
    fn repeats(&self) -> Option<[f64; 2]> {
        self.is_constant().then_some([0.0; 2])
    }

    /// Whether nothing moves.
    fn is_constant(&self) -> bool {
        false
    }
}

/// What is asked of a law of any size.
pub(crate) trait Timed {
    /// As [`Law::told`].
    fn told(&self) -> [f64; 2];

    /// As [`Law::repeats`].
    fn repeats(&self) -> Option<[f64; 2]>;

    /// As [`Law::is_constant`].
    fn is_constant(&self) -> bool;

    /// How fast it changes in the first seconds, rad/s: of a sinusoid $2 \pi f$; from its derivatives at many times, where they are known.
    fn rate(&self, until: f64) -> f64;
}

impl<const N: usize> Timed for Arc<dyn Law<N>> {
    fn told(&self) -> [f64; 2] {
        self.as_ref().told()
    }

    fn repeats(&self) -> Option<[f64; 2]> {
        self.as_ref().repeats()
    }

    fn is_constant(&self) -> bool {
        self.as_ref().is_constant()
    }

    fn rate(&self, until: f64) -> f64 {
        const TIMES: u32 = 1024;
        let largest = |k: u32| {
            let at = |i: u32| self.derivative(until * f64::from(i) / f64::from(TIMES), k);
            let all = (0..=TIMES).flat_map(at).map(f64::abs);
            all.filter(|x| x.is_finite()).fold(0.0, f64::max)
        };
        let (first, third) = (largest(1), largest(3));
        match first > 0.0 {
            true => (third / first).sqrt(),
            false => 0.0,
        }
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
