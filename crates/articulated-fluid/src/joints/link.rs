//! A body in the elimination, and what its parent takes over of it.

use lie::{Ldl3, Mat3, Scalar, Sym3, Vec3};

use crate::node::Node;

/// One body in the elimination, all in its own frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link<S> {
    /// $C_i = R_p^T R_i$; unused for the first body.
    pub(crate) c: Mat3<S>,
    /// $A$, and once eliminated $M^\ast = A - K H^{-1} K^T$.
    pub(crate) mass: Sym3<S>,
    /// $K$, and once eliminated $X = K H^{-1}$.
    pub(crate) x: Mat3<S>,
    /// $H$.
    pub(crate) h: Sym3<S>,
    /// $H = L D L^T$, once eliminated.
    pub(crate) ldl: Ldl3<S>,
    /// $\varphi$, and once eliminated $f^\ast = \varphi - X r$.
    pub(crate) force: Vec3<S>,
    /// $r$, and once eliminated $w = H^{-1} r$.
    pub(crate) w: Vec3<S>,
    /// $\Omega_i$.
    pub(crate) omega: Vec3<S>,
    /// $V_i$.
    pub(crate) v: Vec3<S>,
}

impl<S: Scalar> Link<S> {
    /// A body before its children have been added: $A = M_i$, $K = -M_i \hat d_{ip}$, $H = J'_i$.
    #[inline(always)]
    pub(crate) fn reset(&mut self, node: &Node, mass: &Mat3) {
        self.mass = Sym3::upper(mass).lift();
        self.x = node.k.lift();
        self.h = node.j_joint.lift();
    }

    /// A body that has neither momentum nor velocity.
    pub(super) fn at_rest() -> Self {
        let zero = Vec3::zero();
        Self {
            c: Mat3::identity(),
            mass: Sym3::zero(),
            x: Mat3::zero(),
            h: Sym3::zero(),
            ldl: Ldl3::identity(),
            force: zero,
            w: zero,
            omega: zero,
            v: zero,
        }
    }

    /// Adds the child's mass $N = C M^\ast C^T$, at the lever $l$.
    #[inline(always)]
    pub(crate) fn carry_mass(&mut self, child: &Self, lever: Vec3<S>) {
        let n = child.mass.turned(&child.c);
        let nl = n.times_hat(lever);
        self.mass += n;
        self.x += nl;
        self.h -= Sym3::hat_times(lever, &nl);
    }

    /// Adds all of the child's $\Lambda^\ast$ at the lever $l$, of which [`carry_mass`](Self::carry_mass) adds the mass.
    ///
    /// With the turned $N, K', H'$: $A$ gains $N$, $K$ gains $K' + N \hat l$, and $H$ gains $H' + K'^T \hat l - \hat l (K' + N \hat l)$.
    #[inline(always)]
    pub(crate) fn carry_inertia(&mut self, child: &Self, lever: Vec3<S>) {
        let c = child.c;
        let n = child.mass.turned(&c);
        let k = c.conjugate(child.x);
        let coupling = k + n.times_hat(lever);
        self.mass += n;
        self.x += coupling;
        // K'^T l^ = -(l^ K')^T.
        let turned = lever.hat() * k;
        self.h += child.h.turned(&c) - Sym3::upper(&turned.transpose());
        self.h -= Sym3::hat_times(lever, &coupling);
    }

    /// Adds the child's force and moment, at the lever $l$.
    #[inline(always)]
    pub(crate) fn carry_wrench(&mut self, child: &Self, lever: Vec3<S>) {
        let force = child.c * child.force;
        self.force += force;
        self.w += child.c * child.w - lever.cross(force);
    }

    /// The force and the moment $(F, n)$ on the joint, from what the parent hands on and the velocity of the joint; not of a ball.
    #[inline(always)]
    pub(crate) fn wrench(&self, turning: Vec3<S>, u: Vec3<S>) -> (Vec3<S>, Vec3<S>) {
        let force = self.mass * u - self.x * turning + self.force;
        (force, self.h * turning - self.x.transpose_mul(u) - self.w)
    }

    /// Adds the child's force $C f^\ast$, at the lever $l$.
    #[inline(always)]
    pub(crate) fn carry_force(&mut self, child: &Self, lever: Vec3<S>) {
        let force = child.c * child.force;
        self.force += force;
        self.w -= lever.cross(force);
    }

    /// The velocity of the joint of `child`, in the child's frame: $u = C^T (V_p + \Omega_p \times d_{pi})$.
    #[inline(always)]
    pub(crate) fn joint_velocity(&self, child: &Self, at_parent: Vec3<S>) -> Vec3<S> {
        child.c.transpose_mul(self.v + self.omega.cross(at_parent))
    }
}
