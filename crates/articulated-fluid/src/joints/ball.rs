//! A ball joint: it leaves the whole rotation of the body free, so that $H$ is eliminated as a whole.

use lie::{Mat3, Scalar, Sym3, Vec3};

use super::link::Link;
use crate::node::Node;

/// The matrix whose rows are made of those of `a`.
#[inline(always)]
fn rows<S: Scalar>(a: &Mat3<S>, f: impl Fn(Vec3<S>) -> Vec3<S>) -> Mat3<S> {
    Mat3([f(a.row(0)).0, f(a.row(1)).0, f(a.row(2)).0])
}

impl<S: Scalar> Link<S> {
    /// A body without children, eliminated.
    pub(crate) fn alone(node: &Node, mass: &Mat3) -> Self {
        let mut link = Self::at_rest();
        link.reset(node, mass);
        link.eliminate();
        link
    }

    /// With $Y = K L^{-T}$: $X = Y D^{-1} L^{-1}$ and $M^\ast = A - Y D^{-1} Y^T$, which cancels no more than it has to.
    #[inline(always)]
    pub(crate) fn eliminate(&mut self) {
        let ldl = self.h.ldl();
        let y = rows(&self.x, |row| ldl.forward(row));
        let scaled = rows(&y, |row| ldl.scale(row));
        self.x = rows(&scaled, |row| ldl.backward(row));
        self.mass -= Sym3::product(&scaled, &y);
        self.ldl = ldl;
    }

    #[inline(always)]
    pub(crate) fn eliminate_force(&mut self) {
        self.force -= self.x * self.w;
        self.w = self.ldl.solve(self.w);
    }

    /// $\Omega_i$ and $V_i$ from the velocity of the joint.
    #[inline(always)]
    pub(crate) fn advance(&mut self, u: Vec3<S>, at_self: Vec3<S>) {
        self.omega = self.w + self.x.transpose_mul(u);
        self.v = u + at_self.cross(self.omega);
    }
}
