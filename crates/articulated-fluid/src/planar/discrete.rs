//! The discrete Lagrangian (22) restricted to the plane, and its derivatives.

use core::ops::Range;

use dvi::{Derivatives, DiscreteLagrangian};
use lie::{SO2, Scalar, Vec3};
use smallvec::SmallVec;

use super::vector::Vec2;
use super::{PlanarBody, PlanarConfiguration, of};
use crate::discrete::PerBody;
use crate::elimination::of_mut;

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

/// A number and a vector, packed: what the derivatives store of a body is made of three.
#[inline(always)]
fn pack<S>(a: S, Vec2([x, y]): Vec2<S>) -> Vec3<S> {
    Vec3([a, x, y])
}

#[inline(always)]
fn vector<S>(Vec3([_, x, y]): Vec3<S>) -> Vec2<S> {
    Vec2([x, y])
}

/// What the derivatives need of a body, in its own frame: $E_i$; the displacement of its joint, $B_i$ of (28); that of its
/// centre, $Y_i = B_i - E_i d_{ip}$; and the sum of the momenta on the joints that it carries.
type Moved<S> = [Vec3<S>; 3];

#[inline(always)]
fn turn<S: Scalar>([a, b, _]: &Moved<S>) -> Turn<S> {
    Turn {
        cos_minus_one: a[0],
        sin: b[0],
    }
}

impl PlanarBody {
    /// The displacements that the turns alone make, $\Delta x = 0$, from the first body on.
    #[inline(always)]
    pub(super) fn displace<S: Scalar>(
        &self,
        (r0, _, r): &PlanarConfiguration<S>,
        (f0, _, f): &PlanarConfiguration<S>,
        out: &mut Derivatives<PlanarConfiguration, S>,
    ) {
        let (r, f) = ((r0, &r[..]), (f0, &f[..]));
        out.scratch.resize(3 * self.nodes.len(), Vec3::zero());
        let (moved, _) = out.scratch.as_chunks_mut();
        for (i, node) in self.nodes.iter().enumerate() {
            let e = Turn::of(of(f, i));
            let b = match i {
                0 => Vec2::zero(),
                _ => {
                    let parent: &Moved<S> = &moved[node.parent];
                    let swept = turn(parent).apply(node.at_parent.lift());
                    let joint = (vector(parent[1]) + swept).rotated(of(r, node.parent));
                    joint.rotated_back(of(r, i))
                }
            };
            let y = b - e.apply(node.at_self.lift());
            moved[i] = [pack(e.cos_minus_one, b), pack(e.sin, y), Vec3::zero()];
        }
    }

    /// $\sum_i R_i M_i Y_i$ of these displacements.
    #[inline(always)]
    pub(super) fn turning_momentum<S: Scalar>(
        &self,
        (r0, _, r): &PlanarConfiguration<S>,
        out: &Derivatives<PlanarConfiguration, S>,
    ) -> Vec2<S> {
        let (moved, _): (&[Moved<S>], _) = out.scratch.as_chunks();
        let bodies = self.nodes.iter().zip(moved).enumerate();
        bodies.fold(Vec2::zero(), |sum, (i, (node, moved))| {
            sum + node.mass.apply(vector(moved[1])).rotated(of((r0, r), i))
        })
    }

    /// (29)–(33) from the displacements, to which $\Delta x$ is added: momenta, back from the leaves.
    #[inline(always)]
    pub(super) fn collect<S: Scalar>(
        &self,
        (r0, _, r): &PlanarConfiguration<S>,
        (f0, dx, f): &PlanarConfiguration<S>,
        h: S,
        out: &mut Derivatives<PlanarConfiguration, S>,
    ) {
        let (inverse_h, r, f) = (S::one() / h, (r0, &r[..]), (f0, &f[..]));
        let Derivatives {
            d_f, d_g, scratch, ..
        } = out;
        let (moved, _) = scratch.as_chunks_mut();
        (d_f.0[0], d_g.0[0]) = (S::zero(), S::zero());
        d_f.2.iter_mut().for_each(|d| d[0] = S::zero());
        d_g.2.iter_mut().for_each(|d| d[0] = S::zero());
        for (i, node) in self.nodes.iter().enumerate().rev() {
            let (e, [b, y, carried]) = (turn(&moved[i]), moved[i].map(vector));
            let shift = Vec2(dx.0).rotated_back(of(r, i));
            let (b, y) = (b + shift, y + shift);
            let (mb, my) = (node.mass.apply(b), node.mass.apply(y));
            let pushed = (mb + carried).rotated_back(of(f, i));
            let turned = e.sin.times(node.j_joint) - node.at_self.lift().cross(pushed);
            let slot = &mut of_mut((&mut d_f.0, &mut d_f.2), i)[0];
            *slot = (*slot + turned) * inverse_h;
            let slot = &mut of_mut((&mut d_g.0, &mut d_g.2), i)[0];
            *slot = (*slot + my.cross(b)) * inverse_h;
            if let Some(weight) = &self.weight {
                *slot += weight.torque(i, of(r, i)) * h;
            }
            let on_joint = (my + carried).rotated(of(r, i));
            if i == 0 {
                d_f.1.0 = (on_joint * inverse_h).0;
                continue;
            }
            let on_parent = on_joint.rotated_back(of(r, node.parent));
            let parent: &mut Moved<S> = &mut moved[node.parent];
            parent[2] += pack(S::zero(), on_parent);
            let pushed = on_parent.rotated_back(of(f, node.parent));
            let slot = &mut of_mut((&mut d_f.0, &mut d_f.2), node.parent)[0];
            *slot += node.at_parent.lift().cross(pushed);
            let swept = turn(parent).apply(node.lever.lift());
            let slot = &mut of_mut((&mut d_g.0, &mut d_g.2), node.parent)[0];
            *slot += swept.cross(on_parent);
        }
        if let Some(springs) = &self.springs {
            springs.add_torques(r, h, (&mut d_g.0, &mut d_g.2));
        }
        let falling = self.weight.as_ref().map(|weight| weight.force::<S>() * h);
        d_g.1.0 = falling.unwrap_or(Vec2::zero()).0;
    }
}

impl DiscreteLagrangian for PlanarBody {
    type Group = PlanarConfiguration;

    /// $h L_d = \sum_i \left[\frac12 B_i \cdot M_i B_i - M_i B_i \cdot E_i d_{ip} + (1 - \cos\varphi_i) J'_i\right] - h^2 U$.
    fn value<S: Scalar>(&self, g: &PlanarConfiguration<S>, f: &PlanarConfiguration<S>, h: S) -> S {
        let (r, f) = ((&g.0, &g.2[..]), (&f.0, Vec2(f.1.0), &f.2[..]));
        let mut displacements: PerBody<Vec2<S>> = SmallVec::with_capacity(self.nodes.len());
        let mut sum = S::zero();
        for (i, node) in self.nodes.iter().enumerate() {
            let b = match i {
                0 => f.1.rotated_back(r.0),
                _ => {
                    let turn = Turn::of(of((f.0, f.2), node.parent));
                    let swept = turn.apply(node.at_parent.lift());
                    let joint = (displacements[node.parent] + swept).rotated(of(r, node.parent));
                    joint.rotated_back(of(r, i))
                }
            };
            let (e, mb) = (Turn::of(of((f.0, f.2), i)), node.mass.apply(b));
            let turned = e.apply(node.at_self.lift());
            displacements.push(b - turned);
            sum += b.dot(mb).times(0.5) - mb.dot(turned) - e.cos_minus_one.times(node.j_joint);
        }
        sum / h - h * self.potential(g)
    }

    /// (29)–(33) in the plane: displacements from the first body on, momenta back from the leaves.
    ///
    /// $ h\,d_{f_i} = J'_i \sin\varphi_i - d_{ip} \times F_i^T (M_i B_i + S_i) + \sum_k d_{ik} \times F_i^T C_k G_k$ and
    /// $ h\,d_{g_i} = M_i Y_i \times B_i + \sum_k E_i l_k \times C_k G_k$ with $G_i = M_i Y_i + S_i$, $S_i = \sum_k C_k G_k$.
    #[inline(always)]
    fn derivatives<S: Scalar>(
        &self,
        _t: S,
        g: &PlanarConfiguration<S>,
        f: &PlanarConfiguration<S>,
        h: S,
        out: &mut Derivatives<PlanarConfiguration, S>,
    ) {
        self.displace(g, f, out);
        self.collect(g, f, h, out);
    }

    /// The displacement $\Delta x$ of the first body, but under a weight.
    fn cyclic(&self) -> Range<usize> {
        self.free_translation()
    }

    fn fits(&self, g: &PlanarConfiguration) -> bool {
        self.is_of(g)
    }

    fn is_defined(&self, _t: f64, _g: &PlanarConfiguration) -> bool {
        true
    }
}
