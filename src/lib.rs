#![doc = include_str!("../README.md")]
//!
//! # The crates behind the facade
//! * [`lie`]: groups, algebras, duals, retractions, and a law suite for groups of your own;
//! * [`dvi`]: discrete Lagrangians and the integrators made from them;
//! * [`articulated_fluid`]: rigid ellipsoids on ball joints in a perfect fluid, and its scene files.

pub use articulated_fluid;
pub use dvi;
pub use lie;
