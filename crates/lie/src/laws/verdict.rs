//! Why a check did not pass.

use thiserror::Error;

use crate::LieGroup;

/// Why a check did not pass.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LawError {
    /// There was nothing to try the laws on.
    #[error("no {what} among the examples: give at least one, laws cannot pass on nothing")]
    NoExamples {
        /// What was missing.
        what: &'static str,
    },
    /// A law does not hold.
    #[error(
        "the law {formula} fails for {case}: component {component} is {left:.17e} on the left and {right:.17e} on the right (tolerance {tolerance:.1e})"
    )]
    Violated {
        /// The law.
        formula: &'static str,
        /// The example it fails on.
        case: String,
        /// The coordinate that differs most.
        component: usize,
        /// The left-hand side there.
        left: f64,
        /// The right-hand side there.
        right: f64,
        /// The largest difference that rounding explains.
        tolerance: f64,
    },
    /// A value that a law speaks of does not exist.
    #[error("the law {formula} fails for {case}: it needs a value, the answer is {answer}")]
    Undefined {
        /// The law.
        formula: &'static str,
        /// The example it fails on.
        case: String,
        /// What the group answered.
        answer: String,
    },
}

pub(super) type Outcome = Result<(), LawError>;

/// A group that is its own relative over its scalar, as all are: what dual numbers over it are made of.
pub(super) trait Family: LieGroup<WithScalar<<Self as LieGroup>::Scalar> = Self> {}

impl<G: LieGroup<WithScalar<<G as LieGroup>::Scalar> = G>> Family for G {}
