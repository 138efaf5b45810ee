//! A torque in a joint, as told over time, (S18).

use std::sync::Arc;

use lie::{Scalar, Vec3};

use crate::motion::{self, Law};

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
    /// From when to when it is told, s.
    pub(crate) fn told(&self) -> [f64; 2] {
        match self {
            Self::Hinge(law) => law.told(),
            Self::Ball(law) => law.told(),
        }
    }

    /// From when on it repeats itself, and after how long, s.
    pub(crate) fn repeats(&self) -> Option<[f64; 2]> {
        match self {
            Self::Hinge(law) => law.repeats(),
            Self::Ball(law) => law.repeats(),
        }
    }

    /// How fast it changes, rad/s.
    pub(crate) fn rate(&self, until: f64) -> f64 {
        match self {
            Self::Hinge(law) => motion::rate(law.as_ref(), until),
            Self::Ball(law) => motion::rate(law.as_ref(), until),
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
