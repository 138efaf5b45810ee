//! The continuous model in the plane: the Lagrangian (6), the Legendre transform (10), Hamilton's equations (18)–(20).

use core::ops::Range;

use dvi::{ContinuousSystem, Lagrangian, ShapeError};
use lie::{AlgebraOver, Cotangent, DualOver, LieGroup, Scalar};
use smallvec::SmallVec;

use super::elimination::Elimination;
use super::vector::Vec2;
use super::{Attitudes, PlanarBody, PlanarConfiguration, of};
use crate::discrete::PerBody;
use crate::elimination::of_mut;

impl PlanarBody {
    /// The velocities $V_i$ of the mass centres, each in its body's frame, (16), with the quarter turn $J$:
    /// $V_i = C_i^T (V_p + \Omega_p J d_{pi}) - \Omega_i J d_{ip}$.
    fn centre_velocities<S: Scalar>(
        &self,
        r: Attitudes<S>,
        (omega0, dx, omega): &AlgebraOver<PlanarConfiguration, S>,
    ) -> PerBody<Vec2<S>> {
        let swept = |d: Vec2, i: usize| d.quarter_turn().lift() * of((omega0, omega), i)[0];
        let mut velocities: PerBody<Vec2<S>> = SmallVec::with_capacity(self.nodes.len());
        velocities.push(Vec2(dx.0).rotated_back(r.0));
        for (i, node) in self.nodes.iter().enumerate().skip(1) {
            let joint = velocities[node.parent] + swept(node.at_parent, node.parent);
            let joint = joint.rotated(of(r, node.parent)).rotated_back(of(r, i));
            velocities.push(joint - swept(node.at_self, i));
        }
        velocities
    }

    /// $U$, J, of the weight and of the elastic joints; without them zero.
    pub(super) fn potential<S: Scalar>(&self, (r0, x, r): &PlanarConfiguration<S>) -> S {
        let attitudes = core::iter::once(r0).chain(r.iter());
        let weight = self.weight.as_ref();
        let weight = weight.map(|w| w.potential(Vec2(x.0), attitudes));
        let springs = self.springs.as_ref().map(|s| s.potential((r0, r)));
        weight.unwrap_or(S::zero()) + springs.unwrap_or(S::zero())
    }
}

impl Lagrangian for PlanarBody {
    type Group = PlanarConfiguration;

    /// The kinetic energy (6), less the potential of the weight and of the elastic joints.
    fn value<S: Scalar>(
        &self,
        g: &PlanarConfiguration<S>,
        xi: &AlgebraOver<PlanarConfiguration, S>,
    ) -> S {
        let velocities = self.centre_velocities((&g.0, &g.2), xi);
        let mut twice = S::zero();
        for (i, (node, v)) in self.nodes.iter().zip(velocities).enumerate() {
            let omega = of((&xi.0, &xi.2), i)[0];
            twice += v.dot(node.mass.apply(v)) + (omega * omega).times(node.j);
        }
        twice.times(0.5) - self.potential(g)
    }

    /// (10): with $F_i = M_i V_i + \sum_k C_k F_k$,
    /// $p_x = R_0 F_0$ and $p_i = J_i \Omega_i - d_{ip} \times F_i + \sum_k d_{ik} \times C_k F_k$.
    fn legendre(
        &self,
        _t: f64,
        g: &PlanarConfiguration,
        xi: &<PlanarConfiguration as LieGroup>::Algebra,
    ) -> Result<<PlanarConfiguration as LieGroup>::Dual, ShapeError> {
        self.check_shape(g, xi)?;
        let (r0, _, r) = g;
        let r = (r0, &r[..]);
        let mut momenta = self.centre_velocities(r, xi);
        for (v, node) in momenta.iter_mut().zip(&self.nodes) {
            *v = node.mass.apply(*v);
        }
        let spin = |i: usize| self.nodes[i].j * of((&xi.0, &xi.2), i)[0];
        let mut p: PerBody<f64> = (0..self.nodes.len()).map(spin).collect();
        for (i, node) in self.nodes.iter().enumerate().skip(1).rev() {
            let force = momenta[i].rotated(of(r, i));
            let on_parent = force.rotated_back(of(r, node.parent));
            p[i] -= node.at_self.cross(momenta[i]);
            p[node.parent] += node.at_parent.cross(on_parent);
            momenta[node.parent] += on_parent;
        }
        let tails = p[1..].iter().map(|p| Cotangent([*p])).collect();
        let linear = momenta[0].rotated(r0);
        Ok((Cotangent([p[0]]), Cotangent(linear.0), tails))
    }

    /// The first body's position, but under a weight: $x$ enters nowhere.
    fn cyclic(&self) -> Range<usize> {
        self.free_translation()
    }

    fn fits(&self, g: &PlanarConfiguration) -> bool {
        self.is_of(g)
    }
}

impl ContinuousSystem for PlanarBody {
    type Group = PlanarConfiguration;
    type Workspace<S: Scalar> = Elimination<S>;
    const INLINE: bool = true;

    fn workspace<S: Scalar>(&self, _: &PlanarConfiguration<S>) -> Elimination<S> {
        Elimination::new(self)
    }

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _t: S,
        (r0, _, r): &PlanarConfiguration<S>,
        mu: &DualOver<PlanarConfiguration, S>,
        elimination: &mut Elimination<S>,
        xi: &mut AlgebraOver<PlanarConfiguration, S>,
        tau: &mut DualOver<PlanarConfiguration, S>,
    ) {
        elimination.factorise(self, (r0, r));
        elimination.begin(self, r0, mu);
        elimination.finish_with_forces(self, r0, xi, tau);
        if let Some(weight) = &self.weight {
            tau.1.0 = weight.force().0;
            for i in 0..self.nodes.len() {
                of_mut((&mut tau.0, &mut tau.2), i)[0] += weight.torque(i, of((r0, r), i));
            }
        }
        if let Some(springs) = &self.springs {
            springs.add_torques((r0, r), S::one(), (&mut tau.0, &mut tau.2));
        }
    }

    fn fits(&self, g: &PlanarConfiguration) -> bool {
        self.is_of(g)
    }
}
