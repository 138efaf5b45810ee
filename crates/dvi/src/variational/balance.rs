//! The momentum balance that a step solves.

use lie::{AlgebraOver, Cayley, DualOver, LieGroup, Over, Scalar, VectorSpace};

use crate::numerics::duals::lift;
use crate::system::DiscreteCache;
use crate::{Context, Derivatives, DiscreteLagrangian};

/// The discrete Euler–Lagrange equations (25) at one step, in momentum form and in the frame of the step's end.
///
/// With $f = \tau(c)$, $\tau$ the Cayley map, the residual is
/// $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d - \mathrm{Ad}^\ast_f \left(\mu_k + \mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d\right)$,
/// and the transported momentum in it is $\mu_{k+1}$ where the residual vanishes.
pub(crate) struct Balance<L: DiscreteLagrangian, S: Scalar> {
    pub(crate) f: Over<L::Group, S>,
    pub(crate) parameters: Vec<S>,
    pub(crate) workspace: L::Workspace<S>,
    pub(crate) derivatives: Derivatives<L::Group, S>,
    /// $\mathrm{Ad}^\ast_f (\mu_k + d_g)$.
    pub(crate) transported: DualOver<L::Group, S>,
    /// $d_f - \mathrm{Ad}^\ast_f (\mu_k + d_g)$.
    pub(crate) residual: DualOver<L::Group, S>,
    momentum: DualOver<L::Group, S>,
}

impl<L: DiscreteLagrangian, S: Scalar> Balance<L, S> {
    pub(crate) fn new(g: &Over<L::Group, S>, cache: DiscreteCache<L::Group>) -> Self {
        Self {
            f: g.clone(),
            parameters: Vec::new(),
            workspace: Default::default(),
            derivatives: Derivatives::with_cache(g, cache),
            transported: g.zero_dual(),
            residual: g.zero_dual(),
            momentum: g.zero_dual(),
        }
    }

    /// Takes over the parameters of the system.
    pub(crate) fn set_parameters(&mut self, lagrangian: &L) {
        lift(lagrangian.parameters(), S::from_f64, &mut self.parameters);
    }

    #[inline(always)]
    pub(crate) fn retract(&mut self, c: &AlgebraOver<L::Group, S>) {
        Over::<L::Group, S>::retract_into::<Cayley>(c, &mut self.f);
    }

    /// Fills all fields from `f`.
    #[inline(always)]
    pub(crate) fn evaluate(
        &mut self,
        lagrangian: &L,
        t: S,
        g: &Over<L::Group, S>,
        mu: &DualOver<L::Group, S>,
        h: S,
    ) {
        let (at, work) = (Context::new(t, &self.parameters), &mut self.workspace);
        self.derivatives.settle(lagrangian);
        self.derivatives.find(lagrangian, at, (g, &self.f), h, work);
        self.transport(mu);
    }

    /// The transported momentum and the residual from the derivatives.
    #[inline(always)]
    pub(crate) fn transport(&mut self, mu: &DualOver<L::Group, S>) {
        self.momentum.set_sum(mu, S::one(), &self.derivatives.d_g);
        self.f.coadjoint_into(&self.momentum, &mut self.transported);
        self.residual
            .set_sum(&self.derivatives.d_f, -S::one(), &self.transported);
    }
}
