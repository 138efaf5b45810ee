//! The matrix of the iteration that solves a step.

use core::ops::Range;

use lie::VectorSpace;

use super::newton::{DENSE_LIMIT, Newton, cyclic};
use crate::system::{Algebra, DiscreteCache, Dual};
use crate::{Context, Derivatives, DiscreteLagrangian, State};

/// The matrix of a quasi-Newton iteration on the momentum balance, in the coordinates $c$ of $f = \tau(c)$.
///
/// A model that [has an inertia](DiscreteLagrangian::HAS_INERTIA) gives $\mathbb I(g_k)/h$: one factorisation a step, contraction by a
/// factor of the order of $h |\xi|$. Where the step is so long that this converges slowly, the rest of the step takes the exact
/// matrix; without such an inertia, all of it.
pub(super) struct Matrix<L: DiscreteLagrangian> {
    h: f64,
    /// Whether no coordinate is solved for exactly.
    keeps_all: bool,
    /// With an inertia, made when first needed.
    exact: Option<Newton<L>>,
    takes_exact: bool,
    cache: DiscreteCache<L::Group>,
    /// Of the derivatives, for the matrices of this step; see [`StepReport::evaluations`](crate::StepReport::evaluations).
    pub(super) evaluations: u32,
}

impl<L: DiscreteLagrangian> Matrix<L> {
    /// A contraction slower than this asks for a [new matrix](Self::renew): an exact one costs as much as tens of iterations.
    pub(super) const SLOW: f64 = if L::HAS_INERTIA { 0.6 } else { 0.2 };

    pub(super) fn new(g: &L::Group, (cache, keeps_all): (DiscreteCache<L::Group>, bool)) -> Self {
        Self {
            h: 0.0,
            keeps_all,
            exact: (!L::HAS_INERTIA).then(|| Newton::new(g, cache.clone())),
            cache,
            takes_exact: !L::HAS_INERTIA,
            evaluations: 0,
        }
    }

    /// The exact matrix, where it is taken.
    fn taken(&self) -> Option<&Newton<L>> {
        self.exact.as_ref().filter(|_| self.takes_exact)
    }

    /// Prepares the step of size `h` from `state`.
    #[inline(always)]
    pub(super) fn begin(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        work: &mut L::Workspace<f64>,
    ) {
        if L::HAS_INERTIA {
            lagrangian.factorise((state.t, h), &state.g, work);
            (self.h, self.takes_exact) = (h, false);
        } else if let Some(exact) = &mut self.exact {
            exact.begin(h);
        }
    }

    /// Forgets what steps before have left.
    pub(super) fn forget(&mut self) {
        self.takes_exact = !L::HAS_INERTIA;
        if let Some(exact) = self.exact.as_mut().filter(|_| !L::HAS_INERTIA) {
            exact.forget();
        }
    }

    /// Whether there is no matrix yet that fits the step's size.
    pub(super) fn is_stale(&self) -> bool {
        !L::HAS_INERTIA && self.exact.as_ref().is_some_and(Newton::is_stale)
    }

    /// The coordinates whose equation [`derivatives`](Self::derivatives) or [`solve_cyclic`](Self::solve_cyclic) solves to rounding: the
    /// others are judged without them, since they may have another unit and be larger by far.
    pub(super) fn solved_exactly(&self, lagrangian: &L, dim: usize) -> Range<usize> {
        match (self.keeps_all, self.eliminates(lagrangian)) {
            (true, _) => 0..0,
            (false, true) => lagrangian.eliminated(),
            (false, false) => cyclic(lagrangian, dim),
        }
    }

    /// Whether [`derivatives`](Self::derivatives) solves for coordinates.
    #[inline(always)]
    pub(super) fn eliminates(&self, lagrangian: &L) -> bool {
        L::HAS_INERTIA && !self.keeps_all && !lagrangian.eliminated().is_empty()
    }

    /// The derivatives at $f = \tau(c)$; the eliminated coordinates of both are solved for first.
    #[inline(always)]
    pub(super) fn derivatives(
        &self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        (parameters, work): (&[f64], &mut L::Workspace<f64>),
        (f, c): (&mut L::Group, &mut Algebra<L>),
        out: &mut Derivatives<L::Group, f64>,
    ) {
        out.settle(lagrangian);
        if self.eliminates(lagrangian) {
            lagrangian.eliminate(work, (state, h), f, c, out);
        } else {
            let at = Context::new(state.t, parameters);
            lagrangian.derivatives(at, &state.g, f, h, work, out);
        }
    }

    /// Renews the matrix at `c`; false where it stays as it is.
    pub(super) fn renew(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        c: &Algebra<L>,
    ) -> bool {
        if L::HAS_INERTIA && c.dim() > DENSE_LIMIT {
            return false;
        }
        let new = || Newton::new(&state.g, self.cache.clone());
        let exact = self.exact.get_or_insert_with(new);
        exact.renew(lagrangian, state, h, c);
        self.takes_exact = true;
        self.evaluations += exact.evaluations();
        true
    }

    /// See [`Newton::turns`].
    pub(super) fn turns(&self) -> usize {
        self.taken().map_or(0, Newton::turns)
    }

    /// A coordinate along which the kinetic energy was seen to have no inertia, if any.
    pub(super) fn degenerate(&self) -> Option<usize> {
        self.exact.as_ref().and_then(Newton::degenerate)
    }

    /// The correction $\delta$ that the linearised residual asks for; `c - delta` is the next iterate.
    #[inline(always)]
    pub(super) fn solve(
        &mut self,
        lagrangian: &L,
        work: &mut L::Workspace<f64>,
        residual: &Dual<L>,
        delta: &mut Algebra<L>,
    ) {
        match &mut self.exact {
            Some(exact) if self.takes_exact => exact.solve(residual, delta),
            _ => {
                lagrangian.solve(work, residual, delta);
                delta.scale(self.h);
            }
        }
    }

    /// The correction of the cyclic coordinates alone, zero elsewhere; false where there are none to correct.
    pub(super) fn solve_cyclic(
        &mut self,
        lagrangian: &L,
        work: &mut L::Workspace<f64>,
        residual: &Dual<L>,
        delta: &mut Algebra<L>,
    ) -> bool {
        let cyclic = cyclic(lagrangian, delta.dim());
        if cyclic.is_empty() || self.keeps_all {
            return false;
        }
        match &mut self.exact {
            Some(exact) if self.takes_exact => exact.solve_cyclic(residual, cyclic, delta),
            _ => {
                lagrangian.solve_cyclic(work, residual, delta);
                delta.scale(self.h);
            }
        }
        true
    }
}
