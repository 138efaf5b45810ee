//! Other coordinates for the same motion, and the integrator that steps in them.
//!
//! | view | inner coordinates | taken where |
//! |---|---|---|
//! | [`Rerooted`](crate::views::Rerooted) | the tree hangs on its heaviest body | the first body is not the heaviest |
//! | [`Comoving`](crate::views::Comoving) | a frame that moves and falls with the mass centre | every mass is the same in all directions |
//! | [`Plane`](crate::planar::Plane) | angles and places in a plane | a coordinate plane is a mirror |
//!
//! Views nest: the integrator inside a [`Viewed`] may be a [`Viewed`] itself.

mod comoving;
mod rerooted;
mod view;

pub use comoving::{Comoving, Drift};
pub use rerooted::Rerooted;
pub use view::{View, Viewed};
