//! What loads are told, read once for each time: the iterations of a step come back to the same ones.

use lie::Scalar;

use super::joint_load::ToldInJoint;
use super::on_bodies::Wrench;
use crate::tree::Identity;

/// What all loads are told.
#[derive(Clone, Debug)]
pub(crate) struct Told<S> {
    /// The tree and the time that it was read of at last.
    read: Option<(Identity, S)>,
    /// In the order of the loads.
    pub(super) joints: Vec<ToldInJoint<S>>,
    pub(super) bodies: Vec<Wrench<S>>,
}

impl<S> Default for Told<S> {
    fn default() -> Self {
        Self {
            read: None,
            joints: Vec::new(),
            bodies: Vec::new(),
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
        bodies: impl Iterator<Item = Wrench<S>>,
    ) {
        let known = |(tree, at): (Identity, S)| tree.is(key.0) && at == key.1;
        if self.read.is_some_and(known) {
            return;
        }
        self.joints.clear();
        self.joints.extend(joints);
        self.bodies.clear();
        self.bodies.extend(bodies);
        self.read = Some(key);
    }
}
