//! What loads are told, read once for each time: the iterations of a step come back to the same ones.

use lie::{Mat3, Scalar, Vec3};

use super::Forces;
use super::forces::JointLoad;
use crate::tree::Identity;

/// What the load in a joint is told at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToldInJoint<S> {
    /// In the child's frame, in which a hinge has this axis.
    pub(super) torque: Vec3<S>,
    pub(super) aim: Aim<S>,
}

/// What a servo follows at a time.
#[derive(Clone, Copy, Debug)]
pub(super) enum Aim<S> {
    /// Nothing: there is none.
    None,
    /// $Q$ and $a$.
    Ball(Mat3<S>, Vec3<S>),
    /// $q_d$ and $\dot q_d$.
    Hinge([S; 2]),
}

impl JointLoad {
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

/// What all loads are told.
#[derive(Clone, Debug)]
pub(crate) struct Told<S> {
    /// The tree and the time that it was read of at last.
    read: Option<(Identity, S)>,
    /// In the order of the loads.
    pub(super) joints: Vec<ToldInJoint<S>>,
    pub(super) thrusts: Vec<[Vec3<S>; 2]>,
}

impl<S> Default for Told<S> {
    fn default() -> Self {
        Self {
            read: None,
            joints: Vec::new(),
            thrusts: Vec::new(),
        }
    }
}

impl<S: Scalar> Told<S> {
    /// Reads it, unless it was read for this time and tree.
    #[inline(always)]
    pub(super) fn read(&mut self, forces: &Forces, (tree, t): (Identity, S)) {
        let known = |(other, at): (Identity, S)| other.is(tree) && at == t;
        if !self.read.is_some_and(known) {
            self.read_anew(forces, (tree, t));
        }
    }

    fn read_anew(&mut self, forces: &Forces, (tree, t): (Identity, S)) {
        let joints = forces.joints.iter().map(|joint| joint.told(t));
        self.joints.clear();
        self.joints.extend(joints);
        self.thrusts.clear();
        self.thrusts
            .extend(forces.thrusts.iter().map(|(_, thrust)| thrust.wrench(t)));
        self.read = Some((tree, t));
    }
}
