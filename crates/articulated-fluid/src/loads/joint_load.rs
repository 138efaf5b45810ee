//! What acts in a joint beside its spring. Each part is a file, a field of [`JointLoad`], and its keys in [`KEYS`](crate::scene::KEYS).

use lie::{Mat3, Scalar, Vec3};

use super::servo::{Aim, Servo};
use super::size::is_size;
use super::torque::Torque;
use crate::joints::JointKind;
use crate::scene::entry::{Table, Value};
use crate::scene::error::SceneError;

/// What the load in a joint is told at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToldInJoint<S> {
    /// In the child's frame, in which a hinge has this axis.
    torque: Vec3<S>,
    aim: Aim<S>,
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

/// A part of what acts in a joint.
pub(crate) struct Part {
    /// As a user reads it.
    pub(crate) name: &'static str,
    /// Its key in a scene.
    pub(crate) key: &'static str,
    /// Whether it does anything.
    pub(crate) acts: fn(&JointLoad) -> bool,
}

const fn part(name: &'static str, key: &'static str, acts: fn(&JointLoad) -> bool) -> Part {
    Part { name, key, acts }
}

impl JointLoad {
    pub(crate) const PARTS: &[Part] = &[
        part("damper", "damping", |load| load.damping != 0.0),
        part("torque", "torque", |load| load.torque.is_some()),
        part("servo", "servo", |load| load.servo.is_some()),
    ];

    /// Whether it does anything.
    pub fn acts(&self) -> bool {
        Self::PARTS.iter().any(|part| (part.acts)(self))
    }

    /// By its keys in a scene, in a joint of this kind, which is free.
    pub(crate) fn read(joint: &Table, kind: &JointKind) -> Result<Self, SceneError> {
        Ok(Self {
            damping: joint.read("damping", 0.0, Value::not_negative)?,
            torque: joint.read("torque", None, |value| {
                Torque::read(&value.table()?, kind).map(Some)
            })?,
            servo: joint.read("servo", None, |value| {
                Servo::read(&value.table()?, kind).map(Some)
            })?,
        })
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

    /// From when to when each part is told, s.
    pub(super) fn spans(&self) -> impl Iterator<Item = [f64; 2]> {
        let torque = self.torque.iter().map(|torque| torque.law().told());
        torque.chain(self.servo.iter().map(|servo| servo.target.told()))
    }

    /// From when on each part that is told repeats itself, and after how long, s.
    pub(super) fn repeats(&self) -> impl Iterator<Item = Option<[f64; 2]>> {
        let torque = self.torque.iter().map(|torque| torque.law().repeats());
        torque.chain(self.servo.iter().map(|servo| servo.target.repeats()))
    }

    /// How fast each part that is told changes, rad/s.
    pub(super) fn rates(&self, until: f64) -> impl Iterator<Item = f64> {
        let torque = self.torque.iter();
        let torque = torque.map(move |torque| torque.law().rate(until));
        let servo = self.servo.iter();
        torque.chain(servo.map(move |servo| servo.target.rate(until)))
    }

    /// Whether the torque that is told is a number at the time `t`.
    pub(super) fn is_known(&self, t: f64) -> bool {
        let axis = Vec3([1.0, 0.0, 0.0]);
        let torque = self.torque.as_ref();
        torque.is_none_or(|torque| torque.at(t, axis).is_finite())
    }

    /// What it is told at the time `t`, in a hinge about this axis or in a ball.
    pub(super) fn told<S: Scalar>(&self, t: S, axis: Option<Vec3>) -> ToldInJoint<S> {
        let torque = self.torque.as_ref();
        let on = axis.unwrap_or(Vec3::zero()).lift();
        let servo = self.servo.as_ref();
        ToldInJoint {
            torque: torque.map_or(Vec3::zero(), |torque| torque.at(t, on)),
            aim: servo.map_or(Aim::None, |servo| servo.aim(t)),
        }
    }

    /// The torque on the child of a ball with this attitude on the parent and this rate, in its frame.
    #[inline(always)]
    pub(super) fn on_ball<S: Scalar>(
        &self,
        told: &ToldInJoint<S>,
        c: &Mat3<S>,
        rate: Vec3<S>,
    ) -> Vec3<S> {
        let sum = told.torque - rate * S::from_f64(self.damping);
        match (&self.servo, &told.aim) {
            (Some(servo), Aim::Ball(target, turning)) => {
                sum + servo.on_ball((target, *turning), c, rate)
            }
            _ => sum,
        }
    }

    /// The torque on the child of a hinge about this axis, at this angle and rate, in its frame.
    #[inline(always)]
    pub(super) fn on_hinge<S: Scalar>(
        &self,
        told: &ToldInJoint<S>,
        axis: Vec3<S>,
        turning: [S; 2],
    ) -> Vec3<S> {
        let sum = told.torque - axis * turning[1].times(self.damping);
        match (&self.servo, &told.aim) {
            (Some(servo), Aim::Hinge(target)) => sum + axis * servo.on_hinge(*target, turning),
            _ => sum,
        }
    }
}
