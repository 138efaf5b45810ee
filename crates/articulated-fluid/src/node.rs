//! A body, its joint, and what is constant of them.

use lie::{Mat3, Sym3, Vec3};

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

impl Node {
    /// A body on a joint, whose parent hangs on its own joint at `on`, in the parent's frame.
    pub(crate) fn new(body: &Body, joint: Option<Joint>, on: Vec3) -> Self {
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
}

/// $J_d = \frac12 \mathrm{tr}[J] I - J$, (23); indefinite where added inertia breaks the triangle inequality.
fn nonstandard(j: Mat3) -> Mat3 {
    Mat3::diagonal([0.5 * j.trace(); 3]) - j
}
