//! Discrete variational integrators on Lie groups.

mod balance;
mod continuous;
mod error;
mod inertia;
mod integrator;
mod jets;
mod lagrangian;
mod legendre;
mod linear;
mod newton;
mod solver;
mod state;
mod variational;
mod warm_start;

pub use continuous::ContinuousSystem;
pub use error::{Hint, StepError};
pub use inertia::{FrozenInertia, Inertia};
pub use integrator::{Integrator, StepReport};
pub use lagrangian::{Derivatives, DiscreteLagrangian, Lagrangian};
pub use legendre::{legendre_minus, legendre_plus};
pub use newton::Newton;
pub use solver::StepSolver;
pub use state::{Pair, State};
pub use variational::Variational;
