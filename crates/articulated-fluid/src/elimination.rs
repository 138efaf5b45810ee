//! The inertia (4) solved from the leaves to the first body, in time and memory proportional to the bodies.
//!
//! [`formulas`](crate::formulas) derives it. A body whose children are eliminated has the momenta
//! $F_i = A u - K \Omega_i + \varphi$ and $r_i = H \Omega_i - K^T u$ with the velocity $u$ of its joint. Solved for
//! $\Omega_i$, the force on the joint is $F_i = M^\ast u + f^\ast$: a mass and a momentum, which its parent takes over.

use core::ops::{Add, Range};

use dvi::{Derivatives, Inertia, State};
use lie::{AlgebraOver, DualOver, Ldl3, Mat3, SO3, Scalar, Sym3, Vec3};

use crate::model::Node;
use crate::{ArticulatedBody, Configuration};

pub(crate) type Velocity<S = f64> = AlgebraOver<Configuration, S>;
pub(crate) type Momentum<S = f64> = DualOver<Configuration, S>;
/// The attitude of the first body, and those of the others.
pub(crate) type Attitudes<'a, S> = (&'a SO3<S>, &'a [SO3<S>]);

/// What is body `i`'s, where the first body's is apart.
#[inline(always)]
pub(crate) fn of<'a, T>((first, rest): (&'a T, &'a [T]), i: usize) -> &'a T {
    if i == 0 { first } else { &rest[i - 1] }
}

/// The same, to be changed.
#[inline(always)]
pub(crate) fn of_mut<'a, T>((first, rest): (&'a mut T, &'a mut [T]), i: usize) -> &'a mut T {
    if i == 0 { first } else { &mut rest[i - 1] }
}

/// The matrix whose rows are made of those of `a`.
#[inline(always)]
fn rows<S: Scalar>(a: &Mat3<S>, f: impl Fn(Vec3<S>) -> Vec3<S>) -> Mat3<S> {
    Mat3([f(a.row(0)).0, f(a.row(1)).0, f(a.row(2)).0])
}

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
    h: Sym3<S>,
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
    fn reset(&mut self, node: &Node, mass: &Mat3) {
        self.mass = Sym3::upper(mass).lift();
        self.x = node.k.lift();
        self.h = node.j_joint.lift();
    }

    /// A body without children, eliminated.
    pub(crate) fn alone(node: &Node, mass: &Mat3) -> Self {
        let zero = Vec3::zero();
        let mut link = Self {
            c: Mat3::identity(),
            mass: Sym3::zero(),
            x: Mat3::zero(),
            h: Sym3::zero(),
            ldl: Ldl3::identity(),
            force: zero,
            w: zero,
            omega: zero,
            v: zero,
        };
        link.reset(node, mass);
        link.eliminate();
        link
    }

    /// With $Y = K L^{-T}$: $X = Y D^{-1} L^{-1}$ and $M^\ast = A - Y D^{-1} Y^T$, which cancels no more than it has to.
    #[inline(always)]
    fn eliminate(&mut self) {
        let ldl = self.h.ldl();
        let y = rows(&self.x, |row| ldl.forward(row));
        let scaled = rows(&y, |row| ldl.scale(row));
        self.x = rows(&scaled, |row| ldl.backward(row));
        self.mass = self.mass - Sym3::product(&scaled, &y);
        self.ldl = ldl;
    }

    /// Adds the child's mass $N = C M^\ast C^T$, at the lever $l$.
    #[inline(always)]
    fn carry_mass(&mut self, child: &Self, lever: Vec3<S>) {
        let n = child.mass.turned(&child.c);
        let nl = n.times_hat(lever);
        self.mass += n;
        self.x += nl;
        self.h = self.h - Sym3::hat_times(lever, &nl);
    }

    /// Adds the child's force $C f^\ast$, at the lever $l$.
    #[inline(always)]
    fn carry_force(&mut self, child: &Self, lever: Vec3<S>) {
        let force = child.c * child.force;
        self.force += force;
        self.w -= lever.cross(force);
    }

    #[inline(always)]
    fn eliminate_force(&mut self) {
        self.force -= self.x * self.w;
        self.w = self.ldl.solve(self.w);
    }

    /// $\Omega_i$ and $V_i$ from the velocity of the joint.
    #[inline(always)]
    fn advance(&mut self, u: Vec3<S>, at_self: Vec3<S>) {
        self.omega = self.w + self.x.transpose_mul(u);
        self.v = u + at_self.cross(self.omega);
    }

    /// The velocity of the joint of `child`, in the child's frame: $u = C^T (V_p + \Omega_p \times d_{pi})$.
    #[inline(always)]
    fn joint_velocity(&self, child: &Self, at_parent: Vec3<S>) -> Vec3<S> {
        child.c.transpose_mul(self.v + self.omega.cross(at_parent))
    }
}

/// The inertia at a configuration, factorised, with the storage for solves.
#[derive(Clone, Debug)]
pub struct Elimination<S = f64> {
    links: Vec<Link<S>>,
    /// $M_0^\ast$.
    base: Ldl3<S>,
}

impl<S: Scalar> Elimination<S> {
    pub(crate) fn new(tree: &ArticulatedBody) -> Self {
        let bodies = tree.nodes.iter().zip(&tree.masses);
        Self {
            links: bodies.map(|(node, mass)| Link::alone(node, mass)).collect(),
            base: Ldl3::identity(),
        }
    }

    /// Eliminates the bodies from the leaves on. Those without children stay as they were made.
    #[inline(always)]
    pub(crate) fn factorise(&mut self, tree: &ArticulatedBody, r: Attitudes<S>) {
        for i in (1..tree.nodes.len()).rev() {
            self.factorise_link(tree, i, r);
        }
        self.factorise_base(tree);
    }

    #[inline(always)]
    fn factorise_link(&mut self, tree: &ArticulatedBody, i: usize, r: Attitudes<S>) {
        let node = &tree.nodes[i];
        let (parent, link) = self.joint(i, node.parent);
        if node.is_last_sibling {
            parent.reset(&tree.nodes[node.parent], &tree.masses[node.parent]);
        }
        if !node.is_leaf {
            link.eliminate();
        }
        link.c = of(r, node.parent).matrix().transpose() * *of(r, i).matrix();
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
    fn read_momenta(&mut self, (p0, _, p): &Momentum<S>) {
        for (i, link) in self.links.iter_mut().enumerate() {
            link.force = Vec3::zero();
            link.w = of((p0, p), i).vec3();
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
        let v = self.base.solve(r0.inverse_rotate(mu.1.vec3()) - base.force);
        base.advance(v, Vec3::zero());
    }

    /// [`factorise`](Self::factorise) and [`begin`](Self::begin) in one pass, the momenta of a body while its factors are at hand.
    #[inline(always)]
    pub(crate) fn factorise_and_begin(
        &mut self,
        tree: &ArticulatedBody,
        r: Attitudes<S>,
        mu: &Momentum<S>,
    ) {
        self.read_momenta(mu);
        for i in (1..tree.nodes.len()).rev() {
            self.factorise_link(tree, i, r);
            self.eliminate_momentum(tree, i);
        }
        self.factorise_base(tree);
        self.begin_base(r.0, mu);
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
    fn finish(&mut self, tree: &ArticulatedBody, r0: &SO3<S>, xi: &mut Velocity<S>) {
        let base = &self.links[0];
        xi.0 = base.omega.into();
        xi.1 = r0.rotate(base.v).into();
        for (i, xi) in (1..self.links.len()).zip(xi.2.iter_mut()) {
            self.advance(tree, i);
            *xi = self.links[i].omega.into();
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
        tau: &mut DualOver<Configuration, S>,
    ) {
        let base = &self.links[0];
        xi.0 = base.omega.into();
        xi.1 = r0.rotate(base.v).into();
        tau.0 = tree.masses[0].apply(base.v).cross(base.v).into();
        tau.1 = Vec3::zero().into();
        for i in 1..self.links.len() {
            let u = self.advance(tree, i);
            let (node, link) = (&tree.nodes[i], &self.links[i]);
            let momentum = tree.masses[i].apply(link.v);
            xi.2[i - 1] = link.omega.into();
            tau.2[i - 1] = momentum.cross(u).into();
            let on_parent = link.c * (link.mass * u + link.force);
            let turned = self.links[node.parent].omega.cross(node.lever.lift());
            let tau = of_mut((&mut tau.0, &mut tau.2), node.parent);
            *tau = (tau.vec3() + turned.cross(on_parent)).into();
        }
    }
}

impl ArticulatedBody {
    /// $\sum_i R_i M_i R_i^T$: the slope of the linear momentum in $\dot x$, and that of (31) in $\Delta x / h$.
    #[inline(always)]
    pub(crate) fn total_mass(&self, r: Attitudes<f64>) -> Sym3 {
        let masses = self.masses.iter().enumerate();
        let turned = masses.map(|(i, mass)| Sym3::upper(mass).turned(of(r, i).matrix()));
        turned.fold(Sym3::zero(), Sym3::add)
    }
}

/// What a step's iteration uses as its matrix: $\mathbb I(g_k)$, factorised once a step.
#[derive(Clone, Debug)]
pub struct Factor {
    r0: SO3,
    elimination: Elimination<f64>,
    /// $\sum_i R_i M_i R_i^T$, to solve (31) for $\Delta x$.
    total_mass: Ldl3,
}

impl Inertia for ArticulatedBody {
    type Factor = Factor;

    fn factor(&self) -> Factor {
        Factor {
            r0: SO3::identity(),
            elimination: Elimination::new(self),
            total_mass: Ldl3::identity(),
        }
    }

    #[inline(always)]
    fn factorise(&self, (r0, _, r): &Configuration, factor: &mut Factor) {
        factor.r0 = *r0;
        factor.elimination.factorise(self, (r0, r));
        factor.total_mass = self.total_mass((r0, r)).ldl();
    }

    #[inline(always)]
    fn solve(&self, factor: &mut Factor, mu: &Momentum, xi: &mut Velocity) {
        factor.elimination.begin(self, &factor.r0, mu);
        factor.elimination.finish(self, &factor.r0, xi);
    }

    /// The displacement $\Delta x$, under a weight too: its impulse is constant.
    fn eliminated(&self) -> Range<usize> {
        if self.keeps_translation { 0..0 } else { 3..6 }
    }

    /// (31) $= p_x$, and the impulse of the weight with it, solved for $\Delta x$.
    #[inline(always)]
    fn eliminate(
        &self,
        factor: &mut Factor,
        state: &State<Configuration>,
        h: f64,
        f: &mut Configuration,
        c: &mut Velocity,
        out: &mut Derivatives<Configuration, f64>,
    ) {
        let State { g, mu, .. } = state;
        self.displace(g, f, out);
        if !self.keeps_translation {
            let mut rest = mu.1.vec3() * h - self.turning_momentum(g, out);
            if let Some(weight) = &self.weight {
                rest += weight.force::<f64>() * (h * h);
            }
            let solved = factor.total_mass.solve(rest);
            (f.1, c.1) = (solved.into(), solved.into());
        }
        self.collect(g, f, h, out);
    }
}
