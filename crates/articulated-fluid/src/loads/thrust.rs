//! Thrust: a force at a point of a body, which goes with it, (S28).

use std::sync::Arc;

use lie::{Scalar, Vec3};

use crate::motion::{self, Law};

/// A force at a point of a body.
#[derive(Clone, Debug)]
pub struct Thrust {
    /// N, in the body's frame.
    pub force: Arc<dyn Law<3>>,
    /// From the mass centre, m in the body's frame.
    pub at: Vec3,
}

impl PartialEq for Thrust {
    /// Laws are the same where they are one and the same.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.force, &other.force) && self.at == other.at
    }
}

impl Thrust {
    /// The force and the moment about the mass centre.
    #[inline(always)]
    pub(super) fn wrench<S: Scalar>(&self, t: S) -> [Vec3<S>; 2] {
        let force = Vec3(motion::value(self.force.as_ref(), t));
        [force, self.at.lift::<S>().cross(force)]
    }
}
