//! Frames: a rotation and a place.

use lie::{LieGroup, SO3, Vec3};

/// A frame in another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    /// From this frame to the other one.
    pub turn: SO3,
    /// Its origin, m.
    pub at: Vec3,
}

impl Pose {
    pub fn identity() -> Self {
        Self {
            turn: SO3::identity(),
            at: Vec3::zero(),
        }
    }

    /// The frame of an `origin` element: $R = R_z(y) R_y(p) R_x(r)$.
    pub fn of(origin: &urdf_rs::Pose) -> Self {
        let about = |axis: usize| {
            let (sin, cos) = (0.5 * origin.rpy.0[axis]).sin_cos();
            let mut quaternion = [cos, 0.0, 0.0, 0.0];
            quaternion[axis + 1] = sin;
            SO3::from_quaternion(quaternion)
        };
        Self {
            turn: about(2).compose(&about(1)).compose(&about(0)),
            at: Vec3(origin.xyz.0),
        }
    }

    /// The frame that is `inner` in this one.
    pub fn then(&self, inner: &Self) -> Self {
        Self {
            turn: self.turn.compose(&inner.turn),
            at: self.place(inner.at),
        }
    }

    /// A point of this frame, in the other one.
    pub fn place(&self, x: Vec3) -> Vec3 {
        self.at + self.turn.rotate(x)
    }
}
