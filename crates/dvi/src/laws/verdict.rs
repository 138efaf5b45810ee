//! Why a check did not pass.

use core::ops::Range;

use thiserror::Error;

use crate::StepError;

/// Why a check did not pass.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LawError {
    /// A formula does not hold, or there was nothing to try it on.
    #[error(transparent)]
    Law(#[from] lie::laws::LawError),
    /// The errors of the runs are those of rounding, or there is one run only: they show no order.
    #[error(
        "fewer than two runs have errors above rounding (step sizes and errors: {errors:?}): give more runs, of longer steps"
    )]
    TooFewRuns {
        /// Step sizes, s, and errors of all runs.
        errors: Vec<(f64, f64)>,
    },
    /// The kinetic energy has no inertia in some direction of the velocity.
    #[error(
        "the Lagrangian is degenerate: its kinetic energy has no inertia in some direction of the velocity, so a momentum there has no velocity; give it a small one, as a point mass on a rod needs about the rod (for {case})"
    )]
    Degenerate {
        /// The state it was tried at.
        case: String,
    },
    /// The coordinates that are declared cyclic are not all there.
    #[error(
        "cyclic() names the coordinates {} to {}, but the group has {dimension}, counted from 0; name those of a factor R^m that g does not enter by", cyclic.start, cyclic.end - 1
    )]
    Cyclic {
        /// What [`cyclic`](crate::System::cyclic) returns.
        cyclic: Range<usize>,
        /// The dimension of the group.
        dimension: usize,
    },
    /// The observed order is not the declared one.
    #[error(
        "the observed order is {observed:.3}, the declared one {declared}; step sizes and errors: {errors:?}; a higher one is that of steps too long for the motion"
    )]
    Order {
        /// What the integrator declares.
        declared: u32,
        /// The slope of the log–log fit.
        observed: f64,
        /// Step sizes, s, and errors of the fit.
        errors: Vec<(f64, f64)>,
    },
    /// A step that a law speaks of was refused.
    #[error("a step was refused: {0}")]
    Step(#[from] StepError),
}

pub(super) type Outcome = Result<(), LawError>;

/// Refuses to check on nothing.
pub(super) fn examples<T>(states: &[T]) -> Outcome {
    match states {
        [] => Err(lie::laws::LawError::NoExamples { what: "state" }.into()),
        _ => Ok(()),
    }
}
