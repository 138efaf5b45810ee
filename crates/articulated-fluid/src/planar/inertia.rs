//! The inertia in the plane solved from the leaves to the first body, in time and memory proportional to the bodies.
//!
//! A body whose children are eliminated has the momenta $F_i = A u - K \Omega_i + \varphi$ and $r_i = H \Omega_i - K \cdot u$ with
//! the velocity $u$ of its joint, a vector $K$ and a number $H$. Solved for $\Omega_i$, the force on the joint is
//! $F_i = M^\ast u + f^\ast$: a mass and a momentum, which its parent takes over.

use lie::{LieGroup, SO2, Scalar};

use super::tree::{Momentum, Node, PlanarBody, Velocity};
use super::vector::{Sym2, Vec2};

/// One body in the elimination, all in its own frame.
#[derive(Clone, Copy, Debug)]
struct Link<S> {
    /// $C_i = R_p^T R_i$; unused for the first body.
    c: SO2<S>,
    /// $A$, and once eliminated $M^\ast = A - K K^T / H$.
    mass: Sym2<S>,
    /// $K$, and once eliminated $X = K / H$.
    x: Vec2<S>,
    /// $H$, and once eliminated $1 / H$.
    j_inverse: S,
    /// $\varphi$, and once eliminated $f^\ast = \varphi - X r$.
    force: Vec2<S>,
    /// $r$, and once eliminated $w = r / H$.
    w: S,
    /// $\Omega_i$.
    omega: S,
    /// $V_i$.
    v: Vec2<S>,
}

impl<S: Scalar> Link<S> {
    fn zero() -> Self {
        Self {
            c: SO2::identity(),
            mass: Sym2::zero(),
            x: Vec2::zero(),
            j_inverse: S::zero(),
            force: Vec2::zero(),
            w: S::zero(),
            omega: S::zero(),
            v: Vec2::zero(),
        }
    }

    /// A body before its children have been added: $A = M_i$, $K = M_i J d_{ip}$, $H = J'_i$.
    #[inline(always)]
    fn reset(&mut self, node: &Node) {
        self.mass = node.mass.lift();
        self.x = node.k.lift();
        self.j_inverse = S::from_f64(node.j_joint);
    }

    #[inline(always)]
    fn eliminate(&mut self) {
        let k = self.x;
        self.j_inverse = S::one() / self.j_inverse;
        self.mass = self.mass - Sym2::along(k, self.j_inverse);
        self.x = k * self.j_inverse;
    }

    /// Adds the child's mass $N = C M^\ast C^T$, at the lever $l$.
    #[inline(always)]
    fn carry_mass(&mut self, child: &Self, lever: Vec2<S>) {
        let n = child.mass.turned(&child.c);
        let swept = lever.quarter_turn();
        let carried = n * swept;
        self.mass = self.mass + n;
        self.x -= carried;
        self.j_inverse += swept.dot(carried);
    }

    /// Adds the child's force $C f^\ast$, at the lever $l$.
    #[inline(always)]
    fn carry_force(&mut self, child: &Self, lever: Vec2<S>) {
        let force = child.force.rotated(&child.c);
        self.force += force;
        self.w -= lever.cross(force);
    }

    #[inline(always)]
    fn eliminate_force(&mut self) {
        self.force -= self.x * self.w;
        self.w *= self.j_inverse;
    }

    /// $\Omega_i$ and $V_i$ from the velocity of the joint.
    #[inline(always)]
    fn advance(&mut self, u: Vec2<S>, at_self: Vec2<S>) {
        self.omega = self.w + self.x.dot(u);
        self.v = u - at_self.quarter_turn() * self.omega;
    }

    /// The velocity of the joint of `child`, in the child's frame: $u = C^T (V_p + \Omega_p J d_{pi})$.
    #[inline(always)]
    fn joint_velocity(&self, child: &Self, at_parent: Vec2<S>) -> Vec2<S> {
        let swept = at_parent.quarter_turn() * self.omega;
        (self.v + swept).rotated_back(&child.c)
    }
}

/// The inertia at a configuration, factorised, with the storage for solves.
#[derive(Clone, Debug)]
pub struct PlanarElimination<S = f64> {
    links: Vec<Link<S>>,
    /// $M_0^{\ast -1}$.
    base_inverse: Sym2<S>,
}

impl<S: Scalar> Default for PlanarElimination<S> {
    fn default() -> Self {
        Self {
            links: Vec::new(),
            base_inverse: Sym2::zero(),
        }
    }
}

impl<S: Scalar> PlanarElimination<S> {
    /// The parent of body `i`, which is not the first, and the body.
    #[inline(always)]
    fn with_parent(&mut self, i: usize, node: &Node) -> (&mut Link<S>, &mut Link<S>) {
        let (before, after) = self.links.split_at_mut(i);
        (&mut before[node.parent], &mut after[0])
    }

    /// Eliminates the bodies from the leaves on.
    #[inline(always)]
    pub(super) fn factorise(&mut self, tree: &PlanarBody, r: &[SO2<S>]) {
        self.links.resize(tree.nodes.len(), Link::zero());
        for (link, node) in self.links.iter_mut().zip(&tree.nodes) {
            link.reset(node);
        }
        for (i, node) in tree.nodes.iter().enumerate().skip(1).rev() {
            let (parent, link) = self.with_parent(i, node);
            link.eliminate();
            link.c = r[node.parent].inverse().compose(&r[i]);
            parent.carry_mass(link, node.lever.lift());
        }
        let base = &mut self.links[0];
        base.eliminate();
        self.base_inverse = base.mass.inverse();
    }

    /// Eliminates the momenta from the leaves on, and finds the first body's velocity.
    #[inline(always)]
    pub(super) fn begin(&mut self, tree: &PlanarBody, r0: &SO2<S>, (p, px): &Momentum<S>) {
        for (link, p) in self.links.iter_mut().zip(p.iter()) {
            link.force = Vec2::zero();
            link.w = p[0];
        }
        for (i, node) in tree.nodes.iter().enumerate().skip(1).rev() {
            let (parent, link) = self.with_parent(i, node);
            link.eliminate_force();
            parent.carry_force(link, node.lever.lift());
        }
        let base = &mut self.links[0];
        base.eliminate_force();
        let v = self.base_inverse * (Vec2(px[0].0).rotated_back(r0) - base.force);
        base.advance(v, Vec2::zero());
    }

    /// The velocity of body `i`'s joint, from its parent's velocity; then its own.
    #[inline(always)]
    fn advance(&mut self, i: usize, node: &Node) -> Vec2<S> {
        let (parent, link) = self.with_parent(i, node);
        let u = parent.joint_velocity(link, node.at_parent.lift());
        link.advance(u, node.at_self.lift());
        u
    }

    /// The velocities from the first body on, into `xi`: $\mathbb I(g) \xi = \mu$ is solved.
    #[inline(always)]
    pub(super) fn finish(&mut self, tree: &PlanarBody, r0: &SO2<S>, xi: &mut Velocity<S>) {
        let base = &self.links[0];
        xi.0[0][0] = base.omega;
        xi.1[0].0 = base.v.rotated(r0).0;
        for (i, node) in tree.nodes.iter().enumerate().skip(1) {
            self.advance(i, node);
            xi.0[i][0] = self.links[i].omega;
        }
    }

    /// The velocities likewise, and the forces (11)–(13), with the quarter turn $J$:
    /// $\tau_i = M_i V_i \times u_i + \sum_{k \text{ on } i} \Omega_i J l_k \times C_k F_k$.
    #[inline(always)]
    pub(super) fn finish_with_forces(
        &mut self,
        tree: &PlanarBody,
        r0: &SO2<S>,
        xi: &mut Velocity<S>,
        tau: &mut Momentum<S>,
    ) {
        let base = &self.links[0];
        xi.0[0][0] = base.omega;
        xi.1[0].0 = base.v.rotated(r0).0;
        tau.0[0][0] = tree.nodes[0].mass.apply(base.v).cross(base.v);
        tau.1[0].0 = Vec2::zero().0;
        for (i, node) in tree.nodes.iter().enumerate().skip(1) {
            let u = self.advance(i, node);
            let link = &self.links[i];
            xi.0[i][0] = link.omega;
            tau.0[i][0] = node.mass.apply(link.v).cross(u);
            let on_parent = (link.mass * u + link.force).rotated(&link.c);
            let swept = node.lever.quarter_turn().lift() * self.links[node.parent].omega;
            tau.0[node.parent][0] += swept.cross(on_parent);
        }
    }
}
