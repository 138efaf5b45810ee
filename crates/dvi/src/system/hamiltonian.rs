//! Hamilton's equations of a Lagrangian of which only the value is given.

use core::fmt::Debug;
use std::sync::Arc;

use lie::{AlgebraOver, DualOver, LieGroup, Over, Scalar, VectorSpace};

use super::context::{Adapter, Context, System};
use super::continuous::{ContinuousSystem, Means};
use super::dual_system::{DualSystem, LegendreWorkspace, velocity_and_force as by_duals};
use super::lagrangian::{HamiltonianSystem, Lagrangian};
use super::state::State;
use super::traced::{
    Pivot, Programs, TracedError, TracedWorkspace, Whose, read_rates, without_inertia,
};

impl<L: System + Debug> Debug for HamiltonianSystem<L> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("HamiltonianSystem")
            .field(&self.lagrangian)
            .finish()
    }
}

impl<L: Lagrangian> HamiltonianSystem<L> {
    /// The velocity of a state; not a number where there is none.
    pub fn velocity(&self, state: &State<L::Group>) -> <L::Group as LieGroup>::Algebra {
        let State { t, g, mu } = state;
        let at = Context::new(*t, self.lagrangian.parameters());
        let found = self.programs(g).ok().and_then(|p| p.rates(at, g, mu));
        let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
        read_rates(found.as_deref(), &mut xi, &mut tau);
        if xi.max_magnitude().is_finite() {
            return xi;
        }
        self.by_duals().velocity(state)
    }

    /// The energy of a state, in joules; not a number where there is no velocity.
    pub fn energy(&self, state: &State<L::Group>) -> f64 {
        let State { t, g, mu } = state;
        let at = Context::new(*t, self.lagrangian.parameters());
        let found = self.programs(g).ok().and_then(|p| p.energy(at, g, mu));
        let finite = found.filter(|energy| energy.is_finite());
        finite.unwrap_or_else(|| self.by_duals().energy(state))
    }

    fn by_duals(&self) -> DualSystem<&L> {
        DualSystem(&self.lagrangian)
    }

    /// What is recorded for the shape of `g`.
    fn programs(&self, g: &L::Group) -> Result<Arc<Programs>, TracedError> {
        self.recorded
            .find(g, Whose::THE_ONLY, || Programs::of(&self.lagrangian, g))
    }
}

/// Storage of a [`HamiltonianSystem`], for either way to get the derivatives.
pub struct HamiltonianWorkspace<L: Lagrangian, S: Scalar> {
    recorded: TracedWorkspace<L::Group, S>,
    by_duals: LegendreWorkspace<L, S>,
}

impl<L: Lagrangian, S: Scalar> Default for HamiltonianWorkspace<L, S> {
    fn default() -> Self {
        Self {
            recorded: TracedWorkspace::default(),
            by_duals: LegendreWorkspace::default(),
        }
    }
}

impl<L: Lagrangian> Adapter for HamiltonianSystem<L> {
    type Inner = L;

    fn inner(&self) -> &L {
        &self.lagrangian
    }
}

impl<L: Lagrangian> ContinuousSystem for HamiltonianSystem<L> {
    type Workspace<S: Scalar> = HamiltonianWorkspace<L, S>;
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        mu: &DualOver<L::Group, S>,
        work: &mut HamiltonianWorkspace<L, S>,
        xi: &mut AlgebraOver<L::Group, S>,
        tau: &mut DualOver<L::Group, S>,
    ) {
        // The shape alone matters.
        let shape = || L::Group::convert::<S, f64>(g, |_| 0.0);
        let find = || self.programs(&shape()).ok();
        let found = work.recorded.run(find, at, g, mu);
        let is_finite = |out: &&[S]| out.iter().all(|x| x.magnitude().is_finite());
        // Steps run in lanes by what is recorded alone.
        if !S::IS_SINGLE || found.as_ref().is_some_and(is_finite) {
            return read_rates(found, xi, tau);
        }
        let work = &mut work.by_duals;
        by_duals(&self.lagrangian, (at, g, mu), work, (xi, tau));
    }

    fn is_defined(&self, t: f64, g: &L::Group) -> bool {
        self.by_duals().is_defined(t, g)
    }

    fn without_inertia(&self, t: f64, g: &L::Group) -> Option<usize> {
        match self.programs(g) {
            Ok(programs) => without_inertia(&self.lagrangian, &programs, (t, g)),
            Err(_) => self.by_duals().without_inertia(t, g),
        }
    }

    /// By dual numbers also where a pivot of the inertia at `g` is negative; and from then on, for this shape.
    fn means(&self, t: f64, g: &L::Group) -> Means {
        let at = Context::new(t, self.lagrangian.parameters());
        let why = match self.programs(g).map(|programs| programs.pivot(at, g)) {
            Ok(Some((coordinate, Pivot::Negative))) => {
                let why = TracedError::Indefinite { coordinate };
                self.recorded.refuse(g, Whose::THE_ONLY, why);
                why
            }
            Ok(_) => return Means::Recorded,
            Err(why) => why,
        };
        Means::DualNumbers { why: Some(why) }
    }
}
