//! Loads that are no gradient: what acts in joints and on bodies, summed to torques about the joints and a force on the whole.

use lie::{Cotangent, Mat3, SO3, Scalar, Vec3};

use super::joint_load::{JointLoad, ToldInJoint};
use super::servo::Aim;
use super::told::Told;
use super::{Drag, Thrust, Torque};
use crate::motion;
use crate::tree::{ArticulatedBody, Configuration};

/// A joint with a load.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LoadedJoint {
    /// None for the world.
    pub(crate) parent: Option<usize>,
    pub(crate) child: usize,
    /// The number of a hinge, and its axis.
    pub(crate) hinge: Option<(usize, Vec3)>,
    pub(crate) load: JointLoad,
}

/// The loads that are no gradient.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Forces {
    /// In the order of their children.
    pub(crate) joints: Vec<LoadedJoint>,
    pub(crate) drags: Vec<(usize, Drag)>,
    pub(crate) thrusts: Vec<(usize, Thrust)>,
}

/// What forces are told, and storage for their sums.
#[derive(Clone, Debug)]
pub(crate) struct ForceWork<S> {
    told: Told<S>,
    sums: Vec<Vec3<S>>,
}

impl<S> Default for ForceWork<S> {
    fn default() -> Self {
        Self {
            told: Told::default(),
            sums: Vec::new(),
        }
    }
}

/// When, and in which configuration and attitudes forces act.
#[derive(Clone, Copy)]
pub(crate) struct Scenery<'a, S> {
    pub(crate) t: S,
    pub(crate) g: &'a Configuration<S>,
    pub(crate) r: &'a [SO3<S>],
}

/// The rate and the velocity of the mass centre of a body, both in its frame.
pub(crate) type Twist<S> = [Vec3<S>; 2];

/// A body, with a force at its mass centre and a moment about it, both in its frame.
pub(crate) type OnBody<S> = (usize, [Vec3<S>; 2]);

/// The torque on the child of a joint, and the rate of the child on the parent, in the child's frame.
pub(crate) struct InJoint<S> {
    pub(crate) torque: Vec3<S>,
    pub(crate) rate: Vec3<S>,
    /// $C$.
    c: Mat3<S>,
}

impl LoadedJoint {
    /// What the load is told at the time `t`.
    pub(crate) fn told<S: Scalar>(&self, t: S) -> ToldInJoint<S> {
        self.load.told(t, self.hinge.map(|(_, axis)| axis))
    }

    /// What the load does, (S18)–(S22).
    #[inline(always)]
    pub(crate) fn act<S: Scalar>(
        &self,
        at: Scenery<S>,
        told: &ToldInJoint<S>,
        twist: impl Fn(usize) -> Twist<S>,
    ) -> InJoint<S> {
        let r = *at.r[self.child].matrix();
        let [own, _] = twist(self.child);
        let (c, rate) = match self.parent {
            None => (r, own),
            Some(parent) => {
                let c = at.r[parent].matrix().transpose() * r;
                (c, own - c.transpose_mul(twist(parent)[0]))
            }
        };
        let torque = match self.hinge {
            None => self.on_ball(told, &c, rate),
            Some((k, axis)) => {
                let axis = axis.lift();
                let turning = [at.g.2[k].0[0], axis.dot(rate)];
                self.on_hinge(told, axis, turning)
            }
        };
        InJoint { torque, rate, c }
    }

    #[inline(always)]
    fn on_ball<S: Scalar>(&self, told: &ToldInJoint<S>, c: &Mat3<S>, rate: Vec3<S>) -> Vec3<S> {
        let sum = told.torque - rate * S::from_f64(self.load.damping);
        match (&self.load.servo, &told.aim) {
            (Some(servo), Aim::Ball(target, turning)) => {
                sum + servo.on_ball((target, *turning), c, rate)
            }
            _ => sum,
        }
    }

    #[inline(always)]
    fn on_hinge<S: Scalar>(
        &self,
        told: &ToldInJoint<S>,
        axis: Vec3<S>,
        turning: [S; 2],
    ) -> Vec3<S> {
        let sum = told.torque - axis * turning[1].times(self.load.damping);
        match (&self.load.servo, &told.aim) {
            (Some(servo), Aim::Hinge(target)) => sum + axis * servo.on_hinge(*target, turning),
            _ => sum,
        }
    }
}

impl Forces {
    /// Whether there is nothing.
    #[inline(always)]
    pub(crate) fn are_none(&self) -> bool {
        self.joints.is_empty() && !self.act_on_bodies()
    }

    /// From when to when each is told, s.
    pub(crate) fn told(&self) -> impl Iterator<Item = [f64; 2]> {
        let joints = self.joints.iter().flat_map(|joint| {
            let torque = joint.load.torque.iter().map(Torque::told);
            let servo = joint.load.servo.iter().map(|servo| servo.target.told());
            torque.chain(servo)
        });
        let thrusts = self.thrusts.iter().map(|(_, thrust)| thrust.force.told());
        joints.chain(thrusts)
    }

    /// From when on each repeats itself, and after how long, s.
    pub(crate) fn repeats(&self) -> impl Iterator<Item = Option<[f64; 2]>> {
        let joints = self.joints.iter().flat_map(|joint| {
            let torque = joint.load.torque.iter().map(Torque::repeats);
            let servo = joint.load.servo.iter().map(|servo| servo.target.repeats());
            torque.chain(servo)
        });
        let thrusts = self
            .thrusts
            .iter()
            .map(|(_, thrust)| thrust.force.repeats());
        joints.chain(thrusts)
    }

    /// How fast each that is told changes, rad/s.
    pub(crate) fn told_rates(&self, until: f64) -> impl Iterator<Item = f64> {
        let joints = self.joints.iter().flat_map(move |joint| {
            let torque = joint.load.torque.iter();
            let torque = torque.map(move |torque| torque.rate(until));
            let servo = joint.load.servo.iter();
            torque.chain(servo.map(move |servo| servo.target.rate(until)))
        });
        let thrusts = self.thrusts.iter();
        joints.chain(thrusts.map(move |(_, thrust)| motion::rate(thrust.force.as_ref(), until)))
    }

    /// Whether all that is told is a number at the time `t`.
    pub(crate) fn are_known(&self, t: f64) -> bool {
        let joints = self.joints.iter().all(|joint| {
            let torque = joint.load.torque.as_ref();
            let axis = Vec3([1.0, 0.0, 0.0]);
            torque.is_none_or(|torque| torque.at(t, axis).is_finite())
        });
        let mut thrusts = self.thrusts.iter();
        joints && thrusts.all(|(_, thrust)| thrust.wrench(t)[0].is_finite())
    }

    /// Whether something acts on a body from outside, so that momentum is not kept.
    pub(crate) fn act_on_bodies(&self) -> bool {
        !(self.drags.is_empty() && self.thrusts.is_empty())
    }

    /// Adds the torques about the joints times `scale`; the force on the whole times `scale`, in the reference frame, is returned.
    #[inline(always)]
    pub(crate) fn add<S: Scalar>(
        &self,
        tree: &ArticulatedBody,
        at: Scenery<S>,
        (twist, scale): (impl Fn(usize) -> Twist<S> + Copy, S),
        ForceWork { told, sums: work }: &mut ForceWork<S>,
        torques: &mut [Cotangent<3, S>],
    ) -> Vec3<S> {
        let joints = self.joints.iter().map(|joint| joint.told(at.t));
        let thrusts = self.thrusts.iter().map(|(_, thrust)| thrust.wrench(at.t));
        told.read((tree.identity, at.t), joints, thrusts);
        let mut add = |i: usize, torque: Vec3<S>| {
            torques[i] = (torques[i].vec3() + torque * scale).into();
        };
        for (joint, told) in self.joints.iter().zip(&told.joints) {
            let InJoint { torque, c, .. } = joint.act(at, told, twist);
            add(joint.child, torque);
            if let Some(parent) = joint.parent {
                add(parent, -(c * torque));
            }
        }
        if !self.act_on_bodies() {
            return Vec3::zero();
        }
        work.clear();
        work.resize(tree.nodes.len(), Vec3::zero());
        let thrusts = self.thrusts.iter().zip(&told.thrusts);
        let thrusts = thrusts.map(|((i, _), wrench)| (*i, *wrench));
        for (i, wrench) in self.drag(twist).chain(thrusts) {
            work[i] += wrench[0];
            add(i, wrench[1]);
        }
        // (S24): what the levers of the joints make of the forces.
        for (i, node) in tree.nodes.iter().enumerate().rev() {
            add(i, -node.at_self.lift::<S>().cross(work[i]));
            if i > 0 {
                let on_parent = at.r[node.parent].inverse_rotate(at.r[i].rotate(work[i]));
                add(node.parent, node.at_parent.lift::<S>().cross(on_parent));
                work[node.parent] += on_parent;
            }
        }
        at.r[0].rotate(work[0]) * scale
    }

    /// The load in the joint of a body.
    pub(crate) fn in_joint(&self, child: usize) -> Option<&LoadedJoint> {
        let found = self
            .joints
            .binary_search_by_key(&child, |joint| joint.child);
        found.ok().map(|k| &self.joints[k])
    }

    /// Of all drag: the body, the force at its mass centre and the moment about it, in its frame.
    #[inline(always)]
    pub(crate) fn drag<S: Scalar>(
        &self,
        twist: impl Fn(usize) -> Twist<S>,
    ) -> impl Iterator<Item = OnBody<S>> {
        self.drags.iter().map(move |(i, drag)| {
            let [omega, v] = twist(*i);
            (*i, drag.wrench(omega, v))
        })
    }

    /// The same of all thrust.
    #[inline(always)]
    pub(crate) fn thrust<S: Scalar>(&self, t: S) -> impl Iterator<Item = OnBody<S>> {
        let thrusts = self.thrusts.iter();
        thrusts.map(move |(i, thrust)| (*i, thrust.wrench(t)))
    }
}
