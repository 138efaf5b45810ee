//! Steps of several trajectories side by side, one in each lane.

use lie::lanes::{InstructionSet, PerLane, PerLaneJob, run_per_lane};
use lie::{Cayley, DualOver, LieGroup, Over, RealGroup, VectorSpace};

use super::change::{Change, Judge};
use super::predictor::Predictor;
use super::progress::{AtEnd, Progress, looks_at_end};
use super::solve::MAX_SWEEPS;
use super::sweep::{End, Side, Sweep};
use super::update::Update;
use super::work::Method;
use crate::numerics::elements;
use crate::numerics::numbers::larger;
use crate::numerics::sizes::relative_beside;
use crate::{ContinuousSystem, Means, State, StepReport, TracedSystem};

/// Stages in lanes of their own leave all but one in so many idle where trajectories in lanes are faster: each row waits for its slowest.
const LEFT_IDLE: usize = 2;

/// The steps of as many trajectories as there are lanes, by sweeps alone.
pub(super) trait Abreast<C: ContinuousSystem>: Send {
    fn lanes(&self) -> usize;

    /// Whether the storage is for states of the shape of `state`.
    fn fits(&self, state: &State<C::Group>) -> bool;

    /// Steps the states that have a report. Those that the sweeps do not solve stay as they are, and have none after.
    fn step(
        &mut self,
        method: Method<C>,
        states: &mut [State<C::Group>],
        step: (f64, f64),
        reports: &mut [Option<StepReport>],
    );

    /// Forgets what the steps before have left for the next one's guess.
    fn forget(&mut self);
}

/// One of the trajectories.
struct Lane<G: RealGroup> {
    update: Update<G>,
    judge: Judge,
    progress: Progress,
    report: StepReport,
    is_solved: bool,
    /// The end of the step that was solved.
    f: G,
    impulse: G::Dual,
    mu: G::Dual,
}

impl<G: RealGroup> Lane<G> {
    fn new(g: &G, judge: Judge) -> Self {
        Self {
            update: Update::new(g),
            judge,
            progress: Progress::default(),
            report: StepReport::default(),
            is_solved: false,
            f: g.clone(),
            impulse: g.zero_dual(),
            mu: g.zero_dual(),
        }
    }

    /// Takes in what the last sweep has changed in lane `i`, which is this one.
    fn push<S: PerLane>(&mut self, i: usize, change: &Change<S>, h: f64) -> f64 {
        self.judge.look(change, |x| x.lanes()[i]);
        let change = self.judge.change(h) + change.poison.lanes()[i];
        self.progress.push(change);
        self.report.iterations += 1;
        self.report.residual = change;
        change
    }

    fn begin(&mut self) {
        self.judge.forget_rounding();
        self.progress = Progress::default();
        // The guess is evaluated too.
        self.report.iterations = 1;
        self.is_solved = false;
    }
}

struct InLanes<C: ContinuousSystem, S: PerLane> {
    sweep: Sweep<C, S>,
    predictor: Predictor<S>,
    lanes: Vec<Lane<C::Group>>,
    t: S,
    g: Over<C::Group, S>,
    mu: DualOver<C::Group, S>,
    /// $\pi_0$ of the stages, what their end asks it to be, and its difference from $\mu_k$ in the last step.
    start: Vec<S>,
    wanted: Vec<S>,
    drift: Vec<S>,
    /// Of each kind: how far the first two are apart, and how large the momentum is.
    mismatch: Vec<[S; 2]>,
    /// The numbers of the configurations, one after the other, and storage to write them.
    numbers: Vec<f64>,
    scratch: C::Group,
}

impl<C: ContinuousSystem, S: PerLane> InLanes<C, S> {
    fn new((system, tableau): Method<C>, first: &State<C::Group>) -> Self {
        let (g, dim) = (&first.g, first.mu.dim());
        let mut alone = Sweep::<C, f64>::new(tableau, g);
        alone.set_parameters(system.parameters());
        alone.start_at(g);
        alone.weigh(system, (first.t, &first.mu));
        let lifted = C::Group::convert::<f64, S>(g, S::from_f64);
        let mut sweep = Sweep::new(tableau, &lifted);
        let parameters = system.parameters().iter().map(|p| S::from_f64(*p));
        sweep.set_parameters(&parameters.collect::<Vec<_>>());
        let lane = |_| Lane::new(g, alone.judge.clone());
        Self {
            predictor: Predictor::new(tableau.nodes.len(), dim),
            lanes: (0..S::LANES).map(lane).collect(),
            t: S::zero(),
            mu: lifted.zero_dual(),
            g: lifted,
            start: vec![S::zero(); dim],
            wanted: vec![S::zero(); dim],
            drift: vec![S::zero(); dim],
            mismatch: vec![[S::zero(); 2]; sweep.kinds.count],
            numbers: vec![0.0; S::LANES * elements::count(g)],
            scratch: g.clone(),
            sweep,
        }
    }

    /// Takes the states into the lanes; the first one into those that are left over.
    fn enter(&mut self, states: &[State<C::Group>]) {
        let of = |lane: usize| &states[if lane < states.len() { lane } else { 0 }];
        let count = self.numbers.len() / S::LANES;
        for (lane, numbers) in self.numbers.chunks_exact_mut(count).enumerate() {
            elements::write::<C::Group, f64>(&of(lane).g, &mut self.scratch, numbers);
        }
        self.t = S::from_lanes(|lane| of(lane).t);
        let numbers = |k: usize| S::from_lanes(|lane| self.numbers[lane * count + k]);
        elements::read::<C::Group, S>(&states[0].g, numbers, &mut self.g);
        for d in 0..self.mu.dim() {
            self.mu.set(d, S::from_lanes(|lane| of(lane).mu.get(d)));
        }
    }

    fn guess(&mut self, (system, tableau): Method<C>, h: f64) {
        self.sweep.start_at(&self.g);
        let start = (self.t, &self.mu, h);
        self.predictor
            .guess::<C, Cayley>((system, tableau), start, &mut self.sweep);
        let time = (self.t, S::from_f64(h));
        self.sweep.evaluate::<Cayley>(system, time);
        self.sweep.round(Side::Start);
        self.mu.write(&mut self.start);
        for (start, drift) in self.start.iter_mut().zip(&self.drift) {
            *start += *drift;
        }
    }

    /// Sweeps until each of the `asked` lanes is solved or given up.
    fn iterate(&mut self, system: &C, (h, tolerance): (f64, f64), asked: &[Option<StepReport>]) {
        let mut going: Vec<usize> = (0..asked.len()).filter(|i| asked[*i].is_some()).collect();
        let time = (self.t, S::from_f64(h));
        for iterations in 2..=MAX_SWEEPS {
            self.sweep
                .run_from_start::<Cayley>(system, time, &self.start);
            let (mut change, mut settled) = (0.0, false);
            for i in &going {
                let lane = &mut self.lanes[*i];
                change = larger(change, lane.push(*i, &self.sweep.change, h));
                settled |= lane.progress.is_settled(tolerance);
            }
            if iterations == 2 {
                self.predictor.judge(change);
            }
            let looks = settled || looks_at_end(iterations);
            if looks {
                self.look_at_end(h);
                going.retain(|i| !self.is_at_end(*i, tolerance));
            }
            going.retain(|i| {
                let progress = &mut self.lanes[*i].progress;
                !(progress.stands_still() || progress.diverges())
            });
            if going.is_empty() {
                if !looks {
                    self.look_at_end(h);
                }
                break;
            }
        }
    }

    /// The step's end and the $\pi_0$ that it asks for, and how far that is from what the stages started from.
    fn look_at_end(&mut self, h: f64) {
        let Self { sweep, wanted, .. } = self;
        sweep.end_to_start::<Cayley>(S::from_f64(h), &self.mu, wanted);
        let (kinds, momentum) = (&sweep.kinds, &sweep.end.momentum);
        S::run(
            #[inline(always)]
            || {
                self.mismatch.fill([S::zero(); 2]);
                for (run, kind) in &kinds.runs {
                    let [mut part, mut whole] = self.mismatch[*kind];
                    for d in run.clone() {
                        part = part.max((self.start[d] - wanted[d]).abs());
                        whole = whole.max(momentum.get(d).abs()).max(self.mu.get(d).abs());
                    }
                    self.mismatch[*kind] = [part, whole];
                }
            },
        );
    }

    /// Whether a lane is solved; else its stages start from what the end asks for, where that is known better than it changes.
    fn is_at_end(&mut self, i: usize, tolerance: f64) -> bool {
        let lane = &mut self.lanes[i];
        let kinds = self.mismatch.iter().enumerate();
        let mismatch = kinds.fold(0.0, |found, (kind, [part, whole])| {
            let least = lane.judge.least_momentum(kind);
            let rounding = lane.judge.rounding_of_momentum(kind);
            let [part, whole] = [part, whole].map(|x| x.lanes()[i]);
            larger(found, relative_beside(part, larger(whole, least), rounding))
        });
        lane.report.residual = larger(lane.report.residual, mismatch);
        let settled = lane.progress.is_settled(tolerance);
        match lane.progress.at_end((settled, mismatch), tolerance) {
            AtEnd::Solved => lane.is_solved = true,
            AtEnd::Corrects => {
                for (start, wanted) in self.start.iter_mut().zip(&self.wanted) {
                    start.lanes_mut()[i] = wanted.lanes()[i];
                }
            }
            AtEnd::Waits => {}
        }
        lane.is_solved
    }

    /// Takes the step of a lane; `None` where it cannot be taken.
    fn accept(
        &mut self,
        i: usize,
        system: &C,
        state: &mut State<C::Group>,
        h: f64,
    ) -> Option<StepReport> {
        let lane = &mut self.lanes[i];
        let End { f, impulse, mu, .. } = &self.sweep.end;
        C::Group::convert_into::<S, f64>(f, |x| x.lanes()[i], &mut lane.f);
        for d in 0..lane.mu.dim() {
            lane.mu.set(d, mu.get(d).lanes()[i]);
            lane.impulse.set(d, impulse.get(d).lanes()[i]);
        }
        let end = (&lane.f, &lane.impulse, &lane.mu);
        state.copy_from(lane.update.advance(system, state, h, end)?);
        Some(lane.report)
    }
}

impl<C: ContinuousSystem, S: PerLane> Abreast<C> for InLanes<C, S> {
    fn lanes(&self) -> usize {
        S::LANES
    }

    fn fits(&self, state: &State<C::Group>) -> bool {
        self.scratch.same_shape(&state.g) && self.lanes[0].mu.same_shape(&state.mu)
    }

    fn step(
        &mut self,
        method: Method<C>,
        states: &mut [State<C::Group>],
        (h, tolerance): (f64, f64),
        reports: &mut [Option<StepReport>],
    ) {
        self.enter(states);
        self.lanes.iter_mut().for_each(Lane::begin);
        self.guess(method, h);
        self.iterate(method.0, (h, tolerance), reports);
        let stages = method.1.nodes.len() as u32;
        for (i, (state, report)) in states.iter_mut().zip(reports).enumerate() {
            if report.take().is_some() && self.lanes[i].is_solved {
                let accepted = self.accept(i, method.0, state, h);
                *report = accepted.map(|found| StepReport {
                    evaluations: stages * found.iterations,
                    ..found
                });
            }
        }
        for (d, (drift, start)) in self.drift.iter_mut().zip(&self.start).enumerate() {
            *drift = *start - self.mu.get(d);
        }
        self.predictor.record(h, &self.sweep);
    }

    fn forget(&mut self) {
        self.predictor.forget();
        self.drift.fill(S::zero());
    }
}

/// The steps of a system's recording.
struct OnRecording<G: RealGroup> {
    recorded: TracedSystem<G>,
    lanes: Box<dyn Abreast<TracedSystem<G>>>,
}

impl<C: ContinuousSystem> Abreast<C> for OnRecording<C::Group> {
    fn lanes(&self) -> usize {
        self.lanes.lanes()
    }

    fn fits(&self, state: &State<C::Group>) -> bool {
        self.lanes.fits(state)
    }

    fn step(
        &mut self,
        (_, tableau): Method<C>,
        states: &mut [State<C::Group>],
        step: (f64, f64),
        reports: &mut [Option<StepReport>],
    ) {
        let method = (&self.recorded, tableau);
        self.lanes.step(method, states, step, reports);
        for report in reports.iter_mut().flatten() {
            report.means = Means::Recorded;
        }
    }

    fn forget(&mut self) {
        self.lanes.forget();
    }
}

/// The steps of trajectories that begin as the first one, by these instructions; none where stages in lanes are faster, or nothing runs in lanes.
pub(super) fn abreast<C: ContinuousSystem + 'static>(
    instructions: InstructionSet,
    (system, tableau): Method<C>,
    first: &State<C::Group>,
) -> Option<Box<dyn Abreast<C>>> {
    let lanes = run_per_lane(instructions, CountLanes);
    if lanes < LEFT_IDLE * tableau.nodes.len() {
        return None;
    }
    if C::IS_RECORDED {
        let recorded = TracedSystem::from(system.recorded(first.t, &first.g).ok()?);
        let method = (&recorded, tableau);
        let new = New { method, first };
        let lanes = run_per_lane(instructions, new);
        return Some(Box::new(OnRecording { recorded, lanes }));
    }
    let by_duals = matches!(system.means(first.t, &first.g), Means::DualNumbers { .. });
    match const { C::INLINE && !C::IS_RECORDED } {
        true if !by_duals => {
            let method = (system, tableau);
            let new = New { method, first };
            Some(run_per_lane(instructions, new))
        }
        _ => None,
    }
}

struct CountLanes;

impl PerLaneJob for CountLanes {
    type Output = usize;

    fn run<S: PerLane>(self) -> usize {
        S::LANES
    }
}

struct New<'a, C: ContinuousSystem> {
    method: Method<'a, C>,
    first: &'a State<C::Group>,
}

impl<C: ContinuousSystem + 'static> PerLaneJob for New<'_, C> {
    type Output = Box<dyn Abreast<C>>;

    fn run<S: PerLane>(self) -> Box<dyn Abreast<C>> {
        Box::new(InLanes::<C, S>::new(self.method, self.first))
    }
}
