//! The discrete Lagrangian (22) and its derivatives (29)–(33), for any tree of bodies.

use core::ops::Range;

use dvi::{Context, Derivatives, DiscreteLagrangian, State, Still};
use lie::{Ldl3, Mat3, SO3, Scalar, Vec3};
use smallvec::SmallVec;

use crate::inertia::Elimination;
use crate::kinematics::PerBody;
use crate::tree::{ArticulatedBody, Configuration, Momentum, Velocity};

impl ArticulatedBody {
    /// (22), with the displacement of the first body $\Delta x$ in the reference frame and its position `x`.
    ///
    /// With $E = F - I$, $B_i$ of (28) and $\mathrm{tr}[(I - F) J_d] = -\mathrm{tr}[E J_d]$.
    fn action<S: Scalar>(&self, (r, x): &Configuration<S>, (f, dx): &Configuration<S>, h: S) -> S {
        let mut sum = S::zero();
        let mut displacements: PerBody<Vec3<S>> = SmallVec::with_capacity(self.nodes.len());
        for (i, (node, mass)) in self.nodes.iter().zip(&self.masses).enumerate() {
            let b = match i {
                0 => r[0].inverse_rotate(dx[0].vec3()),
                _ => {
                    let turn = f[node.parent].displacement();
                    let joint = displacements[node.parent] + turn.apply(node.at_parent.lift());
                    r[i].inverse_rotate(r[node.parent].rotate(joint))
                }
            };
            let (e, mb) = (f[i].displacement(), mass.apply(b));
            let turned = e.apply(node.at_self.lift());
            displacements.push(b - turned);
            sum += b.dot(mb).times(0.5) - mb.dot(turned) - e.trace_with(node.jd);
        }
        sum / h - h * self.loads.potential(r, x[0].vec3())
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

/// Storage of the steps of a tree of bodies.
#[derive(Clone, Debug)]
pub struct StepWorkspace<S = f64> {
    moved: Vec<Moved<S>>,
    /// $\mathbb I(g_k)$, factorised once a step, and $R_0$ there.
    inertia: Elimination<S>,
    r0: SO3<S>,
    /// $\sum_i R_i M_i R_i^T$, to solve (31) for $\Delta x$.
    total_mass: Ldl3<S>,
}

impl<S: Scalar> Default for StepWorkspace<S> {
    fn default() -> Self {
        Self {
            moved: Vec::new(),
            inertia: Elimination::default(),
            r0: SO3::identity(),
            total_mass: Ldl3::identity(),
        }
    }
}

impl ArticulatedBody {
    /// The displacements that the turns alone make, $\Delta x = 0$, from the first body on.
    #[inline(always)]
    fn displace<S: Scalar>(
        &self,
        (r, _): &Configuration<S>,
        (f, _): &Configuration<S>,
        moved: &mut Vec<Moved<S>>,
    ) {
        moved.resize(self.nodes.len(), [Vec3::zero(); 6]);
        for (i, node) in self.nodes.iter().enumerate() {
            let e = f[i].minus_identity();
            let b = match i {
                0 => Vec3::zero(),
                _ => {
                    let parent: &Moved<S> = &moved[node.parent];
                    let joint = parent[4] + turn(parent) * node.at_parent.lift();
                    r[i].inverse_rotate(r[node.parent].rotate(joint))
                }
            };
            let y = b - e * node.at_self.lift();
            moved[i] = [e.row(0), e.row(1), e.row(2), b, y, Vec3::zero()];
        }
    }

    /// $\sum_i R_i M_i Y_i$ of these displacements.
    #[inline(always)]
    fn turning_momentum<S: Scalar>(&self, r: &[SO3<S>], moved: &[Moved<S>]) -> Vec3<S> {
        let bodies = self.masses.iter().zip(moved).zip(r);
        bodies.fold(Vec3::zero(), |sum, ((mass, moved), r)| {
            sum + r.rotate(mass.apply(moved[4]))
        })
    }

    /// (29)–(33) from the displacements, to which $\Delta x$ is added: momenta, back from the leaves.
    #[inline(always)]
    fn collect<S: Scalar>(
        &self,
        (r, _): &Configuration<S>,
        (f, dx): &Configuration<S>,
        h: S,
        moved: &mut [Moved<S>],
        out: &mut Derivatives<Configuration, S>,
    ) {
        let (inverse_h, dx) = (S::one() / h, dx[0].vec3());
        let Derivatives { d_f, d_g, .. } = out;
        d_f.0.fill(Vec3::zero().into());
        d_g.0.fill(Vec3::zero().into());
        for (i, node) in self.nodes.iter().enumerate().rev() {
            let (e, [.., b, y, carried]) = (turn(&moved[i]), moved[i]);
            let shift = r[i].inverse_rotate(dx);
            let (b, y) = (b + shift, y + shift);
            let (mb, my) = (self.masses[i].apply(b), self.masses[i].apply(y));
            let joint = node
                .at_self
                .lift::<S>()
                .cross(f[i].inverse_rotate(mb + carried));
            let turned = rotation_momentum(node.jd, &e) - joint;
            let slot = &mut d_f.0[i];
            *slot = ((slot.vec3() + turned) * inverse_h).into();
            let slot = &mut d_g.0[i];
            *slot = ((slot.vec3() + my.cross(b)) * inverse_h).into();
            let on_joint = r[i].rotate(my + carried);
            if i == 0 {
                d_f.1[0] = (on_joint * inverse_h).into();
                continue;
            }
            let on_parent = r[node.parent].inverse_rotate(on_joint);
            let parent: &mut Moved<S> = &mut moved[node.parent];
            parent[5] += on_parent;
            let slot = &mut d_f.0[node.parent];
            let pushed = f[node.parent].inverse_rotate(on_parent);
            *slot = (slot.vec3() + node.at_parent.lift::<S>().cross(pushed)).into();
            let slot = &mut d_g.0[node.parent];
            let swept = turn(parent) * node.lever.lift();
            *slot = (slot.vec3() + swept.cross(on_parent)).into();
        }
        self.loads.add_torques(r, h, &mut d_g.0);
        let falling = self.loads.force().map(|force| force * h);
        d_g.1[0] = falling.unwrap_or(Vec3::zero()).into();
    }
}

impl DiscreteLagrangian for ArticulatedBody {
    type Workspace<S: Scalar> = StepWorkspace<S>;
    const HAS_INERTIA: bool = true;

    fn value<S: Scalar>(
        &self,
        _: Context<S>,
        g: &Configuration<S>,
        f: &Configuration<S>,
        h: S,
    ) -> S {
        self.action(g, f, h)
    }

    /// (29)–(33) by recursion: displacements from the first body on, momenta back from the leaves.
    ///
    /// $ h\,d_{f_i} = (J^\prime_d F_i - F_i^T J^\prime_d)^\vee - d_{ip} \times F_i^T (M_i B_i + S_i) + \sum_k d_{ik} \times F_i^T C_k G_k$ and
    /// $ h\,d_{g_i} = M_i Y_i \times B_i + \sum_k E_i l_k \times C_k G_k$ with $G_i = M_i Y_i + S_i$, $S_i = \sum_k C_k G_k$.
    #[inline(always)]
    fn derivatives<S: Scalar>(
        &self,
        _: Context<S>,
        g: &Configuration<S>,
        f: &Configuration<S>,
        h: S,
        work: &mut StepWorkspace<S>,
        out: &mut Derivatives<Configuration, S>,
    ) {
        self.displace(g, f, &mut work.moved);
        self.collect(g, f, h, &mut work.moved, out);
    }

    fn is_defined(&self, _: f64, _: &Configuration, _: &Still<Configuration>) -> bool {
        true
    }

    #[inline(always)]
    fn factorise(&self, (r, _): &Configuration, work: &mut StepWorkspace) {
        work.r0 = r[0];
        work.inertia.factorise(self, r);
        work.total_mass = self.total_mass(r).ldl();
    }

    #[inline(always)]
    fn solve(&self, work: &mut StepWorkspace, mu: &Momentum, xi: &mut Velocity) {
        work.inertia.begin(self, &work.r0, mu);
        work.inertia.finish(self, &work.r0, xi);
    }

    fn solve_cyclic(&self, work: &mut StepWorkspace, mu: &Momentum, xi: &mut Velocity) {
        xi.0.fill(Vec3::zero().into());
        xi.1[0] = work.total_mass.solve(mu.1[0].vec3()).into();
    }

    /// The displacement $\Delta x$, under a weight too: its impulse is constant.
    fn eliminated(&self) -> Range<usize> {
        self.translation()
    }

    /// (31) $= p_x$, and the impulse of the weight with it, solved for $\Delta x$.
    #[inline(always)]
    fn eliminate(
        &self,
        work: &mut StepWorkspace,
        (State { g, mu, .. }, h): (&State<Configuration>, f64),
        f: &mut Configuration,
        c: &mut Velocity,
        out: &mut Derivatives<Configuration, f64>,
    ) {
        self.displace(g, f, &mut work.moved);
        let mut rest = mu.1[0].vec3() * h - self.turning_momentum(&g.0, &work.moved);
        if let Some(force) = self.loads.force::<f64>() {
            rest += force * (h * h);
        }
        let solved = work.total_mass.solve(rest);
        (f.1[0], c.1[0]) = (solved.into(), solved.into());
        self.collect(g, f, h, &mut work.moved, out);
    }
}
