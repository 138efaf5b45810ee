//! A torque in a joint, as told over time, (S18).

use std::sync::Arc;

use lie::{Scalar, Vec3};

use crate::joints::JointKind;
use crate::motion::{self, Law, Timed};
use crate::scene::entry::Table;
use crate::scene::error::SceneError;
use crate::scene::laws;

/// A torque on the child of a joint, N m; the parent has the opposite one.
#[derive(Clone, Debug)]
pub enum Torque {
    /// About the axis of a hinge.
    Hinge(Arc<dyn Law<1>>),
    /// In the child's frame.
    Ball(Arc<dyn Law<3>>),
}

impl PartialEq for Torque {
    /// Laws are the same where they are one and the same.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Hinge(a), Self::Hinge(b)) => Arc::ptr_eq(a, b),
            (Self::Ball(a), Self::Ball(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

impl Torque {
    /// By its keys in a scene, in a joint of this kind.
    pub(super) fn read(table: &Table, kind: &JointKind) -> Result<Self, SceneError> {
        match kind {
            JointKind::Hinge(_) => laws::law::<1>(table).map(Self::Hinge),
            _ => laws::law::<3>(table).map(Self::Ball),
        }
    }

    /// What it is told by.
    pub(super) fn law(&self) -> &dyn Timed {
        match self {
            Self::Hinge(law) => law,
            Self::Ball(law) => law,
        }
    }

    /// The torque at a time, in the child's frame, in which a hinge has this axis.
    #[inline(always)]
    pub(super) fn at<S: Scalar>(&self, t: S, axis: Vec3<S>) -> Vec3<S> {
        match self {
            Self::Hinge(law) => axis * motion::value(law.as_ref(), t)[0],
            Self::Ball(law) => Vec3(motion::value(law.as_ref(), t)),
        }
    }
}
