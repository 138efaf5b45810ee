//! Why a Lagrangian is not recorded.

use thiserror::Error;
use trace::TraceError;

/// Why a system does not run on a recording of its value.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TracedError {
    /// Its value cannot be recorded.
    #[error("the formula cannot be recorded: {0}")]
    Trace(#[from] TraceError),
    /// It is not quadratic in the velocity, or is not seen to be.
    #[error(
        "momentum {coordinate} is not seen to be linear in the velocity; use `hamiltonian()`, which solves for the velocity by iteration"
    )]
    NotQuadratic {
        /// The index of the momentum.
        coordinate: usize,
    },
    /// The factors of the inertia would be too long a program.
    #[error(
        "the inertia couples too many of the {dim} velocities: its factors take more than {limit} operations"
    )]
    Dense {
        /// How many velocities there are.
        dim: usize,
        /// The most operations that are written out.
        limit: usize,
    },
    /// The formula is not in the memory of the system that is stepped, so that it may be another one at the next evaluation.
    #[error("the formula is made anew for each evaluation: keep it in the system")]
    Elsewhere,
    /// A step's displacement has other factors than the configuration that it starts from.
    #[error("the displacement has another shape than the configuration")]
    Shape,
    /// Another formula, or another shape, was to be recorded again and again.
    #[error(
        "another formula or shape was recorded {times} times: one that stays the same is worth it alone"
    )]
    Changes {
        /// How often.
        times: u32,
    },
    /// The inertia is not positive definite.
    #[error(
        "the inertia has a pivot that is not positive, at coordinate {coordinate}: elimination without exchanges of rows is not safe"
    )]
    Indefinite {
        /// The index of the velocity.
        coordinate: usize,
    },
}
