//! Explicit Runge–Kutta methods of a fixed step: what a variational integrator is measured against.
//!
//! [`GroupRungeKutta`] stays on the group and keeps nothing else; [`ClassicalRungeKutta`] does not know that there is one. Both are
//! [`Integrator`](dvi::Integrator)s, and a step evaluates the velocity and the force [`STAGES`] times.

mod classical;
mod group;

use dvi::{State, StepError};
use lie::{RealGroup, VectorSpace};

pub use classical::ClassicalRungeKutta;
pub use group::{GroupRungeKutta, Scheme};

/// Evaluations in a step of each method here.
pub const STAGES: u32 = 4;

/// What every step refuses, before its step number `step`.
fn check<G: RealGroup>(state: &State<G>, h: f64, step: u64, fits: bool) -> Result<(), StepError> {
    let t = state.t;
    if h == 0.0 || !h.is_finite() {
        return Err(StepError::InvalidStep { step, t, h });
    }
    if !fits {
        return Err(StepError::Misfit { step, t });
    }
    let zero = state.g.zero_dual();
    if !state.mu.same_shape(&zero) {
        let (expected, found) = (zero.dim(), state.mu.dim());
        return Err(StepError::Shape {
            step,
            t,
            expected,
            found,
        });
    }
    Ok(())
}
