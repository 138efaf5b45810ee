//! Comparing the two sides of a law.

use lie::VectorSpace;

use super::{LawError, Outcome, Report};

/// What rounding may make of a formula, relative to its largest term; the systems of the tests reach a hundredth of it.
pub(super) const ROUNDING: f64 = 1e-11;

/// Counts the comparisons and keeps the worst.
#[derive(Default)]
pub(super) struct Checker {
    comparisons: usize,
    worst: f64,
}

impl Checker {
    pub(super) fn report(self) -> Report {
        Report {
            comparisons: self.comparisons,
            worst: self.worst,
        }
    }

    pub(super) fn number(
        &mut self,
        formula: &'static str,
        case: impl Fn() -> String,
        component: usize,
        (left, right): (f64, f64),
        tolerance: f64,
    ) -> Outcome {
        self.comparisons += 1;
        let difference = (left - right).abs();
        if difference > 0.0 {
            self.worst = self.worst.max(difference / tolerance);
        }
        // Written so that NaN fails; an infinite tolerance would pass anything.
        if difference <= tolerance && tolerance.is_finite() {
            return Ok(());
        }
        Err(LawError::Violated {
            formula,
            case: case(),
            component,
            left,
            right,
            tolerance,
        })
    }

    pub(super) fn vectors<V, W>(
        &mut self,
        formula: &'static str,
        case: impl Fn() -> String,
        (left, right): (&V, &W),
        tolerance: f64,
    ) -> Outcome
    where
        V: VectorSpace<Scalar = f64>,
        W: VectorSpace<Scalar = f64>,
    {
        (0..left.dim()).try_for_each(|i| {
            let sides = (left.get(i), right.get(i));
            self.number(formula, &case, i, sides, tolerance)
        })
    }
}

/// The larger of the two, not a number where one is not.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}
