//! Elastic joints in the plane.
//!
//! The turn $R_p^T R_i = N_p \operatorname{rot}(\theta_i - \theta_p) N_i^T$ is about the normal where that has the same direction
//! in both bodies' frames. Then $N_p^T N_i = \operatorname{rot}(\alpha_i)$, the angle from frame to frame at rest, and
//! $$ U = \sum_i k_i \left(1 - \cos(\theta_i - \theta_p - \alpha_i)\right) . $$

use lie::{Cotangent, LieGroup, SO2, Scalar};

/// The joints that are elastic.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::planar) struct Springs(pub(in crate::planar) Vec<Spring>);

/// An elastic joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::planar) struct Spring {
    pub(in crate::planar) parent: usize,
    pub(in crate::planar) child: usize,
    /// $k_i$, N m.
    pub(in crate::planar) stiffness: f64,
    /// $\alpha_i$.
    pub(in crate::planar) rest: SO2,
}

impl Springs {
    /// Adds the torques times `scale`.
    #[inline(always)]
    pub(super) fn add_torques<S: Scalar>(
        &self,
        r: &[SO2<S>],
        scale: S,
        torques: &mut [Cotangent<1, S>],
    ) {
        for spring in &self.0 {
            let torque = -(scale * spring.turn(r).sin()).times(spring.stiffness);
            torques[spring.child][0] += torque;
            torques[spring.parent][0] -= torque;
        }
    }

    /// $U$, J, of the attitudes.
    #[inline(always)]
    pub(super) fn potential<S: Scalar>(&self, r: &[SO2<S>]) -> S {
        self.0.iter().fold(S::zero(), |sum, spring| {
            sum - spring.turn(r).cos_minus_one().times(spring.stiffness)
        })
    }
}

impl Spring {
    /// The turn from rest, $\theta_i - \theta_p - \alpha_i$.
    #[inline(always)]
    fn turn<S: Scalar>(&self, r: &[SO2<S>]) -> SO2<S> {
        let (cos, sin) = (S::from_f64(self.rest.cos()), S::from_f64(self.rest.sin()));
        let aligned = r[self.parent].compose(&SO2::from_cos_sin_unchecked(cos, sin));
        aligned.inverse().compose(&r[self.child])
    }
}
