//! Motion in a plane: the same bodies where everything is symmetric under a mirror.
//!
//! The normal $n$ of a plane may be, in every body's frame, a principal direction of its mass and its inertia. Where moreover the
//! joints, the velocity and the gravity lie in the plane and the bodies spin about $n$, the motion stays so: no force leads
//! out of it. An elastic joint aligns the frames of its bodies: where $n$ has one direction in both, it only turns them about $n$. Rotations are then angles and the group is abelian, $SO(2)^{n+1} \times \mathbb{R}^2$.
//!
//! A plane is taken only where it is exact. Then $n$ is a coordinate axis of the reference frame and of every body's, and all numbers that
//! would lead out of the plane are zero. A small number there may grow, as in a spin about the intermediate axis, so none is left
//! out. A motion in a plane of a tilted frame has such numbers by rounding: it is stepped in space.
//!
//! [`Plane::find`] finds the plane of a model and a state. [`PlanarBody`] is the model in it, with the discrete and the
//! continuous Lagrangian of [`ArticulatedBody`](crate::ArticulatedBody) restricted to the plane, the same functions.
//! [`Viewed`](crate::Viewed) steps states in space by an integrator in the plane.
//!
//! ```
//! use articulated_fluid::planar::Plane;
//! use articulated_fluid::{ArticulatedBody, Body, Joint, JointKind, Viewed};
//! use dvi::{Integrator, Lagrangian, Variational};
//! use lie::{Mat3, Power, Tangent, Vec3};
//!
//! let body = Body::new(Mat3::diagonal([1.0, 2.0, 3.0]), Mat3::diagonal([0.1, 0.2, 0.3]));
//! let (at_parent, at_child) = (Vec3([-0.6, 0.0, 0.0]), Vec3([0.6, 0.0, 0.0]));
//! let fish = ArticulatedBody::new(&[body; 2], &[Joint::new([0, 1], [at_parent, at_child], JointKind::Ball)])?;
//! // The tail beats about z.
//! let beat = Power::new(vec![Tangent::zero(), Tangent([0.0, 0.0, 1.0])]);
//! let ahead = Power::new(vec![Tangent([0.3, 0.0, 0.0])]);
//! let no_hinge = Power::new(vec![]);
//! let mut state = fish.state(0.0, fish.aligned(), &(beat, ahead, no_hinge))?;
//!
//! let plane = Plane::find(&fish, &state)?;
//! let mut integrator = Viewed::new(plane.clone(), Variational::new(plane.model()));
//! let energy = fish.conserved(&state)?.energy;
//! for _ in 0..1000 {
//!     integrator.step(&mut state, 1e-3)?;
//! }
//! assert!((fish.conserved(&state)?.energy - energy).abs() < 1e-3 * energy);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod discrete;
mod error;
mod find;
mod frame;
mod inertia;
mod lagrangian;
mod loads;
mod plane;
mod tree;
mod vector;

pub use discrete::PlanarStepWorkspace;
pub(crate) use error::rounded;
pub use error::{NotPlanar, NotPlanarCause};
pub use inertia::PlanarElimination;
pub use plane::Plane;
pub use tree::{PlanarBody, PlanarConfiguration};
