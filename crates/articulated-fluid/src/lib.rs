//! Rigid ellipsoids on joints in a perfect fluid.
//!
//! The model of T. Lee, M. Leok, N. H. McClamroch, *Dynamics of connected rigid bodies in a perfect fluid* (2009), for any tree
//! of bodies; [`formulas`] derives it. The fluid is irrotational and incompressible, so that it only adds to the inertia of the bodies:
//! anisotropic masses $M_i$ and inertias $J_i$.
//!
//! ```
//! use articulated_fluid::Scene;
//! use dvi::{Integrator, Variational};
//!
//! let scene = Scene::parse(articulated_fluid::scene::EXAMPLE, "example.toml")?;
//! let (model, mut state) = (scene.model()?, scene.initial_state()?);
//! let start = model.conserved(&state)?;
//! let mut integrator = Variational::new(model.clone());
//! for _ in 0..1000 {
//!     integrator.step(&mut state, 1e-3)?;
//! }
//! let end = model.conserved(&state)?;
//! assert!((end.angular - start.angular).norm() < 1e-12 * start.angular.norm());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | formula of the paper | where |
//! |---|---|
//! | (1)–(3), (6): velocities, kinetic energy | [`Lagrangian::value`](dvi::Lagrangian::value) of [`ArticulatedBody`] |
//! | (5): added inertia of an ellipsoid | [`Ellipsoid`] |
//! | (4), (10): inertia, Legendre transform | [`Lagrangian::legendre`](dvi::Lagrangian::legendre), [`DiscreteLagrangian::solve`](dvi::DiscreteLagrangian::solve) |
//! | (11)–(13), (18)–(20): forces, Hamilton's equations | [`ContinuousSystem`](dvi::ContinuousSystem) of [`ArticulatedBody`] |
//! | (21): displacement | [`Configuration`] as $f$ |
//! | (22): discrete Lagrangian | [`DiscreteLagrangian::value`](dvi::DiscreteLagrangian::value) |
//! | (27)–(33): its derivatives | [`DiscreteLagrangian::derivatives`](dvi::DiscreteLagrangian::derivatives) |
//! | (34)–(38), (39)–(46): stepping maps | [`Variational`](dvi::Variational) |
//! | linear and angular momentum | [`Conserved`] |
//!
//! The print is not right everywhere, and the formulas here are the mended ones. Three things matter to a reader. The couplings in
//! (22) are taken at the left end alone, so the method is of order 1, not a trapezoidal rule. The joints of the tails in
//! Sec. V have the opposite sign. The density there is $1/(32 \pi)$ kg/m³.
//!
//! [`scene`] reads scenes from files.
//!
//! # Joints
//! [`JointKind`] is what a joint leaves free, or how it moves as told. [`ArticulatedBody::held`] hangs the first body on the world, at a
//! place that may move. [`motion`] has the time laws. The structure is kept in all of it: steps are symplectic at every time, and the
//! momentum of a free tree is kept to rounding while its joints are driven. Hinge angles have no limits.
//!
//! ```
//! use std::sync::Arc;
//!
//! use articulated_fluid::motion::Sinusoid;
//! use articulated_fluid::{ArticulatedBody, Body, Joint, JointKind, Motion};
//! use dvi::{Composition, Integrator, State};
//! use lie::{LieGroup, Mat3, SO3, Vec3};
//!
//! let body = Body::new(Mat3::diagonal([1.0, 2.0, 2.0]), Mat3::diagonal([0.1, 0.2, 0.2]));
//! let beat = Sinusoid { amplitude: [0.5], frequency: 1.0, ..Sinusoid::constant([0.0]) };
//! let kind = JointKind::Prescribed(Motion::Hinge {
//!     axis: Vec3([0.0, 0.0, 1.0]),
//!     rest: SO3::identity(),
//!     angle: Arc::new(beat),
//! });
//! let points = [Vec3([0.6, 0.0, 0.0]), Vec3([-0.6, 0.0, 0.0])];
//! let pair = ArticulatedBody::new(&[body; 2], &[Joint::new([0, 1], points, kind)])?;
//! let g = pair.aligned();
//! let mut state = State { t: 0.0, mu: g.zero_dual(), g };
//! let mut integrator = Composition::new::<2>(pair.clone());
//! for _ in 0..100 {
//!     integrator.step(&mut state, 0.01)?;
//! }
//! // Without momentum it has none for ever, and turns by its beat.
//! assert!(pair.conserved(&state)?.angular.norm() < 1e-13);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Loads and work
//! Beside weight and springs there are torques, dampers and servos in joints ([`JointLoad`]), and loads on bodies, such as drag ([`BodyLoad`]). Those in joints keep the
//! momentum to rounding; with any of them a step is not symplectic. What drives and loads do is summed along a step's
//! [`Path`](dvi::Path), at the order of its method: [`ArticulatedBody::drives`], [`ArticulatedBody::add_drives`].
//!
//! # Views of a scene
//! [`Scene::smallest`] leaves out only what is exactly nothing. It steps a scene in other coordinates where these are better, by a
//! [`View`]: on its heaviest body ([`Rerooted`]), beside its mass centre ([`Comoving`]), in a plane ([`planar`]). The states given out
//! are the scene's own.
//!
//! # Motion in a plane
//! Where bodies, joints and motion are symmetric under a mirror, [`planar`] restricts both Lagrangians to the plane, on
//! $SO(2) \times \mathbb{R}^2 \times SO(2)^n$. [`Plane::find`](planar::Plane::find) finds it.
//! [`Viewed`] steps the states in space, exactly in the plane and at little more than half the cost.

mod account;
mod conserved;
mod discrete;
mod displaced;
mod drive;
pub mod ellipsoid;
mod error;
#[doc = include_str!("formulas.md")]
pub mod formulas {}
mod inertia;
mod initial;
mod joints;
mod keeps;
mod kinematics;
mod lagrangian;
mod loads;
pub mod motion;
mod node;
pub mod planar;
mod pose;
pub mod scene;
mod smallest;
mod tree;
mod views;

pub use account::{Account, Reduction};
pub use conserved::Conserved;
pub use discrete::StepWorkspace;
pub use drive::{Drive, DriveKind};
pub use ellipsoid::{Ellipsoid, EllipsoidError};
pub use error::ModelError;
pub use joints::*;
pub use kinematics::Kinematics;
pub use lagrangian::Evaluation;
pub use loads::on_bodies::*;
pub use loads::{JointLoad, Servo, Torque};
pub use motion::Motion;
pub use node::{Body, Joint};
pub use scene::{Scene, SceneError};
pub use smallest::Smallest;
pub use tree::{ArticulatedBody, Configuration};
pub use views::{Comoving, Drift, Rerooted, View, Viewed};

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
