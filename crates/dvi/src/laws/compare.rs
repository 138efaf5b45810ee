//! Comparing the two sides of a law.

use lie::laws::Report;
use lie::{RealGroup, VectorSpace};

use super::verdict::{LawError, Outcome, examples};
use crate::State;

/// What rounding may make of a formula, relative to its largest term; the systems of the tests reach a hundredth of it.
pub(super) const ROUNDING: f64 = 1e-11;

/// Calls a law on every state, of which there must be one.
pub(super) fn on_each<G: RealGroup>(
    states: &[State<G>],
    mut law: impl FnMut(&mut Report, &State<G>) -> Outcome,
) -> Result<Report, LawError> {
    examples(states)?;
    let mut report = Report::default();
    states
        .iter()
        .try_for_each(|state| law(&mut report, state))?;
    Ok(report)
}

/// The logarithm, or one of them.
pub(super) fn logarithm<G: RealGroup>(g: &G) -> G::Algebra {
    g.log().unwrap_or_else(|e| e.representative)
}

/// $\log(a^{-1} b)$.
pub(super) fn difference<G: RealGroup>(a: &G, b: &G) -> G::Algebra {
    logarithm(&a.inverse().compose(b))
}

/// One plus the largest coordinate of the logarithm.
pub(super) fn extent<G: RealGroup>(g: &G) -> f64 {
    1.0 + logarithm(g).max_magnitude()
}
