//! Why a problem has no solution of the form asked for.

use crate::baseline::on_group::ReferenceError;

/// Failure to pose a problem or to evaluate its solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProblemError {
    /// A parameter that must be positive is not.
    #[error("the {what} is {value:e}: give a finite number > 0")]
    NotPositive {
        /// The parameter.
        what: &'static str,
        /// The value given.
        value: f64,
    },
    /// A number of the start, a parameter or a time is not finite.
    #[error("the {what} is not finite: give finite numbers")]
    NotFinite {
        /// What was given.
        what: &'static str,
    },
    /// There is no such axis.
    #[error("there is no axis {axis}: give 0, 1 or 2")]
    NoSuchAxis {
        /// The index given.
        axis: usize,
    },
    /// The motion is not periodic.
    #[error(
        "the motion has no period: it is at rest or on a separatrix, start it with more or less energy"
    )]
    NoPeriod,
    /// The motion comes so close to the vertical that its azimuth is lost.
    #[error(
        "the axis comes within {distance:e} (one minus |cos|) of the vertical, where its azimuth is lost: tilt it"
    )]
    Vertical {
        /// $1 - |\cos\theta|$ where it is smallest.
        distance: f64,
    },
    /// The mass centre does not lie in the plane of the swing.
    #[error(
        "the mass centre is {offset:e} m off the plane of the swing: give it no part along the axis"
    )]
    NotPlanar {
        /// The mass centre's coordinate along the axis, m.
        offset: f64,
    },
    /// The start is no state of the Lagrangian.
    #[error("the start is no state of the Lagrangian")]
    Shape(#[from] dvi::ShapeError),
    /// The independent integration failed.
    #[error("the reference solution failed")]
    Reference(#[from] ReferenceError),
}
