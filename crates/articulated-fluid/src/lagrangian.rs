//! The continuous model: the Lagrangian (6), the Legendre transform (10), the forces (11)–(13), Hamilton's equations (18)–(20).

use dvi::{Context, ContinuousSystem, Lagrangian, ShapeError, System};
use lie::{Scalar, Vec3};

use crate::inertia::Elimination;
use crate::tree::{ArticulatedBody, Configuration, Momentum, Velocity};

impl System for ArticulatedBody {
    type Group = Configuration;

    /// The first body's position, but under a weight: $x$ enters nowhere, and the displacement $\Delta x$ enters (31) linearly.
    fn cyclic(&self) -> core::ops::Range<usize> {
        match self.loads.let_float() {
            true => self.translation(),
            false => 0..0,
        }
    }

    fn fits(&self, g: &Configuration) -> bool {
        self.has_shape_of(g)
    }
}

impl Lagrangian for ArticulatedBody {
    /// The kinetic energy (6), less the potential of the loads.
    fn value<S: Scalar>(&self, _: Context<S>, g: &Configuration<S>, xi: &Velocity<S>) -> S {
        let velocities = self.centre_velocities(&g.0, xi);
        let mut twice = S::zero();
        for (i, (node, v)) in self.nodes.iter().zip(velocities).enumerate() {
            let omega = xi.0[i].vec3();
            twice += v.dot(self.masses[i].apply(v)) + omega.dot(node.j.apply(omega));
        }
        twice.times(0.5) - self.loads.potential(&g.0, g.1[0].vec3())
    }

    /// (10), in closed form.
    fn legendre(&self, _: f64, g: &Configuration, xi: &Velocity) -> Result<Momentum, ShapeError> {
        self.check_shape(g, xi)?;
        Ok(self.momenta(g, xi))
    }
}

impl ContinuousSystem for ArticulatedBody {
    type Workspace<S: Scalar> = Elimination<S>;
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _: Context<S>,
        (r, _): &Configuration<S>,
        mu: &Momentum<S>,
        elimination: &mut Elimination<S>,
        xi: &mut Velocity<S>,
        tau: &mut Momentum<S>,
    ) {
        elimination.factorise_and_begin(self, r, mu);
        elimination.finish_with_forces(self, &r[0], xi, tau);
        tau.1[0] = self.loads.force().unwrap_or(Vec3::zero()).into();
        self.loads.add_torques(r, S::one(), &mut tau.0);
    }
}
