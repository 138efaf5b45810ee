//! Gravity and buoyancy: what acts where a body is heavier or lighter than the water it displaces.
//!
//! The net force on body $i$ is $m_i \gamma$ at its mass centre, with the gravity $\gamma$ and the mass $m_i$ less that of the
//! displaced fluid. The forces are parallel, so each body only needs the sum $w_i$ of its subtree and one constant lever:
//! $$ U = -\sum_i m_i \gamma \cdot x_i = -w_0\, \gamma \cdot x - \sum_i \gamma \cdot R_i s_i, \qquad s_i = \sum_{k \text{ on } i} w_k d_{ik} - w_i d_{ip(i)} . $$
//! Buoyancy at the point $b_i$ of a body that displaces $\rho V_i$ adds $-\rho V_i b_i$ to $s_i$, (S28).

use lie::{Cotangent, SO3, Scalar, Vec3};

use crate::node::Node;

/// The weight of a tree of bodies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Weight {
    /// $\gamma$, m/s², reference frame.
    gravity: Vec3,
    /// $m_i$, kg.
    net_masses: Vec<f64>,
    /// $w_0$, kg.
    total: f64,
    /// $s_i$, kg m, in the body's frame.
    levers: Vec<Vec3>,
    /// Whether buoyancy acts anywhere but at a mass centre.
    has_points: bool,
}

impl Weight {
    pub(crate) fn new(gravity: Vec3, net_masses: &[f64], nodes: &[Node]) -> Self {
        let sizes: Vec<f64> = net_masses.iter().map(|mass| mass.abs()).collect();
        let (total, levers) = moments(net_masses, nodes);
        let (size, lengths) = moments_of_sizes(&sizes, nodes);
        // Net masses that cancel as the scene's decimal numbers do leave the rounding of so many terms.
        let is_rounding = |part: f64, size: f64| {
            let rounding = f64::EPSILON * nodes.len() as f64 * size;
            part <= rounding && rounding.is_finite()
        };
        let kept = |(lever, size): (Vec3, f64)| match is_rounding(lever.norm(), size) {
            true => Vec3::zero(),
            false => lever,
        };
        Self {
            gravity,
            net_masses: net_masses.to_vec(),
            total: if is_rounding(total.abs(), size) {
                0.0
            } else {
                total
            },
            levers: levers.into_iter().zip(lengths).map(kept).collect(),
            has_points: false,
        }
    }

    /// The same with buoyancy of these moments $\rho V_i b_i$ about the mass centres, kg m in the bodies' frames.
    pub(crate) fn with_buoyancy(mut self, moments: &[Vec3]) -> Self {
        for (lever, moment) in self.levers.iter_mut().zip(moments) {
            *lever -= *moment;
            self.has_points |= *moment != Vec3::zero();
        }
        self
    }

    /// Whether buoyancy acts anywhere but at a mass centre.
    pub(crate) fn has_points(&self) -> bool {
        self.has_points
    }

    /// The same levers on a whole that floats.
    pub(crate) fn afloat(mut self) -> Self {
        self.total = 0.0;
        self
    }

    pub(crate) fn is_finite(&self) -> bool {
        let levers = self.levers.iter().all(|s| s.is_finite());
        self.gravity.is_finite() && self.total.is_finite() && levers
    }

    /// $\gamma$, m/s².
    pub(crate) fn gravity(&self) -> Vec3 {
        self.gravity
    }

    /// $m_i$, kg.
    pub(crate) fn net_masses(&self) -> &[f64] {
        &self.net_masses
    }

    /// $w_0$, kg.
    pub(crate) fn total(&self) -> f64 {
        self.total
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

    /// Adds the torques times `scale`, each in its body's frame.
    #[inline(always)]
    pub(super) fn add_torques<S: Scalar>(
        &self,
        r: &[SO3<S>],
        scale: S,
        torques: &mut [Cotangent<3, S>],
    ) {
        for (i, (r, slot)) in r.iter().zip(torques).enumerate() {
            *slot = (slot.vec3() + self.torque(i, r) * scale).into();
        }
    }

    /// The torque on body `i`, $s_i \times R_i^T \gamma$, N m, in its frame.
    #[inline(always)]
    pub(crate) fn torque<S: Scalar>(&self, i: usize, r: &SO3<S>) -> Vec3<S> {
        let down = r.inverse_rotate(self.gravity.lift());
        self.levers[i].lift::<S>().cross(down)
    }

    /// $U$, J, of the position of the first body and the attitudes of all.
    #[inline(always)]
    pub(super) fn potential<S: Scalar>(&self, r: &[SO3<S>], x: Vec3<S>) -> S {
        let gravity = self.gravity.lift::<S>();
        let levers = self.levers.iter().zip(r);
        levers.fold(-(self.force().dot(x)), |sum, (s, r)| {
            sum - gravity.dot(r.rotate(s.lift()))
        })
    }
}

/// The sum $w_0$ of such masses, kg, and the levers $s_i$, kg m, each in its body's frame.
pub(crate) fn moments(masses: &[f64], nodes: &[Node]) -> (f64, Vec<Vec3>) {
    let (mut sums, mut levers) = (masses.to_vec(), vec![Vec3::zero(); nodes.len()]);
    for (i, node) in nodes.iter().enumerate().skip(1).rev() {
        sums[node.parent] += sums[i];
        levers[node.parent] += node.at_parent * sums[i];
        levers[i] -= node.at_self * sums[i];
    }
    if let (Some(node), Some(sum)) = (nodes.first(), sums.first()) {
        levers[0] -= node.at_self * *sum;
    }
    (sums.first().copied().unwrap_or(0.0), levers)
}

/// What cancels in [`moments`], of the sizes of the masses.
fn moments_of_sizes(sizes: &[f64], nodes: &[Node]) -> (f64, Vec<f64>) {
    let (mut sums, mut lengths) = (sizes.to_vec(), vec![0.0; nodes.len()]);
    for (i, node) in nodes.iter().enumerate().skip(1).rev() {
        sums[node.parent] += sums[i];
        lengths[node.parent] += node.at_parent.norm() * sums[i];
        lengths[i] += node.at_self.norm() * sums[i];
    }
    if let (Some(node), Some(sum)) = (nodes.first(), sums.first()) {
        lengths[0] += node.at_self.norm() * sum;
    }
    (sums.first().copied().unwrap_or(0.0), lengths)
}
