//! A tree of bodies: where it is, and what acts on it.

use core::ops::Range;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use lie::{AlgebraOver, DualOver, Mat3, Power, R3, Rn, SO3, Vec3};

use crate::error::ModelError;
use crate::joints::{JointKind, Joints, Link};
use crate::loads::Loads;
use crate::motion::Law;
use crate::node::{Body, Joint, Node};

/// What the joints leave free, grouped by kind: attitudes, the position of a free base, hinge angles.
///
/// On ball joints with a free base it is the paper's direct product $SO(3)^{n+1} \times \mathbb{R}^3$, $g = ((R_0, \dots, R_n), x)$.
/// $R_i$ maps body $i$'s frame to the reference frame. $x$, the only factor of its kind, is the mass centre of the first body, in metres.
/// A hinge has its angle, in rad and not wrapped, and a prescribed joint nothing; a base on the world has no $x$.
pub type Configuration<S = f64> = (Power<SO3<S>>, Power<R3<S>>, Power<Rn<1, S>>);

/// Angular velocities, each in its body's frame, and that of the first body's mass centre.
pub(crate) type Velocity<S = f64> = AlgebraOver<Configuration, S>;
/// The momenta conjugate to them.
pub(crate) type Momentum<S = f64> = DualOver<Configuration, S>;

/// Rigid bodies on ball joints in a perfect fluid: a tree with a free base.
///
/// The model of T. Lee, M. Leok and N. H. McClamroch, *Dynamics of connected rigid bodies in a perfect fluid* (2009),
/// for any number of bodies, each on any other. [`formulas`](crate::formulas) derives it. Evaluations, the inertia solve
/// and steps cost time and memory in proportion to the bodies.
///
/// ```
/// use articulated_fluid::{ArticulatedBody, Body, Joint, JointKind};
/// use lie::{Mat3, Vec3};
///
/// let body = Body::new(Mat3::diagonal([1.0, 2.0, 2.0]), Mat3::diagonal([0.1, 0.2, 0.2]));
/// // A chain: each body on the one before.
/// let points = [Vec3([0.6, 0.0, 0.0]), Vec3([-0.6, 0.0, 0.0])];
/// let joint = |child: usize| Joint::new([child - 1, child], points, JointKind::Ball);
/// let eel = ArticulatedBody::new(&[body; 30], &(1..30).map(joint).collect::<Vec<_>>())?;
/// assert_eq!(eel.bodies().len(), 30);
/// # Ok::<(), articulated_fluid::ModelError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ArticulatedBody {
    /// $M_i$.
    pub(crate) masses: Vec<Mat3>,
    /// Whether one of the $C_i$ is not zero.
    pub(crate) is_coupled: bool,
    /// A parent stands before its children.
    pub(crate) nodes: Vec<Node>,
    pub(crate) loads: Loads,
    pub(crate) base: Base,
    pub(crate) joints: Joints,
    pub(crate) identity: Identity,
}

/// What tells a tree from others, so that storage is not taken for another's; equal trees may differ in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Identity(u64);

impl Identity {
    pub(crate) fn new() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }

    /// Whether both are of one tree.
    #[inline(always)]
    pub(crate) fn is(self, other: Self) -> bool {
        self.0 == other.0
    }
}

impl PartialEq for Identity {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// What the first body hangs on.
#[derive(Clone, Debug)]
pub(crate) enum Base {
    Free,
    /// On the world, by a joint whose place $x_J$ may move.
    Held {
        kind: JointKind,
        place: Arc<dyn Law<3>>,
    },
}

impl PartialEq for Base {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Free, Self::Free) => true,
            (Self::Held { kind, place }, Self::Held { kind: k, place: p }) => {
                kind == k && Arc::ptr_eq(place, p)
            }
            _ => false,
        }
    }
}

impl ArticulatedBody {
    /// The model of these bodies on these joints, which may come in any order: a body hangs on one that stands before it.
    ///
    /// # Errors
    /// [`ModelError`] where a matrix is not symmetric and positive definite, or the joints do not make a tree.
    pub fn new(bodies: &[Body], joints: &[Joint]) -> Result<Self, ModelError> {
        Self::on(Base::Free, Vec3::zero(), bodies, joints)
    }

    /// The same with the first body on the world, by a joint of this kind at the point `at_child` of the body, m in its frame.
    ///
    /// The joint is at the place that the law gives, m in the reference frame. Then linear and angular momentum are not kept.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn held(
        bodies: &[Body],
        joints: &[Joint],
        (at_child, kind): (Vec3, JointKind),
        place: Arc<dyn Law<3>>,
    ) -> Result<Self, ModelError> {
        Self::on(Base::Held { kind, place }, at_child, bodies, joints)
    }

    fn on(
        base: Base,
        at_child: Vec3,
        bodies: &[Body],
        joints: &[Joint],
    ) -> Result<Self, ModelError> {
        if bodies.is_empty() {
            return Err(ModelError::NoBody);
        }
        for (index, body) in bodies.iter().enumerate() {
            definite(index, "mass", &body.mass)?;
            definite(index, "inertia", &body.inertia)?;
            definite(index, "inertia with its coupling", &reduced(body))?;
        }
        let joints = in_order(joints, bodies.len())?;
        let first = match &base {
            Base::Free => &JointKind::Ball,
            Base::Held { kind, .. } => kind,
        };
        let mut made = Self {
            masses: bodies.iter().map(|body| body.mass).collect(),
            is_coupled: bodies.iter().any(|body| body.coupling != Mat3::zero()),
            nodes: Vec::with_capacity(bodies.len()),
            loads: Loads::default(),
            joints: Joints::default(),
            base: base.clone(),
            identity: Identity::new(),
        };
        made.hang(&bodies[0], (0, [Vec3::zero(), at_child]), first)?;
        for (body, joint) in bodies[1..].iter().zip(&joints) {
            let points = [joint.at_parent, joint.at_child];
            made.hang(body, (joint.parent, points), &joint.kind)?;
        }
        mark(&mut made.nodes);
        let mut nodes = made.nodes.iter().zip(bodies);
        match nodes.position(|(node, body)| !is_finite(node, &body.mass)) {
            Some(body) => Err(ModelError::OutOfRange { body }),
            None => Ok(made),
        }
    }

    /// Hangs the next body on its parent.
    fn hang(
        &mut self,
        body: &Body,
        (parent, points): (usize, [Vec3; 2]),
        kind: &JointKind,
    ) -> Result<(), ModelError> {
        let index = self.nodes.len();
        if !kind.is_sound() {
            return Err(ModelError::Hinge { body: index });
        }
        let role = self.joints.take(index, kind);
        let on = self.nodes.get(parent).map_or(Vec3::zero(), |p| p.at_self);
        self.nodes.push(Node::new(body, (parent, points), on, role));
        Ok(())
    }

    /// Whether a body hangs by another joint than a ball.
    #[inline(always)]
    pub(crate) fn has_inner(&self) -> bool {
        self.joints.roots.len() != self.nodes.len()
    }

    /// Whether the first body is on nothing.
    #[inline(always)]
    pub(crate) fn is_free(&self) -> bool {
        matches!(self.base, Base::Free)
    }

    /// Whether it is a tree of the paper's kind: on ball joints, with a free base.
    #[inline(always)]
    pub(crate) fn is_simple(&self) -> bool {
        !self.has_inner() && self.is_free()
    }

    /// Whether the motion keeps the energy: nothing moves as told, and nothing acts but gravity and springs.
    pub fn keeps_energy(&self) -> bool {
        !(self.moves_as_told() || self.has_forces())
    }

    /// Whether the motion keeps linear and angular momentum, but for the impulse of the weight: no body hangs on the world, and no load acts on a body.
    pub fn keeps_momentum(&self) -> bool {
        self.is_free() && !self.loads.forces.act_on_bodies()
    }

    /// Whether something acts that is no gradient.
    pub(crate) fn has_forces(&self) -> bool {
        !self.loads.forces.are_none()
    }

    /// Whether a [view](crate::View) of it may be better.
    pub(crate) fn has_views(&self) -> bool {
        let weight = self.loads.weight.as_ref();
        let is_central = weight.is_none_or(|weight| !weight.has_points());
        self.is_simple() && !self.is_coupled && !self.has_forces() && is_central
    }

    /// Whether a joint or a place moves as told.
    pub(crate) fn moves_as_told(&self) -> bool {
        self.is_carried() || self.joints.are_driven()
    }

    /// Whether the first body hangs on a place that moves.
    pub(crate) fn is_carried(&self) -> bool {
        match &self.base {
            Base::Free => false,
            Base::Held { place, .. } => !place.is_constant(),
        }
    }

    /// The total inertia of each body.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = Body> + '_ {
        let bodies = self.masses.iter().zip(&self.nodes);
        bodies.map(|(mass, node)| Body {
            mass: *mass,
            inertia: node.j,
            coupling: node.coupling,
        })
    }

    /// The joints, in the order of the bodies that hang on them.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = Joint> + '_ {
        let tails = self.nodes.iter().enumerate().skip(1);
        tails.map(|(child, node)| Joint {
            parent: node.parent,
            child,
            at_parent: node.at_parent,
            at_child: node.at_self,
            kind: self.joints.kind(node.role),
        })
    }

    /// The aligned configuration: all attitudes the identity, the first body at the origin, hinges at the angle 0.
    pub fn aligned(&self) -> Configuration {
        (
            Power::new(vec![SO3::identity(); self.joints.roots.len()]),
            Power::new(vec![R3::identity(); usize::from(self.is_free())]),
            Power::new(vec![Rn([0.0]); self.joints.hinges.len()]),
        )
    }

    /// The coordinates of $x$.
    pub(crate) fn translation(&self) -> Range<usize> {
        let first = 3 * self.joints.roots.len();
        first..first + 3 * usize::from(self.is_free())
    }

    /// Whether a configuration or a momentum has what the joints and the base leave free.
    pub(crate) fn has_shape_of<R, X, Q>(
        &self,
        (rotations, translations, angles): &(Power<R>, Power<X>, Power<Q>),
    ) -> bool {
        let found = [rotations.len(), translations.len(), angles.len()];
        found
            == [
                self.joints.roots.len(),
                usize::from(self.is_free()),
                self.joints.hinges.len(),
            ]
    }
}

/// Whether a body alone, and what follows from its joint, is in the range of numbers.
fn is_finite(node: &Node, mass: &Mat3) -> bool {
    let alone = Link::<f64>::alone(node, mass);
    let derived = [node.jd, alone.x, alone.mass.matrix()];
    let turn = alone.ldl.solve(Vec3([1.0; 3]));
    let solves = turn.is_finite() && turn != Vec3::zero();
    solves && derived.iter().all(|a| a.frobenius().is_finite()) && node.lever.is_finite()
}

/// $J - C^T M^{-1} C$: what is left to turn the body where its momentum is given.
fn reduced(
    Body {
        mass,
        inertia,
        coupling,
    }: &Body,
) -> Mat3 {
    let coupled = coupling.transpose() * mass.inverse() * *coupling;
    *inertia - (coupled + coupled.transpose()) * 0.5
}

fn definite(body: usize, matrix: &'static str, a: &Mat3) -> Result<(), ModelError> {
    positive_definite(a)
        .then_some(())
        .ok_or(ModelError::NotPositiveDefinite { body, matrix })
}

/// The joints in the order of their children, the bodies from 1 on.
fn in_order(joints: &[Joint], bodies: usize) -> Result<Vec<Joint>, ModelError> {
    let mut counts = vec![0_usize; bodies];
    let mut ordered = joints.to_vec();
    for (index, joint) in joints.iter().enumerate() {
        let Joint { parent, child, .. } = *joint;
        let finite = joint.at_parent.is_finite() && joint.at_child.is_finite();
        if parent >= child || child >= bodies || !finite {
            return Err(ModelError::Joint {
                joint: index,
                parent,
                child,
                last: bodies - 1,
            });
        }
        counts[child] += 1;
    }
    match counts
        .iter()
        .enumerate()
        .skip(1)
        .find(|(_, count)| **count != 1)
    {
        Some((body, count)) => Err(ModelError::Joints {
            body,
            count: *count,
        }),
        None => {
            ordered.sort_by_key(|joint| joint.child);
            Ok(ordered)
        }
    }
}

/// Marks which bodies carry others, and which of the siblings is last.
fn mark(nodes: &mut [Node]) {
    for i in (1..nodes.len()).rev() {
        let parent = nodes[i].parent;
        nodes[i].is_last_sibling = nodes[parent].is_leaf;
        nodes[parent].is_leaf = false;
    }
}

/// By the leading minors of a matrix that is symmetric to rounding, brought to trace one against underflow.
fn positive_definite(a: &Mat3) -> bool {
    if a.trace() <= 0.0 {
        return false;
    }
    let a = *a * (1.0 / a.trace());
    let symmetric = a.skew_vee().norm() <= 1e-12 * a.frobenius();
    let minor = a[(0, 0)] * a[(1, 1)] - a[(0, 1)] * a[(1, 0)];
    let positive = a[(0, 0)] > 0.0 && minor > 0.0 && a.determinant() > 0.0;
    symmetric && positive && a.frobenius().is_finite()
}
