//! Elastic joints: what turns a body back to where its frame is aligned with that of its parent.
//!
//! The joint of body $i$ on its parent $p$, of stiffness $k_i \ge 0$, resists the turn $C_i = R_p^T R_i$ by its angle $\theta_i$:
//! $$ U = \sum_i k_i (1 - \cos\theta_i) = \sum_i \tfrac12 k_i \left(3 - \mathrm{tr}\, C_i\right) = \sum_i \tfrac14 k_i \lVert R_i - R_p \rVert_F^2 . $$
//! By $\delta R_i = R_i \hat\eta$, $\delta U = -\frac12 k_i\, \mathrm{tr}[C_i \hat\eta] = k_i\, a_i \cdot \eta$ with
//! $\hat a_i = \frac12 (C_i - C_i^T)$, so the torque on the body is $-k_i a_i$. The axis of a rotation does not turn,
//! $C_i a_i = a_i$: the torque on the parent is $+k_i a_i$ in its own frame, and in space both cancel. With the rows $r_j$ and $p_j$ of
//! $R_i$ and $R_p$, $C_i = \sum_j p_j r_j^T$ and $-a_i = \frac12 \sum_j p_j \times r_j$.

use lie::{Cotangent, Mat3, SO3, Scalar, Vec3};

/// The joints that are elastic.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Springs(Vec<Spring>);

/// An elastic joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spring {
    /// None for the world.
    pub(crate) parent: Option<usize>,
    pub(crate) child: usize,
    /// $k_i$, N m.
    pub(crate) stiffness: f64,
}

impl Springs {
    /// Those that are elastic; none where none is.
    pub(crate) fn new(elastic: Vec<Spring>) -> Option<Self> {
        (!elastic.is_empty()).then_some(Self(elastic))
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Spring> {
        self.0.iter()
    }

    /// Adds the torques times `scale`, each in its body's frame.
    #[inline(always)]
    pub(super) fn add_torques<S: Scalar>(
        &self,
        r: &[SO3<S>],
        scale: S,
        torques: &mut [Cotangent<3, S>],
    ) {
        for spring in &self.0 {
            let torque = spring.torque(r) * scale;
            let on_child = &mut torques[spring.child];
            *on_child = (on_child.vec3() + torque).into();
            if let Some(parent) = spring.parent {
                let on_parent = &mut torques[parent];
                *on_parent = (on_parent.vec3() - torque).into();
            }
        }
    }

    /// $U$, J, of the attitudes.
    #[inline(always)]
    pub(super) fn potential<S: Scalar>(&self, r: &[SO3<S>]) -> S {
        let potentials = self.0.iter().map(|spring| spring.potential(r));
        potentials.fold(S::zero(), |sum, u| sum + u)
    }
}

impl Spring {
    /// The attitude of the parent.
    #[inline(always)]
    fn on<S: Scalar>(&self, r: &[SO3<S>]) -> Mat3<S> {
        match self.parent {
            Some(parent) => *r[parent].matrix(),
            None => Mat3::identity(),
        }
    }

    /// The torque on the child, $-k_i a_i$, N m, in its frame.
    #[inline(always)]
    pub(crate) fn torque<S: Scalar>(&self, r: &[SO3<S>]) -> Vec3<S> {
        let (p, r) = (self.on(r), r[self.child].matrix());
        let moment = |j: usize| p.row(j).cross(r.row(j));
        (moment(0) + moment(1) + moment(2)) * S::from_f64(0.5 * self.stiffness)
    }

    /// By the difference of the attitudes: the trace would lose the digits of a small angle.
    #[inline(always)]
    fn potential<S: Scalar>(&self, r: &[SO3<S>]) -> S {
        let (p, r) = (self.on(r), r[self.child].matrix());
        let square = |j: usize| (r.row(j) - p.row(j)).norm_squared();
        (square(0) + square(1) + square(2)).times(0.25 * self.stiffness)
    }
}
