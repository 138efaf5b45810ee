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

/// Compiles and runs the code of the README and of the pages; that of the [`guide`] runs with it.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
#[doc = include_str!("../docs/introduction.md")]
#[doc = include_str!("../docs/scenes.md")]
#[doc = include_str!("../docs/joints-and-loads.md")]
#[doc = include_str!("../docs/gaits.md")]
#[doc = include_str!("../docs/urdf.md")]
#[doc = include_str!("../docs/methods.md")]
#[doc = include_str!("../docs/failures.md")]
#[doc = include_str!("../docs/speed.md")]
#[doc = include_str!("../docs/python.md")]
#[doc = include_str!("../docs/notation.md")]
struct Pages;
