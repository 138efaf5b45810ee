//! Gravity and buoyancy in the plane.
//!
//! Of the potential $-\gamma \cdot R_i s_i$ of body $i$ only two numbers are left, $a_i = s_i \cdot \gamma$ and
//! $b_i = s_i \times \gamma$: $$ U = -w_0\, \gamma \cdot x - \sum_i \left(a_i \cos\theta_i + b_i \sin\theta_i\right) . $$

use lie::{SO2, Scalar};

use super::vector::Vec2;

/// The weight of a tree of bodies.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Weight {
    /// $w_0 \gamma$, N, in the frame of the plane.
    pub(super) total: Vec2,
    /// $(a_i, b_i)$, N m.
    pub(super) levers: Vec<Vec2>,
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

    /// The torque on body `i`, $b_i \cos\theta - a_i \sin\theta$, N m.
    #[inline(always)]
    pub(super) fn torque<S: Scalar>(&self, i: usize, r: &SO2<S>) -> S {
        let [a, b] = self.levers[i].0;
        r.cos().times(b) - r.sin().times(a)
    }

    /// $U$, J, of the position of the first body and the attitudes of all.
    #[inline(always)]
    pub(super) fn potential<'a, S: Scalar>(
        &self,
        x: Vec2<S>,
        attitudes: impl Iterator<Item = &'a SO2<S>>,
    ) -> S {
        let levers = self.levers.iter().zip(attitudes);
        levers.fold(-self.force().dot(x), |sum, (lever, r)| {
            let [a, b] = lever.0;
            sum - r.cos().times(a) - r.sin().times(b)
        })
    }
}
