//! Gravity and buoyancy: what acts where a body is heavier or lighter than the water it displaces.
//!
//! The net force on body $i$ is $m_i \gamma$ at its mass centre, with the gravity $\gamma$ and the mass $m_i$ less that of the
//! displaced fluid. The forces are parallel, so each body only needs the sum $w_i$ of its subtree and one constant lever:
//! $$ U = -\sum_i m_i \gamma \cdot x_i = -w_0\, \gamma \cdot x - \sum_i \gamma \cdot R_i s_i, \qquad s_i = \sum_{k \text{ on } i} w_k d_{ik} - w_i d_{ip(i)} . $$

use lie::{SO3, Scalar, Vec3};

use crate::model::Node;

/// The weight of a tree of bodies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Weight {
    /// $\gamma$, m/s², reference frame.
    gravity: Vec3,
    /// $w_0$, kg.
    total: f64,
    /// $s_i$, kg m, in the body's frame.
    levers: Vec<Vec3>,
}

impl Weight {
    pub(crate) fn new(gravity: Vec3, net_masses: &[f64], nodes: &[Node]) -> Self {
        let mut sums = net_masses.to_vec();
        // What cancels in the sums and the levers: their rounding is relative to it.
        let mut sizes: Vec<f64> = net_masses.iter().map(|mass| mass.abs()).collect();
        let mut levers = vec![Vec3::zero(); nodes.len()];
        let mut lever_sizes = vec![0.0; nodes.len()];
        for (i, node) in nodes.iter().enumerate().skip(1).rev() {
            sums[node.parent] += sums[i];
            sizes[node.parent] += sizes[i];
            levers[node.parent] += node.at_parent * sums[i];
            lever_sizes[node.parent] += node.at_parent.norm() * sizes[i];
            levers[i] -= node.at_self * sums[i];
            lever_sizes[i] += node.at_self.norm() * sizes[i];
        }
        let first = |values: &[f64]| values.first().copied().unwrap_or(0.0);
        let (total, size) = (first(&sums), first(&sizes));
        let is_rounding = |part: f64, size: f64| {
            let rounding = f64::EPSILON * nodes.len() as f64 * size;
            part <= rounding && rounding.is_finite()
        };
        for (lever, size) in levers.iter_mut().zip(lever_sizes) {
            if is_rounding(lever.norm(), size) {
                *lever = Vec3::zero();
            }
        }
        Self {
            gravity,
            total: if is_rounding(total.abs(), size) {
                0.0
            } else {
                total
            },
            levers,
        }
    }

    pub(crate) fn is_finite(&self) -> bool {
        let levers = self.levers.iter().all(|s| s.is_finite());
        self.gravity.is_finite() && self.total.is_finite() && levers
    }

    /// $\gamma$, m/s².
    pub(crate) fn gravity(&self) -> Vec3 {
        self.gravity
    }

    /// Whether the whole floats: then nothing depends on where it is.
    pub(crate) fn is_neutral(&self) -> bool {
        self.total == 0.0
    }

    /// Whether it does nothing anywhere: neither a force nor a torque.
    pub(crate) fn is_balanced(&self) -> bool {
        let levers = self.levers.iter().all(|s| *s == Vec3::zero());
        levers && self.is_neutral()
    }

    /// $w_0 \gamma$, N, reference frame.
    #[inline(always)]
    pub(crate) fn force<S: Scalar>(&self) -> Vec3<S> {
        (self.gravity * self.total).lift()
    }

    /// The torque on body `i`, $s_i \times R_i^T \gamma$, N m, in its frame.
    #[inline(always)]
    pub(crate) fn torque<S: Scalar>(&self, i: usize, r: &SO3<S>) -> Vec3<S> {
        let down = r.inverse_rotate(self.gravity.lift());
        self.levers[i].lift::<S>().cross(down)
    }

    /// $U$, J, of the position of the first body and the attitudes of all.
    #[inline(always)]
    pub(crate) fn potential<'a, S: Scalar>(
        &self,
        x: Vec3<S>,
        attitudes: impl Iterator<Item = &'a SO3<S>>,
    ) -> S {
        let gravity = self.gravity.lift::<S>();
        let levers = self.levers.iter().zip(attitudes);
        levers.fold(-(self.force().dot(x)), |sum, (s, r)| {
            sum - gravity.dot(r.rotate(s.lift()))
        })
    }
}
