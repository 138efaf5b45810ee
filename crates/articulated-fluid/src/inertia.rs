//! The inertia (4) solved from the leaves to the first body, in time and memory proportional to the bodies.
//!
//! [`formulas`](crate::formulas) derives it; the [kinds of joints](crate::joints) eliminate what is theirs.

use core::ops::Add;

use lie::{Cotangent, Ldl3, SO3, Scalar, Sym3, Vec3};

use crate::joints::{HingeFactors, Link, Role};
use crate::pose::Drive;
use crate::tree::{ArticulatedBody, Momentum, Velocity};

/// The inertia at a configuration, factorised, with the storage for solves.
#[derive(Clone, Debug)]
pub struct Elimination<S = f64> {
    links: Vec<Link<S>>,
    hinges: Vec<HingeFactors<S>>,
    /// $M_0^\ast$ of a free base.
    base: Ldl3<S>,
}

impl<S: Scalar> Default for Elimination<S> {
    fn default() -> Self {
        Self {
            links: Vec::new(),
            hinges: Vec::new(),
            base: Ldl3::identity(),
        }
    }
}

/// Masses and momenta, from the leaves to the first body.
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
        self.hinges = vec![HingeFactors::at_rest(); tree.hinges.len()];
    }

    /// Eliminates the bodies from the leaves on. Those without children on balls stay as they were made.
    #[inline(always)]
    pub(crate) fn factorise(&mut self, tree: &ArticulatedBody, r: &[SO3<S>], c: &[SO3<S>]) {
        self.prepare(tree);
        for i in (1..tree.nodes.len()).rev() {
            self.factorise_link(tree, i, (r, c));
        }
        self.factorise_base(tree);
    }

    #[inline(always)]
    fn factorise_link(&mut self, tree: &ArticulatedBody, i: usize, (r, c): (&[SO3<S>], &[SO3<S>])) {
        let node = &tree.nodes[i];
        if node.is_last_sibling {
            self.links[node.parent].reset(&tree.nodes[node.parent], &tree.masses[node.parent]);
        }
        self.eliminate_mass(tree, i);
        let (parent, link) = self.joint(i, node.parent);
        if node.role.is_root() {
            link.c = r[node.parent].matrix().transpose() * *r[i].matrix();
            parent.carry_mass(link, node.lever.lift());
        } else {
            link.c = *c[i].matrix();
            parent.carry_inertia(link, node.lever.lift());
        }
    }

    /// What the joint of body `i` leaves free, eliminated from the mass.
    #[inline(always)]
    fn eliminate_mass(&mut self, tree: &ArticulatedBody, i: usize) {
        let (node, link) = (&tree.nodes[i], &mut self.links[i]);
        if node.role.is_root() {
            if !node.is_leaf {
                link.eliminate();
            }
            return;
        }
        if node.is_leaf {
            link.reset(node, &tree.masses[i]);
        }
        if let Role::Hinge(k) = node.role {
            link.eliminate_hinge(tree.hinges[k].axis.lift(), &mut self.hinges[k]);
        }
    }

    #[inline(always)]
    fn factorise_base(&mut self, tree: &ArticulatedBody) {
        self.eliminate_mass(tree, 0);
        if tree.is_free() {
            self.base = self.links[0].mass.ldl();
        }
    }

    /// Eliminates the momenta from the leaves on, and finds the first body's velocity.
    #[inline(always)]
    pub(crate) fn begin(
        &mut self,
        tree: &ArticulatedBody,
        r0: &SO3<S>,
        drive: Drive<S>,
        mu: &Momentum<S>,
    ) {
        self.read_momenta(tree, mu);
        for i in (1..tree.nodes.len()).rev() {
            self.eliminate_momentum(tree, i, drive, mu);
        }
        self.begin_base(tree, r0, drive, mu);
    }

    #[inline(always)]
    fn read_momenta(&mut self, tree: &ArticulatedBody, (p, ..): &Momentum<S>) {
        for (link, node) in self.links.iter_mut().zip(&tree.nodes) {
            link.force = Vec3::zero();
            link.w = match node.role {
                Role::Ball(k) => p[k].vec3(),
                _ => Vec3::zero(),
            };
        }
    }

    #[inline(always)]
    fn eliminate_momentum(
        &mut self,
        tree: &ArticulatedBody,
        i: usize,
        drive: Drive<S>,
        mu: &Momentum<S>,
    ) {
        let node = &tree.nodes[i];
        self.eliminate_force(tree, i, drive, mu);
        let (parent, link) = self.joint(i, node.parent);
        match node.role {
            Role::Ball(_) => parent.carry_force(link, node.lever.lift()),
            _ => parent.carry_wrench(link, node.lever.lift()),
        }
    }

    /// What the joint of body `i` leaves free, eliminated from the momenta.
    #[inline(always)]
    fn eliminate_force(
        &mut self,
        tree: &ArticulatedBody,
        i: usize,
        drive: Drive<S>,
        (.., hinges): &Momentum<S>,
    ) {
        let link = &mut self.links[i];
        match tree.nodes[i].role {
            Role::Ball(_) => link.eliminate_force(),
            Role::Hinge(k) => {
                let axis = tree.hinges[k].axis.lift();
                link.eliminate_hinge_force(axis, hinges[k][0], &mut self.hinges[k]);
            }
            Role::Prescribed(_) => link.drive(drive.rate(i)),
        }
    }

    #[inline(always)]
    fn begin_base(
        &mut self,
        tree: &ArticulatedBody,
        r0: &SO3<S>,
        drive: Drive<S>,
        mu: &Momentum<S>,
    ) {
        self.eliminate_force(tree, 0, drive, mu);
        let u = match tree.is_free() {
            true => {
                let rest = r0.inverse_rotate(mu.1[0].vec3()) - self.links[0].force;
                self.base.solve(rest)
            }
            false => r0.inverse_rotate(drive.place),
        };
        self.advance_body(tree, 0, (Vec3::zero(), u), drive);
    }

    /// [`factorise`](Self::factorise) and [`begin`](Self::begin) in one pass, the momenta of a body while its factors are at hand.
    #[inline(always)]
    pub(crate) fn factorise_and_begin(
        &mut self,
        tree: &ArticulatedBody,
        (r, c): (&[SO3<S>], &[SO3<S>]),
        drive: Drive<S>,
        mu: &Momentum<S>,
    ) {
        self.prepare(tree);
        self.read_momenta(tree, mu);
        for i in (1..tree.nodes.len()).rev() {
            self.factorise_link(tree, i, (r, c));
            self.eliminate_momentum(tree, i, drive, mu);
        }
        self.factorise_base(tree);
        self.begin_base(tree, &r[0], drive, mu);
    }

    /// The links of body `i` and of its `parent`.
    #[inline(always)]
    fn joint(&mut self, i: usize, parent: usize) -> (&mut Link<S>, &mut Link<S>) {
        let (before, after) = self.links.split_at_mut(i);
        (&mut before[parent], &mut after[0])
    }
}

/// Velocities, from the first body to the leaves.
impl<S: Scalar> Elimination<S> {
    /// The velocity of body `i` from the parent's rate in its frame and the velocity of its joint.
    #[inline(always)]
    fn advance_body(
        &mut self,
        tree: &ArticulatedBody,
        i: usize,
        (turning, u): (Vec3<S>, Vec3<S>),
        drive: Drive<S>,
    ) {
        let (node, link) = (&tree.nodes[i], &mut self.links[i]);
        let at_self = node.at_self.lift();
        match node.role {
            Role::Ball(_) => return link.advance(u, at_self),
            Role::Hinge(k) => {
                let axis = tree.hinges[k].axis.lift();
                link.advance_hinge(axis, (turning, u), &mut self.hinges[k]);
            }
            Role::Prescribed(_) => link.omega = turning + drive.rate(i),
        }
        link.v = u + at_self.cross(link.omega);
    }

    /// The velocity of body `i`'s joint, from its parent's velocity; then its own. What the parent hands on is returned.
    #[inline(always)]
    fn advance(&mut self, tree: &ArticulatedBody, i: usize, drive: Drive<S>) -> (Vec3<S>, Vec3<S>) {
        let node = &tree.nodes[i];
        let (parent, link) = self.joint(i, node.parent);
        let u = parent.joint_velocity(link, node.at_parent.lift());
        let turning = match node.role {
            Role::Ball(_) => Vec3::zero(),
            _ => link.c.transpose_mul(parent.omega),
        };
        self.advance_body(tree, i, (turning, u), drive);
        (turning, u)
    }

    #[inline(always)]
    fn write(&self, tree: &ArticulatedBody, i: usize, xi: &mut Velocity<S>) {
        match tree.nodes[i].role {
            Role::Ball(k) => xi.0[k] = self.links[i].omega.into(),
            Role::Hinge(k) => xi.2[k][0] = self.hinges[k].rate,
            Role::Prescribed(_) => {}
        }
    }

    #[inline(always)]
    fn write_base(&self, tree: &ArticulatedBody, r0: &SO3<S>, xi: &mut Velocity<S>) {
        self.write(tree, 0, xi);
        if tree.is_free() {
            xi.1[0] = r0.rotate(self.links[0].v).into();
        }
    }

    /// The velocities from the first body on, into `xi`: $\mathbb I(g) \xi = \mu$ is solved.
    #[inline(always)]
    pub(crate) fn finish(
        &mut self,
        tree: &ArticulatedBody,
        r0: &SO3<S>,
        drive: Drive<S>,
        xi: &mut Velocity<S>,
    ) {
        self.write_base(tree, r0, xi);
        for i in 1..self.links.len() {
            self.advance(tree, i, drive);
            self.write(tree, i, xi);
        }
    }

    /// The velocities likewise, and the forces (11)–(13) on each body about its joint:
    /// $\tau_i = M_i V_i \times u_i + \sum_{k \text{ on } i} (\Omega_i \times l_k) \times C_k F_k$.
    #[inline(always)]
    pub(crate) fn finish_with_forces(
        &mut self,
        tree: &ArticulatedBody,
        r0: &SO3<S>,
        drive: Drive<S>,
        xi: &mut Velocity<S>,
        tau: &mut [Cotangent<3, S>],
    ) {
        self.write_base(tree, r0, xi);
        let u = match tree.is_free() {
            true => self.links[0].v,
            false => r0.inverse_rotate(drive.place),
        };
        let base = &self.links[0];
        tau[0] = tree.masses[0].apply(base.v).cross(u).into();
        if let Role::Hinge(k) = tree.nodes[0].role {
            self.hinges[k].moment = base.wrench(Vec3::zero(), u).1;
        }
        for i in 1..self.links.len() {
            let (turning, u) = self.advance(tree, i, drive);
            self.write(tree, i, xi);
            let (node, link) = (&tree.nodes[i], &self.links[i]);
            let momentum = tree.masses[i].apply(link.v);
            tau[i] = momentum.cross(u).into();
            let force = match node.role {
                Role::Ball(_) => link.mass * u + link.force,
                role => {
                    let (force, moment) = link.wrench(turning, u);
                    if let Role::Hinge(k) = role {
                        self.hinges[k].moment = moment;
                    }
                    force
                }
            };
            let on_parent = link.c * force;
            let turned = self.links[node.parent].omega.cross(node.lever.lift());
            let tau = &mut tau[node.parent];
            *tau = (tau.vec3() + turned.cross(on_parent)).into();
        }
    }

    /// What the joints make of these moments on the bodies, $T_i = \tau_i + \sum_k C_k T_k$ over those that hang on $i$ by no ball:
    /// that of a root, and of a hinge $s \cdot (T_j + n_j \times \Omega_j)$, (S14).
    #[inline(always)]
    pub(crate) fn gather(
        &self,
        tree: &ArticulatedBody,
        tau: &mut [Cotangent<3, S>],
        (on_roots, _, on_hinges): &mut Momentum<S>,
    ) {
        for (i, node) in tree.nodes.iter().enumerate().rev() {
            let own = tau[i].vec3();
            match node.role {
                Role::Ball(k) => {
                    on_roots[k] = own.into();
                    continue;
                }
                Role::Hinge(k) => {
                    let transport = self.hinges[k].moment.cross(self.links[i].omega);
                    on_hinges[k][0] = (own + transport).dot(tree.hinges[k].axis.lift());
                }
                Role::Prescribed(_) => {}
            }
            if i > 0 {
                let on_parent = tau[node.parent].vec3() + self.links[i].c * own;
                tau[node.parent] = on_parent.into();
            }
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
