//! The momentum balance that a step solves.

use lie::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, Retraction, Scalar, VectorSpace};

use crate::{Derivatives, DiscreteLagrangian};

/// The discrete Euler–Lagrange equations (25) at one step, in momentum form and in the frame of the step's end.
///
/// With $f = \tau(c)$, the residual is
/// $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d - \mathrm{Ad}^\ast_f \left(\mu_k + \mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d\right)$,
/// and the transported momentum in it is $\mu_{k+1}$ where the residual vanishes.
pub(crate) struct Balance<G: RealGroup, S: Scalar> {
    pub(crate) f: Over<G, S>,
    pub(crate) derivatives: Derivatives<G, S>,
    /// $\mathrm{Ad}^\ast_f (\mu_k + d_g)$.
    pub(crate) transported: DualOver<G, S>,
    /// $d_f - \mathrm{Ad}^\ast_f (\mu_k + d_g)$.
    pub(crate) residual: DualOver<G, S>,
    momentum: DualOver<G, S>,
}

impl<G: RealGroup, S: Scalar> Balance<G, S> {
    pub(crate) fn new(g: &Over<G, S>) -> Self {
        Self {
            f: g.clone(),
            derivatives: Derivatives::new(g),
            transported: g.zero_dual(),
            residual: g.zero_dual(),
            momentum: g.zero_dual(),
        }
    }

    #[inline(always)]
    pub(crate) fn retract<R: Retraction>(&mut self, c: &AlgebraOver<G, S>) {
        Over::<G, S>::retract_into::<R>(c, &mut self.f);
    }

    /// Fills all fields from `f`.
    #[inline(always)]
    pub(crate) fn evaluate<L: DiscreteLagrangian<Group = G>>(
        &mut self,
        lagrangian: &L,
        t: S,
        g: &Over<G, S>,
        mu: &DualOver<G, S>,
        h: S,
    ) {
        lagrangian.derivatives(t, g, &self.f, h, &mut self.derivatives);
        self.transport(mu);
    }

    /// The transported momentum and the residual from the derivatives.
    #[inline(always)]
    pub(crate) fn transport(&mut self, mu: &DualOver<G, S>) {
        self.momentum.set_sum(mu, S::one(), &self.derivatives.d_g);
        self.f.coadjoint_into(&self.momentum, &mut self.transported);
        self.residual
            .set_sum(&self.derivatives.d_f, -S::one(), &self.transported);
    }
}
