//! What moves, and how it is described: Lagrangians, discrete ones, Hamilton's equations, forces.

mod adjoint;
mod context;
mod continuous;
mod discrete;
mod discretised;
mod dual_system;
mod force;
mod forced;
mod hamiltonian;
mod lagrangian;
mod legendre;
mod lifted;
mod quadrature;
mod shape;
mod state;
mod symmetry;
mod traced;

pub use adjoint::{Adjoint, AdjointWorkspace};
pub(crate) use context::{Algebra, Dual};
pub use context::{Context, System};
pub use continuous::{ContinuousSystem, Means};
pub use discrete::{Derivatives, DiscreteLagrangian};
pub use discretised::DiscretisedWorkspace;
pub use dual_system::{DualSystem, LegendreWorkspace};
pub use force::{DiscreteForce, Force};
pub use forced::{Forced, ForcedWorkspace};
pub use hamiltonian::HamiltonianWorkspace;
pub use lagrangian::{Discretised, HamiltonianSystem, Lagrangian};
pub use legendre::{legendre_minus, legendre_plus};
pub use quadrature::Quadrature;
pub use shape::ShapeError;
pub use state::{Pair, State, Still};
pub(crate) use symmetry::generator;
pub use symmetry::{LeftTranslation, RightTranslation, Symmetry, momentum_map};
pub(crate) use traced::DiscreteCache;
pub use traced::{Recording, TracedError, TracedSystem, TracedWorkspace};
