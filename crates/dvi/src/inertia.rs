//! Quasi-Newton with the model's own inertia.

use core::ops::Range;

use lie::{LieGroup, Retraction, VectorSpace};

use crate::solver::{Algebra, Dual, StepSolver};
use crate::{Derivatives, DiscreteLagrangian, Newton, State};

/// A model that solves its inertia, $\mathbb I(g) \xi = \mu$, faster than a dense matrix does.
pub trait Inertia: DiscreteLagrangian {
    /// The factorised inertia at a configuration.
    type Factor;

    /// Storage for a factorisation.
    fn factor(&self) -> Self::Factor;

    /// Factorises $\mathbb I(g)$.
    fn factorise(&self, g: &Self::Group, factor: &mut Self::Factor);

    /// Solves $\mathbb I(g) \xi = \mu$; writes every coordinate of `xi`. The factorisation stays as it is: it is lent for the storage in it.
    fn solve(
        &self,
        factor: &mut Self::Factor,
        mu: &<Self::Group as LieGroup>::Dual,
        xi: &mut <Self::Group as LieGroup>::Algebra,
    );

    /// The coordinates that [`eliminate`](Self::eliminate) solves for: the cyclic ones, and others whose $\mathbf D_f L_d$ is linear in
    /// them and whose $\mathbf D_g L_d$ does not depend on `f`.
    fn eliminated(&self) -> Range<usize> {
        self.cyclic()
    }

    /// The [derivatives](DiscreteLagrangian::derivatives) of a step from `state`, where the [eliminated](Self::eliminated)
    /// coordinates of `f`, and the same numbers in its coordinates `c`, are first set so that
    /// $\mathbf D_f L_d = \mu + \mathbf D_g L_d$ holds in them, for the other coordinates of `f` as given. One method, since both
    /// share most of their terms.
    ///
    /// A model with such coordinates must implement it.
    #[inline(always)]
    fn eliminate(
        &self,
        _factor: &mut Self::Factor,
        state: &State<Self::Group>,
        h: f64,
        f: &mut Self::Group,
        _c: &mut <Self::Group as LieGroup>::Algebra,
        out: &mut Derivatives<Self::Group, f64>,
    ) {
        self.derivatives(state.t, &state.g, f, h, out);
    }
}

impl<L: Inertia> Inertia for &L {
    type Factor = L::Factor;

    fn factor(&self) -> L::Factor {
        L::factor(self)
    }
    fn eliminated(&self) -> Range<usize> {
        L::eliminated(self)
    }
    #[inline(always)]
    fn factorise(&self, g: &L::Group, factor: &mut L::Factor) {
        L::factorise(self, g, factor);
    }
    #[inline(always)]
    fn solve(&self, factor: &mut L::Factor, mu: &Dual<L>, xi: &mut Algebra<L>) {
        L::solve(self, factor, mu, xi);
    }
    #[inline(always)]
    fn eliminate(
        &self,
        factor: &mut L::Factor,
        state: &State<L::Group>,
        h: f64,
        f: &mut L::Group,
        c: &mut Algebra<L>,
        out: &mut Derivatives<L::Group, f64>,
    ) {
        L::eliminate(self, factor, state, h, f, c, out);
    }
}

/// The largest dimension for which a dense matrix is built where the inertia is not good enough, or to say why a step failed.
pub(crate) const DENSE_LIMIT: usize = 128;

/// Quasi-Newton with the matrix $\mathbb I(g_k)/h$: one factorisation a step, contraction by a factor of the order of $h |\xi|$.
///
/// Where the step is so long that this converges slowly, the rest of the step takes the exact matrix, as [`Newton`] does.
pub struct FrozenInertia<L: Inertia> {
    factor: L::Factor,
    h: f64,
    /// Made when first needed.
    exact: Option<Newton<L::Group>>,
    takes_exact: bool,
}

impl<L: Inertia> StepSolver<L> for FrozenInertia<L> {
    /// An exact matrix costs as much as tens of iterations.
    const SLOW: f64 = 0.6;

    fn allocate(lagrangian: &L, _: &L::Group) -> Self {
        Self {
            factor: lagrangian.factor(),
            h: 0.0,
            exact: None,
            takes_exact: false,
        }
    }

    fn forget(&mut self) {
        self.takes_exact = false;
    }

    fn exact(&self, lagrangian: &L) -> Range<usize> {
        lagrangian.eliminated()
    }

    fn renew<R: Retraction>(
        &mut self,
        lagrangian: &L,
        state: &State<L::Group>,
        h: f64,
        c: &Algebra<L>,
    ) -> bool {
        if c.dim() > DENSE_LIMIT {
            return false;
        }
        let exact = self
            .exact
            .get_or_insert_with(|| StepSolver::<L>::allocate(lagrangian, &state.g));
        StepSolver::<L>::renew::<R>(exact, lagrangian, state, h, c);
        self.takes_exact = true;
        true
    }

    fn turns(&self) -> usize {
        let exact = self.exact.as_ref().filter(|_| self.takes_exact);
        exact.map_or(0, StepSolver::<L>::turns)
    }

    fn degenerate(&self) -> Option<usize> {
        self.exact.as_ref().and_then(StepSolver::<L>::degenerate)
    }

    #[inline(always)]
    fn begin(&mut self, lagrangian: &L, state: &State<L::Group>, h: f64) {
        lagrangian.factorise(&state.g, &mut self.factor);
        (self.h, self.takes_exact) = (h, false);
    }

    #[inline(always)]
    fn derivatives(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        f: &mut L::Group,
        c: &mut Algebra<L>,
        out: &mut Derivatives<L::Group, f64>,
    ) {
        lagrangian.eliminate(&mut self.factor, state, h, f, c, out);
    }

    #[inline(always)]
    fn solve(&mut self, lagrangian: &L, residual: &Dual<L>, delta: &mut Algebra<L>) {
        match &mut self.exact {
            Some(exact) if self.takes_exact => exact.solve(lagrangian, residual, delta),
            _ => {
                lagrangian.solve(&mut self.factor, residual, delta);
                delta.scale(self.h);
            }
        }
    }
}
