//! The storage of a method's steps, and the steps themselves, whatever scalar they are computed with.

use core::marker::PhantomData;

use lie::lanes::{InstructionSet, Job, run};
use lie::{Batch, LieGroup, Retraction, VectorSpace};

use super::newton::SweepNewton;
use super::predictor::Predictor;
use super::solve::{Failure, Limits, Method, Start};
use super::sweep::{End, Sweep};
use super::tableau::Tableau;
use super::update::Update;
use crate::sizes::{Kinds, Sizes};
use crate::{ContinuousSystem, State, StepReport, Variation};

type Dual<C> = <<C as ContinuousSystem>::Group as LieGroup>::Dual;

/// Storage of the steps; the stages are computed over `S`.
pub(super) struct Work<C: ContinuousSystem, S: Batch<Item = f64>> {
    pub(super) sweep: Sweep<C, S>,
    pub(super) predictor: Predictor<S>,
    pub(super) update: Update<C::Group>,
    /// $\pi_0$ of the stages, what their end asks it to be, and its difference from $\mu_k$ in the last step.
    pub(super) start: Vec<f64>,
    pub(super) wanted: Vec<f64>,
    pub(super) drift: Vec<f64>,
    /// Storage to compare the first two: their difference, and the largest numbers of each kind and block.
    pub(super) mismatch: [Vec<f64>; 3],
    pub(super) difference: <C::Group as LieGroup>::Dual,
    pub(super) sizes: Sizes,
    /// Storage for a configuration whose numbers are moved to measure noise.
    pub(super) moved: C::Group,
    /// Steps for which the noise is taken to be as it was measured.
    pub(super) noise_holds: u32,
    /// Made when first needed.
    pub(super) newton: Option<SweepNewton<C>>,
    linearised: Option<SweepNewton<C>>,
    /// Steps to solve by Newton's method before the plain iteration is tried again.
    pub(super) long_steps: u32,
}

impl<C: ContinuousSystem, S: Batch<Item = f64>> Work<C, S> {
    fn new(system: &C, tableau: &Tableau, g: &C::Group) -> Self {
        let (dim, kinds) = (g.zero_dual().dim(), Kinds::of(g).count);
        Self {
            sweep: Sweep::new(system, tableau, g),
            predictor: Predictor::new(tableau.nodes.len(), dim),
            update: Update::new(g),
            start: vec![0.0; dim],
            wanted: vec![0.0; dim],
            drift: vec![0.0; dim],
            mismatch: [dim, kinds, kinds].map(|n| vec![0.0; n]),
            difference: g.zero_dual(),
            sizes: Sizes::new(g, 0..0, None),
            moved: g.clone(),
            noise_holds: 0,
            newton: None,
            linearised: None,
            long_steps: 0,
        }
    }
}

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
    ) -> Result<StepReport, Failure>;

    /// The state after the step that was solved.
    fn ahead(&self, start: Start<C>) -> State<C::Group>;

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
    ) -> Result<StepReport, Failure> {
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
        let linearised = linearised.get_or_insert_with(|| SweepNewton::new(system, tableau, g));
        linearised.weigh(sweep.weights());
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
        let after = update.advance(state, h, (f, impulse, mu))?;
        if !system.is_defined(after.t, &after.g) {
            update.forget();
            return None;
        }
        state.mu.write(drift);
        for (drift, start) in drift.iter_mut().zip(start) {
            *drift = *start - *drift;
        }
        state.copy_from(after);
        predictor.record(h, sweep);
        Some(())
    }
}

/// Storage for the steps from states of the shape of `g`, computed by these instructions.
pub(super) fn stepper<C: ContinuousSystem + 'static, R: Retraction>(
    instructions: InstructionSet,
    system: &C,
    tableau: &Tableau,
    g: &C::Group,
) -> Box<dyn Stepper<C>> {
    let new = New {
        system,
        tableau,
        g,
        retraction: PhantomData::<R>,
    };
    match C::INLINE {
        true => run(instructions, new),
        false => new.run::<f64>(),
    }
}

struct New<'a, C: ContinuousSystem, R> {
    system: &'a C,
    tableau: &'a Tableau,
    g: &'a C::Group,
    retraction: PhantomData<R>,
}

impl<C: ContinuousSystem + 'static, R: Retraction> Job for New<'_, C, R> {
    type Output = Box<dyn Stepper<C>>;

    fn run<S: Batch<Item = f64>>(self) -> Box<dyn Stepper<C>> {
        Box::new(InChart::<C, S, R> {
            work: Work::new(self.system, self.tableau, self.g),
            retraction: PhantomData,
        })
    }
}
