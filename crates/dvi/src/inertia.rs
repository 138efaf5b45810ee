//! Quasi-Newton with the model's own inertia.

use lie::{LieGroup, VectorSpace};

use crate::DiscreteLagrangian;
use crate::solver::{Algebra, Dual, StepSolver};

/// A model that solves its inertia, $\mathbb I(g) \xi = \mu$, faster than a dense matrix does.
pub trait Inertia: DiscreteLagrangian {
    /// The factorised inertia at a configuration.
    type Factor;

    /// Storage for a factorisation.
    fn factor(&self) -> Self::Factor;

    /// Factorises $\mathbb I(g)$.
    fn factorise(&self, g: &Self::Group, factor: &mut Self::Factor);

    /// Solves $\mathbb I(g) \xi = \mu$; writes every coordinate of `xi`.
    fn solve(
        &self,
        factor: &Self::Factor,
        mu: &<Self::Group as LieGroup>::Dual,
        xi: &mut <Self::Group as LieGroup>::Algebra,
    );

    /// Solves the equations of the [cyclic](DiscreteLagrangian::cyclic) coordinates exactly: sets those of `f`
    /// such that $\mathbf D_f L_d = \mu$ in them, for the other coordinates of `f` as given.
    ///
    /// A model with cyclic coordinates that offers its inertia must implement it.
    fn eliminate(
        &self,
        factor: &Self::Factor,
        mu: &<Self::Group as LieGroup>::Dual,
        h: f64,
        f: &mut Self::Group,
    );
}

/// Quasi-Newton with the matrix $\mathbb I(g_k)/h$: one factorisation a step, contraction by a factor of the order of $h |\xi|$.
pub struct FrozenInertia<L: Inertia> {
    factor: L::Factor,
    h: f64,
}

impl<L: Inertia> StepSolver<L> for FrozenInertia<L> {
    fn allocate(lagrangian: &L, _: &L::Group) -> Self {
        Self {
            factor: lagrangian.factor(),
            h: 0.0,
        }
    }

    #[inline(always)]
    fn begin(&mut self, lagrangian: &L, g: &L::Group, _: &Dual<L>, h: f64) {
        lagrangian.factorise(g, &mut self.factor);
        self.h = h;
    }

    #[inline(always)]
    fn eliminate(&self, lagrangian: &L, mu: &Dual<L>, h: f64, f: &mut L::Group) {
        lagrangian.eliminate(&self.factor, mu, h, f);
    }

    #[inline(always)]
    fn solve(&mut self, lagrangian: &L, residual: &Dual<L>, delta: &mut Algebra<L>) {
        lagrangian.solve(&self.factor, residual, delta);
        scale(delta, self.h);
    }
}

#[inline(always)]
fn scale<V: VectorSpace<Scalar = f64>>(x: &mut V, a: f64) {
    for i in 0..x.dim() {
        x.set(i, a * x.get(i));
    }
}
