//! The continuous model: the Lagrangian (6), the Legendre transform (10), the forces (11)–(13), Hamilton's equations (18)–(20).

use dvi::{Context, ContinuousSystem, Lagrangian, ShapeError, System};
use lie::{Cotangent, SO3, Scalar, Vec3};

use crate::inertia::Elimination;
use crate::joints::{Any, Balls, Kinds};
use crate::loads::{ForceWork, Scenery};
use crate::pose::Pose;
use crate::tree::{ArticulatedBody, Configuration, Momentum, Velocity};

impl System for ArticulatedBody {
    type Group = Configuration;

    /// The first body's position, but under a weight: $x$ enters nowhere, and the displacement $\Delta x$ enters (31) linearly.
    fn cyclic(&self) -> core::ops::Range<usize> {
        match self.is_free() && self.loads.let_float() {
            true => self.translation(),
            false => 0..0,
        }
    }

    fn is_driven(&self) -> bool {
        self.moves_as_told() || self.has_forces()
    }

    fn terms(&self) -> usize {
        self.nodes.len()
    }

    fn is_symplectic(&self) -> bool {
        !self.has_forces()
    }

    fn fits(&self, g: &Configuration) -> bool {
        self.has_shape_of(g)
    }
}

impl Lagrangian for ArticulatedBody {
    /// The kinetic energy (6), less the potential of the loads.
    fn value<S: Scalar>(&self, at: Context<S>, g: &Configuration<S>, xi: &Velocity<S>) -> S {
        let mut pose = Pose::default();
        let (r, pose) = self.pose(at.t, g, &mut pose);
        let (rates, velocities) = self.body_velocities((r, pose), xi);
        let twice = self.twice_kinetic(&rates, &velocities);
        twice.times(0.5) - self.potential((r, pose), g)
    }

    /// (10), in closed form.
    fn legendre(&self, t: f64, g: &Configuration, xi: &Velocity) -> Result<Momentum, ShapeError> {
        self.check_shape(g, xi)?;
        Ok(self.momenta(t, g, xi))
    }
}

/// Storage of an evaluation.
#[derive(Clone, Debug)]
pub struct Evaluation<S = f64> {
    pub(crate) pose: Pose<S>,
    pub(crate) elimination: Elimination<S>,
    /// On each body about its joint, and on all that hangs on it by no ball.
    pub(crate) torques: Vec<Cotangent<3, S>>,
    /// Of the loads that are no gradient.
    forces: ForceWork<S>,
    /// The force on the whole, in the reference frame.
    pub(crate) on_whole: Vec3<S>,
}

impl<S: Scalar> Default for Evaluation<S> {
    fn default() -> Self {
        Self {
            pose: Pose::default(),
            elimination: Elimination::default(),
            torques: Vec::new(),
            forces: ForceWork::default(),
            on_whole: Vec3::zero(),
        }
    }
}

impl<S: Scalar> Evaluation<S> {
    /// Lets prescribed joints of a tree do other motions than they are told, in the next evaluation at the time `t`, s. A motion is the
    /// attitude of each body on its parent, and the rate of it in the body's frame, rad/s.
    ///
    /// So a stroke can be differentiated by its own numbers. What follows belongs to these motions until they are given anew.
    pub fn steer(
        &mut self,
        tree: &ArticulatedBody,
        t: S,
        motions: impl Iterator<Item = (usize, (SO3<S>, Vec3<S>))>,
    ) {
        tree.steer_motions(t, motions, &mut self.pose);
    }
}

impl ArticulatedBody {
    /// The velocity of a momentum, without the forces.
    pub(crate) fn velocity_into(
        &self,
        at: Context<f64>,
        (g, mu): (&Configuration, &Momentum),
        work: &mut Evaluation,
        xi: &mut Velocity,
    ) {
        let Evaluation {
            pose, elimination, ..
        } = work;
        let (r, pose) = self.pose(at.t, g, pose);
        let drive = pose.drive();
        elimination.factorise_and_begin::<Any>(self, (r, &pose.c), drive, mu);
        elimination.finish::<Any>(self, &r[0], drive, xi);
    }
}

impl ArticulatedBody {
    /// Adds the torques of what is no gradient; the force on the whole is returned.
    #[inline(always)]
    fn force<K: Kinds, S: Scalar>(
        &self,
        at: Scenery<S>,
        elimination: &Elimination<S>,
        work: &mut ForceWork<S>,
        torques: &mut [Cotangent<3, S>],
    ) -> Vec3<S> {
        let forces = &self.loads.forces;
        if K::ARE_BALLS || forces.are_none() {
            return Vec3::zero();
        }
        let twist = |i: usize| elimination.twist(i);
        forces.add(self, at, (twist, S::one()), work, torques)
    }
}

impl ArticulatedBody {
    /// Velocity and force, where so much is known of the joints.
    #[inline(always)]
    fn evaluate<K: Kinds, S: Scalar>(
        &self,
        at: Context<S>,
        (g, mu): (&Configuration<S>, &Momentum<S>),
        work: &mut Evaluation<S>,
        xi: &mut Velocity<S>,
        tau: &mut Momentum<S>,
    ) {
        let Evaluation {
            pose,
            elimination,
            torques,
            forces,
            on_whole,
        } = work;
        let (r, pose) = self.pose(at.t, g, pose);
        let drive = pose.drive();
        elimination.factorise_and_begin::<K>(self, (r, &pose.c), drive, mu);
        let scenery = Scenery { t: at.t, g, r };
        *on_whole = self.loads.force().unwrap_or(Vec3::zero());
        if !K::ARE_BALLS && self.has_inner() {
            torques.resize(r.len(), Cotangent::zero());
            elimination.finish_with_forces::<K>(self, &r[0], drive, xi, torques);
            self.loads.add_torques(r, S::one(), torques);
            *on_whole += self.force::<K, S>(scenery, elimination, forces, torques);
            elimination.gather::<K>(self, torques, tau);
            self.loads.add_to_hinges(&g.2, S::one(), &mut tau.2);
        } else {
            elimination.finish_with_forces::<K>(self, &r[0], drive, xi, &mut tau.0);
            self.loads.add_torques(r, S::one(), &mut tau.0);
            *on_whole += self.force::<K, S>(scenery, elimination, forces, &mut tau.0);
        }
        if self.floats::<K>() {
            tau.1[0] = (*on_whole).into();
        }
    }
}

impl ContinuousSystem for ArticulatedBody {
    type Workspace<S: Scalar> = Evaluation<S>;
    const INLINE: bool = true;

    fn is_defined(&self, t: f64, _: &Configuration) -> bool {
        self.knows(t)
    }

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Configuration<S>,
        mu: &Momentum<S>,
        work: &mut Evaluation<S>,
        xi: &mut Velocity<S>,
        tau: &mut Momentum<S>,
    ) {
        match self.is_plain() {
            true => self.evaluate::<Balls, S>(at, (g, mu), work, xi, tau),
            false => self.evaluate::<Any, S>(at, (g, mu), work, xi, tau),
        }
    }
}
