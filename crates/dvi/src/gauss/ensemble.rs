//! Many trajectories of one system at once.

use std::thread;

use lie::lanes::InstructionSet;
use lie::{LieGroup, VectorSpace};

use super::abreast::{Abreast, abreast};
use super::solve::LONG_STEPS;
use super::solver::Solver;
use super::tableau::Tableau;
use super::work::Method;
use crate::step::{check_momentum, check_step};
use crate::{ContinuousSystem, State, StepError, StepReport};

/// How one trajectory of an ensemble got on: the report of its last step, or the step that it could not take.
type Outcome = Result<StepReport, StepError>;

/// Many trajectories of one system by [`Gauss`](crate::Gauss), side by side in SIMD [lanes](lie::lanes::PerLane).
///
/// [`Gauss`](crate::Gauss) takes a stage in each lane. Where so few stages leave half of the lanes idle, this takes a trajectory in each; else it steps one
/// trajectory after the other, which is then faster.
/// Each trajectory is solved as if it were alone, to rounding, and keeps what its own steps have left. What the plain iteration does not solve is solved as
/// [`Gauss`](crate::Gauss) does. A system without lanes is stepped so throughout.
///
/// Which trajectories are side by side follows from their order alone. So the result is the same bit by bit whatever the number of
/// [threads](Self::with_threads).
///
/// ```
/// use dvi::{Context, Ensemble, Lagrangian, System};
/// use lie::{Rn, Scalar, Tangent};
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
/// let start = |i: u32| Spring.state(0.0, Rn([f64::from(i)]), &Tangent([0.0]));
/// let mut states = (0..100).map(start).collect::<Result<Vec<_>, _>>()?;
/// let mut ensemble = Ensemble::new::<4>(Spring.hamiltonian());
/// let outcomes = ensemble.advance(&mut states, 0.5, 10);
/// assert!(outcomes.iter().all(Result::is_ok));
/// assert!((states[3].g.0[0] - 3.0 * 5.0_f64.cos()).abs() < 1e-7);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct Ensemble<C: ContinuousSystem> {
    system: C,
    settings: Settings,
    threads: usize,
    /// How many trajectories they are for.
    trajectories: usize,
    rows: Vec<Row<C>>,
}

impl<C: ContinuousSystem + Sync + 'static> Ensemble<C> {
    /// Steps of `S` stages of a system, in the Cayley map's chart; for a Lagrangian, `Ensemble::new::<4>(top.hamiltonian())`.
    ///
    /// Less than one stage, or more than eight, do not compile.
    pub fn new<const S: usize>(system: C) -> Self {
        const { assert!(S >= 1 && S <= 8, "Gauss has from 1 to 8 stages") };
        Self::of(system, S)
    }

    /// The same of so many stages, known at run time; none of less than one or more than eight.
    pub fn with_stages(system: C, stages: usize) -> Option<Self> {
        (1..=8).contains(&stages).then(|| Self::of(system, stages))
    }

    fn of(system: C, stages: usize) -> Self {
        Self {
            system,
            settings: Settings {
                stages,
                tolerance: 0.0,
                instructions: None,
            },
            threads: 1,
            trajectories: 0,
            rows: Vec::new(),
        }
    }

    /// As [`Gauss::with_tolerance`](crate::Gauss::with_tolerance).
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.settings.tolerance = tolerance;
        self.reset();
        self
    }

    /// As [`Gauss::with_instructions`](crate::Gauss::with_instructions).
    pub fn with_instructions(mut self, instructions: InstructionSet) -> Self {
        self.settings.instructions = Some(instructions);
        self.reset();
        self
    }

    /// The same on so many threads, at least one; it begins with one.
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.threads = threads.max(1);
        self
    }

    /// The system.
    pub fn system(&self) -> &C {
        &self.system
    }

    /// Forgets everything that earlier steps have left.
    pub fn reset(&mut self) {
        (self.trajectories, self.rows) = (0, Vec::new());
    }

    /// Advances each state by `steps` steps of `h` seconds; for each, in their order, the report of its last step.
    ///
    /// Call after call it is to be given the same trajectories, or be [reset](Self::reset). It does not need to be where their number changes.
    ///
    /// # Errors
    /// In the place of a trajectory the [`StepError`] that ended it: its state is as before that step, and the others go on.
    pub fn advance(
        &mut self,
        states: &mut [State<C::Group>],
        h: f64,
        steps: usize,
    ) -> Vec<Outcome> {
        let mut outcomes = vec![Ok(StepReport::default()); states.len()];
        if self.trajectories != states.len() {
            self.reset();
        }
        if states.is_empty() {
            return outcomes;
        }
        let (width, settings) = (self.prepare(states), self.settings);
        let method = (&self.system, Tableau::gauss(settings.stages));
        let of = (method, settings, h, steps);
        let share = self.rows.len().div_ceil(self.threads);
        let run = |rows: &mut [Row<C>], states: &mut [State<C::Group>], out: &mut [Outcome]| {
            let states = states.chunks_mut(width).zip(out.chunks_mut(width));
            for (row, (states, outcomes)) in rows.iter_mut().zip(states) {
                row.advance(of, states, outcomes);
            }
        };
        if share == self.rows.len() {
            run(&mut self.rows, states, &mut outcomes);
            return outcomes;
        }
        let states = states.chunks_mut(share * width);
        let outs = outcomes.chunks_mut(share * width);
        thread::scope(|scope| {
            for ((rows, states), out) in self.rows.chunks_mut(share).zip(states).zip(outs) {
                scope.spawn(move || run(rows, states, out));
            }
        });
        outcomes
    }

    /// Makes the rows, where there are none; how many trajectories each takes.
    fn prepare(&mut self, states: &[State<C::Group>]) -> usize {
        let count = states.len();
        if self.rows.is_empty() {
            self.trajectories = count;
            let system = &self.system;
            // A start without sense is no pattern for the others.
            let sound = |state: &&State<C::Group>| {
                is_sound(system, state) && system.without_inertia(state.t, &state.g).is_none()
            };
            let first = states.iter().find(sound);
            let instructions = self.settings.instructions_for(count);
            let method = (system, Tableau::gauss(self.settings.stages));
            let row = || Row::new(first.and_then(|first| abreast(instructions, method, first)));
            let lead = row();
            let others = count.div_ceil(lead.members.len()) - 1;
            self.rows.push(lead);
            self.rows.extend((0..others).map(|_| row()));
        }
        self.rows[0].members.len()
    }
}

/// How the steps are solved.
#[derive(Clone, Copy)]
struct Settings {
    stages: usize,
    tolerance: f64,
    /// Unless the widest are taken.
    instructions: Option<InstructionSet>,
}

impl Settings {
    fn instructions_for(&self, trajectories: usize) -> InstructionSet {
        let widest = || InstructionSet::widest(trajectories);
        self.instructions.unwrap_or_else(widest)
    }

    fn solver<C: ContinuousSystem + 'static>(&self) -> Solver<C> {
        let mut solver = Solver::new(self.stages);
        solver.limits.tolerance = self.tolerance;
        if let Some(instructions) = self.instructions {
            solver.set_instructions(instructions);
        }
        solver
    }
}

/// By what is stepped, and how far: the method, the step in seconds and the number of steps.
type Advance<'a, C> = (Method<'a, C>, Settings, f64, usize);

/// Trajectories that are stepped side by side.
struct Row<C: ContinuousSystem> {
    lanes: Option<Box<dyn Abreast<C>>>,
    members: Vec<Member<C>>,
    reports: Vec<Option<StepReport>>,
}

impl<C: ContinuousSystem + 'static> Row<C> {
    fn new(lanes: Option<Box<dyn Abreast<C>>>) -> Self {
        let width = lanes.as_ref().map_or(1, |lanes| lanes.lanes());
        Self {
            lanes,
            members: (0..width).map(|_| Member::new()).collect(),
            reports: Vec::with_capacity(width),
        }
    }

    fn advance(
        &mut self,
        (method, settings, h, steps): Advance<C>,
        states: &mut [State<C::Group>],
        outcomes: &mut [Outcome],
    ) {
        for (member, state) in self.members.iter_mut().zip(&*states) {
            let fits = self.lanes.as_ref().is_some_and(|lanes| lanes.fits(state));
            member.fits = fits && h != 0.0 && h.is_finite() && is_sound(method.0, state);
        }
        for _ in 0..steps {
            self.step_in_lanes((method, settings, h), states, outcomes);
            for (i, state) in states.iter_mut().enumerate() {
                if outcomes[i].is_err() {
                    continue;
                }
                let member = &mut self.members[i];
                outcomes[i] = match self.reports[i] {
                    Some(report) => Ok(report),
                    None => {
                        // A lane guesses by its last steps, and those of one that comes back were taken elsewhere.
                        if let (1, Some(lanes)) = (member.alone, &mut self.lanes) {
                            lanes.forget();
                        }
                        member.step_alone((method, settings, h), state)
                    }
                };
                member.steps += u64::from(outcomes[i].is_ok());
            }
        }
    }

    /// Steps those that can be side by side, and leaves a report of each that was solved.
    fn step_in_lanes(
        &mut self,
        (method, settings, h): (Method<C>, Settings, f64),
        states: &mut [State<C::Group>],
        outcomes: &[Outcome],
    ) {
        let Self {
            lanes,
            members,
            reports,
        } = self;
        reports.clear();
        let each = members.iter().zip(outcomes);
        let joins = each.map(|(member, outcome)| outcome.is_ok() && member.joins());
        reports.extend(joins.map(|joins| joins.then(StepReport::default)));
        let any = reports.iter().any(Option::is_some);
        let Some(lanes) = lanes.as_mut().filter(|_| any) else {
            return;
        };
        lanes.step(method, states, (h, settings.tolerance), reports);
        for ((member, outcome), report) in members.iter_mut().zip(outcomes).zip(&*reports) {
            if outcome.is_ok() && member.joins() && report.is_none() {
                member.alone = LONG_STEPS;
            }
        }
    }
}

/// One trajectory.
struct Member<C: ContinuousSystem> {
    /// Made when it is first alone.
    solver: Option<Solver<C>>,
    /// Whether its state is one that can be stepped beside the others'.
    fits: bool,
    /// Steps that it still takes by itself.
    alone: u32,
    steps: u64,
}

impl<C: ContinuousSystem + 'static> Member<C> {
    fn new() -> Self {
        Self {
            solver: None,
            fits: false,
            alone: 0,
            steps: 0,
        }
    }

    /// Whether it is stepped beside the others.
    fn joins(&self) -> bool {
        self.fits && self.alone == 0
    }

    fn step_alone(
        &mut self,
        ((system, _), settings, h): (Method<C>, Settings, f64),
        state: &mut State<C::Group>,
    ) -> Outcome {
        self.alone = self.alone.saturating_sub(1);
        let solver = self.solver.get_or_insert_with(|| settings.solver());
        solver.steps = self.steps;
        solver.step(system, state, h)
    }
}

/// Whether steps from a state make sense.
fn is_sound<C: ContinuousSystem>(system: &C, state: &State<C::Group>) -> bool {
    let shape = state.g.zero_dual();
    shape.dim() > 0
        && check_step(system, (state.t, &state.g), 1.0).is_ok()
        && check_momentum(&state.mu, &shape).is_ok()
}
