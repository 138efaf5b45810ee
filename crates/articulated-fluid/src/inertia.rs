//! The inertia (4) solved from the leaves to the first body, in time and memory proportional to the bodies.
//!
//! [`formulas`](crate::formulas) derives it; the [kinds of joints](crate::joints) eliminate what is theirs.

use core::ops::Add;

use lie::{Ldl3, SO3, Scalar, Sym3, Vec3};

use crate::joints::Link;
use crate::tree::{ArticulatedBody, Momentum, Velocity};

/// The inertia at a configuration, factorised, with the storage for solves.
#[derive(Clone, Debug)]
pub struct Elimination<S = f64> {
    links: Vec<Link<S>>,
    /// $M_0^\ast$.
    base: Ldl3<S>,
}

impl<S: Scalar> Default for Elimination<S> {
    fn default() -> Self {
        Self {
            links: Vec::new(),
            base: Ldl3::identity(),
        }
    }
}

impl<S: Scalar> Elimination<S> {
    /// Makes a link for each body.
    #[inline(always)]
    fn prepare(&mut self, tree: &ArticulatedBody) {
        if self.links.len() != tree.nodes.len() {
            self.make_links(tree);
        }
    }

    #[cold]
    fn make_links(&mut self, tree: &ArticulatedBody) {
        let bodies = tree.nodes.iter().zip(&tree.masses);
        self.links = bodies.map(|(node, mass)| Link::alone(node, mass)).collect();
    }

    /// Eliminates the bodies from the leaves on. Those without children stay as they were made.
    #[inline(always)]
    pub(crate) fn factorise(&mut self, tree: &ArticulatedBody, r: &[SO3<S>]) {
        self.prepare(tree);
        for i in (1..tree.nodes.len()).rev() {
            self.factorise_link(tree, i, r);
        }
        self.factorise_base(tree);
    }

    #[inline(always)]
    fn factorise_link(&mut self, tree: &ArticulatedBody, i: usize, r: &[SO3<S>]) {
        let node = &tree.nodes[i];
        let (parent, link) = self.joint(i, node.parent);
        if node.is_last_sibling {
            parent.reset(&tree.nodes[node.parent], &tree.masses[node.parent]);
        }
        if !node.is_leaf {
            link.eliminate();
        }
        link.c = r[node.parent].matrix().transpose() * *r[i].matrix();
        parent.carry_mass(link, node.lever.lift());
    }

    #[inline(always)]
    fn factorise_base(&mut self, tree: &ArticulatedBody) {
        let base = &mut self.links[0];
        if !tree.nodes[0].is_leaf {
            base.eliminate();
        }
        self.base = base.mass.ldl();
    }

    /// Eliminates the momenta from the leaves on, and finds the first body's velocity.
    #[inline(always)]
    pub(crate) fn begin(&mut self, tree: &ArticulatedBody, r0: &SO3<S>, mu: &Momentum<S>) {
        self.read_momenta(mu);
        for i in (1..tree.nodes.len()).rev() {
            self.eliminate_momentum(tree, i);
        }
        self.begin_base(r0, mu);
    }

    #[inline(always)]
    fn read_momenta(&mut self, (p, _): &Momentum<S>) {
        for (link, p) in self.links.iter_mut().zip(p.iter()) {
            link.force = Vec3::zero();
            link.w = p.vec3();
        }
    }

    #[inline(always)]
    fn eliminate_momentum(&mut self, tree: &ArticulatedBody, i: usize) {
        let node = &tree.nodes[i];
        let (parent, link) = self.joint(i, node.parent);
        link.eliminate_force();
        parent.carry_force(link, node.lever.lift());
    }

    #[inline(always)]
    fn begin_base(&mut self, r0: &SO3<S>, mu: &Momentum<S>) {
        let base = &mut self.links[0];
        base.eliminate_force();
        let v = self
            .base
            .solve(r0.inverse_rotate(mu.1[0].vec3()) - base.force);
        base.advance(v, Vec3::zero());
    }

    /// [`factorise`](Self::factorise) and [`begin`](Self::begin) in one pass, the momenta of a body while its factors are at hand.
    #[inline(always)]
    pub(crate) fn factorise_and_begin(
        &mut self,
        tree: &ArticulatedBody,
        r: &[SO3<S>],
        mu: &Momentum<S>,
    ) {
        self.prepare(tree);
        self.read_momenta(mu);
        for i in (1..tree.nodes.len()).rev() {
            self.factorise_link(tree, i, r);
            self.eliminate_momentum(tree, i);
        }
        self.factorise_base(tree);
        self.begin_base(&r[0], mu);
    }

    /// The links of body `i` and of its `parent`.
    #[inline(always)]
    fn joint(&mut self, i: usize, parent: usize) -> (&mut Link<S>, &mut Link<S>) {
        let (before, after) = self.links.split_at_mut(i);
        (&mut before[parent], &mut after[0])
    }

    /// The velocity of body `i`'s joint, from its parent's velocity; then its own.
    #[inline(always)]
    fn advance(&mut self, tree: &ArticulatedBody, i: usize) -> Vec3<S> {
        let node = &tree.nodes[i];
        let (parent, link) = self.joint(i, node.parent);
        let u = parent.joint_velocity(link, node.at_parent.lift());
        link.advance(u, node.at_self.lift());
        u
    }

    /// The velocities from the first body on, into `xi`: $\mathbb I(g) \xi = \mu$ is solved.
    #[inline(always)]
    pub(crate) fn finish(&mut self, tree: &ArticulatedBody, r0: &SO3<S>, xi: &mut Velocity<S>) {
        let base = &self.links[0];
        xi.0[0] = base.omega.into();
        xi.1[0] = r0.rotate(base.v).into();
        for i in 1..self.links.len() {
            self.advance(tree, i);
            xi.0[i] = self.links[i].omega.into();
        }
    }

    /// The velocities likewise, and the forces (11)–(13):
    /// $\tau_i = M_i V_i \times u_i + \sum_{k \text{ on } i} (\Omega_i \times l_k) \times C_k F_k$.
    #[inline(always)]
    pub(crate) fn finish_with_forces(
        &mut self,
        tree: &ArticulatedBody,
        r0: &SO3<S>,
        xi: &mut Velocity<S>,
        tau: &mut Momentum<S>,
    ) {
        let base = &self.links[0];
        xi.0[0] = base.omega.into();
        xi.1[0] = r0.rotate(base.v).into();
        tau.0[0] = tree.masses[0].apply(base.v).cross(base.v).into();
        tau.1[0] = Vec3::zero().into();
        for i in 1..self.links.len() {
            let u = self.advance(tree, i);
            let (node, link) = (&tree.nodes[i], &self.links[i]);
            let momentum = tree.masses[i].apply(link.v);
            xi.0[i] = link.omega.into();
            tau.0[i] = momentum.cross(u).into();
            let on_parent = link.c * (link.mass * u + link.force);
            let turned = self.links[node.parent].omega.cross(node.lever.lift());
            let tau = &mut tau.0[node.parent];
            *tau = (tau.vec3() + turned.cross(on_parent)).into();
        }
    }
}

impl ArticulatedBody {
    /// $\sum_i R_i M_i R_i^T$: the slope of the linear momentum in $\dot x$, and that of (31) in $\Delta x / h$.
    #[inline(always)]
    pub(crate) fn total_mass(&self, r: &[SO3]) -> Sym3 {
        let masses = self.masses.iter().zip(r);
        let turned = masses.map(|(mass, r)| Sym3::upper(mass).turned(r.matrix()));
        turned.fold(Sym3::zero(), Sym3::add)
    }
}
