//! What every integrator asks of a state before a step, and after it.

use lie::{LieGroup, RealGroup, VectorSpace};

use super::Cause;
use crate::{State, System};

/// Whether a step of `h` seconds from the time `t` and the configuration `g` makes sense at all; for integrators of your own.
///
/// # Errors
/// The [`Cause`] that it does not.
pub fn check_step<C: System>(system: &C, (t, g): (f64, &C::Group), h: f64) -> Result<(), Cause> {
    check_call(system, (t, g), h)?;
    g.is_finite().then_some(()).ok_or(Cause::NotFinite)
}

/// The same where a configuration that is not finite will be noticed.
pub(crate) fn check_call<C: System>(
    system: &C,
    (t, g): (f64, &C::Group),
    h: f64,
) -> Result<(), Cause> {
    if !(h.is_finite() && h != 0.0) {
        Err(Cause::InvalidStep)
    } else if !system.fits(g) {
        Err(Cause::Misfit)
    } else if !t.is_finite() {
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
    check_shape(mu, shape)?;
    mu.max_magnitude()
        .is_finite()
        .then_some(())
        .ok_or(Cause::NotFinite)
}

/// Whether a momentum has this shape.
pub(crate) fn check_shape<V: VectorSpace<Scalar = f64>>(mu: &V, shape: &V) -> Result<(), Cause> {
    if shape.same_shape(mu) {
        return Ok(());
    }
    let (expected, found) = (shape.dim(), mu.dim());
    Err(Cause::Shape { expected, found })
}

/// This state, if every number of it is finite.
pub(crate) fn finite<G: RealGroup>(state: State<G>) -> Result<State<G>, Cause> {
    let finite = state.g.is_finite() && state.mu.max_magnitude().is_finite();
    finite.then_some(state).ok_or(Cause::NotFinite)
}
