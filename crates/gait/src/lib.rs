//! Gaits: what a stroke of the joints does, and which one does it best.

mod chain;
mod clearance;
mod effort;
mod error;
mod formulas;
mod frame;
mod gradient;
mod height;
mod joint;
mod net;
mod objective;
mod report;
mod rewrite;
mod rigid;
mod screw;
mod search;
mod steady;
mod steered;
mod stroke;
mod swimmer;
mod tree;

pub use chain::Chain;
pub use effort::Effort;
pub use error::GaitError;
pub use gradient::net_with_gradient;
pub use height::HeightMaps;
pub use net::{net_motion, path};
pub use objective::{Objective, STROKES};
pub use report::{NetMotion, Report, Swims};
pub use rewrite::with_stroke;
pub use screw::{Screw, power};
pub use search::{Found, Limits, Search};
pub use steady::Steady;
pub use stroke::{Fourier, Stroke, Told};
pub use swimmer::Swimmer;
pub use tree::Moving;
