//! What every integrator asks of a state before a step, and after it.

use lie::{LieGroup, RealGroup, VectorSpace};

use super::Cause;
use crate::{State, System};

/// Whether a step of `h` seconds from the time `t` and the configuration `g` makes sense at all; for integrators of your own.
///
/// # Errors
/// The [`Cause`] that it does not.
pub fn check_step<C: System>(system: &C, (t, g): (f64, &C::Group), h: f64) -> Result<(), Cause> {
    if !(h.is_finite() && h != 0.0) {
        Err(Cause::InvalidStep)
    } else if !system.fits(g) {
        Err(Cause::Misfit)
    } else if !(t.is_finite() && g.is_finite()) {
        Err(Cause::NotFinite)
    } else {
        Ok(())
    }
}

/// Whether a momentum has this shape and is finite.
///
/// # Errors
/// The [`Cause`] that it has not, or is not.
pub fn check_momentum<V: VectorSpace<Scalar = f64>>(mu: &V, shape: &V) -> Result<(), Cause> {
    if !shape.same_shape(mu) {
        let (expected, found) = (shape.dim(), mu.dim());
        return Err(Cause::Shape { expected, found });
    }
    mu.max_magnitude()
        .is_finite()
        .then_some(())
        .ok_or(Cause::NotFinite)
}

/// This state, if every number of it is finite.
pub(crate) fn finite<G: RealGroup>(state: State<G>) -> Result<State<G>, Cause> {
    let finite = state.g.is_finite() && state.mu.max_magnitude().is_finite();
    finite.then_some(state).ok_or(Cause::NotFinite)
}
