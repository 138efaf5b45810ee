//! The discrete Lagrangian (22) and its derivatives (29)–(33), for any tree of bodies.

use core::ops::Range;

use dvi::{Derivatives, DiscreteLagrangian};
use lie::{Mat3, Scalar, Vec3};
use smallvec::SmallVec;

use crate::elimination::{Attitudes, of, of_mut};
use crate::{ArticulatedBody, Configuration};

/// Bodies whose quantities fit on the stack.
const FEW: usize = 8;

/// A quantity of each body.
pub(crate) type PerBody<T> = SmallVec<[T; FEW]>;

impl ArticulatedBody {
    /// (22), with the displacement of the first body $\Delta x$ in the reference frame and its position `x`.
    ///
    /// With $E = F - I$, $B_i$ of (28) and $\mathrm{tr}[(I - F) J_d] = -\mathrm{tr}[E J_d]$.
    pub(crate) fn action<S: Scalar>(
        &self,
        (r, x): (Attitudes<S>, Vec3<S>),
        (f, dx): (Attitudes<S>, Vec3<S>),
        h: S,
    ) -> S {
        let mut sum = S::zero();
        let mut displacements: PerBody<Vec3<S>> = SmallVec::with_capacity(self.nodes.len());
        for (i, (node, mass)) in self.nodes.iter().zip(&self.masses).enumerate() {
            let b = match i {
                0 => r.0.inverse_rotate(dx),
                _ => {
                    let turn = of(f, node.parent).displacement();
                    let joint = displacements[node.parent] + turn.apply(node.at_parent.lift());
                    of(r, i).inverse_rotate(of(r, node.parent).rotate(joint))
                }
            };
            let (e, mb) = (of(f, i).displacement(), mass.apply(b));
            let turned = e.apply(node.at_self.lift());
            displacements.push(b - turned);
            sum += b.dot(mb).times(0.5) - mb.dot(turned) - e.trace_with(node.jd);
        }
        sum / h - h * self.potential(r, x)
    }
}

/// $\left(J_d F - F^T J_d\right)^\vee$ from $E = F - I$: the identity cancels.
#[inline(always)]
fn rotation_momentum<S: Scalar>(jd: Mat3, e: &Mat3<S>) -> Vec3<S> {
    (jd.lift::<S>() * *e).skew_vee()
}

/// What the derivatives need of a body, all in its own frame: the rows of $E_i = F_i - I$; the displacement of its joint,
/// $B_i$ of (28); that of its centre, $Y_i = B_i - E_i d_{ip}$; and the sum of the momenta on the joints that it carries.
type Moved<S> = [Vec3<S>; 6];

#[inline(always)]
fn turn<S: Scalar>(moved: &Moved<S>) -> Mat3<S> {
    Mat3([moved[0].0, moved[1].0, moved[2].0])
}

impl ArticulatedBody {
    /// The displacements that the turns alone make, $\Delta x = 0$, from the first body on.
    #[inline(always)]
    pub(crate) fn displace<S: Scalar>(
        &self,
        (r0, _, r): &Configuration<S>,
        (f0, _, f): &Configuration<S>,
        out: &mut Derivatives<Configuration, S>,
    ) {
        let (r, f) = ((r0, &r[..]), (f0, &f[..]));
        out.scratch.resize(6 * self.nodes.len(), Vec3::zero());
        let (moved, _) = out.scratch.as_chunks_mut();
        for (i, node) in self.nodes.iter().enumerate() {
            let e = of(f, i).minus_identity();
            let b = match i {
                0 => Vec3::zero(),
                _ => {
                    let parent: &Moved<S> = &moved[node.parent];
                    let joint = parent[4] + turn(parent) * node.at_parent.lift();
                    of(r, i).inverse_rotate(of(r, node.parent).rotate(joint))
                }
            };
            let y = b - e * node.at_self.lift();
            moved[i] = [e.row(0), e.row(1), e.row(2), b, y, Vec3::zero()];
        }
    }

    /// $\sum_i R_i M_i Y_i$ of these displacements.
    #[inline(always)]
    pub(crate) fn turning_momentum<S: Scalar>(
        &self,
        (r0, _, r): &Configuration<S>,
        out: &Derivatives<Configuration, S>,
    ) -> Vec3<S> {
        let (moved, _): (&[Moved<S>], _) = out.scratch.as_chunks();
        let bodies = self.masses.iter().zip(moved).enumerate();
        bodies.fold(Vec3::zero(), |sum, (i, (mass, moved))| {
            sum + of((r0, r), i).rotate(mass.apply(moved[4]))
        })
    }

    /// (29)–(33) from the displacements, to which $\Delta x$ is added: momenta, back from the leaves.
    #[inline(always)]
    pub(crate) fn collect<S: Scalar>(
        &self,
        (r0, _, r): &Configuration<S>,
        (f0, dx, f): &Configuration<S>,
        h: S,
        out: &mut Derivatives<Configuration, S>,
    ) {
        let (inverse_h, r, f) = (S::one() / h, (r0, &r[..]), (f0, &f[..]));
        let Derivatives {
            d_f, d_g, scratch, ..
        } = out;
        let (moved, _) = scratch.as_chunks_mut();
        (d_f.0, d_g.0) = (Vec3::zero().into(), Vec3::zero().into());
        d_f.2.fill(Vec3::zero().into());
        d_g.2.fill(Vec3::zero().into());
        for (i, node) in self.nodes.iter().enumerate().rev() {
            let (e, [.., b, y, carried]) = (turn(&moved[i]), moved[i]);
            let shift = of(r, i).inverse_rotate(dx.vec3());
            let (b, y) = (b + shift, y + shift);
            let (mb, my) = (self.masses[i].apply(b), self.masses[i].apply(y));
            let joint = node
                .at_self
                .lift::<S>()
                .cross(of(f, i).inverse_rotate(mb + carried));
            let turned = rotation_momentum(node.jd, &e) - joint;
            let slot = of_mut((&mut d_f.0, &mut d_f.2), i);
            *slot = ((slot.vec3() + turned) * inverse_h).into();
            let slot = of_mut((&mut d_g.0, &mut d_g.2), i);
            let mut pulled = (slot.vec3() + my.cross(b)) * inverse_h;
            if let Some(weight) = &self.weight {
                pulled += weight.torque(i, of(r, i)) * h;
            }
            *slot = pulled.into();
            let on_joint = of(r, i).rotate(my + carried);
            if i == 0 {
                d_f.1 = (on_joint * inverse_h).into();
                continue;
            }
            let on_parent = of(r, node.parent).inverse_rotate(on_joint);
            let parent: &mut Moved<S> = &mut moved[node.parent];
            parent[5] += on_parent;
            let slot = of_mut((&mut d_f.0, &mut d_f.2), node.parent);
            let pushed = of(f, node.parent).inverse_rotate(on_parent);
            *slot = (slot.vec3() + node.at_parent.lift::<S>().cross(pushed)).into();
            let slot = of_mut((&mut d_g.0, &mut d_g.2), node.parent);
            let swept = turn(parent) * node.lever.lift();
            *slot = (slot.vec3() + swept.cross(on_parent)).into();
        }
        if let Some(springs) = &self.springs {
            springs.add_torques(r, h, (&mut d_g.0, &mut d_g.2));
        }
        let falling = self.weight.as_ref().map(|weight| weight.force::<S>() * h);
        d_g.1 = falling.unwrap_or(Vec3::zero()).into();
    }
}

impl DiscreteLagrangian for ArticulatedBody {
    type Group = Configuration;

    fn value<S: Scalar>(&self, g: &Configuration<S>, f: &Configuration<S>, h: S) -> S {
        self.action(((&g.0, &g.2), g.1.vec3()), ((&f.0, &f.2), f.1.vec3()), h)
    }

    /// (29)–(33) by recursion: displacements from the first body on, momenta back from the leaves.
    ///
    /// $ h\,d_{f_i} = (J^\prime_d F_i - F_i^T J^\prime_d)^\vee - d_{ip} \times F_i^T (M_i B_i + S_i) + \sum_k d_{ik} \times F_i^T C_k G_k$ and
    /// $ h\,d_{g_i} = M_i Y_i \times B_i + \sum_k E_i l_k \times C_k G_k$ with $G_i = M_i Y_i + S_i$, $S_i = \sum_k C_k G_k$.
    #[inline(always)]
    fn derivatives<S: Scalar>(
        &self,
        _t: S,
        g: &Configuration<S>,
        f: &Configuration<S>,
        h: S,
        out: &mut Derivatives<Configuration, S>,
    ) {
        self.displace(g, f, out);
        self.collect(g, f, h, out);
    }

    /// The displacement $\Delta x$ of the first body, but under a weight: (31) is linear in it, and $x$ enters nowhere.
    fn cyclic(&self) -> Range<usize> {
        self.free_translation()
    }

    fn fits(&self, g: &Configuration) -> bool {
        g.2.len() + 1 == self.nodes.len()
    }

    fn is_defined(&self, _t: f64, _g: &Configuration) -> bool {
        true
    }
}
