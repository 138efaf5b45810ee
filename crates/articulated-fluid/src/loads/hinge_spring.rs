//! Elastic hinges: $U = \sum_j \tfrac12 k_j (q_j - q_{0j})^2$, (S21).

use lie::{Cotangent, Power, Rn, Scalar};

/// The hinges that are elastic.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HingeSprings(pub(super) Vec<HingeSpring>);

impl HingeSprings {
    /// Those that are elastic; none where none is.
    pub(crate) fn new(elastic: Vec<HingeSpring>) -> Option<Self> {
        (!elastic.is_empty()).then_some(Self(elastic))
    }
}

/// An elastic hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HingeSpring {
    pub(crate) hinge: usize,
    /// $k_j$, N m/rad.
    pub(crate) stiffness: f64,
    /// $q_{0j}$, rad.
    pub(crate) rest: f64,
}

impl HingeSprings {
    /// Adds the torques about the axes times `scale`, N m.
    #[inline(always)]
    pub(super) fn add_torques<S: Scalar>(
        &self,
        q: &Power<Rn<1, S>>,
        scale: S,
        torques: &mut Power<Cotangent<1, S>>,
    ) {
        for spring in &self.0 {
            let turn = q[spring.hinge].0[0] - S::from_f64(spring.rest);
            torques[spring.hinge][0] -= (scale * turn).times(spring.stiffness);
        }
    }

    /// $U$, J.
    #[inline(always)]
    pub(super) fn potential<S: Scalar>(&self, q: &Power<Rn<1, S>>) -> S {
        self.0.iter().fold(S::zero(), |sum, spring| {
            let turn = q[spring.hinge].0[0] - S::from_f64(spring.rest);
            sum + (turn * turn).times(0.5 * spring.stiffness)
        })
    }
}
