//! Lie group variational integrators: from a Lagrangian to a simulator that keeps the group, the symplectic form and the
//! momentum maps.
//!
//! This crate is the facade of four:
//! * [`lie`]: groups, algebras, duals, retractions, and a law suite for groups of your own;
//! * [`dvi`]: discrete Lagrangians and the integrators made from them; start at [`dvi::DiscreteLagrangian`];
//! * [`articulated_fluid`]: rigid ellipsoids on ball joints in a perfect fluid, and its scene files;
//! * [`sim`]: runs of scenes by any method, from frame to frame; start at [`sim::Simulation`].
//!
//! With the default feature `cli` it also is the command `lgvi`, with `chart` its experiments; a library wants
//! `default-features = false`.

pub mod guide;

pub use articulated_fluid;
pub use dvi;
pub use lie;
pub use sim;

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
