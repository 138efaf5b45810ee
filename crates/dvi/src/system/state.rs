//! What a trajectory is made of between steps.

use lie::{RealGroup, VectorSpace};

/// Time, configuration and left-trivialised momentum: *the* state between steps.
///
/// The pair $(g_k, f_k)$ of the Lagrangian form is a view of it, through the discrete Legendre transforms.
///
/// ```
/// use dvi::State;
/// use lie::{Cotangent, SO3};
///
/// let state = State { t: 0.0, g: SO3::identity(), mu: Cotangent([1.0, 0.0, 0.0]) };
/// assert_eq!(state.mu[0], 1.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct State<G: RealGroup> {
    /// Time $t_k$ in seconds; a step adds its size, so that rounding gathers: count steps where time must be exact.
    pub t: f64,
    /// Configuration $g_k$.
    pub g: G,
    /// Left-trivialised momentum $\mu_k \in \mathfrak g^\ast$.
    pub mu: G::Dual,
}

impl<G: RealGroup> State<G> {
    /// Sets this state to another of the same shape, in place.
    #[inline(always)]
    pub(crate) fn copy_from(&mut self, state: &Self) {
        self.t = state.t;
        self.g.copy_from(&state.g);
        self.mu.copy_from(&state.mu);
    }
}

/// The state of the Lagrangian form: a configuration and the displacement to the next one.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair<G: RealGroup> {
    /// Time $t_k$ in seconds.
    pub t: f64,
    /// Step size $h$ in seconds, for which $f_k$ was solved.
    pub h: f64,
    /// Configuration $g_k$.
    pub g: G,
    /// Displacement $f_k = g_k^{-1} g_{k+1}$.
    pub f: G,
}

/// Staying where one is, of the shape of a configuration: no displacement, no velocity.
///
/// Integrators keep one, so that [asking for a domain](crate::DiscreteLagrangian::is_defined) in every step does not allocate.
#[derive(Clone, Debug, PartialEq)]
pub struct Still<G: RealGroup> {
    /// The identity.
    pub displacement: G,
    /// Zero.
    pub velocity: G::Algebra,
}

impl<G: RealGroup> Still<G> {
    /// That of the shape of `g`.
    pub fn at(g: &G) -> Self {
        Self {
            displacement: g.identity_like(),
            velocity: g.zero_algebra(),
        }
    }
}
