//! An integrator on its way: the one loop in which a state advances.

use std::time::{Duration, Instant};

use dvi::{Integrator, Path, State, StepError, StepReport};

use crate::clock::Clock;
use crate::schedule::Due;

/// An integrator of any group on its way from a start, by a [`Clock`].
///
/// ```
/// use dvi::{Context, Gauss, Lagrangian, System};
/// use lie::{Rn, Scalar, Tangent};
/// use sim::{Clock, Run};
///
/// /// A particle of 1 kg on a spring of 1 N/m.
/// struct Spring;
///
/// impl System for Spring {
///     type Group = Rn<1>;
/// }
///
/// impl Lagrangian for Spring {
///     fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         (v[0] * v[0] - x.0[0] * x.0[0]) * S::from_f64(0.5)
///     }
/// }
///
/// let start = Spring.state(0.0, Rn([1.0]), &Tangent([0.0]))?;
/// let clock = Clock::new(5.0, 0.5)?;
/// let mut run = Run::new(Gauss::new::<4>(Spring.hamiltonian()), start, clock);
/// run.advance(clock.steps())?;
/// assert_eq!(run.state().t, 5.0);
/// assert!((run.state().g.0[0] - 5.0_f64.cos()).abs() < 1e-8);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct Run<I: Integrator> {
    integrator: I,
    clock: Clock,
    /// The time at the start, s.
    origin: f64,
    state: State<I::Group>,
    cost: Cost,
}

/// What looks on at the parts of a step.
pub type See<'a, G> = &'a mut dyn FnMut(Path<G>);

/// What the steps of a run have cost, and how well they were solved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Of stepping alone, by [`Run::advance`]; of [`Run::advance_along`] with what looks on.
    pub time: Duration,
    /// Steps taken.
    pub steps: u64,
    /// Iterations of the solver.
    pub iterations: u64,
    /// Evaluations of the system, those of Newton's matrices among them, as [`StepReport::evaluations`].
    pub evaluations: u64,
    /// The most iterations of a step.
    pub most_iterations: u32,
    /// The largest residual of a step, relative as [`StepReport::residual`].
    pub residual: f64,
}

impl Cost {
    fn add(&mut self, report: StepReport) {
        self.steps += 1;
        self.iterations += u64::from(report.iterations);
        self.evaluations += u64::from(report.evaluations);
        self.most_iterations = self.most_iterations.max(report.iterations);
        self.residual = self.residual.max(report.residual);
    }
}

impl<I: Integrator> Run<I> {
    /// The run at its start.
    pub fn new(integrator: I, start: State<I::Group>, clock: Clock) -> Self {
        Self {
            integrator,
            clock,
            origin: start.t,
            state: start,
            cost: Cost::default(),
        }
    }

    /// The times of the steps, counted from the start.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// The state at the end of the last step.
    pub fn state(&self) -> &State<I::Group> {
        &self.state
    }

    /// Goes on in steps of half the size.
    pub(crate) fn halve(&mut self) {
        self.clock = self.clock.halved_from(self.cost.steps);
        self.integrator.reset();
    }

    /// What the steps have cost so far.
    pub fn cost(&self) -> &Cost {
        &self.cost
    }

    /// Takes the next step, whether or not the clock ends before.
    ///
    /// # Errors
    /// [`StepError`], and the run is as it was.
    pub fn step(&mut self) -> Result<(), StepError> {
        let report = self.integrator.step(&mut self.state, self.clock.step())?;
        self.count(report);
        Ok(())
    }

    fn count(&mut self, report: StepReport) {
        self.cost.add(report);
        self.state.t = self.origin + self.clock.time(self.cost.steps);
    }

    /// Takes the steps up to number `stop`, and times them.
    ///
    /// # Errors
    /// [`StepError`], and the run is at the end of the last step that was solved.
    pub fn advance(&mut self, stop: u64) -> Result<(), StepError> {
        let begin = Instant::now();
        let solved = (self.cost.steps..stop).try_for_each(|_| self.step());
        self.cost.time += begin.elapsed();
        solved
    }

    /// Takes the next step likewise, and shows what it goes through.
    ///
    /// # Errors
    /// As [`step`](Self::step); then what was seen is not of the motion.
    pub fn advance_along(&mut self, see: See<I::Group>) -> Result<(), StepError> {
        let begin = Instant::now();
        let (state, h) = (&mut self.state, self.clock.step());
        let solved = self.integrator.step_along(state, h, see);
        let taken = solved.map(|report| self.count(report));
        self.cost.time += begin.elapsed();
        taken
    }

    /// The state that is due, at the run's place or inside the next step: there it is a shorter step, and the run stays where it is.
    ///
    /// # Errors
    /// As [`Integrator::peek`].
    pub fn look(&mut self, due: &Due) -> Result<State<I::Group>, StepError> {
        self.look_along(due, &mut |_| ())
    }

    /// The same, with what lies between the run's place and that.
    ///
    /// # Errors
    /// As [`look`](Self::look).
    pub fn look_along(
        &mut self,
        due: &Due,
        see: See<I::Group>,
    ) -> Result<State<I::Group>, StepError> {
        let mut state = match due.ahead {
            0.0 => self.state.clone(),
            ahead => self.integrator.peek_along(&self.state, ahead, see)?,
        };
        state.t = self.origin + due.t;
        Ok(state)
    }
}
