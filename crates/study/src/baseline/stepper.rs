//! One step after the other of an embedded pair, as long as the tolerance allows.

use core::marker::PhantomData;

use lie::Batch;

use super::stages::{RightHandSide, combine, evaluate, is_finite};
use super::tableau::{Row, Tableau, sum};
use super::{BaselineError, Pair, Tolerance};

/// Steps, accepted and rejected, after which a run gives up.
pub const MAX_STEPS: usize = 10_000_000;

/// Of the largest step size that would pass.
const SAFETY: f64 = 0.9;
/// The controller remembers no smaller error.
const LEAST_ERROR: f64 = 1e-4;

/// What a run cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Evaluations of the right-hand side by the method, rejected steps included.
    pub evaluations: usize,
    /// Further evaluations to get states at times between two steps.
    pub sampling_evaluations: usize,
    /// Accepted steps.
    pub accepted: usize,
    /// Rejected steps; failures before the first success are part of finding
    /// the initial step and do not count.
    pub rejected: usize,
}

/// A state, and room for the stages of the step from it. Vectors are combined by the instructions of `S`.
pub(super) struct Stepper<S> {
    pub(super) t: f64,
    pub(super) y: Vec<f64>,
    pub(super) work: Work,
    /// Where the last step started; where it was refused, the same as `t`.
    pub(super) before: f64,
    pair: &'static Pair,
    /// Whether the error estimate takes the rate at the end of the step.
    looks_at_end: bool,
    tolerance: Tolerance,
    /// Length of the next step.
    h: f64,
    /// The end of an attempted step, or the start of the last one taken.
    next: Vec<f64>,
    /// The rates of the stages; the last is that at `next`.
    k: Vec<Vec<f64>>,
    error: Vec<f64>,
    zero: Vec<f64>,
    last_error: f64,
    /// Whether the last attempt was refused.
    refused: bool,
    scalar: PhantomData<S>,
}

impl<S: Batch<Item = f64>> Stepper<S> {
    /// A stepper at a state, whose rate is not known yet.
    pub(super) fn new(pair: &'static Pair, tolerance: Tolerance, (t, y): (f64, &[f64])) -> Self {
        let zero = vec![0.0; y.len()];
        Self {
            t,
            before: t,
            y: y.to_vec(),
            work: Work::default(),
            pair,
            looks_at_end: pair.looks_at_end(),
            tolerance,
            h: 0.0,
            next: y.to_vec(),
            k: vec![zero.clone(); pair.tableau.stages() + 1],
            error: zero.clone(),
            zero,
            last_error: LEAST_ERROR,
            refused: false,
            scalar: PhantomData,
        }
    }

    /// Finds the rate at the start and a first step.
    pub(super) fn begin(
        &mut self,
        rhs: &mut impl RightHandSide,
        until: f64,
    ) -> Result<(), BaselineError> {
        self.work.evaluations += 2;
        rhs(self.t, &self.y, &mut self.k[0]);
        if !is_finite::<S>(&self.k[0]) {
            return Err(BaselineError::NonFiniteRhs { t: self.t });
        }
        self.h = self.first_step(rhs, until - self.t);
        Ok(())
    }

    /// Begins anew where the last step of another one began, and tries the whole way to `at` first.
    pub(super) fn rewind(&mut self, other: &Self, at: f64) {
        let end = self.k.len() - 1;
        self.y.copy_from_slice(&other.next);
        self.k[0].copy_from_slice(&other.k[end]);
        (self.t, self.h) = (other.before, at - other.before);
        (self.work.accepted, self.work.rejected) = (0, 0);
        (self.last_error, self.refused) = (LEAST_ERROR, false);
    }

    /// Takes one step towards `until`, which lies ahead; after an error the state is as it was.
    pub(super) fn step(
        &mut self,
        rhs: &mut impl RightHandSide,
        until: f64,
    ) -> Result<(), BaselineError> {
        // Where the last step started is overwritten.
        self.before = self.t;
        loop {
            let steps = self.work.accepted + self.work.rejected;
            if steps >= MAX_STEPS {
                return Err(BaselineError::TooManySteps { t: self.t, steps });
            }
            if 0.1 * self.h <= f64::EPSILON * self.t.abs() {
                return Err(self.stuck());
            }
            let is_last = self.t + 1.01 * self.h >= until;
            let h = if is_last { until - self.t } else { self.h };
            let error = self.attempt(rhs, h);
            let passes = error <= 1.0 && self.arrives(rhs, h);
            self.h = h * self.factor(error, passes);
            if passes {
                self.take(if is_last { until } else { self.t + h });
                return Ok(());
            }
            self.work.rejected += usize::from(self.work.accepted > 0);
        }
    }

    /// A first step from the sizes of the state and of its first two derivatives (Hairer, Nørsett, Wanner, II.4).
    fn first_step(&mut self, rhs: &mut impl RightHandSide, longest: f64) -> f64 {
        let y = self.size(&self.y, &self.zero);
        let rate = self.size(&self.k[0], &self.zero);
        let small = y <= 1e-5 || rate <= 1e-5;
        let h = if small { 1e-6 } else { 0.01 * y / rate }.min(longest);
        combine::<S>(&mut self.next, &self.y, h, &[(0, 1.0)], &self.k);
        rhs(self.t + h, &self.next, &mut self.k[1]);
        let largest = rate.max(self.size(&self.k[1], &self.k[0]) / h);
        let second = if largest <= 1e-15 {
            (h * 1e-3).max(1e-6)
        } else {
            (0.01 / largest).powf(1.0 / f64::from(self.pair.tableau.order))
        };
        (100.0 * h).min(second).min(longest)
    }

    /// The norm of $a - b$ in units of the tolerance.
    fn size(&self, a: &[f64], b: &[f64]) -> f64 {
        let scaled = a.iter().zip(b).zip(&self.y);
        let squares = scaled.map(|((a, b), y)| ((a - b) / self.tolerance.scale(*y)).powi(2));
        squares.sum::<f64>().sqrt()
    }

    /// A step into `next`, and its error in units of the tolerance.
    fn attempt(&mut self, rhs: &mut impl RightHandSide, h: f64) -> f64 {
        let Pair {
            tableau,
            estimate,
            second,
            ..
        } = self.pair;
        let (t, y) = (self.t, &self.y);
        evaluate::<S>(tableau.rows, rhs, (t, y), h, &mut self.next, &mut self.k);
        self.work.evaluations += tableau.rows.len();
        combine::<S>(&mut self.next, &self.y, h, tableau.weights, &self.k);
        if self.looks_at_end {
            self.evaluate_end(rhs, h);
        }
        let (first, second) = (self.square_of_error(estimate), self.square_of_error(second));
        let both = first + 0.01 * second;
        let both = if both == 0.0 { 1.0 } else { both };
        h * first / (both * self.y.len() as f64).sqrt()
    }

    fn evaluate_end(&mut self, rhs: &mut impl RightHandSide, h: f64) {
        let end = self.k.len() - 1;
        rhs(self.t + h, &self.next, &mut self.k[end]);
        self.work.evaluations += 1;
    }

    /// The sum of the squares of $\sum_i e_i k_i$ in units of the tolerance.
    fn square_of_error(&mut self, row: Row) -> f64 {
        if row.is_empty() {
            return 0.0;
        }
        combine::<S>(&mut self.error, &self.zero, 1.0, row, &self.k);
        let tolerance = self.tolerance;
        S::run(
            #[inline(always)]
            || {
                let ends = self.y.iter().zip(&self.next).zip(&self.error);
                let squares = ends.map(|((y, next), error)| {
                    let scaled = error / tolerance.scale(y.abs().max(next.abs()));
                    scaled * scaled
                });
                squares.sum()
            },
        )
    }

    /// Whether the end of a step of this size and the rate there are finite.
    fn arrives(&mut self, rhs: &mut impl RightHandSide, h: f64) -> bool {
        if !is_finite::<S>(&self.next) {
            return false;
        }
        if !self.looks_at_end {
            self.evaluate_end(rhs, h);
        }
        is_finite::<S>(&self.k[self.k.len() - 1])
    }

    /// By what the step size changes after an attempt.
    fn factor(&mut self, error: f64, passes: bool) -> f64 {
        let Pair {
            tableau,
            damping,
            factors: [least, most],
            ..
        } = *self.pair;
        let exponent = 1.0 / f64::from(tableau.order) - 0.75 * damping;
        let wanted = SAFETY / error.powf(exponent);
        let factor = if passes {
            let factor = wanted * self.last_error.powf(damping);
            self.last_error = error.max(LEAST_ERROR);
            // After a refused step the next one is no longer.
            factor.clamp(least, if self.refused { 1.0 } else { most })
        } else if error > 1.0 {
            wanted.max(least)
        } else {
            least
        };
        self.refused = !passes;
        factor
    }

    /// Takes the attempted step.
    fn take(&mut self, t: f64) {
        let end = self.k.len() - 1;
        core::mem::swap(&mut self.y, &mut self.next);
        self.k.swap(0, end);
        self.t = t;
        self.work.accepted += 1;
    }

    /// Why no step is short enough: what was not finite in the last attempt, if anything.
    fn stuck(&mut self) -> BaselineError {
        let Tableau { rows, weights, .. } = self.pair.tableau;
        let (t, h) = (self.t, self.h);
        for (i, row) in rows.iter().chain([&weights]).enumerate() {
            let t = t + sum(row) * h;
            combine::<S>(&mut self.next, &self.y, h, row, &self.k);
            if !is_finite::<S>(&self.next) {
                return BaselineError::NonFiniteState { t };
            }
            if !is_finite::<S>(&self.k[i + 1]) {
                return BaselineError::NonFiniteRhs { t };
            }
        }
        BaselineError::StepUnderflow { t }
    }
}
