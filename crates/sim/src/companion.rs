//! A second run in longer steps, which goes along with a run and tells its error.

use articulated_fluid::Configuration;
use dvi::{State, StepError};

use crate::clock::Clock;
use crate::distance::distance;
use crate::method::BoxedIntegrator;
use crate::run::Run;
use crate::schedule::Due;

/// The same run in fewer steps.
pub(crate) struct Companion {
    run: Run<BoxedIntegrator<Configuration>>,
}

impl Companion {
    /// From the same start to the same end, in so many steps.
    pub(crate) fn new(
        integrator: BoxedIntegrator<Configuration>,
        start: State<Configuration>,
        (until, steps): (f64, u64),
    ) -> Self {
        let clock = Clock::divided(until, steps);
        Self {
            run: Run::new(integrator, start, clock),
        }
    }

    /// Its state at the time of `other`, not before the last one asked for; inside a step, by a shorter step.
    pub(crate) fn at(&mut self, t: f64) -> Result<State<Configuration>, StepError> {
        let clock = *self.run.clock();
        let (steps, ahead) = match clock.is_end(t) {
            true => (clock.steps(), 0.0),
            false => clock.locate(t),
        };
        self.run.advance(steps)?;
        self.run.look(&Due { steps, ahead, t })
    }

    /// How far it is from `state`, at that time.
    pub(crate) fn apart(&mut self, state: &State<Configuration>) -> Result<f64, StepError> {
        Ok(distance(&self.at(state.t)?.g, &state.g))
    }

    /// Steps taken.
    pub(crate) fn steps(&self) -> u64 {
        self.run.cost().steps
    }
}

/// Steps at whose ends two runs are compared: densely at first, then equally spaced. The next one after `at`, of `steps`.
pub(crate) fn next_look(at: u64, steps: u64) -> u64 {
    let ahead = (at / 4).clamp(1, (steps / 64).max(1));
    (at + ahead).min(steps)
}
