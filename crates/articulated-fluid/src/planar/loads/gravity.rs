//! Gravity and buoyancy in the plane.
//!
//! Of the potential $-\gamma \cdot R_i s_i$ of body $i$ only two numbers are left, $a_i = s_i \cdot \gamma$ and
//! $b_i = s_i \times \gamma$: $$ U = -w_0\, \gamma \cdot x - \sum_i \left(a_i \cos\theta_i + b_i \sin\theta_i\right) . $$

use lie::{Cotangent, SO2, Scalar};

use crate::planar::vector::Vec2;

/// The weight of a tree of bodies.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::planar) struct Weight {
    /// $w_0 \gamma$, N, in the frame of the plane.
    pub(in crate::planar) total: Vec2,
    /// $(a_i, b_i)$, N m.
    pub(in crate::planar) levers: Vec<Vec2>,
}

impl Weight {
    /// Whether the whole floats: then nothing depends on where it is.
    pub(super) fn is_neutral(&self) -> bool {
        self.total == Vec2::zero()
    }

    /// $w_0 \gamma$, N.
    #[inline(always)]
    pub(super) fn force<S: Scalar>(&self) -> Vec2<S> {
        self.total.lift()
    }

    /// Adds the torques times `scale`.
    #[inline(always)]
    pub(super) fn add_torques<S: Scalar>(
        &self,
        r: &[SO2<S>],
        scale: S,
        torques: &mut [Cotangent<1, S>],
    ) {
        for (i, (r, slot)) in r.iter().zip(torques).enumerate() {
            slot[0] += self.torque(i, r) * scale;
        }
    }

    /// The torque on body `i`, $b_i \cos\theta - a_i \sin\theta$, N m.
    #[inline(always)]
    fn torque<S: Scalar>(&self, i: usize, r: &SO2<S>) -> S {
        let [a, b] = self.levers[i].0;
        r.cos().times(b) - r.sin().times(a)
    }

    /// $U$, J, of the position of the first body and the attitudes of all.
    #[inline(always)]
    pub(super) fn potential<S: Scalar>(&self, r: &[SO2<S>], x: Vec2<S>) -> S {
        let levers = self.levers.iter().zip(r);
        levers.fold(-self.force().dot(x), |sum, (lever, r)| {
            let [a, b] = lever.0;
            sum - r.cos().times(a) - r.sin().times(b)
        })
    }
}
