//! A system and a force that acts on it.

use lie::{AlgebraOver, DualOver, LieGroup, Over, Scalar, VectorSpace};

use super::context::{Adapter, Context, System};
use super::continuous::{ContinuousSystem, Means};
use super::discrete::{Derivatives, DiscreteLagrangian};
use super::force::{DiscreteForce, Force};
use super::lagrangian::Discretised;
use super::state::Still;

/// A system and a force that acts on it: a discrete Lagrangian with a [`DiscreteForce`], a [`ContinuousSystem`] with a [`Force`].
///
/// Made by [`Discretised::with_force`], which takes the rule of the Lagrangian for the force too, or from its two parts.
///
/// The discrete Lagrange–d'Alembert principle adds $f_d^-$ to the momentum that enters a step and $f_d^+$ to the one that
/// leaves it. In the step's balance that is the same as adding $f_d^- + \mathrm{Ad}^\ast_{f^{-1}} f_d^+$ to
/// $\mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d$ and $f_d^+$ to $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d$: the
/// carried momentum then contains the impulses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forced<L, F> {
    /// The system without the force.
    pub system: L,
    /// The force.
    pub force: F,
}

impl<L, F> Forced<L, F> {
    /// The system with the force.
    pub fn new(system: L, force: F) -> Self {
        Self { system, force }
    }
}

impl<L, R> Discretised<L, R> {
    /// The system with a force, by the same rule: discrete Lagrange–d'Alembert.
    pub fn with_force<F: Force>(self, force: F) -> Forced<Self, Discretised<F, R>> {
        let force = Discretised::new(force, self.rule).with_retraction();
        Forced::new(self, force)
    }
}

/// Storage of the system, for the force, and of the force's own.
pub struct ForcedWorkspace<W, V, F = ()> {
    system: W,
    /// $f_d^-$ and $f_d^+$, or $F$ alone; then $f_d^+$ at the start of the step.
    force: Option<[V; 3]>,
    of_force: F,
}

impl<W: Default, V, F: Default> Default for ForcedWorkspace<W, V, F> {
    fn default() -> Self {
        Self {
            system: W::default(),
            force: None,
            of_force: F::default(),
        }
    }
}

impl<W, V: VectorSpace, F> ForcedWorkspace<W, V, F> {
    /// Room for a force, zero.
    #[inline(always)]
    fn force(&mut self, zero: impl Fn() -> V) -> (&mut [V; 3], &mut F) {
        let force = self.force.get_or_insert_with(|| [zero(), zero(), zero()]);
        force[..2].iter_mut().for_each(V::set_zero);
        (force, &mut self.of_force)
    }
}

impl<L: System, F> Adapter for Forced<L, F> {
    type Inner = L;
    const STAYS_SYMPLECTIC: bool = false;

    fn inner(&self) -> &L {
        &self.system
    }
}

impl<L, F> DiscreteLagrangian for Forced<L, F>
where
    L: DiscreteLagrangian,
    F: DiscreteForce<Group = L::Group>,
{
    type Workspace<S: Scalar> =
        ForcedWorkspace<L::Workspace<S>, DualOver<L::Group, S>, F::Workspace<S>>;
    const HAS_INERTIA: bool = L::HAS_INERTIA;

    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
    ) -> S {
        self.system.value(at, g, f, h)
    }

    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
        work: &mut Self::Workspace<S>,
        out: &mut Derivatives<L::Group, S>,
    ) {
        self.system.derivatives(at, g, f, h, &mut work.system, out);
        let ([minus, plus, moved], own) = work.force(|| g.zero_dual());
        let impulses = [&mut *minus, &mut *plus];
        self.force.impulses(at, g, f, h, own, impulses);
        out.d_f.add_scaled(S::one(), plus);
        out.d_g.add_scaled(S::one(), minus);
        f.inverse_coadjoint_into(plus, moved);
        out.d_g.add_scaled(S::one(), moved);
    }

    fn is_defined(&self, t: f64, g: &L::Group, still: &Still<L::Group>) -> bool {
        self.system.is_defined(t, g, still)
    }
    fn order(&self) -> u32 {
        self.system.order().min(self.force.order())
    }
    fn is_symmetric(&self) -> bool {
        self.system.is_symmetric() && self.force.is_symmetric()
    }

    fn factorise(&self, step: (f64, f64), g: &L::Group, work: &mut Self::Workspace<f64>) {
        self.system.factorise(step, g, &mut work.system);
    }
    fn solve(
        &self,
        work: &mut Self::Workspace<f64>,
        mu: &<L::Group as LieGroup>::Dual,
        xi: &mut <L::Group as LieGroup>::Algebra,
    ) {
        self.system.solve(&mut work.system, mu, xi);
    }
    fn solve_cyclic(
        &self,
        work: &mut Self::Workspace<f64>,
        mu: &<L::Group as LieGroup>::Dual,
        xi: &mut <L::Group as LieGroup>::Algebra,
    ) {
        self.system.solve_cyclic(&mut work.system, mu, xi);
    }
}

impl<L, F> ContinuousSystem for Forced<L, F>
where
    L: ContinuousSystem,
    F: Force<Group = L::Group>,
{
    type Workspace<S: Scalar> = ForcedWorkspace<L::Workspace<S>, DualOver<L::Group, S>>;
    const INLINE: bool = L::INLINE && F::INLINE;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        mu: &DualOver<L::Group, S>,
        work: &mut Self::Workspace<S>,
        xi: &mut AlgebraOver<L::Group, S>,
        tau: &mut DualOver<L::Group, S>,
    ) {
        let system = &mut work.system;
        self.system.velocity_and_force(at, g, mu, system, xi, tau);
        let ([force, ..], ()) = work.force(|| g.zero_dual());
        self.force.force(at, g, xi, force);
        tau.add_scaled(S::one(), force);
    }

    fn is_defined(&self, t: f64, g: &L::Group) -> bool {
        self.system.is_defined(t, g)
    }
    fn without_inertia(&self, t: f64, g: &L::Group) -> Option<usize> {
        self.system.without_inertia(t, g)
    }
    fn means(&self, t: f64, g: &L::Group) -> Means {
        self.system.means(t, g)
    }
}
