//! Why a scene is not run, or not to its end.

use articulated_fluid::ModelError;
use dvi::{PilotError, StepError};
use thiserror::Error;

use crate::method::Method;
use crate::number::decimal;

/// The largest accuracy that can be asked for: two attitudes at random are hardly farther apart.
pub const LARGEST_ACCURACY: f64 = 1.0;

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
    /// A motion is not told from the start to the end of the run.
    #[error(
        "what moves as told is told from {} s to {} s, and the run goes from 0 s to {} s; {}",
        decimal(*from), decimal(*to), decimal(*until),
        match *from > 0.0 {
            true => "let the table begin at 0 s or before",
            false => "take a shorter --until, a longer table, or repeat = true",
        }
    )]
    Untold {
        /// When the motions begin, s.
        from: f64,
        /// When they end, s.
        to: f64,
        /// The time to run to, s.
        until: f64,
    },
    /// A method's steps back in time come too near to where a damper feeds the motion without bound.
    #[error(
        "{method} takes steps back in time, where dampers and servos feed the motion: at this damping its step is at most {} s, and {} s is asked for; take a shorter --step, composition-2 or gauss-4",
        decimal(*longest), decimal(*step)
    )]
    DamperPole {
        /// Which.
        method: Method,
        /// As asked for, s.
        step: f64,
        /// The longest step, s.
        longest: f64,
    },
    /// No stages and step were found for the accuracy.
    #[error(transparent)]
    Pilot(#[from] PilotError),
    /// More than an error can be.
    #[error(
        "{accuracy:e} is no accuracy: an attitude is never more than pi off; ask for {LARGEST_ACCURACY} at the most, in radians and metres"
    )]
    NoAccuracy {
        /// As asked for.
        accuracy: f64,
    },
    /// Shorter steps do not keep the accuracy to the end: rounding grows beyond it.
    #[error("{}", out_of_reach(*accuracy, *until, *held))]
    AccuracyOutOfReach {
        /// As asked for, rad and m.
        accuracy: f64,
        /// The time to run to, s.
        until: f64,
        /// The last time at which it was seen to hold, s.
        held: f64,
    },
    /// No step that was tried for an accuracy is solved to the end.
    #[error("no step that was tried for the accuracy is solved beyond t = {} s: {source}", decimal(*t))]
    Rehearsal {
        /// The last time that was reached, s.
        t: f64,
        /// Why.
        source: StepError,
    },
    /// A frame is asked for that is not ahead.
    #[error(
        "a frame at {} s is asked for where the run is at {} s on its way to {} s; ask for times in this range, in order",
        decimal(*t), decimal(*from), decimal(*to)
    )]
    Outside {
        /// When, s.
        t: f64,
        /// Where the run is, s.
        from: f64,
        /// Where it ends, s.
        to: f64,
    },
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

fn out_of_reach(accuracy: f64, until: f64, held: f64) -> String {
    let why = format!(
        "an accuracy of {accuracy:e} is out of reach over {} s: shorter steps reach no further, rounding errors grow beyond it",
        decimal(until)
    );
    // Two digits, rounded down; and some room, for another time takes other steps.
    let size = 10.0_f64.powf(held.log10().floor() - 1.0);
    let advised = (ROOM * held / size).floor() * size;
    if advised > 0.0 {
        let advised: f64 = format!("{advised:.1e}").parse().unwrap_or(advised);
        let (held, advised) = (format!("{held:.2e}"), decimal(advised));
        let held = held.parse().map_or(held, decimal);
        format!("{why}. It holds up to t = {held} s; run to {advised} s, or ask for less")
    } else {
        format!("{why} at once; ask for less")
    }
}

/// The part of a time for which an accuracy held that is advised.
const ROOM: f64 = 0.8;

/// The value, if it is finite and positive.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<f64, SimError> {
    let valid = value.is_finite() && value > 0.0;
    valid
        .then_some(value)
        .ok_or(SimError::NotPositive { what, value })
}
