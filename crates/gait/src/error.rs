//! What keeps a scene from being a gait.

use articulated_fluid::ModelError;
use thiserror::Error;

/// Why there is no gait, or none better.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GaitError {
    /// The scene makes no model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The first body hangs on the world.
    #[error(
        "the first body is held by the world; a gait moves a free one: remove the joint to \"world\""
    )]
    Held,
    /// A joint follows from the motion, where the shape has to be told.
    #[error("the joint {joint:?} is free; give it a `motion` or a `[[gait]]`")]
    Free {
        /// Its name.
        joint: String,
    },
    /// Nothing moves.
    #[error("no joint moves as told; give one a `motion` or a `[[gait]]`")]
    Rigid,
    /// What is told never repeats itself.
    #[error(
        "what moves the joints never repeats itself: a table without `repeat = true`, or frequencies without a common period"
    )]
    NotPeriodic,
    /// What is told is constant.
    #[error("the joints stay where they are; give their motion an amplitude and a frequency")]
    Still,
    /// A period is not positive.
    #[error("the period is {period:?} s; expected a finite number > 0")]
    Period {
        /// What was given, s.
        period: f64,
    },
    /// Coefficients that make no stroke.
    #[error(
        "{found} coefficients of order {order}; expected finite numbers, 1 + 2 * order of each coordinate"
    )]
    Coefficients {
        /// How many were given.
        found: usize,
        /// The order of the stroke.
        order: usize,
    },
    /// A limit that is not positive.
    #[error(
        "the limits are {angle:?} rad and {rate:?} rad/s; expected an angle > 0 and a rate > 0"
    )]
    Limits {
        /// The largest angle, rad.
        angle: f64,
        /// The largest rate, rad/s.
        rate: f64,
    },
    /// A step was refused.
    #[error(transparent)]
    Step(dvi::StepError),
    /// No steady stroke was found.
    #[error(
        "no steady stroke was found: after a period the motion is still off by {residual:e}; give the bodies drag, or another start"
    )]
    NotSteady {
        /// How far the state is from itself after a period.
        residual: f64,
    },
    /// A text that is not that of the scene.
    #[error("{what}")]
    Text {
        /// What is wrong with it.
        what: String,
    },
    /// No start led to a stroke within the limits.
    #[error("no stroke within the limits was found; allow larger angles or rates, or more starts")]
    NoStroke,
    /// A shape or a stroke of another number of coordinates.
    #[error("{found} numbers; this chain expects {expected}")]
    Shape {
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A formula could not be recorded.
    #[error("the formulas could not be recorded: {0}")]
    Trace(trace::TraceError),
    /// Height functions of another number of coordinates.
    #[error("height functions are maps of two shape coordinates; this scene has {found}")]
    NotTwo {
        /// How many there are.
        found: usize,
    },
    /// A stroke that encloses no area.
    #[error("one of the two shape coordinates does not move; height functions need a loop")]
    Thin,
    /// An objective that is not known of a scene.
    #[error(
        "with loads the positive work of the joints alone is not known; take advance, advance-per-length or turn"
    )]
    Objective,
}
