//! The steps of a method, whatever scalar they are computed with and whatever chart they are in.

use core::marker::PhantomData;

use lie::lanes::{InstructionSet, Job, run};
use lie::{Batch, LieGroup, RealGroup, Retraction, VectorSpace};

use super::newton::SweepNewton;
use super::sweep::End;
use super::tableau::Tableau;
use super::work::{Limits, Method, Start, Work};
use crate::system::Dual;
use crate::{Cause, ContinuousSystem, Means, State, StepReport, System, TracedSystem, Variation};

/// The steps of a method, over a scalar that was chosen at run time.
pub(super) trait Stepper<C: ContinuousSystem>: Send + Sync {
    /// Whether the storage is for states of the shape of `state`.
    fn fits(&self, g: &C::Group) -> bool;

    /// A dual element of the storage's shape.
    fn shape(&self) -> &Dual<C>;

    /// Solves the stages of a step; the state stays as it is.
    fn solve(
        &mut self,
        method: Method<C>,
        start: Start<C>,
        limits: Limits,
    ) -> Result<StepReport, Cause>;

    /// The state after the step that was solved.
    fn ahead(&self, start: Start<C>) -> State<C::Group>;

    /// Configuration and momentum at stage `i` of the step that was solved.
    fn stage(&self, i: usize, out: &mut State<C::Group>);

    /// Carries variations over the step that was solved.
    fn carry(&mut self, method: Method<C>, start: Start<C>, variations: &mut [Variation<C::Group>]);

    /// Takes the step that was solved; `None` where a number is not finite, or where the system is not defined.
    fn accept(&mut self, system: &C, state: &mut State<C::Group>, h: f64) -> Option<()>;
}

/// The steps in the chart of `R`.
struct InChart<C: ContinuousSystem, S: Batch<Item = f64>, R> {
    work: Work<C, S>,
    retraction: PhantomData<fn() -> R>,
}

impl<C: ContinuousSystem, S: Batch<Item = f64>, R: Retraction> Stepper<C> for InChart<C, S, R> {
    fn fits(&self, g: &C::Group) -> bool {
        self.work.sweep.end.f.same_shape(g)
    }

    fn shape(&self) -> &Dual<C> {
        &self.work.sweep.end.mu
    }

    fn solve(
        &mut self,
        method: Method<C>,
        start: Start<C>,
        limits: Limits,
    ) -> Result<StepReport, Cause> {
        self.work.solve::<R>(method, start, limits)
    }

    fn ahead(&self, (state, h): Start<C>) -> State<C::Group> {
        let mut ahead = state.clone();
        let End { f, mu, .. } = &self.work.sweep.end;
        ahead.t += h;
        ahead.g = state.g.compose(f);
        ahead.mu.copy_from(mu);
        ahead
    }

    fn stage(&self, i: usize, out: &mut State<C::Group>) {
        self.work.sweep.read_stage(i, out);
    }

    fn carry(
        &mut self,
        (system, tableau): Method<C>,
        start: Start<C>,
        variations: &mut [Variation<C::Group>],
    ) {
        let Work {
            sweep, linearised, ..
        } = &mut self.work;
        let g = &start.0.g;
        let linearised = linearised.get_or_insert_with(|| SweepNewton::new(tableau, g));
        linearised.weigh(sweep.judge.weights());
        linearised.carry::<R, S>(system, start, sweep, variations);
    }

    fn accept(&mut self, system: &C, state: &mut State<C::Group>, h: f64) -> Option<()> {
        let Work {
            sweep,
            update,
            predictor,
            start,
            drift,
            ..
        } = &mut self.work;
        let End { f, impulse, mu, .. } = &sweep.end;
        let after = update.advance(system, state, h, (f, impulse, mu))?;
        state.mu.write(drift);
        for (drift, start) in drift.iter_mut().zip(start) {
            *drift = *start - *drift;
        }
        state.copy_from(after);
        predictor.record(h, sweep);
        Some(())
    }
}

/// The steps of a system's recording.
struct OnRecording<G: RealGroup> {
    recorded: TracedSystem<G>,
    steps: Box<dyn Stepper<TracedSystem<G>>>,
}

impl<C: ContinuousSystem> Stepper<C> for OnRecording<C::Group> {
    fn fits(&self, g: &C::Group) -> bool {
        self.steps.fits(g)
    }

    fn shape(&self) -> &Dual<C> {
        self.steps.shape()
    }

    fn solve(
        &mut self,
        (_, tableau): Method<C>,
        start: Start<C>,
        limits: Limits,
    ) -> Result<StepReport, Cause> {
        self.steps.solve((&self.recorded, tableau), start, limits)
    }

    fn ahead(&self, start: Start<C>) -> State<C::Group> {
        self.steps.ahead(start)
    }

    fn stage(&self, i: usize, out: &mut State<C::Group>) {
        self.steps.stage(i, out);
    }

    fn carry(
        &mut self,
        (_, tableau): Method<C>,
        start: Start<C>,
        variations: &mut [Variation<C::Group>],
    ) {
        let method = (&self.recorded, tableau);
        self.steps.carry(method, start, variations);
    }

    fn accept(&mut self, _: &C, state: &mut State<C::Group>, h: f64) -> Option<()> {
        self.steps.accept(&self.recorded, state, h)
    }
}

/// What [`stepper`] is in the chart of some retraction.
pub(super) type MakeStepper<C> =
    fn(InstructionSet, &Tableau, &C, Moment<C>) -> (Box<dyn Stepper<C>>, Means);

/// When and where.
type Moment<'a, C> = (f64, &'a <C as System>::Group);

/// The steps of a system from configurations of the shape of `g`, computed by these instructions; and how its rates come about.
pub(super) fn stepper<C: ContinuousSystem + 'static, R: Retraction>(
    instructions: InstructionSet,
    tableau: &Tableau,
    system: &C,
    (t, g): Moment<C>,
) -> (Box<dyn Stepper<C>>, Means) {
    let means = match C::IS_RECORDED {
        true => match system.recorded(t, g) {
            Ok(recording) => {
                let recorded = TracedSystem::from(recording);
                let steps = New::<TracedSystem<C::Group>, R>::at(tableau, g);
                let steps = run(instructions, steps);
                return (Box::new(OnRecording { recorded, steps }), Means::Recorded);
            }
            Err(means) => means,
        },
        false => system.means(t, g),
    };
    let new = New::<C, R>::at(tableau, g);
    // Dual numbers in lanes would cost more than they save.
    let in_lanes = !matches!(means, Means::DualNumbers { .. });
    let steps = match const { C::INLINE && !C::IS_RECORDED } {
        true if in_lanes => run(instructions, new),
        _ => new.run::<f64>(),
    };
    (steps, means)
}

struct New<'a, C: ContinuousSystem, R> {
    tableau: &'a Tableau,
    g: &'a C::Group,
    retraction: PhantomData<R>,
}

impl<'a, C: ContinuousSystem, R> New<'a, C, R> {
    fn at(tableau: &'a Tableau, g: &'a C::Group) -> Self {
        Self {
            tableau,
            g,
            retraction: PhantomData,
        }
    }
}

impl<C: ContinuousSystem + 'static, R: Retraction> Job for New<'_, C, R> {
    type Output = Box<dyn Stepper<C>>;

    fn run<S: Batch<Item = f64>>(self) -> Box<dyn Stepper<C>> {
        Box::new(InChart::<C, S, R> {
            work: Work::new(self.tableau, self.g),
            retraction: PhantomData,
        })
    }
}
