//! What a body is to its parent once all that hangs on it is eliminated, and what a joint leaves free.
//!
//! A body whose children are eliminated has the momenta
//! $F_i = A u - K \Omega_i + \varphi$ and $r_i = H \Omega_i - K^T u$ with the velocity $u$ of its joint. What the joint leaves free
//! is solved for, and the force on it is $F_i = M^\ast u + f^\ast$: its parent takes over the mass and the force.
//! A joint that leaves less than a rotation free hands up $A, K, H$ and the moment with it.
//!
//! Each kind of joint is a file: how it eliminates the mass and the force, how the velocity goes on outwards, and what it makes of a
//! moment. [`act`] alone tells them apart.

mod act;
mod ball;
mod given;
mod hinge;
mod link;

use lie::{SO3, Vec3};

use crate::motion::Motion;
pub use hinge::Hinge;
pub(crate) use hinge::HingeFactors;
pub(crate) use link::Link;

/// What a joint leaves free.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum JointKind {
    /// Every rotation: the child's attitude in the reference frame is an unknown.
    #[default]
    Ball,
    /// The angle about an axis, an unknown that is not wrapped.
    Hinge(Hinge),
    /// Nothing: the attitude on the parent is fixed, or moves as told.
    Prescribed(Motion),
}

impl JointKind {
    /// A hinge about an axis of any length in the child's frame; at the angle 0 the child has the attitude `rest` on the parent.
    pub fn hinge(axis: Vec3, rest: SO3) -> Self {
        let axis = axis * (1.0 / axis.norm());
        Self::Hinge(Hinge {
            axis,
            rest,
            rest_angle: 0.0,
        })
    }

    /// Whether it moves as told.
    pub fn is_driven(&self) -> bool {
        matches!(self, Self::Prescribed(motion) if motion.is_driven())
    }

    /// A weld, with the attitude of the child on the parent.
    pub fn fixed(rest: SO3) -> Self {
        Self::Prescribed(Motion::Fixed(rest))
    }
}

/// What a body's attitude comes from: the k-th of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// An attitude of the configuration.
    Ball(usize),
    /// A hinge angle of the configuration.
    Hinge(usize),
    /// A motion of the tree.
    Prescribed(usize),
}

impl Role {
    /// Whether the attitude is an unknown of its own.
    pub(crate) fn is_root(self) -> bool {
        matches!(self, Self::Ball(_))
    }
}
