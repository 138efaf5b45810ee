//! The Lie group variational integrator of a discrete Lagrangian: (25)–(26) in both forms.

use core::marker::PhantomData;
use core::ops::Range;

use lie::{Cayley, LieGroup, Retraction, VectorSpace};

use crate::balance::Balance;
use crate::newton::is_degenerate;
use crate::numbers::{larger, relative};
use crate::solver::{Algebra, Dual, StepSolver};
use crate::variation::Linearised;
use crate::warm_start::WarmStart;
use crate::{
    DiscreteLagrangian, FirstVariation, FrozenInertia, Hint, Inertia, Integrator, Newton, Pair,
    State, StepError, StepReport, Variation, legendre_plus,
};

/// The default [tolerance](Variational::with_tolerance) for up to `FEW` coordinates.
const TOLERANCE: f64 = 1e-13;
/// The rounding of a residual grows as the root of its coordinates beyond these.
const FEW: f64 = 12.0;
/// Evaluations of the balance before a step is given up.
const MAX_ITERATIONS: u32 = 60;
/// A residual below this is one that only rounding keeps from the tolerance.
const ROUNDING: f64 = 1e-12;
/// A residual that shrinks by less than this factor, in one iteration and in two, stands.
const STANDS: f64 = 0.9;
/// Iterations that bring the cyclic equations from the tolerance to rounding.
const CYCLIC_ITERATIONS: u32 = 3;
/// A correction of the cyclic coordinates below this share of the displacement is rounding.
const NOISE: f64 = 1e3 * f64::EPSILON;
/// A residual below this is at a root; it may rise by rounding.
const AT_ROOT: f64 = 1e-6;
/// The shortest part of a correction that is tried where the whole makes the residual grow.
const SHORTEST_CORRECTION: f64 = 1e-2;
/// How far a root whose matrix has turned an even number of pivots may lie from the one before, continued in proportion to $h$.
const NEAR: f64 = 0.25;
/// The shortest part of a step that its solution is followed by.
const SHORTEST_PART: f64 = 1.0 / 64.0;
/// Steps between corrections of the rounding that moves the configuration off its group.
const NORMALIZE_EVERY: u64 = 32;

/// A Lie group variational integrator: the stepping map of a discrete Lagrangian.
///
/// A step solves the momentum balance
/// $\mathsf T_e^\ast \mathsf L_{f} \cdot \mathbf D_{f} L_d = \mathrm{Ad}^\ast_{f} \left(\mu_k + \mathsf T_e^\ast \mathsf L_{g} \cdot \mathbf D_{g} L_d\right)$
/// for $f_k = \tau(c)$, then $g_{k+1} = g_k f_k$ and $\mu_{k+1}$ is the right-hand side: the momentum is *carried* by the
/// coadjoint transport, so that the momentum map holds to rounding even where the balance holds to a tolerance only.
/// This is (25)–(26) of Lee, Leok & McClamroch (2009) in the form (39)–(46).
///
/// The first step allocates; later ones do not, unless the state's shape changes or a long step needs another matrix
/// for the first time.
///
/// The type parameters are the Lagrangian, the solver's matrix ([`Newton`] or [`FrozenInertia`]) and the retraction of the
/// unknowns' chart.
pub struct Variational<L, M = Newton<<L as DiscreteLagrangian>::Group>, R = Cayley>
where
    L: DiscreteLagrangian,
{
    lagrangian: L,
    tolerance: Option<f64>,
    steps: u64,
    work: Option<Work<L, M>>,
    linearised: Option<Linearised<L::Group>>,
    retraction: PhantomData<R>,
}

/// Storage of the steps.
struct Work<L: DiscreteLagrangian, M> {
    solver: M,
    balance: Balance<L::Group, f64>,
    /// What a norm is taken of.
    judged: Dual<L>,
    /// What a residual is relative to.
    scale: f64,
    warm: WarmStart,
    c: Algebra<L>,
    delta: Algebra<L>,
    /// Those of a guess or of a solution.
    coordinates: Vec<f64>,
    /// The solution of a part of the step.
    reached: Algebra<L>,
    next: L::Group,
}

impl<L: DiscreteLagrangian, M: StepSolver<L>> Work<L, M> {
    fn new(lagrangian: &L, g: &L::Group) -> Self {
        let c = g.zero_algebra();
        Self {
            solver: M::allocate(lagrangian, g),
            balance: Balance::new(g),
            judged: g.zero_dual(),
            scale: 0.0,
            warm: WarmStart::new(c.dim()),
            coordinates: vec![0.0; c.dim()],
            delta: c.clone(),
            reached: c.clone(),
            c,
            next: g.clone(),
        }
    }
}

impl<L: DiscreteLagrangian> Variational<L> {
    /// The integrator of a discrete Lagrangian, with the Newton matrix from dual numbers.
    pub fn new(lagrangian: L) -> Self {
        Self::with_solver(lagrangian)
    }
}

impl<L: Inertia> Variational<L, FrozenInertia<L>> {
    /// The integrator of a discrete Lagrangian that brings its own inertia solve.
    pub fn with_inertia(lagrangian: L) -> Self {
        Self::with_solver(lagrangian)
    }
}

/// What an iteration has led to.
struct Ended {
    report: StepReport,
    at: End,
    /// Pivots whose sign has turned on the way from the inertia.
    turns: usize,
}

#[derive(Clone, Copy, PartialEq)]
enum End {
    /// The motion's solution.
    Solved,
    /// A solution of another branch.
    AnotherBranch,
    /// No solution.
    Nowhere,
    /// Nothing: the first evaluation was not finite.
    NotFinite,
}

impl<L: DiscreteLagrangian, M: StepSolver<L>, R: Retraction> Variational<L, M, R> {
    /// The integrator of a discrete Lagrangian with the solver `M`, [`Newton`] or another.
    pub fn with_solver(lagrangian: L) -> Self {
        Self {
            lagrangian,
            tolerance: None,
            steps: 0,
            work: None,
            linearised: None,
            retraction: PhantomData,
        }
    }

    /// The same integrator with its unknowns in another retraction's chart; the solution does not depend on it.
    pub fn with_retraction<Q: Retraction>(self) -> Variational<L, M, Q> {
        let mut other = Variational::with_solver(self.lagrangian);
        other.tolerance = self.tolerance;
        other
    }

    /// The largest residual of a solved step relative to the momentum's size; unless set, 1e-13 for up to 12 coordinates and
    /// growing as their root, as rounding does. Unless set, a residual below 1e-12 that no longer shrinks is taken for rounding:
    /// where bodies move against each other, their momenta cancel and the rounding is that of the parts.
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = Some(tolerance);
        self
    }

    /// The discrete Lagrangian.
    pub fn lagrangian(&self) -> &L {
        &self.lagrangian
    }

    /// The displacement $f_k$ from a state: the inverse of the discrete Legendre transform $\mathbb F^- L_d$.
    ///
    /// # Errors
    /// As [`step`](Integrator::step).
    pub fn displacement(&mut self, state: &State<L::Group>, h: f64) -> Result<L::Group, StepError> {
        self.solve(state, h)?;
        Ok(self.work(&state.g).balance.f.clone())
    }

    /// The pair $(g_k, f_k)$ of a state and a step size, where the Lagrangian form starts.
    ///
    /// # Errors
    /// As [`step`](Integrator::step).
    pub fn pair(&mut self, state: &State<L::Group>, h: f64) -> Result<Pair<L::Group>, StepError> {
        let f = self.displacement(state, h)?;
        Ok(Pair {
            t: state.t,
            h,
            g: state.g.clone(),
            f,
        })
    }

    /// The Lagrangian form $(g_k, f_k) \mapsto (g_{k+1}, f_{k+1})$, (25)–(26) and (34)–(38), by the step size of the pair.
    ///
    /// The momentum between the steps is derived anew from the pair, which divides a small difference by $h$:
    /// prefer [`step`](Integrator::step), which carries it, for long runs. Each step clones the configuration.
    ///
    /// # Errors
    /// As [`step`](Integrator::step); the pair is as it was.
    pub fn step_pair(&mut self, pair: &mut Pair<L::Group>) -> Result<StepReport, StepError> {
        let Pair { t, h, g, f } = pair;
        self.check(*t, *h, g)?;
        let mu = legendre_plus(&self.lagrangian, *t, g, f, *h);
        let mut next = State {
            t: *t + *h,
            g: g.compose(f),
            mu,
        };
        if self.normalizes() {
            next.g.normalize();
        }
        let step = self.steps;
        let finite = |x: &L::Group| {
            let (t, h) = (*t, *h);
            x.is_finite()
                .then_some(())
                .ok_or(StepError::NotFinite { step, t, h })
        };
        finite(&next.g)?;
        let report = self.solve(&next, *h)?;
        finite(&self.work(&next.g).balance.f)?;
        self.accept(*h);
        f.clone_from(&self.work(&next.g).balance.f);
        (*t, *g) = (next.t, next.g);
        Ok(report)
    }

    /// Takes the step that was solved.
    fn advance(&mut self, state: &mut State<L::Group>, h: f64) -> Result<(), StepError> {
        let (normalizes, step, t) = (self.normalizes(), self.steps, state.t);
        let work = self.work(&state.g);
        state.g.compose_into(&work.balance.f, &mut work.next);
        if normalizes {
            work.next.normalize();
        }
        if !work.next.is_finite() {
            return Err(StepError::NotFinite { step, t, h });
        }
        core::mem::swap(&mut state.g, &mut work.next);
        core::mem::swap(&mut state.mu, &mut work.balance.transported);
        state.t += h;
        self.accept(h);
        Ok(())
    }

    fn normalizes(&self) -> bool {
        self.steps % NORMALIZE_EVERY == NORMALIZE_EVERY - 1
    }

    /// Counts a step that was taken and remembers its solution for the next guess.
    fn accept(&mut self, h: f64) {
        self.steps += 1;
        if let Some(Work {
            warm,
            c,
            coordinates,
            ..
        }) = &mut self.work
        {
            c.write(coordinates);
            warm.record(h, coordinates);
        }
    }

    fn work(&mut self, g: &L::Group) -> &mut Work<L, M> {
        self.work
            .get_or_insert_with(|| Work::new(&self.lagrangian, g))
    }

    /// Whether a step of size `h` from `g` at time `t` makes sense at all.
    fn check(&self, t: f64, h: f64, g: &L::Group) -> Result<(), StepError> {
        let step = self.steps;
        if !(h.is_finite() && h != 0.0) {
            return Err(StepError::InvalidStep { step, t, h });
        }
        if !self.lagrangian.fits(g) {
            return Err(StepError::Misfit { step, t });
        }
        if !t.is_finite() {
            return Err(StepError::NotFinite { step, t, h });
        }
        Ok(())
    }

    /// Solves the balance from the extrapolated guess, and from no displacement where that leads nowhere or astray.
    fn solve(&mut self, state: &State<L::Group>, h: f64) -> Result<StepReport, StepError> {
        let (step, t) = (self.steps, state.t);
        self.check(t, h, &state.g)?;
        let fits = |work: &Work<L, M>| work.next.same_shape(&state.g);
        if !self.work.as_ref().is_some_and(fits) {
            self.work = Some(Work::new(&self.lagrangian, &state.g));
        }
        let (lagrangian, work) = (&self.lagrangian, &mut self.work);
        let work = work.get_or_insert_with(|| Work::new(lagrangian, &state.g));
        let shape = &work.balance.residual;
        if !shape.same_shape(&state.mu) {
            let (expected, found) = (shape.dim(), state.mu.dim());
            return Err(StepError::Shape {
                step,
                t,
                expected,
                found,
            });
        }
        let few = (shape.dim() as f64 / FEW).sqrt().max(1.0);
        let tolerance = self.tolerance.unwrap_or(TOLERANCE * few);
        let floor = if self.tolerance.is_some() {
            0.0
        } else {
            ROUNDING
        };
        if !state.mu.max_magnitude().is_finite() {
            return Err(StepError::NotFinite { step, t, h });
        }
        let mut before = 0;
        if work.warm.guess(h, &mut work.coordinates) {
            work.solver.begin(lagrangian, state, h);
            work.c.read(&work.coordinates);
            let goal = (tolerance, floor);
            let ended = work.iterate::<R>(lagrangian, (state, h), goal);
            // An even number may be two bodies past their folds: the guess was, and the determinant does not tell.
            if ended.at == End::Solved && ended.turns == 0 {
                return Ok(ended.report);
            }
            before = ended.report.iterations;
            work.forget();
        }
        let mut ended = work.follow::<R>(lagrangian, (state, h), (tolerance, floor));
        ended.report.iterations += before;
        if ended.at == End::Solved {
            return Ok(ended.report);
        }
        work.forget();
        let degenerate = ended.at != End::NotFinite && is_degenerate(lagrangian, state, h);
        Err(failure((step, t, h), tolerance, &ended, degenerate))
    }
}

fn failure(
    (step, t, h): (u64, f64, f64),
    tolerance: f64,
    ended: &Ended,
    degenerate: bool,
) -> StepError {
    let StepReport {
        iterations,
        residual,
    } = ended.report;
    let hint = match ended.at {
        End::NotFinite => return StepError::NotFinite { step, t, h },
        _ if degenerate => Hint::Degenerate,
        End::AnotherBranch => Hint::AnotherBranch { h: h / 4.0 },
        _ if is_rounding(residual, tolerance) => Hint::LooserTolerance {
            tolerance: 2.0 * residual,
        },
        _ => Hint::SmallerStep { h: h / 4.0 },
    };
    StepError::NotConverged {
        step,
        t,
        h,
        residual,
        iterations,
        hint,
    }
}

/// Whether rounding alone may be what keeps a residual from the tolerance.
fn is_rounding(residual: f64, tolerance: f64) -> bool {
    residual < ROUNDING.max(1e3 * tolerance)
}

/// The Euclidean norm, by the largest coordinate where squares leave the range of numbers.
#[inline(always)]
fn norm<V: VectorSpace>(x: &V) -> f64 {
    let squared = x.norm_squared();
    if (1e-280..1e300).contains(&squared) {
        squared.sqrt()
    } else {
        x.max_magnitude()
    }
}

/// The norm without the coordinates that are solved exactly: they may have another unit, and be larger by far.
#[inline(always)]
fn judged<V: VectorSpace<Scalar = f64>>(storage: &mut V, x: &V, exact: Range<usize>) -> f64 {
    storage.copy_from(x);
    exact.for_each(|i| storage.set(i, 0.0));
    norm(storage)
}

impl<L: DiscreteLagrangian, M: StepSolver<L>> Work<L, M> {
    /// Forgets what steps before have left, where it may be what made a step fail.
    fn forget(&mut self) {
        self.warm.forget();
        self.solver.forget();
    }

    /// Follows the solution from $h = 0$, where it is no displacement: in one go, or else in parts. The balance of a long step has many
    /// roots, and this one is the motion's.
    fn follow<R: Retraction>(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        goal: (f64, f64),
    ) -> Ended {
        let mut whole = self.follow_to::<R>(lagrangian, (state, h), [0.0, 1.0], goal);
        let missed = match whole.at {
            End::AnotherBranch => true,
            End::Nowhere => !is_rounding(whole.report.residual, goal.0),
            End::Solved | End::NotFinite => false,
        };
        if !missed {
            return whole;
        }
        let (mut reached, mut part) = (0.0, 0.5);
        while part >= SHORTEST_PART {
            let next = (reached + part).min(1.0);
            let mut ended = self.follow_to::<R>(lagrangian, (state, h), [reached, next], goal);
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
    fn follow_to<R: Retraction>(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        [reached, next]: [f64; 2],
        goal: (f64, f64),
    ) -> Ended {
        if reached == 0.0 {
            self.c.set_zero();
        } else {
            self.c.copy_from(&self.reached);
            self.c.scale(next / reached);
        }
        self.solver.forget();
        self.solver.begin(lagrangian, state, next * h);
        self.c.write(&mut self.coordinates);
        let mut ended = self.iterate::<R>(lagrangian, (state, next * h), goal);
        // Pivots turn in pairs where none of them is a fold; and where two bodies are past theirs.
        let followed = reached > 0.0 && ended.turns.is_multiple_of(2) && self.is_near(lagrangian);
        if ended.at == End::Solved && ended.turns > 0 && !followed {
            ended.at = End::AnotherBranch;
        }
        ended
    }

    /// Whether the root is near where the iteration has started.
    fn is_near(&self, lagrangian: &L) -> bool {
        let exact = self.solver.exact(lagrangian);
        let (mut apart, mut size) = (0.0, 0.0);
        for (i, expected) in self.coordinates.iter().enumerate() {
            if !exact.contains(&i) {
                apart = larger(apart, (self.c.get(i) - expected).abs());
                size = larger(size, expected.abs());
            }
        }
        apart <= NEAR * size
    }

    /// Iterates from the coordinates in `c`, which `coordinates` are too, until the residual is within the tolerance, or stands below the
    /// floor. With the exact matrix it has to fall, by a part of the correction where not by all: else the iteration leads anywhere.
    fn iterate<R: Retraction>(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        (tolerance, floor): (f64, f64),
    ) -> Ended {
        let ended = |at, iterations, residual| Ended {
            report: StepReport {
                iterations,
                residual,
            },
            at,
            turns: 0,
        };
        let [mut first, mut best, mut last, mut before] = [f64::INFINITY; 4];
        let (mut exact, mut part) = (false, 1.0);
        for iterations in 1..=MAX_ITERATIONS {
            self.evaluate::<R>(lagrangian, state, h);
            if iterations == 1 {
                self.scale = self.momenta(lagrangian, &state.mu);
            }
            let mut residual = self.residual(lagrangian);
            // Over two iterations: the contraction's eigenvalues are complex, and single ones jump.
            let slow = match before.is_finite() {
                true => residual > M::SLOW * last && residual > M::SLOW * M::SLOW * before,
                false => residual > last,
            };
            let stands = residual < floor && residual > STANDS * last.min(before);
            if residual <= tolerance || stands {
                if self.solver.is_stale() {
                    self.solver.renew::<R>(lagrangian, state, h, &self.c);
                }
                let more = self.finish_cyclic::<R>(lagrangian, state, h);
                if self.scale == 0.0 {
                    // Only the cyclic coordinates have moved, and the others follow.
                    self.scale = self.momenta(lagrangian, &state.mu);
                }
                // What that has moved may be just above the tolerance again: then iterate on.
                residual = self.residual(lagrangian);
                if residual <= tolerance || (stands && residual < floor) {
                    // The iteration contracts: the solution's matrix has the signs of the one that it is found by.
                    return Ended {
                        turns: self.solver.turns(),
                        ..ended(End::Solved, iterations + more, residual)
                    };
                }
            }
            if iterations == 1 {
                first = residual;
            }
            if !first.is_finite() {
                return ended(End::NotFinite, iterations, best);
            }
            best = best.min(residual);
            let falls = residual <= last.max(AT_ROOT);
            if exact && !falls && part > SHORTEST_CORRECTION {
                part *= 0.5;
                self.c.add_scaled(part, &self.delta);
                continue;
            }
            if exact && !falls {
                return ended(End::Nowhere, iterations, best);
            }
            part = 1.0;
            if self.solver.is_stale() || slow || !residual.is_finite() {
                // Where the steps before have led astray, the exact matrix is that of the start.
                let astray = residual.is_nan() || residual > first;
                if astray {
                    self.delta.read(&self.coordinates);
                }
                let at = if astray { &self.delta } else { &self.c };
                let renewed = self.solver.renew::<R>(lagrangian, state, h, at);
                exact |= renewed;
                if renewed && astray {
                    core::mem::swap(&mut self.c, &mut self.delta);
                    [last, before] = [f64::INFINITY; 2];
                    continue;
                }
            }
            if !residual.is_finite() {
                return ended(End::Nowhere, iterations, best);
            }
            (last, before) = (residual, last);
            self.solver
                .solve(lagrangian, &self.balance.residual, &mut self.delta);
            self.c.add_scaled(-1.0, &self.delta);
        }
        ended(End::Nowhere, MAX_ITERATIONS, best)
    }

    /// The size of the momenta in the balance as it is evaluated first: before the step, after it, and what a force adds to either.
    ///
    /// Not of those at later iterates: where these go astray momenta grow, and any residual is small beside them.
    fn momenta(&mut self, lagrangian: &L, mu: &Dual<L>) -> f64 {
        let exact = self.solver.exact(lagrangian);
        let Balance {
            transported,
            derivatives,
            ..
        } = &self.balance;
        [mu, transported, &derivatives.d_f]
            .map(|x| judged(&mut self.judged, x, exact.clone()))
            .into_iter()
            .fold(0.0, larger)
    }

    /// The residual's norm relative to that of the momenta.
    #[inline(always)]
    fn residual(&mut self, lagrangian: &L) -> f64 {
        let exact = self.solver.exact(lagrangian);
        relative(
            judged(&mut self.judged, &self.balance.residual, exact),
            self.scale,
        )
    }

    /// Evaluates the balance at `c`.
    #[inline(always)]
    fn evaluate<R: Retraction>(&mut self, lagrangian: &L, state: &State<L::Group>, h: f64) {
        self.balance.retract::<R>(&self.c);
        let Balance { f, derivatives, .. } = &mut self.balance;
        self.solver
            .derivatives(lagrangian, (state, h), f, &mut self.c, derivatives);
        self.balance.transport(&state.mu);
    }

    /// Solves the cyclic equations on to rounding, so that their momentum map does not feel the tolerance.
    fn finish_cyclic<R: Retraction>(
        &mut self,
        lagrangian: &L,
        state: &State<L::Group>,
        h: f64,
    ) -> u32 {
        let cyclic = lagrangian.cyclic();
        for more in 0..=CYCLIC_ITERATIONS {
            if more == CYCLIC_ITERATIONS {
                if self.delta.max_magnitude() <= NOISE * self.c.max_magnitude() {
                    return more;
                }
                // The matrix is of an attitude too far from this one.
                self.solver.renew::<R>(lagrangian, state, h, &self.c);
            }
            let left = &self.balance.residual;
            let solved = cyclic.clone().all(|i| left.get(i) == 0.0);
            if solved
                || !self
                    .solver
                    .solve_cyclic(left, cyclic.clone(), &mut self.delta)
            {
                return more;
            }
            self.c.add_scaled(-1.0, &self.delta);
            self.evaluate::<R>(lagrangian, state, h);
        }
        CYCLIC_ITERATIONS + 1
    }
}

impl<L: DiscreteLagrangian, M: StepSolver<L>, R: Retraction> Integrator for Variational<L, M, R> {
    type Group = L::Group;

    fn order(&self) -> u32 {
        self.lagrangian.order()
    }

    fn is_symmetric(&self) -> bool {
        self.lagrangian.is_symmetric()
    }

    fn is_symplectic(&self) -> bool {
        self.lagrangian.is_symplectic()
    }

    /// The Hamiltonian form $(g_k, \mu_k) \mapsto (g_{k+1}, \mu_{k+1})$, (39)–(46).
    fn step(&mut self, state: &mut State<L::Group>, h: f64) -> Result<StepReport, StepError> {
        let report = self.solve(state, h)?;
        self.advance(state, h)?;
        Ok(report)
    }

    fn peek(&mut self, state: &State<L::Group>, h: f64) -> Result<State<L::Group>, StepError> {
        self.solve(state, h)?;
        let balance = &self.work(&state.g).balance;
        let ahead = State {
            t: state.t + h,
            g: state.g.compose(&balance.f),
            mu: balance.transported.clone(),
        };
        ahead.if_finite(self.steps, state.t, h)
    }
}

impl<L: DiscreteLagrangian, M: StepSolver<L>, R: Retraction> FirstVariation
    for Variational<L, M, R>
{
    fn step_varied(
        &mut self,
        state: &mut State<L::Group>,
        variations: &mut [Variation<L::Group>],
        h: f64,
    ) -> Result<StepReport, StepError> {
        let report = self.solve(state, h)?;
        let mut carried = variations.to_vec();
        let (step, t) = (self.steps, state.t);
        let Self {
            lagrangian,
            work,
            linearised,
            ..
        } = self;
        let work = work.get_or_insert_with(|| Work::new(lagrangian, &state.g));
        let fits = |known: &Linearised<L::Group>| known.fits(&state.g);
        let mut linearised = linearised
            .take()
            .filter(fits)
            .unwrap_or_else(|| Linearised::new(lagrangian, &state.g));
        linearised.carry::<L, R>(lagrangian, (state, h), &work.c, &mut carried);
        self.linearised = Some(linearised);
        if !carried.iter().all(Variation::is_finite) {
            return Err(StepError::NotFinite { step, t, h });
        }
        self.advance(state, h)?;
        variations.clone_from_slice(&carried);
        Ok(report)
    }
}
