//! How the momentum balance of a step is solved, and which of its roots is taken.

use core::ops::Range;

use lie::{Cayley, LieGroup, RealGroup, VectorSpace};

use super::balance::Balance;
use super::matrix::Matrix;
use super::newton::cyclic;
use super::warm_start::WarmStart;
use crate::numerics::numbers::larger;
use crate::numerics::sizes::{Kinds, Relative, Shaker, Sizes, Weights, shake};
use crate::system::{Algebra, DiscreteCache, Dual};
use crate::{Context, Derivatives, DiscreteLagrangian, State, StepReport, Still};

/// Evaluations of the balance before a step is given up.
const MAX_ITERATIONS: u32 = 60;
/// A residual below this is one that only rounding keeps from the tolerance.
const ROUNDING: f64 = 1e-12;
/// How many times the tolerance a single block may be left at, relative to its own momentum.
const BLOCKS: f64 = 10.0;
/// A residual that shrinks by less than this factor, in one iteration and in two, stands.
const STANDS: f64 = 0.9;
/// How often rounding is measured in one iteration, at most: it costs two evaluations.
const MEASUREMENTS: u32 = 4;
/// Iterations that bring the cyclic equations from the tolerance to rounding.
const CYCLIC_ITERATIONS: u32 = 3;
/// A correction of the cyclic coordinates below this share of the displacement is rounding.
const CYCLIC_NOISE: f64 = 1e3 * f64::EPSILON;
/// Only a residual below this may ask for no correction.
const SETTLES_BELOW: f64 = 1e-10;
/// A residual below this is at a root; it may rise by rounding.
const AT_ROOT: f64 = 1e-6;
/// The shortest part of a correction that is tried where the whole makes the residual grow.
const SHORTEST_CORRECTION: f64 = 1e-2;
/// How far a root whose matrix has turned an even number of pivots may lie from the one before, continued in proportion to $h$.
const NEAR: f64 = 0.25;
/// The shortest part of a step that its solution is followed by.
const SHORTEST_PART: f64 = 1.0 / 64.0;

/// Storage of the steps.
pub(super) struct Work<L: DiscreteLagrangian> {
    pub(super) matrix: Matrix<L>,
    pub(super) balance: Balance<L, f64>,
    /// Of the coordinates that are not solved exactly: those may have another unit, and be larger by far.
    sizes: Sizes,
    driven: Option<Driven>,
    pub(super) warm: WarmStart,
    pub(super) c: Algebra<L>,
    delta: Algebra<L>,
    /// Of the cyclic coordinates alone.
    cyclic_delta: Algebra<L>,
    /// Those of a guess or of a solution.
    pub(super) coordinates: Vec<f64>,
    /// The solution of a part of the step.
    reached: Algebra<L>,
    pub(super) next: L::Group,
    pub(super) still: Still<L::Group>,
    /// Made when first needed.
    shaken: Option<Shaken<L::Group>>,
}

/// Storage to see what rounding makes of the balance.
struct Shaken<G: RealGroup> {
    state: State<G>,
    c: G::Algebra,
    residual: G::Dual,
}

/// When a step is solved.
#[derive(Clone, Copy)]
pub(super) struct Goal {
    /// The largest residual, relative to the momenta.
    pub(super) tolerance: f64,
    /// Whether a residual that rounding explains is enough.
    pub(super) accepts_rounding: bool,
}

impl Goal {
    fn is_reached(&self, residual: Relative) -> bool {
        let Self { tolerance, .. } = *self;
        residual.overall <= tolerance && residual.by_block <= BLOCKS * tolerance
    }
}

/// What an iteration has led to.
pub(super) struct Ended {
    pub(super) report: StepReport,
    pub(super) at: End,
    /// Pivots whose sign has turned on the way from the inertia.
    pub(super) turns: usize,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum End {
    /// The motion's solution.
    Solved,
    /// A solution of another branch.
    AnotherBranch,
    /// No solution.
    Nowhere,
    /// Nothing: the first evaluation was not finite.
    NotFinite,
}

/// The residuals of the last two iterates.
struct Progress {
    last: Relative,
    before: Relative,
}

impl Progress {
    const NONE: Self = Self {
        last: Relative::NONE,
        before: Relative::NONE,
    };

    /// Over two iterations: the contraction's eigenvalues are complex, and single ones jump.
    fn is_slow(&self, now: Relative, slow: f64) -> bool {
        let (last, before) = (self.last.overall, self.before.overall);
        match before.is_finite() {
            true => now.overall > slow * last && now.overall > slow * slow * before,
            false => now.overall > last,
        }
    }

    /// Whether no block's residual shrinks any more.
    fn stands(&self, now: Relative) -> bool {
        let falls =
            |of: fn(&Relative) -> f64| of(&now) < STANDS * of(&self.last).min(of(&self.before));
        now.overall < AT_ROOT && !falls(|r| r.overall) && !falls(|r| r.by_block)
    }

    fn push(&mut self, now: Relative) {
        (self.last, self.before) = (now, self.last);
    }
}

/// Whether rounding alone may be what keeps a residual from the tolerance.
pub(super) fn is_rounding(residual: f64, tolerance: f64) -> bool {
    residual < ROUNDING.max(1e3 * tolerance)
}

/// What brings the velocities of a driven system to momenta.
struct Driven {
    weights: Weights,
    kinds: Kinds,
}

impl<L: DiscreteLagrangian> Work<L> {
    pub(super) fn new(
        lagrangian: &L,
        (t, h): (f64, f64),
        g: &L::Group,
        (cache, keeps_all): (DiscreteCache<L::Group>, bool),
    ) -> Self {
        let c = g.zero_algebra();
        let matrix = Matrix::new(g, (cache.clone(), keeps_all));
        let weights = weights(lagrangian, (t, h), g, cache.clone());
        let driven = weights.clone().filter(|_| lagrangian.is_driven());
        Self {
            driven: driven.map(|weights| Driven {
                weights,
                kinds: Kinds::of(g),
            }),
            balance: Balance::new(g, cache),
            sizes: Sizes::new(
                g,
                matrix.solved_exactly(lagrangian, c.dim()),
                weights.as_ref(),
            )
            .with_terms(lagrangian.terms()),
            warm: WarmStart::new(g, weights.as_ref()),
            coordinates: vec![0.0; c.dim()],
            delta: c.clone(),
            cyclic_delta: c.clone(),
            reached: c.clone(),
            c,
            next: g.clone(),
            still: Still::at(g),
            shaken: None,
            matrix,
        }
    }

    /// Prepares the step of size `h` from `state`.
    #[inline(always)]
    pub(super) fn begin(&mut self, lagrangian: &L, (state, h): (&State<L::Group>, f64)) {
        self.balance.set_parameters(lagrangian);
        let work = &mut self.balance.workspace;
        self.matrix.begin(lagrangian, (state, h), work);
    }

    /// Forgets what steps before have left, where it may be what made a step fail.
    pub(super) fn forget(&mut self) {
        self.warm.forget();
        self.matrix.forget();
    }

    /// Follows the solution from $h = 0$, where it is no displacement: in one go, or else in parts. The balance of a long step has many
    /// roots, and this one is the motion's.
    pub(super) fn follow(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        goal: Goal,
    ) -> Ended {
        let mut whole = self.follow_to(lagrangian, (state, h), [0.0, 1.0], goal);
        let missed = match whole.at {
            End::AnotherBranch => true,
            End::Nowhere => !is_rounding(whole.report.residual, goal.tolerance),
            End::Solved | End::NotFinite => false,
        };
        if !missed {
            return whole;
        }
        let (mut reached, mut part) = (0.0, 0.5);
        while part >= SHORTEST_PART {
            let next = (reached + part).min(1.0);
            let mut ended = self.follow_to(lagrangian, (state, h), [reached, next], goal);
            whole.report.iterations += ended.report.iterations;
            if ended.at != End::Solved {
                part *= 0.5;
                continue;
            }
            if next == 1.0 {
                ended.report.iterations = whole.report.iterations;
                return ended;
            }
            self.reached.copy_from(&self.c);
            (reached, part) = (next, 2.0 * part);
        }
        whole
    }

    /// Solves for the share `next` of a step from the solution for the share `reached`.
    fn follow_to(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        [reached, next]: [f64; 2],
        goal: Goal,
    ) -> Ended {
        if reached == 0.0 {
            self.c.set_zero();
        } else {
            self.c.copy_from(&self.reached);
            self.c.scale(next / reached);
        }
        self.matrix.forget();
        self.begin(lagrangian, (state, next * h));
        self.c.write(&mut self.coordinates);
        let mut ended = self.iterate(lagrangian, (state, next * h), goal);
        // Pivots turn in pairs where none of them is a fold; and where two bodies are past theirs.
        let followed = reached > 0.0 && ended.turns.is_multiple_of(2) && self.is_near();
        if ended.at == End::Solved && ended.turns > 0 && !followed {
            ended.at = End::AnotherBranch;
        }
        ended
    }

    /// Whether the root is near where the iteration has started.
    fn is_near(&mut self) -> bool {
        self.delta.read(&self.coordinates);
        let size = self.sizes.displacement(&self.delta);
        self.delta.add_scaled(-1.0, &self.c);
        self.sizes.displacement(&self.delta) <= NEAR * size
    }

    /// Iterates from the coordinates in `c`, which `coordinates` are too, until the goal is reached. With the exact matrix the residual has to
    /// fall, by a part of the correction where not by all: else the iteration leads anywhere.
    pub(super) fn iterate(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        goal: Goal,
    ) -> Ended {
        let ended = |at, iterations, residual| Ended {
            report: StepReport {
                iterations,
                residual,
                ..StepReport::default()
            },
            at,
            turns: 0,
        };
        let (mut first, mut best) = (None, f64::INFINITY);
        let mut progress = Progress::NONE;
        let (mut exact, mut part, mut measured) = (false, 1.0, 0);
        for iterations in 1..=MAX_ITERATIONS {
            self.evaluate(lagrangian, state, h);
            if iterations == 1 {
                self.set_scales((state, h));
            }
            let now = self.residual();
            let residual = now.overall;
            let slow = progress.is_slow(now, Matrix::<L>::SLOW);
            let mut solved = goal.is_reached(now);
            if !solved && goal.accepts_rounding && measured < MEASUREMENTS && progress.stands(now) {
                measured += 1;
                solved = self.is_noise(lagrangian, (state, h), (goal.tolerance, measured));
            }
            if solved {
                match self.finish(lagrangian, (state, h), goal, now) {
                    Some(ended) => return ended.after(iterations),
                    // Solving the cyclic equations has moved the rest.
                    None => continue,
                }
            }
            let first = *first.get_or_insert(residual);
            if !first.is_finite() {
                return ended(End::NotFinite, iterations, best);
            }
            best = best.min(residual);
            let falls = residual <= progress.last.overall.max(AT_ROOT);
            if exact && !falls && goal.accepts_rounding && measured == 0 {
                measured = 1;
                if self.is_noise_of_start(lagrangian, (state, h), goal.tolerance) {
                    let found = self.residual();
                    match self.finish(lagrangian, (state, h), goal, found) {
                        Some(ended) => return ended.after(iterations),
                        None => continue,
                    }
                }
            }
            if exact && !falls && part > SHORTEST_CORRECTION {
                part *= 0.5;
                self.c.add_scaled(part, &self.delta);
                continue;
            }
            if exact && !falls {
                return ended(End::Nowhere, iterations, best);
            }
            part = 1.0;
            if self.matrix.is_stale() || slow || !residual.is_finite() {
                // Where the steps before have led astray, the exact matrix is that of the start.
                let astray = residual.is_nan() || residual > first.max(AT_ROOT);
                if astray {
                    self.delta.read(&self.coordinates);
                }
                let at = if astray { &self.delta } else { &self.c };
                let renewed = self.matrix.renew(lagrangian, (state, h), at);
                exact |= renewed;
                if renewed && astray {
                    core::mem::swap(&mut self.c, &mut self.delta);
                    progress = Progress::NONE;
                    continue;
                }
            }
            if !residual.is_finite() {
                return ended(End::Nowhere, iterations, best);
            }
            progress.push(now);
            let (work, left) = (&mut self.balance.workspace, &self.balance.residual);
            self.matrix.solve(lagrangian, work, left, &mut self.delta);
            if residual < SETTLES_BELOW && self.is_settled(goal.tolerance) {
                match self.finish(lagrangian, (state, h), goal, now) {
                    Some(ended) => return ended.after(iterations),
                    None => continue,
                }
            }
            self.c.add_scaled(-1.0, &self.delta);
        }
        ended(End::Nowhere, MAX_ITERATIONS, best)
    }

    /// The end at a residual that is good enough; none where solving the cyclic equations on has made it worse.
    fn finish(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        goal: Goal,
        found: Relative,
    ) -> Option<Ended> {
        if self.matrix.is_stale() {
            self.matrix.renew(lagrangian, (state, h), &self.c);
        }
        let iterations = self.finish_cyclic(lagrangian, state, h)?;
        let solved = |iterations, residual, turns| Ended {
            report: StepReport {
                iterations,
                residual,
                ..StepReport::default()
            },
            at: End::Solved,
            turns,
        };
        // The iteration contracts: the solution's matrix has the signs of the one that it is found by.
        let turns = self.matrix.turns();
        if iterations == 0 {
            return Some(solved(0, found.overall, turns));
        }
        if self.sizes.have_no_scale() {
            // Only the cyclic coordinates have moved, and the others follow.
            self.set_scales((state, h));
        }
        let now = self.residual();
        let holds = goal.is_reached(now) || now.overall <= 2.0 * found.overall;
        holds.then(|| solved(iterations, now.overall, self.matrix.turns()))
    }

    /// The momenta in the balance as it is evaluated first: before the step, after it, and what a force adds to either.
    ///
    /// Not those at later iterates: where these go astray momenta grow, and any residual is small beside them.
    fn set_scales(&mut self, (state, h): (&State<L::Group>, f64)) {
        let Balance {
            transported,
            derivatives,
            ..
        } = &self.balance;
        self.sizes
            .set_scales(&[&state.mu, transported, &derivatives.d_f]);
        let Some(Driven { weights, kinds }) = &self.driven else {
            return;
        };
        let mut velocities = vec![0.0; kinds.count];
        kinds.raise(&mut velocities, &self.c.coordinates());
        let rates = || velocities.iter().map(|c| c / h.abs());
        self.sizes
            .raise_scales(|kind| weights.momentum_of(rates(), kind));
    }

    /// The residual relative to the momenta.
    #[inline(always)]
    fn residual(&mut self) -> Relative {
        self.sizes.relative(&self.balance.residual)
    }

    /// Whether what is left asks for no correction beside the displacement, in any block.
    #[inline(always)]
    fn is_settled(&self, tolerance: f64) -> bool {
        self.sizes.are_settled((&self.delta, &self.c), tolerance)
    }

    /// Whether the residual is no more than rounding makes of it: it is compared with that of arguments which differ in their last place.
    #[cold]
    fn is_noise(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        (tolerance, time): (f64, u32),
    ) -> bool {
        let storage = || Shaken {
            state: state.clone(),
            c: self.c.clone(),
            residual: self.balance.residual.clone(),
        };
        let mut other = self.shaken.take().unwrap_or_else(storage);
        // The last one shows what cancels in the others.
        let new = match time < MEASUREMENTS {
            true => Shaker::new,
            false => Shaker::far,
        };
        let shaker = new(time);
        L::Group::convert_into::<f64, f64>(&state.g, |x| shaker.shake(x), &mut other.state.g);
        other.state.t = state.t;
        other.state.mu.copy_from(&state.mu);
        other.c.copy_from(&self.c);
        other.residual.copy_from(&self.balance.residual);
        shake(&mut other.state.mu, &new(time));
        shake(&mut self.c, &new(time));
        self.evaluate_apart(lagrangian, &other.state, h);
        other.residual.add_scaled(-1.0, &self.balance.residual);
        self.sizes.raise_noise(&other.residual, shaker.times());
        self.c.copy_from(&other.c);
        self.evaluate_apart(lagrangian, state, h);
        self.shaken = Some(other);
        self.residual();
        self.is_settled(tolerance)
    }

    /// The same by what rounding makes of the balance where the iteration has started.
    ///
    /// At rest under forces that balance, momenta are rounding, and the residual is not small beside them. Where the iteration went astray
    /// numbers may be so large that any residual is rounding of theirs: those of the start are not.
    #[cold]
    fn is_noise_of_start(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        tolerance: f64,
    ) -> bool {
        let here = self.c.clone();
        self.c.read(&self.coordinates);
        self.evaluate_apart(lagrangian, state, h);
        for time in 1..=MEASUREMENTS {
            self.is_noise(lagrangian, (state, h), (tolerance, time));
        }
        self.c.copy_from(&here);
        self.evaluate_apart(lagrangian, state, h);
        self.residual();
        self.is_settled(tolerance)
    }

    /// Evaluates the balance at `c`.
    #[inline(always)]
    fn evaluate(&mut self, lagrangian: &L, state: &State<L::Group>, h: f64) {
        self.balance.retract(&self.c);
        let Balance {
            f,
            derivatives,
            parameters,
            workspace,
            ..
        } = &mut self.balance;
        let (own, at) = ((&parameters[..], workspace), (f, &mut self.c));
        self.matrix
            .derivatives(lagrangian, (state, h), own, at, derivatives);
        self.balance.transport(&state.mu);
    }

    /// The same in a function of its own: it is compiled once for all but the iteration.
    #[inline(never)]
    fn evaluate_apart(&mut self, lagrangian: &L, state: &State<L::Group>, h: f64) {
        self.evaluate(lagrangian, state, h);
    }

    /// Solves the cyclic equations on to rounding, so that their momentum map does not feel the tolerance; the iterations, or none where they
    /// are not solved.
    fn finish_cyclic(&mut self, lagrangian: &L, state: &State<L::Group>, h: f64) -> Option<u32> {
        if self.matrix.eliminates(lagrangian) {
            return Some(0);
        }
        let cyclic = cyclic(lagrangian, self.coordinates.len());
        let mut last = f64::INFINITY;
        for iterations in 0..=MAX_ITERATIONS {
            let largest = |x: &Algebra<L>| {
                cyclic
                    .clone()
                    .fold(0.0, |max, i| larger(max, x.get(i).abs()))
            };
            if iterations >= CYCLIC_ITERATIONS {
                let correction = largest(&self.cyclic_delta);
                if correction <= CYCLIC_NOISE * largest(&self.c)
                    || (correction > 0.5 * last && self.is_cyclic_rounding(cyclic.clone()))
                {
                    return Some(iterations);
                }
                last = correction;
                // The matrix is of a place too far from this one.
                self.matrix.renew(lagrangian, (state, h), &self.c);
            }
            let Balance {
                workspace,
                residual,
                ..
            } = &mut self.balance;
            let left: &Dual<L> = residual;
            let solved = cyclic.clone().all(|i| left.get(i) == 0.0);
            let delta = &mut self.cyclic_delta;
            let corrects = !solved && self.matrix.solve_cyclic(lagrangian, workspace, left, delta);
            if !corrects {
                return Some(iterations);
            }
            self.c.add_scaled(-1.0, &self.cyclic_delta);
            self.evaluate_apart(lagrangian, state, h);
        }
        None
    }

    /// Whether what is left of the cyclic equations is small beside the momenta that they are made of, whatever the kind.
    ///
    /// The mass centre of a body that turns about it stays, but for rounding.
    fn is_cyclic_rounding(&self, cyclic: Range<usize>) -> bool {
        let Balance {
            residual,
            derivatives,
            ..
        } = &self.balance;
        let left = cyclic.fold(0.0, |max, i| larger(max, residual.get(i).abs()));
        left <= ROUNDING * derivatives.d_f.max_magnitude()
    }
}

/// By what the momentum answers to small displacements in a short part of a step.
fn weights<L: DiscreteLagrangian>(
    lagrangian: &L,
    (t, h): (f64, f64),
    g: &L::Group,
    cache: DiscreteCache<L::Group>,
) -> Option<Weights> {
    const SHORT: f64 = 1e-6;
    const SMALL: f64 = 1e-9;
    let (mut c, mut f) = (g.zero_algebra(), g.clone());
    let mut derivatives = Derivatives::with_cache(g, cache);
    derivatives.settle(lagrangian);
    let mut work = Default::default();
    let at = Context::new(t, lagrangian.parameters());
    let mut momenta = |displacement: f64, i: usize| {
        c.set_zero();
        if displacement != 0.0 {
            c.set(i, displacement);
        }
        L::Group::retract_into::<Cayley>(&c, &mut f);
        derivatives.find(lagrangian, at, (g, &f), SHORT * h, &mut work);
        derivatives.d_f.clone()
    };
    let still = momenta(0.0, 0);
    let inertia = |_, i| (momenta(SMALL, i).get(i) - still.get(i)).abs();
    Weights::new(&Kinds::of(g), inertia)
}

impl Ended {
    /// The same, after so many iterations before.
    fn after(mut self, iterations: u32) -> Self {
        self.report.iterations += iterations;
        self
    }
}
