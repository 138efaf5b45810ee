//! Loads that are no gradient: what acts in joints and on bodies, summed to torques about the joints and a force on the whole.

use lie::{Cotangent, Mat3, SO3, Scalar, Vec3};

use super::joint_load::{JointLoad, ToldInJoint};
use super::on_bodies::{BodyLoad, Twist, Wrench};
use super::told::Told;
use crate::motion::Timed;
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
    /// Each with its body, kind by kind in the order of their [names](BodyLoad::names).
    pub(crate) bodies: Vec<(usize, BodyLoad)>,
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
            None => self.load.on_ball(told, &c, rate),
            Some((k, axis)) => {
                let axis = axis.lift();
                let turning = [at.g.2[k].0[0], axis.dot(rate)];
                self.load.on_hinge(told, axis, turning)
            }
        };
        InJoint { torque, rate, c }
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
        let joints = self.joints.iter().flat_map(|joint| joint.load.spans());
        let laws = self.bodies.iter().filter_map(|(_, load)| load.law());
        joints.chain(laws.map(Timed::told))
    }

    /// From when on each repeats itself, and after how long, s.
    pub(crate) fn repeats(&self) -> impl Iterator<Item = Option<[f64; 2]>> {
        let joints = self.joints.iter().flat_map(|joint| joint.load.repeats());
        let laws = self.bodies.iter().filter_map(|(_, load)| load.law());
        joints.chain(laws.map(Timed::repeats))
    }

    /// How fast each that is told changes, rad/s.
    pub(crate) fn told_rates(&self, until: f64) -> impl Iterator<Item = f64> {
        let joints = self.joints.iter();
        let joints = joints.flat_map(move |joint| joint.load.rates(until));
        let laws = self.bodies.iter().filter_map(|(_, load)| load.law());
        joints.chain(laws.map(move |law| law.rate(until)))
    }

    /// Whether all that is told is a number at the time `t`.
    pub(crate) fn are_known(&self, t: f64) -> bool {
        let mut bodies = self.bodies.iter();
        self.joints.iter().all(|joint| joint.load.is_known(t))
            && bodies.all(|(_, load)| load.told(t)[0].is_finite())
    }

    /// Whether something acts on a body from outside, so that momentum is not kept.
    pub(crate) fn act_on_bodies(&self) -> bool {
        !self.bodies.is_empty()
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
        let bodies = self.bodies.iter().map(|(_, load)| load.told(at.t));
        told.read((tree.identity, at.t), joints, bodies);
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
        for ((i, load), told) in self.bodies.iter().zip(&told.bodies) {
            let [force, moment] = load.wrench(*told, || twist(*i));
            work[*i] += force;
            add(*i, moment);
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

    /// The wrenches of all loads of this name on bodies, each with its body.
    pub(crate) fn on_bodies(
        &self,
        name: &'static str,
        t: f64,
        twist: impl Fn(usize) -> Twist<f64>,
    ) -> impl Iterator<Item = (usize, Wrench<f64>)> {
        let loads = self
            .bodies
            .iter()
            .filter(move |(_, load)| load.name() == name);
        loads.map(move |(i, load)| (*i, load.wrench(load.told(t), || twist(*i))))
    }
}
