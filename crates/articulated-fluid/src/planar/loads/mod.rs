//! What acts on the bodies of a plane: each load a file, as in space.

mod gravity;
mod spring;

use lie::{Cotangent, SO2, Scalar};

use super::vector::Vec2;
pub(super) use gravity::Weight;
pub(super) use spring::{Spring, Springs};

/// The loads of a tree of bodies in a plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Loads {
    pub(super) weight: Option<Weight>,
    pub(super) springs: Option<Springs>,
}

impl Loads {
    /// $U$, J, at the attitudes and the position of the first body; without loads zero.
    #[inline(always)]
    pub(super) fn potential<S: Scalar>(&self, r: &[SO2<S>], x: Vec2<S>) -> S {
        let weight = self.weight.as_ref().map(|weight| weight.potential(r, x));
        let springs = self.springs.as_ref().map(|springs| springs.potential(r));
        weight.unwrap_or(S::zero()) + springs.unwrap_or(S::zero())
    }

    /// Adds the torques times `scale`, N m.
    #[inline(always)]
    pub(super) fn add_torques<S: Scalar>(
        &self,
        r: &[SO2<S>],
        scale: S,
        torques: &mut [Cotangent<1, S>],
    ) {
        if let Some(weight) = &self.weight {
            weight.add_torques(r, scale, torques);
        }
        if let Some(springs) = &self.springs {
            springs.add_torques(r, scale, torques);
        }
    }

    /// The force on the whole, N, in the frame of the plane, if there may be one; it is constant.
    #[inline(always)]
    pub(super) fn force<S: Scalar>(&self) -> Option<Vec2<S>> {
        self.weight.as_ref().map(Weight::force)
    }

    /// Whether nothing depends on where the whole is.
    pub(super) fn let_float(&self) -> bool {
        self.weight.as_ref().is_none_or(Weight::is_neutral)
    }
}
