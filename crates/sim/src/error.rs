//! Why a scene is not run, or not to its end.

use articulated_fluid::ModelError;
use dvi::{PilotError, StepError};
use thiserror::Error;

use crate::number::decimal;

/// More steps than this are taken for a slip: a day of computing and more.
pub const MAX_STEPS: f64 = 1e11;

/// Why a scene is not run, or not to its end.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SimError {
    /// The scene has no model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A duration or a count is not positive and finite.
    #[error("the {what} is {}; expected a finite number > 0", decimal(*value))]
    NotPositive {
        /// What it is, with its unit.
        what: &'static str,
        /// As given.
        value: f64,
    },
    /// The steps are absurdly many.
    #[error(
        "{} s in steps of {} s are {count:.1e} steps, more than {MAX_STEPS:.0e}",
        decimal(*until), decimal(*step)
    )]
    TooManySteps {
        /// The time to run to, s.
        until: f64,
        /// The step, s.
        step: f64,
        /// How many steps that would be.
        count: f64,
    },
    /// The samples are absurdly many.
    #[error(
        "{} s with a sample every {} s are {count:.1e} samples, more than {MAX_STEPS:.0e}",
        decimal(*until), decimal(*every)
    )]
    TooManySamples {
        /// The time to run to, s.
        until: f64,
        /// The time between samples, s.
        every: f64,
        /// How many samples that would be.
        count: f64,
    },
    /// No stages and step were found for the accuracy.
    #[error(transparent)]
    Pilot(#[from] PilotError),
    /// A step was refused; the run stays at the end of the one before.
    #[error("{source}")]
    Step {
        /// Steps of the run before it.
        step: u64,
        /// The time at its start, s.
        t: f64,
        /// Why.
        source: StepError,
    },
    /// What is measured of a state is not a number.
    #[error(
        "at t = {} s the {quantity} is too large for a number; check the scene's position, velocities and masses", decimal(*t)
    )]
    NotFinite {
        /// The time of the state, s.
        t: f64,
        /// What it is.
        quantity: &'static str,
    },
}

impl SimError {
    /// That the state at `t` has no frame.
    pub(crate) fn unmeasured(t: f64, error: ModelError) -> Self {
        match error {
            ModelError::NotFinite { quantity } => Self::NotFinite { t, quantity },
            error => Self::Model(error),
        }
    }
}

/// The value, if it is finite and positive.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<f64, SimError> {
    let valid = value.is_finite() && value > 0.0;
    valid
        .then_some(value)
        .ok_or(SimError::NotPositive { what, value })
}
