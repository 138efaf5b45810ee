//! Where the bodies are and how they move: what viewers, tables and monitors read.

use lie::{Cotangent, Power, SO3, Scalar, Vec3};
use smallvec::SmallVec;

use crate::node::Joint;
use crate::tree::{ArticulatedBody, Configuration, Momentum, Velocity};

/// Bodies whose quantities fit on the stack.
const FEW: usize = 8;

/// A quantity of each body.
pub(crate) type PerBody<T> = SmallVec<[T; FEW]>;

impl ArticulatedBody {
    /// The largest $\lVert I - R_i^T R_i \rVert_F$ of the bodies.
    pub fn orthogonality_error(&self, g: &Configuration) -> f64 {
        g.0.iter().map(SO3::orthogonality_error).fold(0.0, f64::max)
    }

    /// Where the joints are, in the reference frame: $x_p + R_p d_{pi}$, m, in the order of the bodies that hang on them;
    /// as many as both the model and `g` have.
    pub fn joint_positions(&self, g: &Configuration) -> Vec<Vec3> {
        let centres = self.centre_positions(g);
        let known = self.joints().zip(centres.iter().skip(1));
        let position =
            |joint: Joint| centres[joint.parent] + g.0[joint.parent].rotate(joint.at_parent);
        known.map(|(joint, _)| position(joint)).collect()
    }

    /// Where the mass centres are, in the reference frame: $x$, then $x_p + R_p d_{pi} - R_i d_{ip}$, m;
    /// as many as both the model and `g` have.
    pub fn centre_positions(&self, (r, x): &Configuration) -> Vec<Vec3> {
        let mut centres: Vec<Vec3> = x.iter().take(r.len().min(1)).map(|x| x.vec3()).collect();
        for (joint, r_i) in self.joints().zip(r.iter().skip(1)) {
            if let Some(centre) = centres.get(joint.parent) {
                let at = *centre + r[joint.parent].rotate(joint.at_parent);
                centres.push(at - r_i.rotate(joint.at_child));
            }
        }
        centres
    }

    /// The velocities $V_i$ of the mass centres, each in its body's frame, (16):
    /// $V_i = C_i^T (V_p + \Omega_p \times d_{pi}) + d_{ip} \times \Omega_i$.
    pub(crate) fn centre_velocities<S: Scalar>(
        &self,
        r: &[SO3<S>],
        (omega, dx): &Velocity<S>,
    ) -> PerBody<Vec3<S>> {
        let mut velocities: PerBody<Vec3<S>> = SmallVec::with_capacity(self.nodes.len());
        velocities.push(r[0].inverse_rotate(dx[0].vec3()));
        for (i, node) in self.nodes.iter().enumerate().skip(1) {
            let swept = omega[node.parent].vec3().cross(node.at_parent.lift());
            let joint = r[node.parent].rotate(velocities[node.parent] + swept);
            let own = node.at_self.lift::<S>().cross(omega[i].vec3());
            velocities.push(r[i].inverse_rotate(joint) + own);
        }
        velocities
    }

    /// The momenta of a velocity of the right shape, (10) with the rows of (4): with $F_i = M_i V_i + \sum_k C_k F_k$,
    /// $p_x = R_0 F_0$ and $p_i = J_i \Omega_i - d_{ip} \times F_i + \sum_k d_{ik} \times C_k F_k$.
    pub(crate) fn momenta(&self, (r, _): &Configuration, xi: &Velocity) -> Momentum {
        let mut momenta = self.centre_velocities(r, xi);
        for (v, mass) in momenta.iter_mut().zip(&self.masses) {
            *v = mass.apply(*v);
        }
        let spins = self.nodes.iter().zip(xi.0.iter());
        let mut p: PerBody<Vec3> = spins.map(|(node, omega)| node.j * omega.vec3()).collect();
        for (i, node) in self.nodes.iter().enumerate().skip(1).rev() {
            let force = r[i].rotate(momenta[i]);
            let on_parent = r[node.parent].inverse_rotate(force);
            p[i] -= node.at_self.cross(momenta[i]);
            p[node.parent] += node.at_parent.cross(on_parent);
            momenta[node.parent] += on_parent;
        }
        let linear = Power::new(vec![r[0].rotate(momenta[0]).into()]);
        (p.into_iter().map(Cotangent::from).collect(), linear)
    }
}
