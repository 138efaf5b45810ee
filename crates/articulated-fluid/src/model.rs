//! The bodies, their joints, and what is constant of them.

use core::ops::Range;

use lie::{Mat3, Power, R3, SO3, Sym3, Vec3};

use crate::ModelError;
use crate::elimination::Link;
use crate::springs::Springs;
use crate::weight::Weight;

/// The paper's direct product $SO(3) \times \mathbb{R}^3 \times SO(3)^n$, $g = (R_0, x, R_1, \dots, R_n)$.
///
/// $R_i$ maps body $i$'s frame to the reference frame; $x$ is the mass centre of the first body, in metres.
pub type Configuration<S = f64> = (SO3<S>, R3<S>, Power<SO3<S>>);

/// The total inertia of one body, the body's own plus the added one of the fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// $M_i$ in the body's frame, kg; anisotropic in a fluid.
    pub mass: Mat3,
    /// $J_i$ about the mass centre in the body's frame, kg m².
    pub inertia: Mat3,
}

/// A ball joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Index of the body it is on.
    pub parent: usize,
    /// Index of the body that hangs on it.
    pub child: usize,
    /// $d_{pi}$: from the parent's mass centre, in the parent's frame, m.
    pub at_parent: Vec3,
    /// $d_{ip}$: from the child's mass centre, in the child's frame, m.
    pub at_child: Vec3,
}

/// Rigid bodies on ball joints in a perfect fluid: a tree with a free base.
///
/// The model of T. Lee, M. Leok and N. H. McClamroch, *Dynamics of connected rigid bodies in a perfect fluid* (2009),
/// for any number of bodies, each on any other; [`formulas`](crate::formulas) derives it. Evaluations, the inertia solve
/// and steps cost time and memory in proportion to the bodies.
///
/// ```
/// use articulated_fluid::{ArticulatedBody, Body, Joint};
/// use lie::{Mat3, Vec3};
///
/// let body = Body { mass: Mat3::diagonal([1.0, 2.0, 2.0]), inertia: Mat3::diagonal([0.1, 0.2, 0.2]) };
/// // A chain: each body on the one before.
/// let joint = |child: usize| Joint {
///     parent: child - 1,
///     child,
///     at_parent: Vec3([0.6, 0.0, 0.0]),
///     at_child: Vec3([-0.6, 0.0, 0.0]),
/// };
/// let eel = ArticulatedBody::new(&[body; 30], &(1..30).map(joint).collect::<Vec<_>>())?;
/// assert_eq!(eel.bodies().len(), 30);
/// # Ok::<(), articulated_fluid::ModelError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ArticulatedBody {
    /// $M_i$.
    pub(crate) masses: Vec<Mat3>,
    /// A parent stands before its children.
    pub(crate) nodes: Vec<Node>,
    pub(crate) weight: Option<Weight>,
    pub(crate) springs: Option<Springs>,
    /// Whether the translation is kept as an unknown, though it could be eliminated.
    pub(crate) keeps_translation: bool,
}

/// A body, its joint to its parent, and what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    /// Index of the parent; of the first body, which has none, 0.
    pub(crate) parent: usize,
    pub(crate) is_leaf: bool,
    /// Whether the elimination, which goes through the bodies backwards, meets the parent's children here first.
    pub(crate) is_last_sibling: bool,
    /// $J_i$.
    pub(crate) j: Mat3,
    /// $d_{pi}$, in the parent's frame.
    pub(crate) at_parent: Vec3,
    /// $d_{ip}$, in the body's frame.
    pub(crate) at_self: Vec3,
    /// $l_i = d_{pi} - d_{pp(p)}$: from the parent's joint to this body's, in the parent's frame.
    pub(crate) lever: Vec3,
    /// $J'_{d_i}$, (24).
    pub(crate) jd: Mat3,
    /// $-M_i \hat d_{ip}$.
    pub(crate) k: Mat3,
    /// $J'_i = J_i - \hat d_{ip} M_i \hat d_{ip}$, (24).
    pub(crate) j_joint: Sym3,
}

impl ArticulatedBody {
    /// The model of these bodies on these joints, which may come in any order: a body hangs on one that stands before it.
    ///
    /// # Errors
    /// [`ModelError`] where a matrix is not symmetric and positive definite, or the joints do not make a tree.
    pub fn new(bodies: &[Body], joints: &[Joint]) -> Result<Self, ModelError> {
        if bodies.is_empty() {
            return Err(ModelError::NoBody);
        }
        for (index, body) in bodies.iter().enumerate() {
            definite(index, "mass", &body.mass)?;
            definite(index, "inertia", &body.inertia)?;
        }
        let joints = in_order(joints, bodies.len())?;
        let mut nodes: Vec<Node> = Vec::with_capacity(bodies.len());
        for (body, joint) in bodies
            .iter()
            .zip(core::iter::once(None).chain(joints.into_iter().map(Some)))
        {
            let on = joint.map_or(Vec3::zero(), |joint| nodes[joint.parent].at_self);
            nodes.push(Node::new(body, joint, on));
        }
        mark(&mut nodes);
        let mut made = nodes.iter().zip(bodies);
        match made.position(|(node, body)| !node.is_finite(&body.mass)) {
            Some(body) => Err(ModelError::OutOfRange { body }),
            None => Ok(Self {
                masses: bodies.iter().map(|body| body.mass).collect(),
                nodes,
                weight: None,
                springs: None,
                keeps_translation: false,
            }),
        }
    }

    /// The same bodies under gravity: on each acts its net mass, that of the body less that of the displaced fluid, kg, times
    /// `gravity`, m/s² in the reference frame, at its mass centre.
    ///
    /// # Errors
    /// [`ModelError::NetMasses`] where there is not one net mass for each body; [`ModelError::NotFinite`] where the forces are not.
    pub fn with_gravity(mut self, gravity: Vec3, net_masses: &[f64]) -> Result<Self, ModelError> {
        let (expected, found) = (self.nodes.len(), net_masses.len());
        if expected != found {
            return Err(ModelError::NetMasses { expected, found });
        }
        let weight = Weight::new(gravity, net_masses, &self.nodes);
        if !weight.is_finite() {
            return Err(ModelError::NotFinite { quantity: "weight" });
        }
        self.weight = Some(weight);
        Ok(self)
    }

    /// The same bodies on elastic joints, at rest where the frames of body and parent are aligned: the potential of a joint is
    /// $k (1 - \cos\theta)$ with the angle $\theta$ between these and the stiffness $k \ge 0$, N m; zero is a free joint.
    ///
    /// The stiffnesses are in the order of [`joints`](Self::joints).
    ///
    /// # Errors
    /// [`ModelError::Stiffnesses`] where there is not one for each joint; [`ModelError::Stiffness`] where one is negative or not finite.
    ///
    /// ```
    /// use articulated_fluid::{ArticulatedBody, Body, Joint};
    /// use dvi::State;
    /// use lie::{LieGroup, Mat3, SO3, Tangent, Vec3};
    ///
    /// let body = Body { mass: Mat3::diagonal([1.0, 2.0, 2.0]), inertia: Mat3::diagonal([0.1, 0.2, 0.2]) };
    /// let (at_parent, at_child) = (Vec3([0.6, 0.0, 0.0]), Vec3([-0.6, 0.0, 0.0]));
    /// let pair = ArticulatedBody::new(&[body; 2], &[Joint { parent: 0, child: 1, at_parent, at_child }])?;
    /// let elastic = pair.with_stiffness(&[5.0])?;
    /// let mut g = elastic.aligned();
    /// g.2[0] = SO3::exp(&Tangent([0.0, 0.0, 0.3]));
    /// let mu = g.zero_dual();
    /// let energy = elastic.conserved(&State { t: 0.0, g, mu })?.energy;
    /// assert!((energy - 5.0 * (1.0 - 0.3_f64.cos())).abs() < 1e-15);
    /// # Ok::<(), articulated_fluid::ModelError>(())
    /// ```
    pub fn with_stiffness(mut self, stiffnesses: &[f64]) -> Result<Self, ModelError> {
        let (expected, found) = (self.nodes.len() - 1, stiffnesses.len());
        if expected != found {
            return Err(ModelError::Stiffnesses { expected, found });
        }
        let sound = |k: &f64| k.is_finite() && *k >= 0.0;
        if let Some(joint) = stiffnesses.iter().position(|k| !sound(k)) {
            return Err(ModelError::Stiffness {
                body: joint + 1,
                stiffness: stiffnesses[joint],
            });
        }
        self.springs = Springs::new(stiffnesses, &self.nodes);
        Ok(self)
    }

    /// Gravity, m/s² in the reference frame, where it acts on a net mass.
    pub fn gravity(&self) -> Option<Vec3> {
        self.weight.as_ref().map(Weight::gravity)
    }

    /// The total weight less the buoyancy, N in the reference frame: the rate of the linear momentum. Zero without gravity.
    pub fn net_weight(&self) -> Vec3 {
        self.weight.as_ref().map_or(Vec3::zero(), Weight::force)
    }

    /// The same model with its translation among the unknowns of a step, though it could be eliminated: to measure what that saves.
    pub fn keep_translation(mut self) -> Self {
        self.keeps_translation = true;
        self
    }

    /// The total inertia of each body.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = Body> + '_ {
        let bodies = self.masses.iter().zip(&self.nodes);
        bodies.map(|(mass, node)| Body {
            mass: *mass,
            inertia: node.j,
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
        })
    }

    /// The aligned configuration: all attitudes the identity, the first body at the origin.
    pub fn aligned(&self) -> Configuration {
        let tails = Power::new(vec![SO3::identity(); self.nodes.len() - 1]);
        (SO3::identity(), R3::identity(), tails)
    }

    /// The coordinates of $x$, where nothing depends on it and it is to be eliminated.
    pub(crate) fn free_translation(&self) -> Range<usize> {
        let floats = self.weight.as_ref().is_none_or(Weight::is_neutral);
        if floats && !self.keeps_translation {
            3..6
        } else {
            0..0
        }
    }
}

impl Node {
    /// A body on a joint, whose parent hangs on its own joint at `on`, in the parent's frame.
    fn new(body: &Body, joint: Option<Joint>, on: Vec3) -> Self {
        let zero = Vec3::zero();
        let (parent, at_parent, at_self) = match joint {
            Some(joint) => (joint.parent, joint.at_parent, joint.at_child),
            None => (0, zero, zero),
        };
        let (m, d) = (body.mass, at_self.hat());
        let j_joint = body.inertia - d * m * d;
        Self {
            parent,
            is_leaf: true,
            is_last_sibling: true,
            j: body.inertia,
            at_parent,
            at_self,
            lever: at_parent - on,
            jd: nonstandard(j_joint),
            k: -(m * d),
            j_joint: Sym3::upper(&j_joint),
        }
    }

    fn is_finite(&self, mass: &Mat3) -> bool {
        let alone = Link::<f64>::alone(self, mass);
        let derived = [self.jd, alone.x, alone.mass.matrix()];
        let turn = alone.ldl.solve(Vec3([1.0; 3]));
        let solves = turn.is_finite() && turn != Vec3::zero();
        solves && derived.iter().all(|a| a.frobenius().is_finite()) && self.lever.is_finite()
    }
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

/// $J_d = \frac12 \mathrm{tr}[J] I - J$, (23); indefinite where added inertia breaks the triangle inequality.
fn nonstandard(j: Mat3) -> Mat3 {
    Mat3::diagonal([0.5 * j.trace(); 3]) - j
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
