//! The discrete Lagrangian (22) restricted to the plane, and its derivatives.

use core::ops::Range;

use dvi::{Context, Derivatives, DiscreteLagrangian, State, Still};
use lie::{SO2, Scalar};
use smallvec::SmallVec;

use super::inertia::PlanarElimination;
use super::tree::{Momentum, PlanarBody, PlanarConfiguration, Velocity};
use super::vector::{Sym2, Vec2};
use crate::kinematics::PerBody;

/// $E = F - I$ as $(\cos\varphi - 1, \sin\varphi)$.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn<S> {
    cos_minus_one: S,
    sin: S,
}

impl<S: Scalar> Turn<S> {
    #[inline(always)]
    pub(super) fn of(f: &SO2<S>) -> Self {
        Self {
            cos_minus_one: f.cos_minus_one(),
            sin: f.sin(),
        }
    }

    /// $E x$.
    #[inline(always)]
    pub(super) fn apply(self, x: Vec2<S>) -> Vec2<S> {
        x * self.cos_minus_one + x.quarter_turn() * self.sin
    }
}

/// What the derivatives need of a body, in its own frame.
#[derive(Clone, Copy, Debug)]
struct Moved<S> {
    /// $E_i$.
    e: Turn<S>,
    /// The displacement of its joint, $B_i$ of (28).
    b: Vec2<S>,
    /// That of its centre, $Y_i = B_i - E_i d_{ip}$.
    y: Vec2<S>,
    /// The sum of the momenta on the joints that it carries.
    carried: Vec2<S>,
}

/// Storage of the steps of a tree of bodies in a plane.
#[derive(Clone, Debug)]
pub struct PlanarStepWorkspace<S = f64> {
    moved: Vec<Moved<S>>,
    /// $\mathbb I(g_k)$, factorised once a step, and $R_0$ there.
    inertia: PlanarElimination<S>,
    r0: SO2<S>,
    /// $\left(\sum_i R_i M_i R_i^T\right)^{-1}$: (31) solved for $\Delta x$.
    total_mass_inverse: Sym2<S>,
}

impl<S: Scalar> Default for PlanarStepWorkspace<S> {
    fn default() -> Self {
        Self {
            moved: Vec::new(),
            inertia: PlanarElimination::default(),
            r0: SO2::identity(),
            total_mass_inverse: Sym2::zero(),
        }
    }
}

impl PlanarBody {
    /// The displacements that the turns alone make, $\Delta x = 0$, from the first body on.
    #[inline(always)]
    fn displace<S: Scalar>(
        &self,
        (r, _): &PlanarConfiguration<S>,
        (f, _): &PlanarConfiguration<S>,
        moved: &mut Vec<Moved<S>>,
    ) {
        moved.clear();
        for (i, node) in self.nodes.iter().enumerate() {
            let e = Turn::of(&f[i]);
            let b = match i {
                0 => Vec2::zero(),
                _ => {
                    let parent: &Moved<S> = &moved[node.parent];
                    let swept = parent.e.apply(node.at_parent.lift());
                    let joint = (parent.y + swept).rotated(&r[node.parent]);
                    joint.rotated_back(&r[i])
                }
            };
            let y = b - e.apply(node.at_self.lift());
            let carried = Vec2::zero();
            moved.push(Moved { e, b, y, carried });
        }
    }

    /// $\sum_i R_i M_i Y_i$ of these displacements.
    #[inline(always)]
    fn turning_momentum<S: Scalar>(&self, r: &[SO2<S>], moved: &[Moved<S>]) -> Vec2<S> {
        let bodies = self.nodes.iter().zip(moved).zip(r);
        bodies.fold(Vec2::zero(), |sum, ((node, moved), r)| {
            sum + node.mass.apply(moved.y).rotated(r)
        })
    }

    /// (29)–(33) from the displacements, to which $\Delta x$ is added: momenta, back from the leaves.
    #[inline(always)]
    fn collect<S: Scalar>(
        &self,
        (r, _): &PlanarConfiguration<S>,
        (f, dx): &PlanarConfiguration<S>,
        h: S,
        moved: &mut [Moved<S>],
        out: &mut Derivatives<PlanarConfiguration, S>,
    ) {
        let (inverse_h, dx) = (S::one() / h, Vec2(dx[0].0));
        let Derivatives { d_f, d_g, .. } = out;
        d_f.0.iter_mut().for_each(|d| d[0] = S::zero());
        d_g.0.iter_mut().for_each(|d| d[0] = S::zero());
        for (i, node) in self.nodes.iter().enumerate().rev() {
            let Moved { e, b, y, carried } = moved[i];
            let shift = dx.rotated_back(&r[i]);
            let (b, y) = (b + shift, y + shift);
            let (mb, my) = (node.mass.apply(b), node.mass.apply(y));
            let pushed = (mb + carried).rotated_back(&f[i]);
            let turned = e.sin.times(node.j_joint) - node.at_self.lift().cross(pushed);
            let slot = &mut d_f.0[i][0];
            *slot = (*slot + turned) * inverse_h;
            let slot = &mut d_g.0[i][0];
            *slot = (*slot + my.cross(b)) * inverse_h;
            let on_joint = (my + carried).rotated(&r[i]);
            if i == 0 {
                d_f.1[0].0 = (on_joint * inverse_h).0;
                continue;
            }
            let on_parent = on_joint.rotated_back(&r[node.parent]);
            let parent: &mut Moved<S> = &mut moved[node.parent];
            parent.carried += on_parent;
            let pushed = on_parent.rotated_back(&f[node.parent]);
            d_f.0[node.parent][0] += node.at_parent.lift().cross(pushed);
            let swept = parent.e.apply(node.lever.lift());
            d_g.0[node.parent][0] += swept.cross(on_parent);
        }
        self.loads.add_torques(r, h, &mut d_g.0);
        let falling = self.loads.force().map(|force| force * h);
        d_g.1[0].0 = falling.unwrap_or(Vec2::zero()).0;
    }
}

impl DiscreteLagrangian for PlanarBody {
    type Workspace<S: Scalar> = PlanarStepWorkspace<S>;
    const HAS_INERTIA: bool = true;

    /// $h L_d = \sum_i \left[\frac12 B_i \cdot M_i B_i - M_i B_i \cdot E_i d_{ip} + (1 - \cos\varphi_i) J'_i\right] - h^2 U$.
    fn value<S: Scalar>(
        &self,
        _: Context<S>,
        (r, x): &PlanarConfiguration<S>,
        (f, dx): &PlanarConfiguration<S>,
        h: S,
    ) -> S {
        let mut displacements: PerBody<Vec2<S>> = SmallVec::with_capacity(self.nodes.len());
        let mut sum = S::zero();
        for (i, node) in self.nodes.iter().enumerate() {
            let b = match i {
                0 => Vec2(dx[0].0).rotated_back(&r[0]),
                _ => {
                    let turn = Turn::of(&f[node.parent]);
                    let swept = turn.apply(node.at_parent.lift());
                    let joint = (displacements[node.parent] + swept).rotated(&r[node.parent]);
                    joint.rotated_back(&r[i])
                }
            };
            let (e, mb) = (Turn::of(&f[i]), node.mass.apply(b));
            let turned = e.apply(node.at_self.lift());
            displacements.push(b - turned);
            sum += b.dot(mb).times(0.5) - mb.dot(turned) - e.cos_minus_one.times(node.j_joint);
        }
        sum / h - h * self.loads.potential(r, Vec2(x[0].0))
    }

    /// (29)–(33) in the plane: displacements from the first body on, momenta back from the leaves.
    ///
    /// $ h\,d_{f_i} = J'_i \sin\varphi_i - d_{ip} \times F_i^T (M_i B_i + S_i) + \sum_k d_{ik} \times F_i^T C_k G_k$ and
    /// $ h\,d_{g_i} = M_i Y_i \times B_i + \sum_k E_i l_k \times C_k G_k$ with $G_i = M_i Y_i + S_i$, $S_i = \sum_k C_k G_k$.
    #[inline(always)]
    fn derivatives<S: Scalar>(
        &self,
        _: Context<S>,
        g: &PlanarConfiguration<S>,
        f: &PlanarConfiguration<S>,
        h: S,
        work: &mut PlanarStepWorkspace<S>,
        out: &mut Derivatives<PlanarConfiguration, S>,
    ) {
        self.displace(g, f, &mut work.moved);
        self.collect(g, f, h, &mut work.moved, out);
    }

    fn is_defined(&self, _: f64, _: &PlanarConfiguration, _: &Still<PlanarConfiguration>) -> bool {
        true
    }

    #[inline(always)]
    fn factorise(
        &self,
        _: (f64, f64),
        (r, _): &PlanarConfiguration,
        work: &mut PlanarStepWorkspace,
    ) {
        work.r0 = r[0];
        work.inertia.factorise(self, r);
        let turned = self.nodes.iter().zip(r.iter());
        let turned = turned.map(|(node, r)| node.mass.turned(r));
        work.total_mass_inverse = turned.fold(Sym2::zero(), |sum, mass| sum + mass).inverse();
    }

    #[inline(always)]
    fn solve(&self, work: &mut PlanarStepWorkspace, mu: &Momentum, xi: &mut Velocity) {
        work.inertia.begin(self, &work.r0, mu);
        work.inertia.finish(self, &work.r0, xi);
    }

    fn solve_cyclic(&self, work: &mut PlanarStepWorkspace, mu: &Momentum, xi: &mut Velocity) {
        xi.0.iter_mut().for_each(|omega| omega[0] = 0.0);
        xi.1[0].0 = (work.total_mass_inverse * Vec2(mu.1[0].0)).0;
    }

    /// The displacement $\Delta x$, under a weight too: its impulse is constant.
    fn eliminated(&self) -> Range<usize> {
        self.translation()
    }

    /// (31) $= p_x$, and the impulse of the weight with it, solved for $\Delta x$.
    #[inline(always)]
    fn eliminate(
        &self,
        work: &mut PlanarStepWorkspace,
        (State { g, mu, .. }, h): (&State<PlanarConfiguration>, f64),
        f: &mut PlanarConfiguration,
        c: &mut Velocity,
        out: &mut Derivatives<PlanarConfiguration, f64>,
    ) {
        self.displace(g, f, &mut work.moved);
        let mut rest = Vec2(mu.1[0].0) * h - self.turning_momentum(&g.0, &work.moved);
        if let Some(force) = self.loads.force() {
            rest += force * (h * h);
        }
        let solved = (work.total_mass_inverse * rest).0;
        (f.1[0].0, c.1[0].0) = (solved, solved);
        self.collect(g, f, h, &mut work.moved, out);
    }
}
