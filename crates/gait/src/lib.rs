//! Gaits: what a stroke of the joints does, and which one does it best.
//!
//! A swimmer whose joints repeat a motion has moved after each period by some $g_T$ in SE(3). Without momentum and loads the shape
//! $q$ alone leads: $\xi = -A(q) \dot q$ with the connection $A$, at any speed. With loads or free joints a swimmer comes to a steady
//! stroke, after which it is as it was, but elsewhere.
//!
//! ```
//! use articulated_fluid::Scene;
//! use gait::{Chain, Screw, Told, net_motion};
//!
//! let text = r#"
//!     fluid.density = 1000
//!     start.momentum = "zero"
//!     body = [{ name = "trunk", semi_axes = [0.3, 0.1, 0.1] }, { name = "head", semi_axes = [0.2, 0.1, 0.1] },
//!             { name = "tail", semi_axes = [0.2, 0.05, 0.1] }]
//!     [[joint]]
//!     parent = "trunk"
//!     child = "head"
//!     at_parent = [0.35, 0, 0]
//!     at_child = [-0.25, 0, 0]
//!     type = "hinge"
//!     axis = [0, 0, 1]
//!     motion = { amplitude = 0.3, frequency = 1 }
//!     [[joint]]
//!     parent = "trunk"
//!     child = "tail"
//!     at_parent = [-0.35, 0, 0]
//!     at_child = [0.25, 0, 0]
//!     type = "hinge"
//!     axis = [0, 0, 1]
//!     motion = { amplitude = 0.5, frequency = 1, phase = 1.57 }
//! "#;
//! let scene = Scene::parse(text, "fish.toml")?;
//! let (chain, told) = (Chain::new(&scene)?, Told::new(&scene.model()?)?);
//! let screw = Screw::of(&net_motion(&chain, &told)?);
//! assert!(screw.radius > 0.0 || screw.advance > 0.0);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! | what | where |
//! |---|---|
//! | the connection and the metric of a chain of bodies | [`Chain`] |
//! | a stroke, as told or by Fourier coefficients | [`Stroke`], [`Told`], [`Fourier`] |
//! | its net motion, and the gradient of it | [`net_motion`], [`net_with_gradient`] |
//! | a net motion as turn and advance | [`Screw`] |
//! | length and positive work | [`Effort`] |
//! | the best stroke | [`Search`], by an [`Objective`] |
//! | height functions of two coordinates | [`HeightMaps`] |
//! | steady strokes with loads | [`Swimmer`], [`Steady`] |
//! | all of that for a scene | [`Report`] |
//!
//! The model leaves out how the bodies disturb the fluid for each other. For strokes of three links that were computed with it, that is
//! 9 to 14 % of the net motion, and 4 to 23 % for others.

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
mod walk;

pub use chain::Chain;
pub use effort::Effort;
pub use error::GaitError;
pub use gradient::net_with_gradient;
pub use height::HeightMaps;
pub use net::{net_motion, path};
pub use objective::{Objective, WAY};
pub use report::{NetMotion, Report, Swims};
pub use rewrite::with_stroke;
pub use screw::Screw;
pub use search::{Found, Limits, Search};
pub use steady::Steady;
pub use stroke::{Fourier, Stroke, Told};
pub use swimmer::Swimmer;
pub use tree::Moving;

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
