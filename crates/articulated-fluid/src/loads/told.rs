//! What loads are told, read once for each time: the iterations of a step come back to the same ones.

use lie::{Scalar, Vec3};

use super::joint_load::ToldInJoint;
use crate::tree::Identity;

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
    pub(super) fn read(
        &mut self,
        key: (Identity, S),
        joints: impl Iterator<Item = ToldInJoint<S>>,
        thrusts: impl Iterator<Item = [Vec3<S>; 2]>,
    ) {
        let known = |(tree, at): (Identity, S)| tree.is(key.0) && at == key.1;
        if self.read.is_some_and(known) {
            return;
        }
        self.joints.clear();
        self.joints.extend(joints);
        self.thrusts.clear();
        self.thrusts.extend(thrusts);
        self.read = Some(key);
    }
}
