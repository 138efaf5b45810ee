//! The steps of one trajectory of a system that somebody else holds.

use lie::lanes::InstructionSet;
use lie::{Cayley, Retraction, VectorSpace};

use super::stepper::{MakeStepper, Stepper, stepper};
use super::tableau::Tableau;
use super::work::Limits;
use crate::step::{check_momentum, check_step, finite};
use crate::{Cause, ContinuousSystem, Means, Path, State, StepError, StepReport, Variation};

/// Solves step after step of one trajectory. Every call is to be with the same system.
pub(super) struct Solver<C: ContinuousSystem> {
    tableau: &'static Tableau,
    pub(super) limits: Limits,
    instructions: InstructionSet,
    pub(super) steps: u64,
    /// Makes the work for the retraction that was chosen.
    make: MakeStepper<C>,
    work: Option<Box<dyn Stepper<C>>>,
    /// Those of the steps that the work is for.
    means: Means,
}

impl<C: ContinuousSystem + 'static> Solver<C> {
    /// Of 1 to 8 stages, in the Cayley map's chart.
    pub(super) fn new(stages: usize) -> Self {
        Self {
            tableau: Tableau::gauss(stages),
            limits: Limits::default(),
            instructions: InstructionSet::widest(stages),
            steps: 0,
            make: stepper::<C, Cayley>,
            work: None,
            means: Means::default(),
        }
    }

    pub(super) fn stages(&self) -> usize {
        self.tableau.nodes.len()
    }

    pub(super) fn set_retraction<R: Retraction>(&mut self) {
        (self.make, self.work) = (stepper::<C, R>, None);
    }

    pub(super) fn set_instructions(&mut self, instructions: InstructionSet) {
        (self.instructions, self.work) = (instructions, None);
    }

    pub(super) fn reset(&mut self) {
        (self.steps, self.work) = (0, None);
    }

    pub(super) fn step(
        &mut self,
        system: &C,
        state: &mut State<C::Group>,
        h: f64,
    ) -> Result<StepReport, StepError> {
        if state.mu.dim() == 0 {
            return self.pass(system, state, h);
        }
        let report = self.solve(system, state, h)?;
        self.accept(system, state, h)?;
        Ok(report)
    }

    pub(super) fn peek(
        &mut self,
        system: &C,
        state: &State<C::Group>,
        h: f64,
    ) -> Result<State<C::Group>, StepError> {
        if state.mu.dim() == 0 {
            let mut ahead = state.clone();
            return self.pass(system, &mut ahead, h).map(|_| ahead);
        }
        self.solve(system, state, h)?;
        let ahead = self.work.as_ref().map(|work| work.ahead((state, h)));
        let defined = ahead.filter(|ahead| system.is_defined(ahead.t, &ahead.g));
        let ahead = defined.ok_or(Cause::NotFinite).and_then(finite);
        ahead.map_err(|cause| self.error(state, h, cause))
    }

    pub(super) fn step_varied(
        &mut self,
        system: &C,
        state: &mut State<C::Group>,
        variations: &mut [Variation<C::Group>],
        h: f64,
    ) -> Result<StepReport, StepError> {
        if state.mu.dim() == 0 {
            return self.pass(system, state, h);
        }
        let report = self.solve(system, state, h)?;
        let mut carried = variations.to_vec();
        if let Some(work) = &mut self.work {
            work.carry((system, self.tableau), (state, h), &mut carried);
        }
        if !carried.iter().all(Variation::is_finite) {
            return Err(self.error(state, h, Cause::NotFinite));
        }
        self.accept(system, state, h)?;
        variations.clone_from_slice(&carried);
        Ok(report)
    }

    /// Shows the step that was solved last: its start, its stages, its end.
    pub(super) fn show(
        &self,
        (start, h): (&State<C::Group>, f64),
        end: &State<C::Group>,
        see: &mut dyn FnMut(Path<C::Group>),
    ) {
        let nodes = &self.tableau.nodes;
        let mut along = vec![start.clone(); nodes.len() + 2];
        for (i, (node, stage)) in nodes.iter().zip(&mut along[1..]).enumerate() {
            stage.t = start.t + node * h;
            // A system without unknowns has no stages to solve.
            if let Some(work) = &self.work
                && start.mu.dim() > 0
            {
                work.stage(i, stage);
            }
        }
        along[nodes.len() + 1].copy_from(end);
        see(Path::new(&self.tableau.rule, &along, h));
    }

    fn error(&self, state: &State<C::Group>, h: f64, cause: Cause) -> StepError {
        cause.at((self.steps, state.t, h))
    }

    /// Solves the stages of a step; the state stays as it is.
    fn solve(
        &mut self,
        system: &C,
        state: &State<C::Group>,
        h: f64,
    ) -> Result<StepReport, StepError> {
        let solved = self.try_to_solve(system, state, h);
        solved.map_err(|cause| self.error(state, h, cause))
    }

    fn try_to_solve(
        &mut self,
        system: &C,
        state: &State<C::Group>,
        h: f64,
    ) -> Result<StepReport, Cause> {
        check_step(system, (state.t, &state.g), h)?;
        let tableau = self.tableau;
        let degenerate = || system.without_inertia(state.t, &state.g);
        let work = match self.work.take() {
            Some(work) if work.fits(&state.g) => work,
            _ => match degenerate() {
                Some(coordinate) => return Err(Cause::Degenerate { coordinate }),
                None => {
                    let start = (state.t, &state.g);
                    let (work, means) = (self.make)(self.instructions, tableau, system, start);
                    self.means = means;
                    work
                }
            },
        };
        let work = self.work.insert(work);
        check_momentum(&state.mu, work.shape())?;
        let solved = work.solve((system, tableau), (state, h), self.limits);
        let means = self.means;
        let solved = solved.map(|report| StepReport { means, ..report });
        solved.map_err(|cause| match degenerate() {
            Some(coordinate) if cause == Cause::NotFinite => Cause::Degenerate { coordinate },
            _ => cause,
        })
    }

    /// The step of a system without unknowns: time goes on.
    fn pass(
        &mut self,
        system: &C,
        state: &mut State<C::Group>,
        h: f64,
    ) -> Result<StepReport, StepError> {
        let refused = |cause: Cause| cause.at((self.steps, state.t, h));
        check_step(system, (state.t, &state.g), h).map_err(refused)?;
        match system.is_defined(state.t + h, &state.g) {
            true => state.t += h,
            false => return Err(self.error(state, h, Cause::NotFinite)),
        }
        self.steps += 1;
        Ok(StepReport::default())
    }

    /// Takes the step that was solved.
    fn accept(&mut self, system: &C, state: &mut State<C::Group>, h: f64) -> Result<(), StepError> {
        let work = self.work.as_mut();
        let accepted = work.and_then(|work| work.accept(system, state, h));
        accepted.ok_or_else(|| self.error(state, h, Cause::NotFinite))?;
        self.steps += 1;
        Ok(())
    }
}
