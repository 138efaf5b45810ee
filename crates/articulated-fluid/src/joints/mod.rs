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
mod kinds;
mod link;

use lie::{SO3, Vec3};

use crate::motion::Motion;
pub use hinge::Hinge;
pub(crate) use hinge::HingeFactors;
pub(crate) use kinds::{Any, Balls, Damped, Kinds};
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

/// The words for the kinds in a scene, and what they mean.
pub(crate) const WORDS: [&str; 2] = [
    "\"ball\", \"hinge\" or \"fixed\"",
    "what the joint leaves free: every rotation, the angle about an axis, or nothing",
];

impl JointKind {
    /// A hinge about an axis of any length in the child's frame; at the angle 0 the child has the attitude `rest` on the parent.
    pub fn hinge(axis: Vec3, rest: SO3) -> Self {
        Self::Hinge(Hinge::new(axis, rest))
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

impl JointKind {
    /// Whether the attitude of the child is an unknown.
    pub(crate) fn is_root(&self) -> bool {
        matches!(self, Self::Ball)
    }

    /// Whether an angle is an unknown.
    pub(crate) fn has_angle(&self) -> bool {
        matches!(self, Self::Hinge(_))
    }

    /// Whether its numbers make a joint.
    pub(crate) fn is_sound(&self) -> bool {
        match self {
            Self::Hinge(hinge) => hinge.is_sound(),
            Self::Ball | Self::Prescribed(_) => true,
        }
    }

    /// The attitude of the child on the parent and its rate, at the start and an angle with its rate; none where the child has its own.
    pub(crate) fn relative(&self, [angle, rate]: [f64; 2]) -> Option<(SO3, Vec3)> {
        match self {
            Self::Ball => None,
            Self::Hinge(hinge) => Some((hinge.relative(angle), hinge.axis * rate)),
            Self::Prescribed(motion) => Some(motion.at(0.0)),
        }
    }
}

/// What the joints of a tree have of their own, kind by kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Joints {
    /// The bodies whose attitudes are unknowns.
    pub(crate) roots: Vec<usize>,
    pub(crate) hinges: Vec<Hinge>,
    pub(crate) motions: Vec<Motion>,
}

impl Joints {
    /// Takes the joint of a body, and gives its role.
    pub(crate) fn take(&mut self, body: usize, kind: &JointKind) -> Role {
        match kind {
            JointKind::Ball => {
                self.roots.push(body);
                Role::Ball(self.roots.len() - 1)
            }
            JointKind::Hinge(hinge) => {
                self.hinges.push(*hinge);
                Role::Hinge(self.hinges.len() - 1)
            }
            JointKind::Prescribed(motion) => {
                self.motions.push(motion.clone());
                Role::Prescribed(self.motions.len() - 1)
            }
        }
    }

    /// The kind of joint of this role.
    pub(crate) fn kind(&self, role: Role) -> JointKind {
        match role {
            Role::Ball(_) => JointKind::Ball,
            Role::Hinge(k) => JointKind::Hinge(self.hinges[k]),
            Role::Prescribed(k) => JointKind::Prescribed(self.motions[k].clone()),
        }
    }

    /// Whether one moves as told.
    pub(crate) fn are_driven(&self) -> bool {
        self.motions.iter().any(Motion::is_driven)
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
