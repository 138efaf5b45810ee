//! The inertia in the plane solved from the leaves to the first body, in time and memory proportional to the bodies.
//!
//! A body whose children are eliminated has the momenta $F_i = A u - K \Omega_i + \varphi$ and $r_i = H \Omega_i - K \cdot u$ with
//! the velocity $u$ of its joint, a vector $K$ and a number $H$. Solved for $\Omega_i$, the force on the joint is
//! $F_i = M^\ast u + f^\ast$: a mass and a momentum, which its parent takes over.

use core::ops::Range;

use dvi::{Derivatives, Inertia, State};
use lie::{AlgebraOver, DualOver, LieGroup, SO2, Scalar};

use super::vector::{Sym2, Vec2};
use super::{Attitudes, Node, PlanarBody, PlanarConfiguration, of};
use crate::elimination::of_mut;

type Velocity<S = f64> = AlgebraOver<PlanarConfiguration, S>;
type Momentum<S = f64> = DualOver<PlanarConfiguration, S>;

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
pub struct Elimination<S = f64> {
    links: Vec<Link<S>>,
    /// $M_0^{\ast -1}$.
    base_inverse: Sym2<S>,
}

impl<S: Scalar> Elimination<S> {
    pub(super) fn new(tree: &PlanarBody) -> Self {
        Self {
            links: vec![Link::zero(); tree.nodes.len()],
            base_inverse: Sym2::zero(),
        }
    }

    /// The parent of body `i`, which is not the first, and the body.
    #[inline(always)]
    fn with_parent(&mut self, i: usize, node: &Node) -> (&mut Link<S>, &mut Link<S>) {
        let (before, after) = self.links.split_at_mut(i);
        (&mut before[node.parent], &mut after[0])
    }

    /// Eliminates the bodies from the leaves on.
    #[inline(always)]
    pub(super) fn factorise(&mut self, tree: &PlanarBody, r: Attitudes<S>) {
        for (link, node) in self.links.iter_mut().zip(&tree.nodes) {
            link.reset(node);
        }
        for (i, node) in tree.nodes.iter().enumerate().skip(1).rev() {
            let (parent, link) = self.with_parent(i, node);
            link.eliminate();
            link.c = of(r, node.parent).inverse().compose(of(r, i));
            parent.carry_mass(link, node.lever.lift());
        }
        let base = &mut self.links[0];
        base.eliminate();
        self.base_inverse = base.mass.inverse();
    }

    /// Eliminates the momenta from the leaves on, and finds the first body's velocity.
    #[inline(always)]
    pub(super) fn begin(&mut self, tree: &PlanarBody, r0: &SO2<S>, (p0, px, p): &Momentum<S>) {
        for (i, link) in self.links.iter_mut().enumerate() {
            link.force = Vec2::zero();
            link.w = of((p0, p), i)[0];
        }
        for (i, node) in tree.nodes.iter().enumerate().skip(1).rev() {
            let (parent, link) = self.with_parent(i, node);
            link.eliminate_force();
            parent.carry_force(link, node.lever.lift());
        }
        let base = &mut self.links[0];
        base.eliminate_force();
        let v = self.base_inverse * (Vec2(px.0).rotated_back(r0) - base.force);
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
    fn finish(&mut self, tree: &PlanarBody, r0: &SO2<S>, xi: &mut Velocity<S>) {
        let base = &self.links[0];
        xi.0[0] = base.omega;
        xi.1.0 = base.v.rotated(r0).0;
        for (i, node) in tree.nodes.iter().enumerate().skip(1) {
            self.advance(i, node);
            xi.2[i - 1][0] = self.links[i].omega;
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
        xi.0[0] = base.omega;
        xi.1.0 = base.v.rotated(r0).0;
        tau.0[0] = tree.nodes[0].mass.apply(base.v).cross(base.v);
        tau.1.0 = Vec2::zero().0;
        for (i, node) in tree.nodes.iter().enumerate().skip(1) {
            let u = self.advance(i, node);
            let link = &self.links[i];
            xi.2[i - 1][0] = link.omega;
            tau.2[i - 1][0] = node.mass.apply(link.v).cross(u);
            let on_parent = (link.mass * u + link.force).rotated(&link.c);
            let swept = node.lever.quarter_turn().lift() * self.links[node.parent].omega;
            of_mut((&mut tau.0, &mut tau.2), node.parent)[0] += swept.cross(on_parent);
        }
    }
}

/// What a step's iteration uses as its matrix: $\mathbb I(g_k)$, factorised once a step.
#[derive(Clone, Debug)]
pub struct Factor {
    r0: SO2,
    elimination: Elimination,
    /// $\left(\sum_i R_i M_i R_i^T\right)^{-1}$: (31) solved for $\Delta x$.
    total_mass_inverse: Sym2,
}

impl Inertia for PlanarBody {
    type Factor = Factor;

    fn factor(&self) -> Factor {
        Factor {
            r0: SO2::identity(),
            elimination: Elimination::new(self),
            total_mass_inverse: Sym2::zero(),
        }
    }

    #[inline(always)]
    fn factorise(&self, (r0, _, r): &PlanarConfiguration, factor: &mut Factor) {
        factor.r0 = *r0;
        factor.elimination.factorise(self, (r0, r));
        let nodes = self.nodes.iter().enumerate();
        let turned = nodes.map(|(i, node)| node.mass.turned(of((r0, r), i)));
        factor.total_mass_inverse = turned.fold(Sym2::zero(), |sum, mass| sum + mass).inverse();
    }

    #[inline(always)]
    fn solve(&self, factor: &mut Factor, mu: &Momentum, xi: &mut Velocity) {
        factor.elimination.begin(self, &factor.r0, mu);
        factor.elimination.finish(self, &factor.r0, xi);
    }

    /// The displacement $\Delta x$, under a weight too: its impulse is constant.
    fn eliminated(&self) -> Range<usize> {
        if self.keeps_translation { 0..0 } else { 1..3 }
    }

    /// (31) $= p_x$, and the impulse of the weight with it, solved for $\Delta x$.
    #[inline(always)]
    fn eliminate(
        &self,
        factor: &mut Factor,
        state: &State<PlanarConfiguration>,
        h: f64,
        f: &mut PlanarConfiguration,
        c: &mut Velocity,
        out: &mut Derivatives<PlanarConfiguration, f64>,
    ) {
        let State { g, mu, .. } = state;
        self.displace(g, f, out);
        if !self.keeps_translation {
            let mut rest = Vec2(mu.1.0) * h - self.turning_momentum(g, out);
            if let Some(weight) = &self.weight {
                rest += weight.force() * (h * h);
            }
            let solved = (factor.total_mass_inverse * rest).0;
            (f.1.0, c.1.0) = (solved, solved);
        }
        self.collect(g, f, h, out);
    }
}
