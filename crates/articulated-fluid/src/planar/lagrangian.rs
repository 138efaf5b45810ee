//! The continuous model in the plane: the Lagrangian (6), the Legendre transform (10), Hamilton's equations (18)–(20).

use dvi::{Context, ContinuousSystem, Lagrangian, ShapeError};
use lie::{Cotangent, Power, SO2, Scalar};
use smallvec::SmallVec;

use super::inertia::PlanarElimination;
use super::tree::{Momentum, PlanarBody, PlanarConfiguration, Velocity};
use super::vector::Vec2;
use crate::kinematics::PerBody;

impl PlanarBody {
    /// The velocities $V_i$ of the mass centres, each in its body's frame, (16), with the quarter turn $J$:
    /// $V_i = C_i^T (V_p + \Omega_p J d_{pi}) - \Omega_i J d_{ip}$.
    fn centre_velocities<S: Scalar>(
        &self,
        r: &[SO2<S>],
        (omega, dx): &Velocity<S>,
    ) -> PerBody<Vec2<S>> {
        let swept = |d: Vec2, i: usize| d.quarter_turn().lift() * omega[i][0];
        let mut velocities: PerBody<Vec2<S>> = SmallVec::with_capacity(self.nodes.len());
        velocities.push(Vec2(dx[0].0).rotated_back(&r[0]));
        for (i, node) in self.nodes.iter().enumerate().skip(1) {
            let joint = velocities[node.parent] + swept(node.at_parent, node.parent);
            let joint = joint.rotated(&r[node.parent]).rotated_back(&r[i]);
            velocities.push(joint - swept(node.at_self, i));
        }
        velocities
    }
}

impl Lagrangian for PlanarBody {
    /// The kinetic energy (6), less the potential of the loads.
    fn value<S: Scalar>(&self, _: Context<S>, g: &PlanarConfiguration<S>, xi: &Velocity<S>) -> S {
        let velocities = self.centre_velocities(&g.0, xi);
        let mut twice = S::zero();
        for (i, (node, v)) in self.nodes.iter().zip(velocities).enumerate() {
            let omega = xi.0[i][0];
            twice += v.dot(node.mass.apply(v)) + (omega * omega).times(node.j);
        }
        twice.times(0.5) - self.loads.potential(&g.0, Vec2(g.1[0].0))
    }

    /// (10): with $F_i = M_i V_i + \sum_k C_k F_k$,
    /// $p_x = R_0 F_0$ and $p_i = J_i \Omega_i - d_{ip} \times F_i + \sum_k d_{ik} \times C_k F_k$.
    fn legendre(
        &self,
        _: f64,
        g: &PlanarConfiguration,
        xi: &Velocity,
    ) -> Result<Momentum, ShapeError> {
        self.check_shape(g, xi)?;
        let r = &g.0;
        let mut momenta = self.centre_velocities(r, xi);
        for (v, node) in momenta.iter_mut().zip(&self.nodes) {
            *v = node.mass.apply(*v);
        }
        let spins = self.nodes.iter().zip(xi.0.iter());
        let mut p: PerBody<f64> = spins.map(|(node, omega)| node.j * omega[0]).collect();
        for (i, node) in self.nodes.iter().enumerate().skip(1).rev() {
            let force = momenta[i].rotated(&r[i]);
            let on_parent = force.rotated_back(&r[node.parent]);
            p[i] -= node.at_self.cross(momenta[i]);
            p[node.parent] += node.at_parent.cross(on_parent);
            momenta[node.parent] += on_parent;
        }
        let linear = Cotangent(momenta[0].rotated(&r[0]).0);
        let angular = p.into_iter().map(|p| Cotangent([p])).collect();
        Ok((angular, Power::new(vec![linear])))
    }
}

impl ContinuousSystem for PlanarBody {
    type Workspace<S: Scalar> = PlanarElimination<S>;
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _: Context<S>,
        (r, _): &PlanarConfiguration<S>,
        mu: &Momentum<S>,
        elimination: &mut PlanarElimination<S>,
        xi: &mut Velocity<S>,
        tau: &mut Momentum<S>,
    ) {
        elimination.factorise(self, r);
        elimination.begin(self, &r[0], mu);
        elimination.finish_with_forces(self, &r[0], xi, tau);
        tau.1[0].0 = self.loads.force().unwrap_or(Vec2::zero()).0;
        self.loads.add_torques(r, S::one(), &mut tau.0);
    }
}
