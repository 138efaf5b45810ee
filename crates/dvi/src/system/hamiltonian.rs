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
    Pivot, Recording, TracedError, TracedSystem, TracedWorkspace, read_rates, without_inertia,
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
        let traced = self.traced(g).ok();
        let found = traced.and_then(|s| s.programs.rates(at, g, mu));
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
        let traced = self.traced(g).ok();
        let found = traced.and_then(|s| s.programs.energy(at, g, mu));
        let finite = found.filter(|energy| energy.is_finite());
        finite.unwrap_or_else(|| self.by_duals().energy(state))
    }

    fn by_duals(&self) -> DualSystem<&L> {
        DualSystem(&self.lagrangian)
    }

    /// What is recorded for the shape of `g`.
    fn traced(&self, g: &L::Group) -> Result<Arc<Recording<L::Group>>, TracedError> {
        let record = || Ok(TracedSystem::new(&self.lagrangian, g)?.into_recording());
        self.recorded.find(g, (), record)
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
    const IS_RECORDED: bool = true;

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
        let find = || Some(self.traced(&shape()).ok()?.programs.clone());
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
        match self.traced(g) {
            Ok(traced) => without_inertia(&self.lagrangian, &traced.programs, (t, g)),
            Err(_) => self.by_duals().without_inertia(t, g),
        }
    }

    fn means(&self, t: f64, g: &L::Group) -> Means {
        self.recorded(t, g).err().unwrap_or(Means::Recorded)
    }

    /// None also where a pivot of the inertia at `g` is negative; and from then on, for this shape.
    fn recorded(&self, t: f64, g: &L::Group) -> Result<Recording<L::Group>, Means> {
        let at = Context::new(t, self.lagrangian.parameters());
        let why = match self.traced(g) {
            Ok(traced) => match traced.programs.pivot(at, g) {
                Some((coordinate, Pivot::Negative)) => {
                    let why = TracedError::Indefinite { coordinate };
                    self.recorded.refuse(g, (), why);
                    why
                }
                _ => return Ok(Recording::clone(&traced)),
            },
            Err(why) => why,
        };
        Err(Means::DualNumbers { why: Some(why) })
    }
}
