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
        "what moves the joints never repeats itself: give tables `repeat = true`, and frequencies a common period"
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
        "{found} coefficients of order {order}; give 1 + 2 * order finite numbers for each coordinate"
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
        "no steady stroke was found: after a period the motion is still off by {residual:e}; take more drag, or a smaller stroke"
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
    #[error(
        "{found} numbers where this chain has {expected}; give a stroke of as many coordinates"
    )]
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
    #[error(
        "height functions are maps of two shape coordinates, and this scene has {found}; let two hinges move"
    )]
    NotTwo {
        /// How many there are.
        found: usize,
    },
    /// A stroke that encloses no area.
    #[error(
        "one of the two shape coordinates stays where it is; let both move, so that the stroke is a loop"
    )]
    Thin,
    /// An objective that is not known of a scene.
    #[error(
        "with loads the positive work of the joints alone is not known; take advance, advance-per-length or turn"
    )]
    Objective,
    /// Gravity acts.
    #[error(
        "a weight is left that turns or moves the swimmer; make the bodies neutrally buoyant, or leave gravity out"
    )]
    Weight,
    /// A momentum where there must be none.
    #[error("the swimmer has a momentum, which is kept; set start.momentum = \"zero\"")]
    Momentum,
    /// One coordinate without loads.
    #[error(
        "one shape coordinate leads nowhere without drag: it opens and shuts; let a second joint move"
    )]
    Scallop,
    /// Too many harmonics.
    #[error("order {order}; give at most {most} harmonics")]
    Order {
        /// What was asked for.
        order: usize,
        /// The most there may be.
        most: usize,
    },
    /// Too few harmonics.
    #[error("{order} harmonics miss {part:.1e} of the scene's stroke; give more of them")]
    Harmonics {
        /// How many there are.
        order: usize,
        /// The largest difference over the largest angle.
        part: f64,
    },
    /// More strokes than a path can tell.
    #[error("{strokes} strokes; give at most {most}")]
    Strokes {
        /// What was asked for.
        strokes: u32,
        /// The most there may be.
        most: u32,
    },
    /// A search that is too large.
    #[error(
        "{limits} limits on {unknowns} coefficients are too many for the search; take fewer harmonics or bodies"
    )]
    TooLarge {
        /// The limits, at all times.
        limits: usize,
        /// The coefficients.
        unknowns: usize,
    },
    /// Something is no number.
    #[error("the {quantity} of the stroke is not a finite number; check the sizes in the scene")]
    NotFinite {
        /// What.
        quantity: &'static str,
    },
}
