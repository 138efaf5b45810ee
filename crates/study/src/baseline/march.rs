//! From step to step to the end, with a sample wherever the grid has one.

use ode_solvers::dop_shared::IntegrationError;

use super::grid::Grid;
use super::system::{Call, Leg, Listened, Listener, Rhs, State, is_finite};
use super::{BaselineError, MAX_STEPS, Pair, Samples, Tolerance};

/// The steppers keep every step of a call, so a call is kept short.
const STEPS_PER_LEG: u32 = 1 << 16;

/// Shorter than this, relative to the time, the steppers refuse to step.
const NO_STEP: f64 = 16.0 * f64::EPSILON;

/// Integrates over the whole grid.
pub(super) fn march(
    pair: Pair,
    tolerance: Tolerance,
    grid: &Grid,
    rhs: Call<'_>,
    y0: &[f64],
) -> Result<Samples, BaselineError> {
    let rhs = Rhs::new(rhs);
    let mut track = Track::new(pair, tolerance, grid, &rhs, y0);
    while !track.leg()? {}
    Ok(track.finish())
}

/// A state the method has reached.
struct Node {
    t: f64,
    y: State,
}

/// Length of the last step and the numbers of steps so far.
struct Tally {
    last_step: f64,
    accepted: usize,
    rejected: usize,
}

struct Track<'a, 'c> {
    pair: Pair,
    tolerance: Tolerance,
    grid: &'a Grid,
    rhs: &'a Rhs<'c>,
    node: Node,
    tally: Tally,
    samples: Samples,
    failure: Option<BaselineError>,
}

impl<'a, 'c> Track<'a, 'c> {
    fn new(pair: Pair, tolerance: Tolerance, grid: &'a Grid, rhs: &'a Rhs<'c>, y0: &[f64]) -> Self {
        let node = Node {
            t: 0.0,
            y: State::from_column_slice(y0),
        };
        let tally = Tally {
            last_step: 0.0,
            accepted: 0,
            rejected: 0,
        };
        let mut samples = Samples {
            t: Vec::with_capacity(grid.len()),
            y: Vec::with_capacity(grid.len()),
            evaluations: 0,
            sampling_evaluations: 0,
            accepted: 0,
            rejected: 0,
        };
        samples.push(0.0, &node.y);
        Self {
            pair,
            tolerance,
            grid,
            rhs,
            node,
            tally,
            samples,
            failure: None,
        }
    }

    /// Runs a bounded number of steps; says whether the end is reached.
    fn leg(&mut self) -> Result<bool, BaselineError> {
        let rhs = self.rhs;
        let before = self.tally.accepted;
        let leg = Leg {
            pair: self.pair,
            tolerance: self.tolerance,
            from: self.node.t,
            to: self.grid.until(),
            first_step: self.tally.last_step,
            max_steps: STEPS_PER_LEG,
        };
        let y = self.node.y.clone();
        let listened = Listened {
            rhs,
            listener: &mut *self,
        };
        let outcome = leg.run(listened, y);
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        match outcome {
            Ok(stats) => {
                self.tally.rejected += stats.rejected_steps as usize;
                Ok(true)
            }
            Err(IntegrationError::MaxNumStepReached { n_step, .. }) => {
                self.cut(n_step as usize, self.tally.accepted - before)
            }
            Err(_) => Err(stuck(rhs, self.node.t)),
        }
    }

    fn cut(&mut self, tried: usize, accepted: usize) -> Result<bool, BaselineError> {
        if accepted == 0 {
            return Err(stuck(self.rhs, self.node.t));
        }
        self.tally.rejected += tried.saturating_sub(accepted);
        let steps = self.tally.accepted + self.tally.rejected;
        if steps >= MAX_STEPS {
            return Err(BaselineError::TooManySteps {
                t: self.node.t,
                steps,
            });
        }
        Ok(false)
    }

    /// Samples strictly before the end that this step has passed.
    fn sample_up_to(&mut self, t: f64, y: &State) -> Result<(), BaselineError> {
        while let Some(at) = self.grid.before_end(self.samples.t.len()) {
            if at > t {
                break;
            }
            if at == t {
                self.samples.push(at, y);
            } else {
                let between = self.between(at)?;
                self.samples.push(at, &between);
            }
        }
        Ok(())
    }

    /// The state at a time within the step that starts at the node.
    fn between(&mut self, at: f64) -> Result<State, BaselineError> {
        let step = at - self.node.t;
        if step <= NO_STEP * at {
            return Ok(self.node.y.clone());
        }
        let leg = Leg {
            pair: self.pair,
            tolerance: self.tolerance,
            from: self.node.t,
            to: at,
            first_step: step,
            max_steps: STEPS_PER_LEG,
        };
        let calls = self.rhs.calls.get();
        let mut last = Last(self.node.y.clone());
        let listened = Listened {
            rhs: self.rhs,
            listener: &mut last,
        };
        leg.run(listened, self.node.y.clone())
            .map_err(|_| stuck(self.rhs, self.node.t))?;
        self.samples.sampling_evaluations += self.rhs.calls.get() - calls;
        if is_finite(&last.0) {
            return Ok(last.0);
        }
        Err(BaselineError::NonFiniteState { t: at })
    }

    fn finish(mut self) -> Samples {
        self.samples.push(self.grid.until(), &self.node.y);
        self.samples.evaluations = self.rhs.calls.get() - self.samples.sampling_evaluations;
        self.samples.accepted = self.tally.accepted;
        self.samples.rejected = self.tally.rejected;
        self.samples
    }

    fn step(&mut self, t: f64, y: &State, dy: &State) -> Result<(), BaselineError> {
        if !is_finite(y) {
            return Err(BaselineError::NonFiniteState { t });
        }
        if !is_finite(dy) {
            return Err(BaselineError::NonFiniteRhs { t });
        }
        self.rhs.not_finite.set(None);
        self.sample_up_to(t, y)?;
        self.tally.last_step = t - self.node.t;
        self.tally.accepted += 1;
        self.node = Node { t, y: y.clone() };
        Ok(())
    }
}

impl Listener for Track<'_, '_> {
    fn accepted(&mut self, t: f64, y: &State, dy: &State) -> bool {
        self.failure = self.step(t, y, dy).err();
        self.failure.is_some()
    }
}

/// Keeps the newest state.
struct Last(State);

impl Listener for Last {
    fn accepted(&mut self, _t: f64, y: &State, _dy: &State) -> bool {
        self.0.copy_from(y);
        false
    }
}

fn stuck(rhs: &Rhs<'_>, t: f64) -> BaselineError {
    match rhs.not_finite.get() {
        Some(t) => BaselineError::NonFiniteRhs { t },
        None => BaselineError::StepUnderflow { t },
    }
}

impl Samples {
    fn push(&mut self, t: f64, y: &State) {
        self.t.push(t);
        self.y.push(y.as_slice().to_vec());
    }
}
