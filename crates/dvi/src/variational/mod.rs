//! The Lie group variational integrator of a discrete Lagrangian: (25)–(26) in both forms.

mod balance;
mod linearised;
mod matrix;
mod newton;
mod solve;
mod sparsity;
mod warm_start;

use lie::{LieGroup, VectorSpace};

use crate::step::{check_call, check_shape, check_step, finite};
use crate::system::DiscreteCache;
use crate::{
    Cause, DiscreteLagrangian, FirstVariation, Hint, Integrator, Pair, State, StepError,
    StepReport, Still, Variation, legendre_plus,
};
use linearised::Linearised;
pub(crate) use newton::degenerate;
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
/// for $f_k = \tau(c)$. Then $g_{k+1} = g_k f_k$, and $\mu_{k+1}$ is the right-hand side. The momentum is *carried* by the
/// coadjoint transport: the momentum map holds to rounding even where the balance holds to a tolerance only.
/// This is (25)–(26) of Lee, Leok & McClamroch (2009) in the form (39)–(46).
///
/// The first step allocates; later ones do not, unless the state's shape changes or a long step needs another matrix
/// for the first time.
///
/// The matrix of the iteration is the model's own inertia, where it [has one](DiscreteLagrangian::HAS_INERTIA): a tree of N bodies then steps
/// in O(N). Else it comes from dual numbers; it is sparse where the recorded balance is, and dense elsewhere.
pub struct Variational<L: DiscreteLagrangian> {
    lagrangian: L,
    tolerance: Option<f64>,
    keeps_all: bool,
    /// What is recorded of the discrete Lagrangian.
    cache: DiscreteCache<L::Group>,
    steps: u64,
    work: Option<Work<L>>,
    linearised: Option<Linearised<L>>,
}

impl<L: DiscreteLagrangian> Variational<L> {
    /// The integrator of a discrete Lagrangian.
    pub fn new(lagrangian: L) -> Self {
        Self {
            lagrangian,
            tolerance: None,
            keeps_all: false,
            cache: DiscreteCache::default(),
            steps: 0,
            work: None,
            linearised: None,
        }
    }

    /// The largest error of a solved step, relative; unless set, 1e-13 for up to 12 coordinates and growing as their root, as rounding
    /// does.
    ///
    /// What is judged is the residual relative to the momentum, of all coordinates together. Each rotation and each vector of a
    /// product is judged by itself too, to ten times the tolerance. So neither units nor the ratio of masses matter. A correction that is negligible
    /// beside the displacement is enough too.
    ///
    /// Unless a tolerance is set, a residual that no longer shrinks is also taken for solved where rounding explains it. That is so where it
    /// is at most 16 times what moving every number of the state by two units of its last place makes of it.
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = Some(tolerance);
        self
    }

    /// The same with all coordinates among the unknowns, and none solved for exactly: to measure what that saves.
    pub fn with_all_unknowns(mut self) -> Self {
        (self.keeps_all, self.work) = (true, None);
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
        let work = Self::work_of(
            &self.lagrangian,
            &mut self.work,
            (state, h),
            (&self.cache, self.keeps_all),
        );
        let f = work.balance.f.clone();
        let end = state.g.compose(&f);
        let ends = require_end(&self.lagrangian, state.t + h, &end, &work.still);
        ends.map_err(|cause| self.error(state.t, h, cause))?;
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
        let (t, h) = (pair.t, pair.h);
        let next = self.end_of(pair);
        let next = next.map_err(|cause| self.error(t, h, cause))?;
        let report = self.solve(&next, h)?;
        let f = &self.work(&next, h).balance.f;
        if !f.is_finite() {
            return Err(self.error(t, h, Cause::NotFinite));
        }
        pair.f.clone_from(f);
        (pair.t, pair.g) = (next.t, next.g);
        self.accept(h);
        Ok(report)
    }

    /// The state at the end of a pair.
    fn end_of(&self, Pair { t, h, g, f }: &Pair<L::Group>) -> Result<State<L::Group>, Cause> {
        check_step(&self.lagrangian, (*t, g), *h)?;
        let mut next = State {
            t: t + h,
            g: g.compose(f),
            mu: legendre_plus(&self.lagrangian, *t, g, f, *h),
        };
        if self.normalizes() {
            next.g.normalize();
        }
        require_end(&self.lagrangian, next.t, &next.g, &Still::at(g))?;
        Ok(next)
    }

    /// Takes the step that was solved.
    fn advance(&mut self, state: &mut State<L::Group>, h: f64) -> Result<(), StepError> {
        let normalizes = self.normalizes();
        let work = Self::work_of(
            &self.lagrangian,
            &mut self.work,
            (state, h),
            (&self.cache, self.keeps_all),
        );
        state.g.compose_into(&work.balance.f, &mut work.next);
        if normalizes {
            work.next.normalize();
        }
        let ends = require_end(&self.lagrangian, state.t + h, &work.next, &work.still);
        ends.map_err(|cause| cause.at((self.steps, state.t, h)))?;
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
    fn work(&mut self, state: &State<L::Group>, h: f64) -> &mut Work<L> {
        Self::work_of(
            &self.lagrangian,
            &mut self.work,
            (state, h),
            (&self.cache, self.keeps_all),
        )
    }

    /// The storage for states of this shape, made when there is none.
    fn work_of<'a>(
        lagrangian: &L,
        work: &'a mut Option<Work<L>>,
        (state, h): (&State<L::Group>, f64),
        (cache, keeps_all): (&DiscreteCache<L::Group>, bool),
    ) -> &'a mut Work<L> {
        let new = || {
            Work::new(
                lagrangian,
                (state.t, h),
                &state.g,
                (cache.clone(), keeps_all),
            )
        };
        work.get_or_insert_with(new)
    }

    fn error(&self, t: f64, h: f64, cause: Cause) -> StepError {
        cause.at((self.steps, t, h))
    }

    /// Solves the balance; the state stays as it is.
    fn solve(&mut self, state: &State<L::Group>, h: f64) -> Result<StepReport, StepError> {
        let solved = self.try_to_solve(state, h);
        solved.map_err(|cause| self.error(state.t, h, cause))
    }

    /// From the extrapolated guess, and from no displacement where that leads nowhere or astray.
    fn try_to_solve(&mut self, state: &State<L::Group>, h: f64) -> Result<StepReport, Cause> {
        // Of numbers that are not finite, the first residual or the end of the step is not.
        check_call(&self.lagrangian, (state.t, &state.g), h)?;
        let fits = |work: &Work<L>| work.next.same_shape(&state.g);
        if !self.work.as_ref().is_some_and(fits) {
            self.work = None;
        }
        let lagrangian = &self.lagrangian;
        let work = Self::work_of(
            lagrangian,
            &mut self.work,
            (state, h),
            (&self.cache, self.keeps_all),
        );
        check_shape(&state.mu, &work.balance.residual)?;
        let few = (state.mu.dim() as f64 / FEW).sqrt().max(1.0);
        let goal = Goal {
            tolerance: self.tolerance.unwrap_or(TOLERANCE * few),
            accepts_rounding: self.tolerance.is_none(),
        };
        work.matrix.evaluations = 0;
        let mut before = 0;
        if work.warm.guess(h, &mut work.coordinates) {
            work.begin(lagrangian, (state, h));
            work.c.read(&work.coordinates);
            let ended = work.iterate(lagrangian, (state, h), goal);
            // An even number may be two bodies past their folds: the guess was, and the determinant does not tell.
            if ended.at == End::Solved && ended.turns == 0 {
                return Ok(counted(ended.report, work));
            }
            before = ended.report.iterations;
            work.forget();
        }
        let mut ended = work.follow(lagrangian, (state, h), goal);
        ended.report.iterations += before;
        let coordinate = match ended.at {
            End::Solved => match work.matrix.degenerate() {
                None => return Ok(counted(ended.report, work)),
                coordinate => coordinate,
            },
            End::NotFinite => None,
            _ => degenerate(lagrangian, state, h, &self.cache),
        };
        work.forget();
        if let Some(coordinate) = coordinate {
            // What was seen of this state is not so of others.
            self.work = None;
            return Err(Cause::Degenerate { coordinate });
        }
        Err(failure(h, goal.tolerance, &ended))
    }
}

/// Refuses a step that ends at no configuration of the Lagrangian's domain.
fn require_end<L: DiscreteLagrangian>(
    lagrangian: &L,
    t: f64,
    end: &L::Group,
    still: &Still<L::Group>,
) -> Result<(), Cause> {
    let ends = end.is_finite() && lagrangian.is_defined(t, end, still);
    ends.then_some(()).ok_or(Cause::NotFinite)
}

/// With the evaluations of iterations and matrices.
fn counted<L: DiscreteLagrangian>(report: StepReport, work: &Work<L>) -> StepReport {
    StepReport {
        evaluations: report.iterations + work.matrix.evaluations,
        means: work.balance.derivatives.means,
        ..report
    }
}

fn failure(h: f64, tolerance: f64, ended: &Ended) -> Cause {
    let StepReport {
        iterations,
        residual,
        ..
    } = ended.report;
    let hint = match ended.at {
        End::NotFinite => return Cause::NotFinite,
        End::AnotherBranch => Hint::AnotherBranch { h: h / 4.0 },
        _ if is_rounding(residual, tolerance) => Hint::LooserTolerance {
            tolerance: 2.0 * residual,
        },
        _ => Hint::SmallerStep { h: h / 4.0 },
    };
    Cause::NotConverged {
        residual,
        iterations,
        hint,
    }
}

impl<L: DiscreteLagrangian> Integrator for Variational<L> {
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
        let work = Self::work_of(
            &self.lagrangian,
            &mut self.work,
            (state, h),
            (&self.cache, self.keeps_all),
        );
        let balance = &work.balance;
        let ahead = State {
            t: state.t + h,
            g: state.g.compose(&balance.f),
            mu: balance.transported.clone(),
        };
        let ends = require_end(&self.lagrangian, ahead.t, &ahead.g, &work.still);
        let ahead = ends.and_then(|()| finite(ahead));
        ahead.map_err(|cause| self.error(state.t, h, cause))
    }

    fn reset(&mut self) {
        (self.steps, self.work, self.linearised) = (0, None, None);
    }
}

impl<L: DiscreteLagrangian> FirstVariation for Variational<L> {
    fn step_varied(
        &mut self,
        state: &mut State<L::Group>,
        variations: &mut [Variation<L::Group>],
        h: f64,
    ) -> Result<StepReport, StepError> {
        let report = self.solve(state, h)?;
        let mut carried = variations.to_vec();
        let fits = |known: &Linearised<L>| known.fits(&state.g);
        let new = || Linearised::new(&state.g, self.cache.clone());
        let mut linearised = self.linearised.take().filter(fits).unwrap_or_else(new);
        let lagrangian = &self.lagrangian;
        let work = Self::work_of(
            lagrangian,
            &mut self.work,
            (state, h),
            (&self.cache, self.keeps_all),
        );
        linearised.carry(lagrangian, (state, h), &work.c, &mut carried);
        self.linearised = Some(linearised);
        if !carried.iter().all(Variation::is_finite) {
            return Err(self.error(state.t, h, Cause::NotFinite));
        }
        self.advance(state, h)?;
        variations.clone_from_slice(&carried);
        Ok(report)
    }
}
