//! A solution by an independent integration.

use dvi::{ContinuousSystem, State};

use super::{ProblemError, Solution};
use crate::baseline::{Tolerance, on_group};

/// The motion of a system as [`on_group`] finds it, anew from the start at every call.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference<S: ContinuousSystem> {
    /// The system.
    pub system: S,
    /// The state at its own time.
    pub start: State<S::Group>,
    /// Of the steps.
    pub tolerance: Tolerance,
}

impl<S: ContinuousSystem> Solution<S::Group> for Reference<S> {
    fn at(&self, t: f64) -> Result<State<S::Group>, ProblemError> {
        Ok(on_group::integrate(
            &self.system,
            &self.start,
            t,
            self.tolerance,
        )?)
    }
}
