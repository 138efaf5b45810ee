//! What moves as told: time laws, and the attitudes and places that follow them.
//!
//! A [`Law`] gives numbers over time, with all their derivatives: a [`Sinusoid`], a [`Spline`] through measured points, or your own.
//! A [`Motion`] makes of them the attitude $Q(t)$ of a body on its parent.

mod attitude;
mod law;
mod period;
mod sinusoid;
mod spline;

pub use attitude::Motion;
pub use law::Law;
pub(crate) use law::{Timed, at, value};
pub(crate) use period::common;
pub use sinusoid::Sinusoid;
pub use spline::{Ends, Spline, SplineError};
