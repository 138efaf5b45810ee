//! Why a run did not reach its end.

use dvi::{PilotError, StepError};
use sim::number::decimal;
use thiserror::Error;

use crate::baseline::BaselineError;

/// Why a contender did not reach the end of a run.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Failure {
    /// A step was refused.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The adaptive method refused its input or gave up.
    #[error(transparent)]
    Adaptive(#[from] BaselineError),
    /// No stages and step were found.
    #[error(transparent)]
    Pilot(#[from] PilotError),
    /// The setting is another control's: a step for a tolerance, say.
    #[error("{name} is not run with {given}")]
    Control {
        /// The contender.
        name: &'static str,
        /// The setting.
        given: String,
    },
    /// What is measured of a state is not a number.
    #[error("at t = {} s the energy, a momentum or an attitude is not a finite number", decimal(*t))]
    NotFinite {
        /// Time of the state, s.
        t: f64,
    },
}
