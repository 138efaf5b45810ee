//! What does not fit a configuration.

use thiserror::Error;

/// Why a configuration and a velocity make no state.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// The configuration is not one of the system's; see [`Lagrangian::fits`](crate::System::fits).
    #[error(
        "the configuration does not fit the system (another number of bodies?); make it from the system"
    )]
    Configuration,
    /// The velocity has other factors than the configuration.
    #[error(
        "the velocity does not have the configuration's shape ({expected} coordinates, found {found}); make it of `g.zero_algebra()`"
    )]
    Velocity {
        /// Coordinates of the configuration's algebra.
        expected: usize,
        /// Coordinates of the velocity.
        found: usize,
    },
    /// There are more or fewer parameters than the system has.
    #[error("the system has {expected} parameters, and {found} were given")]
    Parameters {
        /// Those of the system.
        expected: usize,
        /// Those given.
        found: usize,
    },
}
