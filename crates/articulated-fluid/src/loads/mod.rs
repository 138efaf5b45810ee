//! What acts on the bodies: each load a file, of what potential it has, or what torques and force it gives.

mod forces;
mod gravity;
mod hinge_spring;
mod joint_load;
pub(crate) mod on_bodies;
mod on_tree;
mod servo;
mod size;
mod spring;
mod told;
mod torque;

use lie::{Cotangent, Power, Rn, SO3, Scalar, Vec3};

pub(crate) use forces::{ForceWork, Forces, Scenery};
pub(crate) use gravity::{Weight, moments};
pub(crate) use hinge_spring::HingeSprings;
pub use joint_load::JointLoad;
pub use servo::Servo;
pub(crate) use spring::{Spring, Springs};
pub use torque::Torque;

/// The loads of a tree of bodies.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Loads {
    pub(crate) weight: Option<Weight>,
    pub(crate) springs: Option<Springs>,
    pub(crate) hinge_springs: Option<HingeSprings>,
    pub(crate) forces: Forces,
}

impl Loads {
    /// $U$, J, at the attitudes and the position of the first body; without loads zero.
    #[inline(always)]
    pub(crate) fn potential<S: Scalar>(&self, r: &[SO3<S>], x: Vec3<S>) -> S {
        let weight = self.weight.as_ref().map(|weight| weight.potential(r, x));
        let springs = self.springs.as_ref().map(|springs| springs.potential(r));
        weight.unwrap_or(S::zero()) + springs.unwrap_or(S::zero())
    }

    /// Adds the torques times `scale`, N m, each in its body's frame.
    #[inline(always)]
    pub(crate) fn add_torques<S: Scalar>(
        &self,
        r: &[SO3<S>],
        scale: S,
        torques: &mut [Cotangent<3, S>],
    ) {
        if let Some(weight) = &self.weight {
            weight.add_torques(r, scale, torques);
        }
        if let Some(springs) = &self.springs {
            springs.add_torques(r, scale, torques);
        }
    }

    /// $U$, J, of what is in the hinges.
    #[inline(always)]
    pub(crate) fn potential_of_hinges<S: Scalar>(&self, q: &Power<Rn<1, S>>) -> S {
        let springs = self.hinge_springs.as_ref();
        springs.map_or(S::zero(), |springs| springs.potential(q))
    }

    /// Adds the torques about the axes of the hinges times `scale`, N m.
    #[inline(always)]
    pub(crate) fn add_to_hinges<S: Scalar>(
        &self,
        q: &Power<Rn<1, S>>,
        scale: S,
        torques: &mut Power<Cotangent<1, S>>,
    ) {
        if let Some(springs) = &self.hinge_springs {
            springs.add_torques(q, scale, torques);
        }
    }

    /// The force on the whole, N, reference frame, if there may be one; it is constant.
    #[inline(always)]
    pub(crate) fn force<S: Scalar>(&self) -> Option<Vec3<S>> {
        self.weight.as_ref().map(Weight::force)
    }

    /// Whether nothing acts on the whole.
    pub(crate) fn let_float(&self) -> bool {
        let is_neutral = self.weight.as_ref().is_none_or(Weight::is_neutral);
        is_neutral && !self.forces.act_on_bodies()
    }
}
