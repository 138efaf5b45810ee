//! Comparing the two sides of a law.

use lie::{RealGroup, VectorSpace};

use super::verdict::{LawError, Outcome, Report, examples};
use crate::State;

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

/// Calls a law on every state, of which there must be one.
pub(super) fn on_each<G: RealGroup>(
    states: &[State<G>],
    mut law: impl FnMut(&mut Checker, &State<G>) -> Outcome,
) -> Result<Report, LawError> {
    examples(states)?;
    let mut checker = Checker::default();
    states
        .iter()
        .try_for_each(|state| law(&mut checker, state))?;
    Ok(checker.report())
}

/// One plus the largest coordinate of the logarithm.
pub(super) fn extent<G: RealGroup>(g: &G) -> f64 {
    let log = g.log().unwrap_or_else(|e| e.representative);
    1.0 + log.max_magnitude()
}
