//! What acts in a joint beside its spring.

use lie::{Scalar, Vec3};

use super::servo::{Aim, Servo};
use super::size::is_size;
use super::torque::Torque;

/// What the load in a joint is told at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToldInJoint<S> {
    /// In the child's frame, in which a hinge has this axis.
    pub(super) torque: Vec3<S>,
    pub(super) aim: Aim<S>,
}

/// What acts in a joint beside its spring.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointLoad {
    /// $d \ge 0$ of a damper with the torque $-d \omega$ on the child, N m s/rad.
    pub damping: f64,
    /// As told.
    pub torque: Option<Torque>,
    /// A motor.
    pub servo: Option<Servo>,
}

impl JointLoad {
    /// Whether it does anything.
    pub fn acts(&self) -> bool {
        self.damping != 0.0 || self.torque.is_some() || self.servo.is_some()
    }

    /// The slope of its torque against the rate, $d + k_d$, N m s/rad.
    pub(crate) fn resistance(&self) -> f64 {
        self.damping + self.servo.as_ref().map_or(0.0, |servo| servo.damping)
    }

    /// Whether it is one of a hinge, or of a ball, and its numbers are sound.
    pub(super) fn suits(&self, is_hinge: bool) -> bool {
        let torque = self.torque.as_ref();
        let of_hinge = torque.is_none_or(|torque| matches!(torque, Torque::Hinge(_)) == is_hinge);
        let servo = self.servo.as_ref();
        let sound = servo.is_none_or(|servo| servo.suits(is_hinge));
        of_hinge && sound && is_size(self.damping)
    }

    /// What it is told at the time `t`, in a hinge about this axis or in a ball.
    pub(crate) fn told<S: Scalar>(&self, t: S, axis: Option<Vec3>) -> ToldInJoint<S> {
        let torque = self.torque.as_ref();
        let on = axis.unwrap_or(Vec3::zero()).lift();
        let servo = self.servo.as_ref();
        ToldInJoint {
            torque: torque.map_or(Vec3::zero(), |torque| torque.at(t, on)),
            aim: servo.map_or(Aim::None, |servo| servo.aim(t)),
        }
    }
}
