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
        link.eliminate(None);
        link
    }

    /// With $Y = K L^{-T}$: $X = Y D^{-1} L^{-1}$ and $M^\ast = A - Y D^{-1} Y^T$, which cancels no more than it has to.
    ///
    /// A damper's $h d$ is in $H = L D L^T$, (S23).
    #[inline(always)]
    pub(crate) fn eliminate(&mut self, resistance: Option<S>) {
        if let Some(by) = resistance {
            self.h += Sym3::isotropic(by);
        }
        let ldl = self.h.ldl();
        let y = rows(&self.x, |row| ldl.forward(row));
        let scaled = rows(&y, |row| ldl.scale(row));
        self.x = rows(&scaled, |row| ldl.backward(row));
        self.mass -= Sym3::product(&scaled, &y);
        self.ldl = ldl;
    }

    /// What a damper hands up of an eliminated body beside its mass, (S23): with $\delta = h d$, $K^\ast = \delta X$ and
    /// $H^\ast = \delta - \delta H^{-1} \delta$.
    pub(crate) fn resisted(&self, by: S) -> Self {
        let turned = |axis: [S; 3]| self.ldl.solve(Vec3(axis) * by) * by;
        let unit = Mat3::identity();
        let columns = [0, 1, 2].map(|i| turned(unit.row(i).0).0);
        Self {
            x: self.x * by,
            h: Sym3::isotropic(by) - Sym3::upper(&Mat3(columns)),
            ..*self
        }
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
