//! Steady motions: relative equilibria of a left-invariant system.

use dvi::State;
use lie::{LieGroup, RealGroup, VectorSpace};

use super::{ProblemError, Solution, checked, finite};

/// The motion of constant velocity, $g(t) = g_0 \exp((t - t_0) \xi)$, $\mu(t) = \mu_0$.
#[derive(Clone, Debug, PartialEq)]
pub struct Steady<G: RealGroup> {
    /// The state at its own time.
    pub start: State<G>,
    /// The velocity $\xi$.
    pub velocity: G::Algebra,
}

impl<G: RealGroup> Solution<G> for Steady<G> {
    fn at(&self, t: f64) -> Result<State<G>, ProblemError> {
        finite("time", &[t])?;
        let mut c = self.velocity.zero_like();
        c.add_scaled(t - self.start.t, &self.velocity);
        let g = self.start.g.compose(&<G as LieGroup>::exp(&c));
        let mu = self.start.mu.clone();
        checked(State { t, g, mu })
    }
}
