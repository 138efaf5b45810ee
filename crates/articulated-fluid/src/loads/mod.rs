//! What acts on the bodies: each load a file, of what potential it has and what torques and force it gives.

mod gravity;
mod spring;

use lie::{Cotangent, SO3, Scalar, Vec3};

pub(crate) use gravity::{Weight, moments};
pub(crate) use spring::{Spring, Springs};

/// The loads of a tree of bodies.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Loads {
    pub(crate) weight: Option<Weight>,
    pub(crate) springs: Option<Springs>,
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

    /// The force on the whole, N, reference frame, if there may be one; it is constant.
    #[inline(always)]
    pub(crate) fn force<S: Scalar>(&self) -> Option<Vec3<S>> {
        self.weight.as_ref().map(Weight::force)
    }

    /// Whether nothing depends on where the whole is.
    pub(crate) fn let_float(&self) -> bool {
        self.weight.as_ref().is_none_or(Weight::is_neutral)
    }
}
