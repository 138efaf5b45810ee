//! Motion in a plane: the same bodies where everything is symmetric under a mirror.
//!
//! The normal $n$ of a plane may be, in every body's frame, a principal direction of its mass and its inertia. Where moreover the
//! joints, the velocity and the gravity lie in the plane and the bodies spin about $n$, the motion stays so: no force leads
//! out of it. An elastic joint aligns the frames of its bodies: where $n$ has one direction in both, it only turns them about $n$. Rotations are then angles and the group is abelian, $SO(2) \times \mathbb{R}^2 \times SO(2)^n$.
//!
//! A plane is taken only where it is exact: $n$ is a coordinate axis of the reference frame and of every body's, and all numbers that
//! would lead out of the plane are zero. A small number there may grow, as in a spin about the intermediate axis, so none is left
//! out. A motion in a plane of a tilted frame has such numbers by rounding: it is stepped in space.
//!
//! [`Plane::find`] finds the plane of a model and a state; [`PlanarBody`] is the model in it, with the discrete and the
//! continuous Lagrangian of [`ArticulatedBody`](crate::ArticulatedBody) restricted to the plane, the same functions; and
//! [`Viewed`](crate::Viewed) steps states in space by an integrator in the plane.
//!
//! ```
//! use articulated_fluid::planar::Plane;
//! use articulated_fluid::{ArticulatedBody, Body, Joint, Viewed};
//! use dvi::{Integrator, Lagrangian, Variational};
//! use lie::{Mat3, Power, R3, SO3, Tangent, Vec3};
//!
//! let body = Body { mass: Mat3::diagonal([1.0, 2.0, 3.0]), inertia: Mat3::diagonal([0.1, 0.2, 0.3]) };
//! let (at_parent, at_child) = (Vec3([-0.6, 0.0, 0.0]), Vec3([0.6, 0.0, 0.0]));
//! let fish = ArticulatedBody::new(&[body; 2], &[Joint { parent: 0, child: 1, at_parent, at_child }])?;
//! // The tail beats about z.
//! let beat = Power::new(vec![Tangent([0.0, 0.0, 1.0])]);
//! let mut state = fish.state(0.0, fish.aligned(), &(Tangent::zero(), Tangent([0.3, 0.0, 0.0]), beat))?;
//!
//! let plane = Plane::find(&fish, &state)?;
//! let mut integrator = Viewed::new(plane.clone(), Variational::with_inertia(plane.model()));
//! let energy = fish.conserved(&state)?.energy;
//! for _ in 0..1000 {
//!     integrator.step(&mut state, 1e-3)?;
//! }
//! assert!((fish.conserved(&state)?.energy - energy).abs() < 1e-3 * energy);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod continuous;
mod discrete;
mod elimination;
mod error;
mod find;
mod frame;
mod plane;
mod springs;
mod vector;
mod weight;

use core::ops::Range;

use lie::{Power, Rn, SO2};

use crate::elimination::of;
use springs::Springs;
use vector::{Sym2, Vec2};
use weight::Weight;

pub use elimination::{Elimination, Factor};
pub(crate) use error::rounded;
pub use error::{NotPlanar, NotPlanarCause};
pub use plane::Plane;

/// $SO(2) \times \mathbb{R}^2 \times SO(2)^n$, $g = (R_0, x, R_1, \dots, R_n)$, in the frame of a [`Plane`].
///
/// $R_i$ maps body $i$'s frame in the plane to that of the plane; $x$ is the mass centre of the first body, in metres.
pub type PlanarConfiguration<S = f64> = (SO2<S>, Rn<2, S>, Power<SO2<S>>);

/// The attitude of the first body, and those of the others.
type Attitudes<'a, S> = (&'a SO2<S>, &'a [SO2<S>]);

/// Rigid bodies on hinges in a perfect fluid, all in one plane: a tree with a free base, made by [`Plane::model`].
///
/// Evaluations, the inertia solve and steps cost time and memory in proportion to the bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarBody {
    /// A parent stands before its children.
    nodes: Vec<Node>,
    weight: Option<Weight>,
    springs: Option<Springs>,
    /// Whether the translation is kept as an unknown, though it could be eliminated.
    keeps_translation: bool,
}

/// A body, its joint to its parent, and what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Node {
    /// Index of the parent; of the first body, which has none, 0.
    parent: usize,
    /// $M_i$ in the plane, kg, in the body's frame.
    mass: Sym2,
    /// $J_i$ about the normal, kg m².
    j: f64,
    /// $d_{pi}$, m, in the parent's frame.
    at_parent: Vec2,
    /// $d_{ip}$, m, in the body's frame.
    at_self: Vec2,
    /// $l_i = d_{pi} - d_{pp(p)}$: from the parent's joint to this body's, in the parent's frame.
    lever: Vec2,
    /// $K = M_i J d_{ip}$ with the quarter turn $J$.
    k: Vec2,
    /// $J'_i = J_i + J d_{ip} \cdot M_i J d_{ip}$: about the joint.
    j_joint: f64,
}

impl Node {
    fn new(parent: usize, mass: Sym2, j: f64, [at_parent, at_self, lever]: [Vec2; 3]) -> Self {
        let swept = at_self.quarter_turn();
        let k = mass.apply(swept);
        Self {
            parent,
            mass,
            j,
            at_parent,
            at_self,
            lever,
            k,
            j_joint: j + swept.dot(k),
        }
    }
}

impl PlanarBody {
    /// The coordinates of $x$, where nothing depends on it and it is to be eliminated.
    fn free_translation(&self) -> Range<usize> {
        let floats = self.weight.as_ref().is_none_or(Weight::is_neutral);
        if floats && !self.keeps_translation {
            1..3
        } else {
            0..0
        }
    }

    fn is_of(&self, g: &PlanarConfiguration) -> bool {
        g.2.len() + 1 == self.nodes.len()
    }
}
