//! Lie group variational integrators.

pub use articulated_fluid;
pub use dvi;
pub use lie;
