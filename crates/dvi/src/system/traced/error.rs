//! Why a Lagrangian is not recorded.

use thiserror::Error;
use trace::TraceError;

/// Why a Lagrangian has no [`TracedSystem`](crate::TracedSystem).
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TracedError {
    /// Its value cannot be recorded.
    #[error("the Lagrangian cannot be recorded: {0}")]
    Trace(#[from] TraceError),
    /// It is not quadratic in the velocity, or is not seen to be.
    #[error(
        "momentum {coordinate} is not seen to be linear in the velocity; use `hamiltonian()`, which solves for the velocity by iteration"
    )]
    NotQuadratic {
        /// The index of the momentum.
        coordinate: usize,
    },
}
