//! Rigid ellipsoids on ball joints in a perfect fluid.

mod conserved;
mod continuous;
mod discrete;
pub mod ellipsoid;
mod error;
mod initial;
mod model;
mod reduced;
pub mod scene;
mod semidirect;

pub use conserved::Conserved;
pub use ellipsoid::{Ellipsoid, EllipsoidError};
pub use error::ModelError;
pub use model::{ArticulatedBody, Body, Configuration, Joint};
pub use reduced::Factor;
pub use scene::{Scene, SceneError};
pub use semidirect::{OnSe3, SemidirectConfiguration};
