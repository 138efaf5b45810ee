//! The continuous model: the Lagrangian (6), the Legendre transform (10), the forces (11)–(13), Hamilton's equations (18)–(20).

use core::ops::Range;

use dvi::{ContinuousSystem, Lagrangian, ShapeError};
use lie::{AlgebraOver, DualOver, LieGroup, Scalar, Vec3};
use smallvec::SmallVec;

use crate::discrete::PerBody;
use crate::elimination::{Attitudes, Elimination, of, of_mut};
use crate::{ArticulatedBody, Configuration};

impl ArticulatedBody {
    /// The velocities $V_i$ of the mass centres, each in its body's frame, (16):
    /// $V_i = C_i^T (V_p + \Omega_p \times d_{pi}) + d_{ip} \times \Omega_i$.
    fn centre_velocities<S: Scalar>(
        &self,
        r: Attitudes<S>,
        (omega0, dx, omega): &AlgebraOver<Configuration, S>,
    ) -> PerBody<Vec3<S>> {
        let rate = |i: usize| of((omega0, omega), i).vec3();
        let mut velocities: PerBody<Vec3<S>> = SmallVec::with_capacity(self.nodes.len());
        velocities.push(r.0.inverse_rotate(dx.vec3()));
        for (i, node) in self.nodes.iter().enumerate().skip(1) {
            let swept = rate(node.parent).cross(node.at_parent.lift());
            let joint = of(r, node.parent).rotate(velocities[node.parent] + swept);
            let own = node.at_self.lift::<S>().cross(rate(i));
            velocities.push(of(r, i).inverse_rotate(joint) + own);
        }
        velocities
    }

    /// $U$, J, of the weight and of the elastic joints; without them zero.
    pub(crate) fn potential<S: Scalar>(&self, r: Attitudes<S>, x: Vec3<S>) -> S {
        let attitudes = core::iter::once(r.0).chain(r.1);
        let weight = self.weight.as_ref().map(|w| w.potential(x, attitudes));
        let springs = self.springs.as_ref().map(|s| s.potential(r));
        weight.unwrap_or(S::zero()) + springs.unwrap_or(S::zero())
    }

    /// The momenta of a velocity of the right shape, (10) with the rows of (4): with $F_i = M_i V_i + \sum_k C_k F_k$,
    /// $p_x = R_0 F_0$ and $p_i = J_i \Omega_i - d_{ip} \times F_i + \sum_k d_{ik} \times C_k F_k$.
    pub(crate) fn momenta(
        &self,
        (r0, _, r): &Configuration,
        xi: &<Configuration as LieGroup>::Algebra,
    ) -> <Configuration as LieGroup>::Dual {
        let r = (r0, &r[..]);
        let mut momenta = self.centre_velocities(r, xi);
        for (v, mass) in momenta.iter_mut().zip(&self.masses) {
            *v = mass.apply(*v);
        }
        let spin = |i: usize| self.nodes[i].j * of((&xi.0, &xi.2), i).vec3();
        let mut p: PerBody<Vec3> = (0..self.nodes.len()).map(spin).collect();
        for (i, node) in self.nodes.iter().enumerate().skip(1).rev() {
            let force = of(r, i).rotate(momenta[i]);
            let on_parent = of(r, node.parent).inverse_rotate(force);
            p[i] -= node.at_self.cross(momenta[i]);
            p[node.parent] += node.at_parent.cross(on_parent);
            momenta[node.parent] += on_parent;
        }
        let tails = p[1..].iter().map(|p| (*p).into()).collect();
        (p[0].into(), r0.rotate(momenta[0]).into(), tails)
    }
}

impl Lagrangian for ArticulatedBody {
    type Group = Configuration;

    /// The kinetic energy (6), less the potential of the weight and of the elastic joints.
    fn value<S: Scalar>(&self, g: &Configuration<S>, xi: &AlgebraOver<Configuration, S>) -> S {
        let velocities = self.centre_velocities((&g.0, &g.2), xi);
        let mut twice = S::zero();
        for (i, (node, v)) in self.nodes.iter().zip(velocities).enumerate() {
            let omega = of((&xi.0, &xi.2), i).vec3();
            twice += v.dot(self.masses[i].apply(v)) + omega.dot(node.j.apply(omega));
        }
        twice.times(0.5) - self.potential((&g.0, &g.2), g.1.vec3())
    }

    /// (10), in closed form.
    fn legendre(
        &self,
        _t: f64,
        g: &Configuration,
        xi: &<Configuration as LieGroup>::Algebra,
    ) -> Result<<Configuration as LieGroup>::Dual, ShapeError> {
        self.check_shape(g, xi)?;
        Ok(self.momenta(g, xi))
    }

    /// The first body's position, but under a weight: $x$ enters nowhere.
    fn cyclic(&self) -> Range<usize> {
        self.free_translation()
    }

    fn fits(&self, g: &Configuration) -> bool {
        g.2.len() + 1 == self.nodes.len()
    }
}

impl ContinuousSystem for ArticulatedBody {
    type Group = Configuration;
    type Workspace<S: Scalar> = Elimination<S>;
    const INLINE: bool = true;

    fn workspace<S: Scalar>(&self, _: &Configuration<S>) -> Elimination<S> {
        Elimination::new(self)
    }

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _t: S,
        (r0, _, r): &Configuration<S>,
        mu: &DualOver<Configuration, S>,
        elimination: &mut Elimination<S>,
        xi: &mut AlgebraOver<Configuration, S>,
        tau: &mut DualOver<Configuration, S>,
    ) {
        elimination.factorise_and_begin(self, (r0, r), mu);
        elimination.finish_with_forces(self, r0, xi, tau);
        if let Some(weight) = &self.weight {
            tau.1 = weight.force().into();
            for i in 0..self.nodes.len() {
                let tau = of_mut((&mut tau.0, &mut tau.2), i);
                *tau = (tau.vec3() + weight.torque(i, of((r0, r), i))).into();
            }
        }
        if let Some(springs) = &self.springs {
            springs.add_torques((r0, r), S::one(), (&mut tau.0, &mut tau.2));
        }
    }

    fn fits(&self, g: &Configuration) -> bool {
        g.2.len() + 1 == self.nodes.len()
    }
}
