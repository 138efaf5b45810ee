//! The Lie group variational integrator of a discrete Lagrangian: (25)–(26) in both forms.

mod solve;

use core::marker::PhantomData;

use lie::{Cayley, LieGroup, Retraction, VectorSpace};

use crate::newton::degenerate;
use crate::solver::StepSolver;
use crate::variation::Linearised;
use crate::{
    DiscreteLagrangian, FirstVariation, FrozenInertia, Hint, Inertia, Integrator, Newton, Pair,
    State, StepError, StepReport, Variation, legendre_plus,
};
use solve::{End, Ended, Goal, Work, is_rounding};

/// The default [tolerance](Variational::with_tolerance) for up to `FEW` coordinates.
const TOLERANCE: f64 = 1e-13;
/// The rounding of a residual grows as the root of its coordinates beyond these.
const FEW: f64 = 12.0;
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

    /// The largest error of a solved step, relative; unless set, 1e-13 for up to 12 coordinates and growing as their root, as rounding
    /// does.
    ///
    /// What is judged is the residual relative to the momentum: of all coordinates together, and of each rotation and each vector of a
    /// product by itself, to ten times the tolerance. So neither units nor the ratio of masses matter. A correction that is negligible
    /// beside the displacement is enough too.
    ///
    /// Unless a tolerance is set, a residual that no longer shrinks is also taken for solved where rounding explains it. That is so where it
    /// is at most 16 times what moving every number of the state by two units of its last place makes of it.
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
        let f = self.work((state.t, h), &state.g).balance.f.clone();
        let time = (self.steps, state.t, h);
        require_end(&self.lagrangian, &state.g.compose(&f), time)?;
        Ok(f)
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
        let (step, t_k, h_k) = (self.steps, *t, *h);
        require_end(&self.lagrangian, &next.g, (step, t_k, h_k))?;
        let report = self.solve(&next, h_k)?;
        if !self.work((next.t, h_k), &next.g).balance.f.is_finite() {
            let (t, h) = (t_k, h_k);
            return Err(StepError::NotFinite { step, t, h });
        }
        self.accept(*h);
        f.clone_from(&self.work((next.t, *h), &next.g).balance.f);
        (*t, *g) = (next.t, next.g);
        Ok(report)
    }

    /// Takes the step that was solved.
    fn advance(&mut self, state: &mut State<L::Group>, h: f64) -> Result<(), StepError> {
        let (normalizes, step, t) = (self.normalizes(), self.steps, state.t);
        let (lagrangian, work) = (&self.lagrangian, &mut self.work);
        let work = work.get_or_insert_with(|| Work::new(lagrangian, (state.t, h), &state.g));
        state.g.compose_into(&work.balance.f, &mut work.next);
        if normalizes {
            work.next.normalize();
        }
        require_end(lagrangian, &work.next, (step, t, h))?;
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

    /// The storage of a step that was solved.
    fn work(&mut self, time: (f64, f64), g: &L::Group) -> &mut Work<L, M> {
        self.work
            .get_or_insert_with(|| Work::new(&self.lagrangian, time, g))
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
            self.work = Some(Work::new(&self.lagrangian, (t, h), &state.g));
        }
        let (lagrangian, work) = (&self.lagrangian, &mut self.work);
        let work = work.get_or_insert_with(|| Work::new(lagrangian, (state.t, h), &state.g));
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
        if !state.mu.max_magnitude().is_finite() {
            return Err(StepError::NotFinite { step, t, h });
        }
        let few = (shape.dim() as f64 / FEW).sqrt().max(1.0);
        let goal = Goal {
            tolerance: self.tolerance.unwrap_or(TOLERANCE * few),
            accepts_rounding: self.tolerance.is_none(),
        };
        let mut before = 0;
        if work.warm.guess(h, &mut work.coordinates) {
            work.solver.begin(lagrangian, state, h);
            work.c.read(&work.coordinates);
            let ended = work.iterate::<R>(lagrangian, (state, h), goal);
            // An even number may be two bodies past their folds: the guess was, and the determinant does not tell.
            if ended.at == End::Solved && ended.turns == 0 {
                return Ok(ended.report);
            }
            before = ended.report.iterations;
            work.forget();
        }
        let mut ended = work.follow::<R>(lagrangian, (state, h), goal);
        ended.report.iterations += before;
        let coordinate = match ended.at {
            End::Solved => match work.solver.degenerate() {
                None => return Ok(ended.report),
                coordinate => coordinate,
            },
            End::NotFinite => None,
            _ => degenerate(lagrangian, state, h),
        };
        work.forget();
        if let Some(coordinate) = coordinate {
            // What was seen of this state is not so of others.
            self.work = None;
            return Err(StepError::Degenerate {
                step,
                t,
                coordinate,
            });
        }
        Err(failure((step, t, h), goal.tolerance, &ended))
    }
}

/// Refuses a step number `step` of size `h` from `t` that ends at no configuration of the Lagrangian's domain.
fn require_end<L: DiscreteLagrangian>(
    lagrangian: &L,
    end: &L::Group,
    (step, t, h): (u64, f64, f64),
) -> Result<(), StepError> {
    let ends = end.is_finite() && lagrangian.is_defined(t + h, end);
    ends.then_some(())
        .ok_or(StepError::NotFinite { step, t, h })
}

fn failure((step, t, h): (u64, f64, f64), tolerance: f64, ended: &Ended) -> StepError {
    let StepReport {
        iterations,
        residual,
    } = ended.report;
    let hint = match ended.at {
        End::NotFinite => return StepError::NotFinite { step, t, h },
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
        let (step, t) = (self.steps, state.t);
        let balance = &self.work((state.t, h), &state.g).balance;
        let ahead = State {
            t: state.t + h,
            g: state.g.compose(&balance.f),
            mu: balance.transported.clone(),
        };
        require_end(&self.lagrangian, &ahead.g, (step, t, h))?;
        ahead.if_finite(step, t, h)
    }

    fn reset(&mut self) {
        (self.steps, self.work, self.linearised) = (0, None, None);
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
        let work = work.get_or_insert_with(|| Work::new(lagrangian, (state.t, h), &state.g));
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
