//! The first guess of a step, extrapolated from the steps before.

use core::ops::Range;

use lie::{LieGroup, Units, VectorSpace};

use crate::numerics::sizes::Weights;

/// Highest degree of the extrapolating polynomial.
const DEGREE: usize = 4;
/// Steps between choices of the degree: comparing costs as much as extrapolating.
const CHOOSE_EVERY: u32 = 16;

/// The backward differences $\nabla^0 c, \dots, \nabla^{d+1} c$ of the solutions at equal steps.
///
/// Extrapolating by degree $d$ is summing the first $d + 1$ of them, and $\nabla^{d+1} c$ is the error that this
/// made in the last step. Now and then the degree whose error is smallest is taken for the steps to come.
pub(crate) struct WarmStart {
    differences: [Vec<f64>; DEGREE + 2],
    /// Differences that are known.
    known: usize,
    /// Differences that are summed.
    terms: usize,
    recorded: u32,
    h: f64,
    /// Coordinates of one unit, and what brings it to that of the others.
    runs: Vec<(Range<usize>, f64)>,
}

impl WarmStart {
    pub(crate) fn new<G: LieGroup>(g: &G, weights: Option<&Weights>) -> Self {
        let dim = g.zero_dual().dim();
        let runs = Units::of(g).runs().into_iter().map(|(run, kind)| {
            let weight = weights.map_or(1.0, |weights| weights.velocities.of(kind));
            (run, weight)
        });
        Self {
            runs: runs.collect(),
            differences: core::array::from_fn(|_| vec![0.0; dim]),
            known: 0,
            terms: 0,
            recorded: 0,
            h: 0.0,
        }
    }

    pub(crate) fn forget(&mut self) {
        (self.known, self.terms, self.recorded) = (0, 0, 0);
    }

    /// Writes the guess for a step of size `h`; false, and zero, where nothing is known.
    ///
    /// For a step of another size than the last one, that is the same velocity.
    pub(crate) fn guess(&mut self, h: f64, out: &mut [f64]) -> bool {
        out.fill(0.0);
        if h != self.h && self.known > 0 {
            add(out, &self.differences[0]);
            out.iter_mut().for_each(|x| *x *= h / self.h);
            return true;
        }
        for difference in &self.differences[..self.terms] {
            add(out, difference);
        }
        self.terms > 0
    }

    fn best(&self) -> usize {
        let error = |terms: &usize| self.size(*terms);
        // With one solution known there is no error to compare by: repeat it.
        let candidates = 1..self.known.max(2);
        let best = candidates.min_by(|a, b| error(a).total_cmp(&error(b)));
        best.unwrap_or(0).min(self.known)
    }

    /// How large a difference is, in one unit for all coordinates.
    fn size(&self, order: usize) -> f64 {
        let runs = self.runs.iter().map(|(run, weight)| {
            let part = &self.differences[order][run.clone()];
            weight * size(part)
        });
        runs.fold(0.0, f64::max)
    }

    pub(crate) fn record(&mut self, h: f64, solution: &[f64]) {
        if h != self.h {
            self.h = h;
            self.forget();
        }
        let last = DEGREE + 1;
        self.differences.rotate_right(1);
        // Now index k holds the old difference of order k - 1; index 0 is the one to overwrite.
        self.differences[0].copy_from_slice(solution);
        for k in 1..=last {
            let (lower, upper) = self.differences.split_at_mut(k);
            for (old, new) in upper[0].iter_mut().zip(&lower[k - 1]) {
                *old = *new - *old;
            }
        }
        self.known = (self.known + 1).min(last + 1);
        if self.recorded < CHOOSE_EVERY || self.recorded.is_multiple_of(CHOOSE_EVERY) {
            self.terms = self.best();
        }
        self.recorded = self.recorded.wrapping_add(1);
    }
}

#[inline(always)]
fn add(sum: &mut [f64], x: &[f64]) {
    sum.iter_mut().zip(x).for_each(|(sum, x)| *sum += x);
}

#[inline(always)]
fn size(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |max, x| max.max(x.abs()))
}

#[cfg(test)]
mod tests {
    use lie::Rn;

    use super::*;

    #[test]
    fn a_polynomial_is_continued_exactly() {
        let mut warm = WarmStart::new(&Rn([0.0]), None);
        let cubic = |k: i32| f64::from(k * k * k - 2 * k);
        let mut guess = [0.0];
        assert!(!warm.guess(0.1, &mut guess));
        for k in 0..8 {
            warm.record(0.1, &[cubic(k)]);
        }
        assert!(warm.guess(0.1, &mut guess));
        assert_eq!(guess, [cubic(8)]);
        assert!(warm.guess(0.2, &mut guess));
        assert_eq!(guess, [2.0 * cubic(7)]);
    }

    #[test]
    fn noise_is_not_amplified() {
        let mut warm = WarmStart::new(&Rn([0.0]), None);
        for k in 0..20 {
            warm.record(1.0, &[if k % 2 == 0 { 1.0 } else { -1.0 }]);
        }
        let mut guess = [0.0];
        warm.guess(1.0, &mut guess);
        assert!(guess[0].abs() <= 1.0, "{guess:?}");
    }
}
