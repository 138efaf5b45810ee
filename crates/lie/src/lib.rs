//! Lie groups for mechanics.

mod approximate;
#[cfg(feature = "nalgebra")]
mod convert_nalgebra;
mod dense;
mod error;
mod group;
pub mod laws;
mod matrix;
mod power;
mod product;
mod retraction;
mod rn;
mod scalar;
mod se3;
mod so3;
mod stumpff;
mod vector;
mod vector_space;

pub use error::{NotARotation, NotUnique, OutsideChart};
pub use group::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, seed};
pub use matrix::Mat3;
pub use power::Power;
pub use retraction::{Cayley, Exp, Retraction};
pub use rn::{R3, Rn};
pub use scalar::{JET_DIRECTIONS, Jet, Scalar};
pub use se3::SE3;
pub use so3::SO3;
pub use vector::Vec3;
pub use vector_space::{Cotangent, Tangent, VectorSpace};
