//! The Lie group variational integrator of a discrete Lagrangian: (25)–(26) in both forms.

use core::marker::PhantomData;

use lie::{Cayley, LieGroup, Retraction, VectorSpace};

use crate::balance::Balance;
use crate::solver::{Algebra, StepSolver};
use crate::warm_start::WarmStart;
use crate::{
    DiscreteLagrangian, FrozenInertia, Hint, Inertia, Integrator, Newton, Pair, State, StepError,
    StepReport, legendre_plus,
};

/// The default [tolerance](Variational::with_tolerance).
const TOLERANCE: f64 = 1e-13;
/// Evaluations of the balance before a step is given up.
const MAX_ITERATIONS: u32 = 60;
/// Iterations that bring the cyclic equations from the tolerance to rounding.
const CYCLIC_ITERATIONS: u32 = 3;
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
    tolerance: f64,
    steps: u64,
    work: Option<Work<L, M>>,
    retraction: PhantomData<R>,
}

/// Storage of the steps.
struct Work<L: DiscreteLagrangian, M> {
    solver: M,
    balance: Balance<L::Group, f64>,
    warm: WarmStart,
    c: Algebra<L>,
    delta: Algebra<L>,
    coordinates: Vec<f64>,
    next: L::Group,
}

impl<L: DiscreteLagrangian, M: StepSolver<L>> Work<L, M> {
    fn new(lagrangian: &L, g: &L::Group) -> Self {
        let c = g.zero_algebra();
        Self {
            solver: M::allocate(lagrangian, g),
            balance: Balance::new(g),
            warm: WarmStart::new(c.dim()),
            coordinates: vec![0.0; c.dim()],
            delta: c.clone(),
            c,
            next: g.clone(),
        }
    }
}

impl<L: DiscreteLagrangian> Variational<L> {
    /// The integrator of a discrete Lagrangian, with the Newton matrix from dual numbers.
    pub fn new(lagrangian: L) -> Self {
        Self::from_lagrangian(lagrangian)
    }
}

impl<L: Inertia> Variational<L, FrozenInertia<L>> {
    /// The integrator of a discrete Lagrangian that brings its own inertia solve.
    pub fn with_inertia(lagrangian: L) -> Self {
        Self::from_lagrangian(lagrangian)
    }
}

/// What the last evaluation found.
struct Solved {
    report: StepReport,
    converged: bool,
}

impl<L: DiscreteLagrangian, M: StepSolver<L>, R: Retraction> Variational<L, M, R> {
    fn from_lagrangian(lagrangian: L) -> Self {
        Self {
            lagrangian,
            tolerance: TOLERANCE,
            steps: 0,
            work: None,
            retraction: PhantomData,
        }
    }

    /// The same integrator with its unknowns in another retraction's chart; the solution does not depend on it.
    pub fn with_retraction<Q: Retraction>(self) -> Variational<L, M, Q> {
        Variational::from_lagrangian(self.lagrangian).with_tolerance(self.tolerance)
    }

    /// The largest residual of a solved step relative to the momentum's size; 1e-13 unless set.
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
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

    /// The Lagrangian form $(g_k, f_k) \mapsto (g_{k+1}, f_{k+1})$, (25)–(26) and (34)–(38).
    ///
    /// The momentum between the steps is derived anew from the pair, which divides a small difference by $h$:
    /// prefer [`step`](Integrator::step), which carries it, for long runs.
    ///
    /// # Errors
    /// As [`step`](Integrator::step); the pair is as it was.
    pub fn step_pair(
        &mut self,
        pair: &mut Pair<L::Group>,
        h: f64,
    ) -> Result<StepReport, StepError> {
        let mut g = pair.g.compose(&pair.f);
        let mu = legendre_plus(&self.lagrangian, &pair.g, &pair.f, h);
        self.normalize(&mut g);
        let next = State {
            t: pair.t + h,
            g,
            mu,
        };
        let report = self.solve(&next, h)?;
        pair.f.clone_from(&self.work(&next.g).balance.f);
        (pair.t, pair.g) = (next.t, next.g);
        self.steps += 1;
        Ok(report)
    }

    fn normalize(&self, g: &mut L::Group) {
        if self.steps % NORMALIZE_EVERY == NORMALIZE_EVERY - 1 {
            g.normalize();
        }
    }

    fn work(&mut self, g: &L::Group) -> &mut Work<L, M> {
        self.work
            .get_or_insert_with(|| Work::new(&self.lagrangian, g))
    }

    /// Solves the balance from the extrapolated guess, and once more from zero where that fails.
    fn solve(&mut self, state: &State<L::Group>, h: f64) -> Result<StepReport, StepError> {
        let (step, t) = (self.steps, state.t);
        if !(h.is_finite() && h != 0.0) {
            return Err(StepError::InvalidStep { step, t, h });
        }
        if !state.mu.norm_squared().is_finite() {
            return Err(StepError::NotFinite { step, t, h });
        }
        if self
            .work
            .as_ref()
            .is_some_and(|work| !work.next.same_shape(&state.g))
        {
            self.work = None;
        }
        let shape = &self.work(&state.g).balance.residual;
        if !shape.same_shape(&state.mu) {
            let (expected, found) = (shape.dim(), state.mu.dim());
            return Err(StepError::Shape {
                step,
                t,
                expected,
                found,
            });
        }
        let tolerance = self.tolerance;
        let Self {
            lagrangian,
            work: Some(work),
            ..
        } = self
        else {
            return Err(StepError::NotFinite { step, t, h });
        };
        work.solver.begin(lagrangian, &state.g, &state.mu, h);
        let warm = work.warm.guess(h, &mut work.coordinates);
        work.c.read(&work.coordinates);
        let mut solved = work.iterate::<R>(lagrangian, state, h, tolerance);
        if warm && !solved.converged {
            work.c.set_zero();
            let before = solved.report.iterations;
            solved = work.iterate::<R>(lagrangian, state, h, tolerance);
            solved.report.iterations += before;
        }
        if !solved.converged {
            work.warm.forget();
            return Err(failure(step, t, h, tolerance, solved.report));
        }
        work.c.write(&mut work.coordinates);
        work.warm.record(h, &work.coordinates);
        Ok(solved.report)
    }
}

fn failure(step: u64, t: f64, h: f64, tolerance: f64, report: StepReport) -> StepError {
    let StepReport {
        iterations,
        residual,
    } = report;
    if !residual.is_finite() && iterations <= 1 {
        return StepError::NotFinite { step, t, h };
    }
    let hint = if residual < 1e3 * tolerance {
        Hint::LooserTolerance {
            tolerance: 2.0 * residual,
        }
    } else {
        Hint::SmallerStep { h: h / 4.0 }
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

impl<L: DiscreteLagrangian, M: StepSolver<L>> Work<L, M> {
    /// Iterates from the coordinates in `c` until the residual is within the tolerance.
    fn iterate<R: Retraction>(
        &mut self,
        lagrangian: &L,
        state: &State<L::Group>,
        h: f64,
        tolerance: f64,
    ) -> Solved {
        let (mut best, mut last, mut scale) = (f64::INFINITY, f64::INFINITY, 0.0);
        for iterations in 1..=MAX_ITERATIONS {
            let residual = self.evaluate::<R>(lagrangian, state, h);
            if iterations == 1 {
                scale = self.scale(state);
            }
            // A system at rest has no scale, and no residual either.
            let residual = if residual == 0.0 {
                0.0
            } else {
                residual / scale
            };
            if residual <= tolerance {
                let (residual, more) =
                    self.finish_cyclic::<R>(lagrangian, state, h, scale, residual);
                let report = StepReport {
                    iterations: iterations + more,
                    residual,
                };
                return Solved {
                    report,
                    converged: true,
                };
            }
            if !residual.is_finite() {
                let report = StepReport {
                    iterations,
                    residual: best.min(residual),
                };
                return Solved {
                    report,
                    converged: false,
                };
            }
            best = best.min(residual);
            if self.solver.is_stale() || residual > M::SLOW * last {
                self.solver
                    .renew::<R>(lagrangian, &state.g, &state.mu, h, &self.c);
            }
            last = residual;
            self.solver
                .solve(lagrangian, &self.balance.residual, &mut self.delta);
            self.c.add_scaled(-1.0, &self.delta);
        }
        Solved {
            report: StepReport {
                iterations: MAX_ITERATIONS,
                residual: best,
            },
            converged: false,
        }
    }

    /// Evaluates the balance at `c`; the residual's norm.
    #[inline(always)]
    fn evaluate<R: Retraction>(&mut self, lagrangian: &L, state: &State<L::Group>, h: f64) -> f64 {
        self.balance.retract::<R>(&self.c);
        let (f, c) = (&mut self.balance.f, &mut self.c);
        self.solver.eliminate(lagrangian, &state.mu, h, f, c);
        self.balance.evaluate(lagrangian, &state.g, &state.mu, h);
        self.balance.residual.norm_squared().sqrt()
    }

    /// The size of the momenta that balance: the scale of the residual.
    fn scale(&self, state: &State<L::Group>) -> f64 {
        let (before, after) = (
            state.mu.norm_squared(),
            self.balance.transported.norm_squared(),
        );
        before.max(after).sqrt()
    }

    /// Solves the cyclic equations on to rounding, so that their momentum map does not feel the tolerance.
    fn finish_cyclic<R: Retraction>(
        &mut self,
        lagrangian: &L,
        state: &State<L::Group>,
        h: f64,
        scale: f64,
        residual: f64,
    ) -> (f64, u32) {
        let cyclic = lagrangian.cyclic();
        let mut residual = residual;
        for more in 0..CYCLIC_ITERATIONS {
            let left = &self.balance.residual;
            let solved = cyclic.clone().all(|i| left.get(i) == 0.0);
            if solved
                || !self
                    .solver
                    .solve_cyclic(left, cyclic.clone(), &mut self.delta)
            {
                return (residual, more);
            }
            self.c.add_scaled(-1.0, &self.delta);
            residual = self.evaluate::<R>(lagrangian, state, h) / scale;
        }
        (residual, CYCLIC_ITERATIONS)
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
        true
    }

    /// The Hamiltonian form $(g_k, \mu_k) \mapsto (g_{k+1}, \mu_{k+1})$, (39)–(46).
    fn step(&mut self, state: &mut State<L::Group>, h: f64) -> Result<StepReport, StepError> {
        let report = self.solve(state, h)?;
        let normalize = self.steps % NORMALIZE_EVERY == NORMALIZE_EVERY - 1;
        let work = self.work(&state.g);
        state.g.compose_into(&work.balance.f, &mut work.next);
        if normalize {
            work.next.normalize();
        }
        core::mem::swap(&mut state.g, &mut work.next);
        core::mem::swap(&mut state.mu, &mut work.balance.transported);
        state.t += h;
        self.steps += 1;
        Ok(report)
    }
}
