//! One sweep over the stages of a step: where they are, what the system says there, what that adds up to.

use lie::{
    AlgebraOver, Batch, DualOver, LieGroup, Over, RealGroup, Retraction, Scalar, VectorSpace,
};
use num_traits::{One, Zero};

use super::change::{Change, Judge};
use super::stages::{Coefficients, Stages};
use super::tableau::Tableau;
use crate::numerics::duals::lift;
use crate::numerics::sizes::{Kinds, Shaker, Weights};
use crate::{Context, ContinuousSystem, State};

/// Sweeps that bring guessed velocities to the chart: each leaves about a hundredth of the error.
const CHART_SWEEPS: usize = 3;

/// As many stages as `S` has items: what their last evaluation leaves.
struct Block<G: RealGroup, S: Scalar> {
    /// $f_i = \tau(c_i)$.
    f: Over<G, S>,
    /// $\mu_i = (\mathrm d\tau_{c_i}^{-1})^\ast \pi_i$.
    mu: DualOver<G, S>,
    /// The velocity $\xi_i$.
    xi: AlgebraOver<G, S>,
    /// The force $\tau_i$.
    tau: DualOver<G, S>,
}

impl<G: RealGroup, S: Scalar> Block<G, S> {
    fn new(g: &Over<G, S>) -> Self {
        Self {
            f: g.clone(),
            mu: g.zero_dual(),
            xi: g.zero_algebra(),
            tau: g.zero_dual(),
        }
    }
}

/// What the evaluation of a block writes down on its way; one for all, so that it stays in the cache.
struct Scratch<G: RealGroup, S: Scalar> {
    /// $c_i$ with $g_i = g_k \tau(c_i)$.
    c: AlgebraOver<G, S>,
    /// $\pi_i$, the momentum conjugate to $c_i$.
    pi: DualOver<G, S>,
    /// $g_i = g_k f_i$.
    g: Over<G, S>,
    /// $\dot c_i = \mathrm d\tau_{c_i}^{-1} \xi_i$.
    c_dot: AlgebraOver<G, S>,
    /// $\dot\pi_i = (\mathrm d\tau_{c_i})^\ast \tau_i - \partial_c \langle \pi_i, \mathrm d\tau_c^{-1} \xi_i \rangle$.
    pi_dot: DualOver<G, S>,
    /// $\mathrm{Ad}^\ast_{f_i^{-1}} \tau_i$: the force in the frame of the step's start.
    force: DualOver<G, S>,
}

impl<G: RealGroup, S: Scalar> Scratch<G, S> {
    fn new(g: &Over<G, S>) -> Self {
        Self {
            c: g.zero_algebra(),
            pi: g.zero_dual(),
            g: g.clone(),
            c_dot: g.zero_algebra(),
            pi_dot: g.zero_dual(),
            force: g.zero_dual(),
        }
    }

    /// The force of a block in the frame of the step's start, into `out` too.
    #[inline(always)]
    fn transport_force(&mut self, block: &Block<G, S>, out: &mut [S]) {
        block.f.inverse_coadjoint_into(&block.tau, &mut self.force);
        self.force.write(out);
    }
}

/// The end of a step, of which there is one.
pub(super) struct End<G: RealGroup, S: Scalar> {
    /// $c_1 = h \sum_j b_j \dot c_j$, the displacement of the whole step in the chart.
    c: AlgebraOver<G, S>,
    /// $f_k = \tau(c_1)$.
    pub(super) f: Over<G, S>,
    /// $P - \mu_k = h \sum_i b_i \mathrm{Ad}^\ast_{f_i^{-1}} \tau_i$: the impulse of the step, in the frame of its start.
    pub(super) impulse: DualOver<G, S>,
    /// $P$.
    pub(super) momentum: DualOver<G, S>,
    /// $\mu_{k+1} = \mathrm{Ad}^\ast_{f_k} P$.
    pub(super) mu: DualOver<G, S>,
    /// $\pi_1 = (\mathrm d\tau_{c_1})^\ast \mu_{k+1}$.
    pi: DualOver<G, S>,
}

impl<G: RealGroup, S: Scalar> End<G, S> {
    fn new(g: &Over<G, S>) -> Self {
        Self {
            c: g.zero_algebra(),
            f: g.clone(),
            impulse: g.zero_dual(),
            momentum: g.zero_dual(),
            mu: g.zero_dual(),
            pi: g.zero_dual(),
        }
    }
}

/// Where the momenta of the stages are summed from.
#[derive(Clone, Copy)]
pub(super) enum Side {
    Start,
    End,
}

/// The stages of a step and its end.
///
/// The stages of a block do not need one another: they are evaluated side by side, as many as `S` has items.
pub(super) struct Sweep<C: ContinuousSystem, S: Batch> {
    stages: usize,
    coefficients: Coefficients<S>,
    c: Stages<S>,
    pi: Stages<S>,
    pub(super) xi: Stages<S>,
    pub(super) tau: Stages<S>,
    pub(super) c_dot: Stages<S>,
    pub(super) pi_dot: Stages<S>,
    force: Stages<S>,
    /// What the coefficients' rounding leaves out of $\sum_j a_{ij} \dot c_j$ and of the sum of momenta.
    low_c: Stages<S>,
    low_pi: Stages<S>,
    /// The momentum that the stages' are summed from.
    given: Vec<S::Item>,
    nothing: Vec<S::Item>,
    pub(super) end: End<C::Group, S::Item>,
    /// A change of the force, at every stage; only for variations.
    pub(super) extra_force: Option<DualOver<C::Group, S>>,
    blocks: Vec<Block<C::Group, S>>,
    scratch: Scratch<C::Group, S>,
    /// $g_k$.
    g: Over<C::Group, S>,
    parameters: Vec<S>,
    workspace: C::Workspace<S>,
    pub(super) kinds: Kinds,
    pub(super) change: Change<S>,
    pub(super) judge: Judge,
    /// How often numbers were moved to measure noise.
    shakes: u32,
    /// New rates of a block.
    rates: Vec<S>,
}

impl<C: ContinuousSystem, S: Batch> Sweep<C, S> {
    pub(super) fn new(tableau: &Tableau, g: &Over<C::Group, S::Item>) -> Self {
        let (stages, dim) = (tableau.nodes.len(), g.zero_dual().dim());
        let zero = Stages::new(stages, dim);
        let lifted = C::Group::convert::<S::Item, S>(g, S::splat);
        let kinds = Kinds::of(g);
        Self {
            stages,
            coefficients: Coefficients::new(tableau),
            c: zero.clone(),
            pi: zero.clone(),
            xi: zero.clone(),
            tau: zero.clone(),
            c_dot: zero.clone(),
            pi_dot: zero.clone(),
            force: zero.clone(),
            low_c: zero.clone(),
            low_pi: zero.clone(),
            given: vec![S::Item::zero(); dim],
            nothing: vec![S::Item::zero(); dim],
            end: End::new(g),
            extra_force: None,
            blocks: (0..zero.blocks()).map(|_| Block::new(&lifted)).collect(),
            scratch: Scratch::new(&lifted),
            parameters: Vec::new(),
            workspace: Default::default(),
            g: lifted,
            change: Change::new(kinds.count),
            judge: Judge::new(kinds.count),
            shakes: 0,
            kinds,
            rates: vec![S::zero(); dim],
        }
    }

    pub(super) fn dim(&self) -> usize {
        self.end.pi.dim()
    }

    /// Sets the system's parameters.
    pub(super) fn set_parameters(&mut self, parameters: &[S::Item]) {
        lift(parameters, S::splat, &mut self.parameters);
    }

    /// Sets the configuration that the step starts from.
    pub(super) fn start_at(&mut self, g: &Over<C::Group, S::Item>) {
        C::Group::convert_into::<S::Item, S>(g, S::splat, &mut self.g);
    }

    /// Finds what the coefficients' rounding leaves out, from rates that are nearly right, for momenta summed from the start or from
    /// the end of the step.
    pub(super) fn round(&mut self, from: Side) {
        let Coefficients {
            forward, backward, ..
        } = &self.coefficients;
        let momenta = match from {
            Side::Start => forward,
            Side::End => backward,
        };
        S::run(
            #[inline(always)]
            || {
                self.low_c.set_zero();
                forward.low.add(&mut self.low_c, &self.c_dot);
                self.low_pi.set_zero();
                momenta.low.add(&mut self.low_pi, &self.pi_dot);
            },
        );
    }

    /// A sweep from a given $\pi_0$: the stages' places $c_i = h \sum_j a_{ij} \dot c_j$ and $\pi_i = \pi_0 + h \sum_j a_{ij} \dot\pi_j$,
    /// and the rates there, block by block: each block knows the new rates of those before it.
    pub(super) fn run_from_start<R: Retraction>(
        &mut self,
        system: &C,
        (t, h): (S::Item, S::Item),
        start: &[S::Item],
    ) {
        S::run(
            #[inline(always)]
            || {
                self.change.clear();
                for k in 0..self.c.blocks() {
                    self.place_coordinates(h, k);
                    let forward = &self.coefficients.forward.high;
                    let (pi, low) = (&mut self.pi, &self.low_pi);
                    forward.combine(k, pi, (h, low), &self.pi_dot, start);
                    self.evaluate_block::<R>(system, (t, h), k);
                }
            },
        );
    }

    /// $P$, the step's end, and the $\pi_0$ that it asks for, $\pi_1 - h \sum_j b_j \dot\pi_j$, into `start`.
    pub(super) fn end_to_start<R: Retraction>(
        &mut self,
        h: S::Item,
        mu: &DualOver<C::Group, S::Item>,
        start: &mut [S::Item],
    ) {
        S::run(
            #[inline(always)]
            || {
                self.find_momentum(h, mu);
                self.find_end::<R>(h);
                self.end.pi.write(start);
                let weights = &self.coefficients.weights;
                weights.combine((&mut self.given, &mut self.rates), h, &self.pi_dot);
                for (start, sum) in start.iter_mut().zip(&self.given) {
                    *start -= *sum;
                }
            },
        );
    }

    /// A sweep from the step's end, which follows from the rates and from $P$:
    /// $c_i = h \sum_j a_{ij} \dot c_j$ and $\pi_i = \pi_1 - h \sum_j (b_j - a_{ij}) \dot\pi_j$; all places before all rates.
    pub(super) fn run_from_end<R: Retraction>(&mut self, system: &C, (t, h): (S::Item, S::Item)) {
        self.end::<R>(h);
        self.end.pi.write(&mut self.given);
        S::run(
            #[inline(always)]
            || {
                for k in 0..self.c.blocks() {
                    self.place_coordinates(h, k);
                    let backward = &self.coefficients.backward.high;
                    let (pi, low) = (&mut self.pi, &self.low_pi);
                    backward.combine(k, pi, (-h, low), &self.pi_dot, &self.given);
                }
            },
        );
        self.evaluate::<R>(system, (t, h));
    }

    /// $c_i = h \sum_j a_{ij} \dot c_j$.
    #[inline(always)]
    fn place_coordinates(&mut self, h: S::Item, k: usize) {
        let forward = &self.coefficients.forward.high;
        let (c, low) = (&mut self.c, &self.low_c);
        forward.combine(k, c, (h, low), &self.c_dot, &self.nothing);
    }

    /// The step's end from the rates and from $P$.
    pub(super) fn end<R: Retraction>(&mut self, h: S::Item) {
        S::run(
            #[inline(always)]
            || self.find_end::<R>(h),
        );
    }

    #[inline(always)]
    fn find_end<R: Retraction>(&mut self, h: S::Item) {
        let (weights, end) = (&self.coefficients.weights, &mut self.end);
        weights.combine((&mut self.given, &mut self.rates), h, &self.c_dot);
        end.c.read(&self.given);
        Over::<C::Group, S::Item>::chart_leave_into::<R>(
            &end.c,
            &end.momentum,
            (&mut end.f, &mut end.mu, &mut end.pi),
        );
    }

    /// The rates at the stages' places; no stage needs another.
    pub(super) fn evaluate<R: Retraction>(&mut self, system: &C, time: (S::Item, S::Item)) {
        S::run(
            #[inline(always)]
            || {
                self.change.clear();
                for k in 0..self.c.blocks() {
                    self.evaluate_block::<R>(system, time, k);
                }
            },
        );
    }

    /// The rates at the places of block `k`. A function of its own, so that the system's is compiled into one place.
    #[inline(never)]
    fn evaluate_block<R: Retraction>(&mut self, system: &C, (t, h): (S::Item, S::Item), k: usize) {
        S::run(
            #[inline(always)]
            || self.find_rates::<R>(system, (t, h), k),
        );
    }

    #[inline(always)]
    fn find_rates<R: Retraction>(&mut self, system: &C, (t, h): (S::Item, S::Item), k: usize) {
        let (block, scratch) = (&mut self.blocks[k], &mut self.scratch);
        scratch.c.read(self.c.block(k));
        scratch.pi.read(self.pi.block(k));
        let chart = (&scratch.c, &scratch.pi);
        let place = (&mut block.f, &mut block.mu);
        Over::<C::Group, S>::chart_enter_into::<R>(chart.0, chart.1, place);
        self.g.compose_into(&block.f, &mut scratch.g);
        let (xi, tau) = (&mut block.xi, &mut block.tau);
        let t = S::splat(h).mul_add(self.coefficients.nodes[k], S::splat(t));
        let (at, work) = (Context::new(t, &self.parameters), &mut self.workspace);
        system.velocity_and_force(at, &scratch.g, &block.mu, work, xi, tau);
        if let Some(force) = &self.extra_force {
            block.tau.add_scaled(S::one(), force);
        }
        let rates = (&mut scratch.c_dot, &mut scratch.pi_dot);
        Over::<C::Group, S>::chart_rates_into::<R>(chart, (&block.xi, &block.tau), rates);
        let (change, rates) = (&mut self.change, &mut self.rates);
        scratch.c_dot.write(rates);
        change.replace((&self.kinds, 0), self.c_dot.block_mut(k), rates, rates);
        scratch.pi_dot.write(rates);
        let momenta = self.pi.block(k);
        change.replace((&self.kinds, 1), self.pi_dot.block_mut(k), rates, momenta);
    }

    /// Configuration and momentum at stage `i`, where it was evaluated at last.
    pub(super) fn read_stage(&self, i: usize, out: &mut State<C::Group>)
    where
        S: Batch<Item = f64>,
    {
        let (block, lane) = (&self.blocks[i / S::ITEMS], i % S::ITEMS);
        let item = |x: S| S::items(&[x])[lane];
        C::Group::convert_into::<S, f64>(&self.g.compose(&block.f), item, &mut out.g);
        for d in 0..out.mu.dim() {
            out.mu.set(d, item(block.mu.get(d)));
        }
    }

    /// $P$ from the forces.
    pub(super) fn gather(&mut self, mu: &DualOver<C::Group, S::Item>, h: S::Item) {
        S::run(
            #[inline(always)]
            || self.find_momentum(h, mu),
        );
    }

    #[inline(always)]
    fn find_momentum(&mut self, h: S::Item, mu: &DualOver<C::Group, S::Item>) {
        let (weights, end) = (&self.coefficients.weights, &mut self.end);
        for (k, block) in self.blocks.iter().enumerate() {
            self.scratch.transport_force(block, self.force.block_mut(k));
        }
        weights.combine((&mut self.given, &mut self.rates), h, &self.force);
        end.impulse.read(&self.given);
        end.momentum.set_sum(mu, S::Item::one(), &end.impulse);
    }

    /// Velocities and forces at one state, for a step that has no step before it.
    pub(super) fn rates_at(&mut self, system: &C, t: S::Item, mu: &DualOver<C::Group, S::Item>) {
        let Block {
            mu: at, xi, tau, ..
        } = &mut self.blocks[0];
        for d in 0..at.dim() {
            at.set(d, S::splat(mu.get(d)));
        }
        let now = Context::new(S::splat(t), &self.parameters);
        let (g, workspace) = (&self.g, &mut self.workspace);
        S::run(
            #[inline(always)]
            || system.velocity_and_force(now, g, at, workspace, xi, tau),
        );
        for k in 0..self.xi.blocks() {
            xi.write(self.xi.block_mut(k));
            tau.write(self.tau.block_mut(k));
        }
    }

    /// The stages' places from velocities and forces alone: $\dot c = \mathrm d\tau_c^{-1} \xi$ a few times over, and the
    /// momenta by transport.
    pub(super) fn place_by_velocities<R: Retraction>(
        &mut self,
        h: S::Item,
        mu: &DualOver<C::Group, S::Item>,
    ) {
        mu.write(&mut self.given);
        S::run(
            #[inline(always)]
            || {
                self.low_c.set_zero();
                self.low_pi.set_zero();
                self.c_dot.copy_from(&self.xi);
                for _ in 0..CHART_SWEEPS {
                    for k in 0..self.c.blocks() {
                        self.place_coordinates(h, k);
                        self.turn_velocity::<R>(k);
                    }
                }
                for k in 0..self.c.blocks() {
                    self.place_coordinates(h, k);
                    self.turn_force::<R>(k);
                }
                for k in 0..self.c.blocks() {
                    let forward = &self.coefficients.forward.high;
                    let (pi, zero) = (&mut self.pi, &self.low_pi);
                    forward.combine(k, pi, (h, zero), &self.force, &self.given);
                    self.transport_momentum::<R>(k);
                }
            },
        );
    }

    /// $\dot c_i$ from $\xi_i$ at the place $c_i$.
    #[inline(always)]
    fn turn_velocity<R: Retraction>(&mut self, k: usize) {
        let (block, scratch) = (&mut self.blocks[k], &mut self.scratch);
        scratch.c.read(self.c.block(k));
        block.xi.read(self.xi.block(k));
        let (c, xi) = (&scratch.c, &block.xi);
        Over::<C::Group, S>::chart_velocity_into::<R>(c, xi, &mut scratch.c_dot);
        scratch.c_dot.write(self.c_dot.block_mut(k));
    }

    /// The force in the frame of the start, from $\tau_i$ at the place $c_i$.
    #[inline(always)]
    fn turn_force<R: Retraction>(&mut self, k: usize) {
        let (block, scratch) = (&mut self.blocks[k], &mut self.scratch);
        scratch.c.read(self.c.block(k));
        block.tau.read(self.tau.block(k));
        Over::<C::Group, S>::retract_into::<R>(&scratch.c, &mut block.f);
        scratch.transport_force(block, self.force.block_mut(k));
    }

    /// $\pi_i$ from the momentum in the frame of the start.
    #[inline(always)]
    fn transport_momentum<R: Retraction>(&mut self, k: usize) {
        let (block, scratch) = (&mut self.blocks[k], &mut self.scratch);
        scratch.c.read(self.c.block(k));
        block.mu.read(self.pi.block(k));
        let out = (&mut block.f, &mut scratch.force, &mut scratch.pi);
        Over::<C::Group, S>::chart_leave_into::<R>(&scratch.c, &block.mu, out);
        scratch.pi.write(self.pi.block_mut(k));
    }

    /// Writes the velocities and forces at the stages.
    pub(super) fn write_velocities(&self, xi: &mut Stages<S>, tau: &mut Stages<S>) {
        for (k, block) in self.blocks.iter().enumerate() {
            block.xi.write(xi.block_mut(k));
            block.tau.write(tau.block_mut(k));
        }
    }

    /// Writes the rates, stage by stage, and the momentum.
    pub(super) fn write(&self, out: &mut [S::Item]) {
        let dim = self.dim();
        let (rates, momentum) = out.split_at_mut(2 * dim * self.stages);
        for (i, rates) in rates.chunks_exact_mut(2 * dim).enumerate() {
            for d in 0..dim {
                rates[d] = self.c_dot.get(i, d);
                rates[dim + d] = self.pi_dot.get(i, d);
            }
        }
        self.end.momentum.write(momentum);
    }

    /// Reads them back.
    pub(super) fn read(&mut self, from: &[S::Item]) {
        let (dim, stages) = (self.dim(), self.stages);
        let (rates, momentum) = from.split_at(2 * dim * stages);
        for (i, rates) in rates.chunks_exact(2 * dim).enumerate() {
            for d in 0..dim {
                self.c_dot.set(stages, i, d, rates[d]);
                self.pi_dot.set(stages, i, d, rates[dim + d]);
            }
        }
        self.end.momentum.read(momentum);
    }
}

impl<C: ContinuousSystem, S: Batch<Item = f64>> Sweep<C, S> {
    /// Whether velocities and forces are finite.
    pub(super) fn is_finite(&self) -> bool {
        let finite = |stages: &Stages<S>| S::items(stages.values()).iter().all(|x| x.is_finite());
        finite(&self.xi) && finite(&self.tau)
    }

    /// Finds what brings the kinds of coordinates to one unit, by what the velocity answers to small momenta.
    pub(super) fn weigh(&mut self, system: &C, (t, mu): (f64, &<C::Group as LieGroup>::Dual)) {
        /// Of the momentum of the kind, or of its unit where there is none.
        const SMALL: f64 = 1.0 / 1024.0;
        if self.judge.is_weighed() {
            return;
        }
        let driven = system.is_driven();
        let (kinds, mut sizes) = (self.kinds.clone(), vec![0.0; self.kinds.count]);
        kinds.raise(&mut sizes, &mu.coordinates());
        let mut moved = mu.clone();
        let mut velocity = |add: f64, i: usize| {
            moved.copy_from(mu);
            moved.set(i, mu.get(i) + add);
            self.rates_at(system, t, &moved);
            self.xi.get(0, i)
        };
        let inertia = |kind: usize, i: usize| {
            // The momentum of a driven system may be rounding, of which the velocity does not tell.
            let mut size = match sizes[kind] == 0.0 || driven {
                true => SMALL,
                false => SMALL * sizes[kind],
            };
            let rest = velocity(0.0, i);
            let mut change = (velocity(size, i) - rest).abs();
            if driven && change < SMALL * rest.abs() {
                size *= rest.abs() / change.max(f64::EPSILON * rest.abs());
                change = (velocity(size, i) - rest).abs();
            }
            size / change
        };
        let weights = Weights::new(&kinds, inertia);
        self.judge.weigh(weights, driven);
    }

    /// The largest change of the rates in the last sweep, in the kind of coordinates where it is largest; not a number where a rate is not.
    pub(super) fn change(&mut self, h: f64) -> f64 {
        self.judge.look(&self.change, largest);
        let poison = core::slice::from_ref(&self.change.poison);
        self.judge.change(h) + S::items(poison).iter().sum::<f64>()
    }

    /// Whether all rates of the last evaluation are finite.
    pub(super) fn has_rates(&self) -> bool {
        let poison = core::slice::from_ref(&self.change.poison);
        S::items(poison).iter().all(|x| *x == 0.0)
    }

    /// Whether a stage is where the system is not defined.
    pub(super) fn leaves_domain(&self, system: &C, (t, h): (f64, f64)) -> bool {
        let outside = |k: usize, lane: usize| {
            let item = |x: S| S::items(&[x])[lane];
            let g = C::Group::convert::<S, f64>(&self.g.compose(&self.blocks[k].f), item);
            g.is_finite() && !system.is_defined(t + h * item(self.coefficients.nodes[k]), &g)
        };
        (0..self.blocks.len()).any(|k| (0..S::ITEMS).any(|lane| outside(k, lane)))
    }

    /// Measures what rounding makes of the rates at the stages' places: how much they change where every number that they follow from moves in
    /// its last place. The rates keep the moved values.
    #[cold]
    pub(super) fn measure_noise<R: Retraction>(
        &mut self,
        system: &C,
        (g, moved): (&C::Group, &mut C::Group),
        (t, h): (f64, f64),
    ) {
        self.shakes += 1;
        let time = self.shakes;
        for places in [&mut self.c, &mut self.pi] {
            let shaker = Shaker::new(time);
            places.items_mut().for_each(|x| *x = shaker.shake(*x));
        }
        let shaker = Shaker::new(time);
        C::Group::convert_into::<f64, f64>(g, |x| shaker.shake(x), moved);
        self.start_at(moved);
        self.evaluate::<R>(system, (t, h));
        self.start_at(g);
        self.judge.look(&self.change, largest);
        self.judge.hear(shaker.times());
    }

    /// Forgets what rounding makes.
    pub(super) fn forget_noise(&mut self) {
        self.shakes = 0;
        self.judge.forget_noise();
    }
}

/// The largest of a batch. What is not a number is not looked for here; one instruction a number, where `larger` takes three.
fn largest<S: Batch<Item = f64>>(x: &S) -> f64 {
    let items = S::items(core::slice::from_ref(x)).iter();
    items.fold(0.0, |a, b| if *b > a { *b } else { a })
}
