//! The continuous model: the Lagrangian (6), the Legendre transform (10), the forces (11)–(13), Hamilton's equations (18)–(20).

use core::ops::Range;

use dvi::{ContinuousSystem, Lagrangian};
use lie::{AlgebraOver, Cotangent, DualOver, LieGroup, Mat3, SO3, Scalar, Vec3};

use crate::model::Tail;
use crate::{ArticulatedBody, Configuration};

impl Tail {
    /// The velocity of the joint in the tail's frame, $u_i = R_i^T (\dot x - R_0 \hat d_{0i} \Omega_0)$.
    #[inline(always)]
    fn joint_velocity<S: Scalar>(
        &self,
        r0: &SO3<S>,
        r: &SO3<S>,
        dx: Vec3<S>,
        omega0: Vec3<S>,
    ) -> Vec3<S> {
        r.inverse_rotate(dx + r0.rotate(omega0.cross(self.on_head.lift())))
    }

    /// The velocity of the mass centre in the tail's frame, $V_i = u_i + \hat d_{i0} \Omega_i$, (16).
    #[inline(always)]
    fn centre_velocity<S: Scalar>(&self, u: Vec3<S>, omega: Vec3<S>) -> Vec3<S> {
        u + self.on_tail.lift::<S>().cross(omega)
    }
}

impl Lagrangian for ArticulatedBody {
    type Group = Configuration;

    /// The kinetic energy (6).
    fn value<S: Scalar>(&self, g: &Configuration<S>, xi: &AlgebraOver<Configuration, S>) -> S {
        let ((r0, _, r), (omega0, dx, omega)) = (g, xi);
        let (omega0, dx) = (omega0.vec3(), dx.vec3());
        let energy = |m: Mat3, v: Vec3<S>| v.dot(m.lift::<S>() * v) * S::from_f64(0.5);
        let mut sum = energy(self.head.m, r0.inverse_rotate(dx)) + energy(self.head.j, omega0);
        for ((tail, r), omega) in self.tails.iter().zip(r.iter()).zip(omega.iter()) {
            let u = tail.joint_velocity(r0, r, dx, omega0);
            let v = tail.centre_velocity(u, omega.vec3());
            sum += energy(tail.m, v) + energy(tail.j, omega.vec3());
        }
        sum
    }

    /// (10) with the rows of (4): $p_x = \sum_i R_i M_i V_i$, $p_0 = J_0 \Omega_0 + \sum_i \hat d_{0i} R_0^T R_i M_i V_i$, $p_i = J_i \Omega_i - \hat d_{i0} M_i V_i$.
    fn legendre(
        &self,
        _t: f64,
        g: &Configuration,
        xi: &<Configuration as LieGroup>::Algebra,
    ) -> <Configuration as LieGroup>::Dual {
        let ((r0, _, r), (omega0, dx, omega)) = (g, xi);
        let (omega0, dx) = (omega0.vec3(), dx.vec3());
        let mut px = r0.rotate(self.head.m * r0.inverse_rotate(dx));
        let mut p0 = self.head.j * omega0;
        let tails = self.tails.iter().zip(r.iter()).zip(omega.iter());
        let p = tails.map(|((tail, r), omega)| {
            let u = tail.joint_velocity(r0, r, dx, omega0);
            let momentum = tail.m * tail.centre_velocity(u, omega.vec3());
            px += r.rotate(momentum);
            p0 += tail.on_head.cross(r0.inverse_rotate(r.rotate(momentum)));
            Cotangent::from(tail.j * omega.vec3() - tail.on_tail.cross(momentum))
        });
        let p = p.collect();
        (p0.into(), px.into(), p)
    }

    /// The head's position: $x$ enters nowhere.
    fn cyclic(&self) -> Range<usize> {
        3..6
    }

    fn fits(&self, g: &Configuration) -> bool {
        g.2.len() == self.tails.len()
    }
}

impl ContinuousSystem for ArticulatedBody {
    type Group = Configuration;
    /// The attitudes of the tails in the head's frame.
    type Workspace<S: Scalar> = Vec<Mat3<S>>;

    fn workspace<S: Scalar>(&self, _: &Configuration<S>) -> Vec<Mat3<S>> {
        vec![Mat3::zero(); self.tails.len()]
    }

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _t: S,
        g: &Configuration<S>,
        mu: &DualOver<Configuration, S>,
        c: &mut Vec<Mat3<S>>,
        xi: &mut AlgebraOver<Configuration, S>,
        tau: &mut DualOver<Configuration, S>,
    ) {
        let (r0, _, r) = g;
        let system = self.head_system(r0, r, c);
        self.solve_inertia(r0, c, &system, mu, xi);
        let (omega0, v) = (xi.0.vec3(), r0.inverse_rotate(xi.1.vec3()));
        // (11): the head's own term, then one a tail.
        let mut tau0 = (self.head.m.lift::<S>() * v).cross(v);
        let tails = self
            .tails
            .iter()
            .zip(c.iter())
            .zip(xi.2.iter().zip(tau.2.iter_mut()));
        for ((tail, c), (omega, tau)) in tails {
            let d_omega = tail.on_head.lift::<S>().cross(omega0);
            let u = c.transpose_mul(v - d_omega);
            let momentum = tail.m.lift::<S>() * tail.centre_velocity(u, omega.vec3());
            tau0 -= d_omega.cross(*c * momentum);
            // (13).
            *tau = momentum.cross(u).into();
        }
        tau.0 = tau0.into();
        // (12).
        tau.1 = Vec3::zero().into();
    }

    fn fits(&self, g: &Configuration) -> bool {
        g.2.len() == self.tails.len()
    }
}
