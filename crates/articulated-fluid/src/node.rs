//! A body, its joint, and what is constant of them.

use lie::{Mat3, Sym3, Vec3};

use crate::joints::{JointKind, Role};

/// The total inertia of one body, the body's own plus the added one of the fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// $M_i$ in the body's frame, kg; anisotropic in a fluid.
    pub mass: Mat3,
    /// $J_i$ about the mass centre in the body's frame, kg m².
    pub inertia: Mat3,
    /// $C_i$ of the kinetic energy $\frac12 V \cdot M V + V \cdot C \Omega + \frac12 \Omega \cdot J \Omega$, kg m, (S26): the added one of a body
    /// without three planes of symmetry, or whose fluid has another centre.
    pub coupling: Mat3,
}

impl Body {
    /// A body whose turns and displacements are not coupled.
    pub fn new(mass: Mat3, inertia: Mat3) -> Self {
        let coupling = Mat3::zero();
        Self {
            mass,
            inertia,
            coupling,
        }
    }
}

/// A joint: where it is on both bodies, and what it leaves free.
///
/// ```
/// use articulated_fluid::{Joint, JointKind};
/// use lie::{SO3, Vec3};
///
/// let (at_parent, at_child) = (Vec3([0.5, 0.0, 0.0]), Vec3([-0.5, 0.0, 0.0]));
/// let ball = Joint::new([0, 1], [at_parent, at_child], JointKind::Ball);
/// let elbow = JointKind::hinge(Vec3([0.0, 0.0, 2.0]), SO3::identity());
/// let hinge = Joint::new([1, 2], [at_parent, at_child], elbow);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Index of the body it is on.
    pub parent: usize,
    /// Index of the body that hangs on it.
    pub child: usize,
    /// $d_{pi}$: from the parent's mass centre, in the parent's frame, m.
    pub at_parent: Vec3,
    /// $d_{ip}$: from the child's mass centre, in the child's frame, m.
    pub at_child: Vec3,
    /// What it leaves free.
    pub kind: JointKind,
}

impl Joint {
    /// The joint between a parent and a child, at these points of theirs.
    pub fn new(
        [parent, child]: [usize; 2],
        [at_parent, at_child]: [Vec3; 2],
        kind: JointKind,
    ) -> Self {
        Self {
            parent,
            child,
            at_parent,
            at_child,
            kind,
        }
    }
}

/// A body, its joint to its parent, and what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    /// Index of the parent; of the first body, which has none, 0.
    pub(crate) parent: usize,
    pub(crate) role: Role,
    pub(crate) is_leaf: bool,
    /// Whether the elimination, which goes through the bodies backwards, meets the parent's children here first.
    pub(crate) is_last_sibling: bool,
    /// $J_i$.
    pub(crate) j: Mat3,
    /// $C_i$, (S26).
    pub(crate) coupling: Mat3,
    /// $d_{pi}$, in the parent's frame.
    pub(crate) at_parent: Vec3,
    /// $d_{ip}$, in the body's frame.
    pub(crate) at_self: Vec3,
    /// $l_i = d_{pi} - d_{pp(p)}$: from the parent's joint to this body's, in the parent's frame.
    pub(crate) lever: Vec3,
    /// $J'_{d_i}$, (24).
    pub(crate) jd: Mat3,
    /// $-M_i \hat d_{ip} - C_i$.
    pub(crate) k: Mat3,
    /// $J'_i = J_i - \hat d_{ip} M_i \hat d_{ip}$, (24), and $-\hat d_{ip} C_i + C_i^T \hat d_{ip}$ with it.
    pub(crate) j_joint: Sym3,
}

impl Node {
    /// A body on a joint, whose parent hangs on its own joint at `on`, in the parent's frame.
    pub(crate) fn new(
        body: &Body,
        (parent, [at_parent, at_self]): (usize, [Vec3; 2]),
        on: Vec3,
        role: Role,
    ) -> Self {
        let (m, c, d) = (body.mass, body.coupling, at_self.hat());
        let j_joint = body.inertia - d * m * d;
        let coupled = d * c + (d * c).transpose();
        Self {
            parent,
            role,
            is_leaf: true,
            is_last_sibling: true,
            j: body.inertia,
            coupling: c,
            at_parent,
            at_self,
            lever: at_parent - on,
            jd: nonstandard(j_joint),
            k: -(m * d) - c,
            j_joint: Sym3::upper(&(j_joint - coupled)),
        }
    }
}

/// $J_d = \frac12 \mathrm{tr}[J] I - J$, (23); indefinite where added inertia breaks the triangle inequality.
fn nonstandard(j: Mat3) -> Mat3 {
    Mat3::diagonal([0.5 * j.trace(); 3]) - j
}
