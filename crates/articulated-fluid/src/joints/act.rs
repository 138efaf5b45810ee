//! What each kind of joint does in the recursions of a tree: the one place that tells the kinds apart.

use lie::{Mat3, SO3, Scalar, Vec3};

use super::{HingeFactors, Kinds, Link, Role};
use crate::displaced::Angles;
use crate::pose::{Drive, Pose};
use crate::tree::{ArticulatedBody, Configuration, Momentum, Velocity};

impl ArticulatedBody {
    /// Whether the joint of body `i` turns it as told.
    pub(crate) fn is_turned(&self, i: usize) -> bool {
        match self.nodes[i].role {
            Role::Prescribed(k) => self.joints.motions[k].is_driven(),
            _ => false,
        }
    }

    /// $C_i$ and $a_i$ of a joint that moves as told, into the pose.
    pub(crate) fn read_motion<S: Scalar>(&self, t: S, i: usize, pose: &mut Pose<S>) {
        if let Role::Prescribed(k) = self.nodes[i].role {
            (pose.c[i], pose.rates[i]) = self.joints.motions[k].at(t);
        }
    }

    /// The attitude $R_i$ of a body that has one of its own; else $C_i$ goes into the pose, where it is not yet.
    #[inline(always)]
    pub(crate) fn own_attitude<S: Scalar>(
        &self,
        i: usize,
        g: &Configuration<S>,
        pose: &mut Pose<S>,
    ) -> Option<SO3<S>> {
        match self.nodes[i].role {
            Role::Ball(k) => return Some(g.0[k]),
            Role::Hinge(k) => pose.c[i] = self.joints.hinges[k].relative(g.2[k].0[0]),
            Role::Prescribed(_) => {}
        }
        None
    }

    /// $C_i^T C_{i+} - I$ over a step, without cancellation; $C_{i+}$ goes into the next pose, where it is not yet.
    #[inline(always)]
    pub(crate) fn own_turn<S: Scalar>(
        &self,
        i: usize,
        (g, angles): (&Configuration<S>, Angles<S>),
        [now, next]: [&mut Pose<S>; 2],
    ) -> Mat3<S> {
        if let Role::Hinge(k) = self.nodes[i].role {
            let (hinge, dq) = (&self.joints.hinges[k], angles[k].0[0]);
            next.c[i] = hinge.relative(g.2[k].0[0] + dq);
            return hinge.turn_minus_identity(dq);
        }
        let (c, c_next) = (*now.c[i].matrix(), *next.c[i].matrix());
        c.transpose() * (c_next - c)
    }

    /// The rate of body `i`: its own, or what the joint adds to what the parent hands on.
    #[inline(always)]
    pub(crate) fn rate<S: Scalar>(
        &self,
        i: usize,
        (omega, _, dq): &Velocity<S>,
        pose: &Pose<S>,
        turning: impl FnOnce() -> Vec3<S>,
    ) -> Vec3<S> {
        match self.nodes[i].role {
            Role::Ball(k) => omega[k].vec3(),
            Role::Hinge(k) => turning() + self.joints.hinges[k].axis.lift() * dq[k][0],
            Role::Prescribed(_) => turning() + pose.rates[i],
        }
    }

    /// Writes what the joint of body `i` makes of a moment on it; whether the parent takes it over.
    #[inline(always)]
    pub(crate) fn project<K: Kinds, S: Scalar>(
        &self,
        i: usize,
        moment: Vec3<S>,
        out: &mut Momentum<S>,
    ) -> bool {
        match self.role::<K>(i) {
            Role::Ball(k) => {
                out.0[k] = moment.into();
                return false;
            }
            Role::Hinge(k) => out.2[k][0] = moment.dot(self.joints.hinges[k].axis.lift()),
            Role::Prescribed(_) => {}
        }
        i > 0
    }

    /// The momentum of what the joint of body `i` leaves whole: of a ball.
    #[inline(always)]
    pub(crate) fn own_momentum<K: Kinds, S: Scalar>(&self, i: usize, mu: &Momentum<S>) -> Vec3<S> {
        match self.role::<K>(i) {
            Role::Ball(k) => mu.0[k].vec3(),
            _ => Vec3::zero(),
        }
    }

    /// What the joint of body `i` leaves free, eliminated from the mass; with $h d$ of a damper in it, (S23).
    #[inline(always)]
    pub(crate) fn eliminate_mass<K: Kinds, S: Scalar>(
        &self,
        i: usize,
        resistance: Option<S>,
        link: &mut Link<S>,
        hinges: &mut [HingeFactors<S>],
    ) {
        let node = &self.nodes[i];
        let is_root = self.role::<K>(i).is_root();
        // Balls without children stay as they were made, but for a damper, which knows the step.
        if is_root && node.is_leaf && resistance.is_none() {
            return;
        }
        if node.is_leaf {
            link.reset(node, &self.masses[i]);
        }
        if is_root {
            return link.eliminate(resistance);
        }
        if let Role::Hinge(k) = self.role::<K>(i) {
            let axis = self.joints.hinges[k].axis.lift();
            link.eliminate_hinge(axis, resistance, &mut hinges[k]);
        }
    }

    /// What the joint of body `i` leaves free, eliminated from the momenta.
    #[inline(always)]
    pub(crate) fn eliminate_force<K: Kinds, S: Scalar>(
        &self,
        i: usize,
        (drive, mu): (Drive<S>, &Momentum<S>),
        link: &mut Link<S>,
        hinges: &mut [HingeFactors<S>],
    ) {
        match self.role::<K>(i) {
            Role::Ball(_) => link.eliminate_force(),
            Role::Hinge(k) => {
                let axis = self.joints.hinges[k].axis.lift();
                link.eliminate_hinge_force(axis, mu.2[k][0], &mut hinges[k]);
            }
            Role::Prescribed(_) => link.drive(drive.rate(i)),
        }
    }

    /// The velocity of body `i` from the parent's rate in its frame and the velocity of its joint.
    #[inline(always)]
    pub(crate) fn advance<K: Kinds, S: Scalar>(
        &self,
        i: usize,
        (turning, u): (Vec3<S>, Vec3<S>),
        drive: Drive<S>,
        link: &mut Link<S>,
        hinges: &mut [HingeFactors<S>],
    ) {
        let node = &self.nodes[i];
        match self.role::<K>(i) {
            Role::Ball(_) => return link.advance(u, node.at_self.lift()),
            Role::Hinge(k) => {
                let axis = self.joints.hinges[k].axis.lift();
                link.advance_hinge(axis, (turning, u), &mut hinges[k]);
            }
            Role::Prescribed(_) => link.omega = turning + drive.rate(i),
        }
        link.v = u + node.at_self.lift::<S>().cross(link.omega);
    }

    /// Writes the velocity of what the joint of body `i` leaves free.
    #[inline(always)]
    pub(crate) fn write_velocity<K: Kinds, S: Scalar>(
        &self,
        i: usize,
        link: &Link<S>,
        hinges: &[HingeFactors<S>],
        xi: &mut Velocity<S>,
    ) {
        match self.role::<K>(i) {
            Role::Ball(k) => xi.0[k] = link.omega.into(),
            Role::Hinge(k) => xi.2[k][0] = hinges[k].rate,
            Role::Prescribed(_) => {}
        }
    }

    /// The force on the joint of body `i`, from what the parent hands on; a hinge keeps the moment.
    #[inline(always)]
    pub(crate) fn force_on_joint<K: Kinds, S: Scalar>(
        &self,
        i: usize,
        (turning, u): (Vec3<S>, Vec3<S>),
        link: &Link<S>,
        hinges: &mut [HingeFactors<S>],
    ) -> Vec3<S> {
        let role = self.role::<K>(i);
        if role.is_root() {
            return link.mass * u + link.force;
        }
        let (force, moment) = link.wrench(turning, u);
        if let Role::Hinge(k) = role {
            hinges[k].moment = moment;
        }
        force
    }

    /// $n_i \times \Omega_i$ of a hinge, which turns with its body, (S14).
    #[inline(always)]
    pub(crate) fn transport<K: Kinds, S: Scalar>(
        &self,
        i: usize,
        link: &Link<S>,
        hinges: &[HingeFactors<S>],
    ) -> Vec3<S> {
        match self.role::<K>(i) {
            Role::Hinge(k) => hinges[k].moment.cross(link.omega),
            _ => Vec3::zero(),
        }
    }
}
