//! The discrete Lagrangian (22) and its derivatives (29)–(33), for any tree of bodies.

use core::ops::Range;

use dvi::{Context, Derivatives, DiscreteLagrangian, State, Still};
use lie::{Cotangent, Ldl3, Mat3, SO3, Scalar, Tangent, Vec3};
use smallvec::SmallVec;

use crate::displaced::{Expansion, Step};
use crate::inertia::Elimination;
use crate::joints::{Any, Balls, Damped, Kinds};
use crate::kinematics::PerBody;
use crate::loads::{ForceWork, Scenery};
use crate::pose::Drive;
use crate::tree::{ArticulatedBody, Configuration, Momentum, Velocity};

impl ArticulatedBody {
    /// (22), with the displacement of the first body $\Delta x$ in the reference frame and its position `x`.
    ///
    /// With $E = F - I$, $B_i$ of (28) and $\mathrm{tr}[(I - F) J_d] = -\mathrm{tr}[E J_d]$; coupled inertia adds (S27).
    fn action<S: Scalar>(&self, t: S, g: &Configuration<S>, f: &Configuration<S>, h: S) -> S {
        let mut work = Expansion::default();
        let step = self.step((t, h), g, (&f.0, &f.2), &mut work);
        let mut sum = S::zero();
        let mut displacements: PerBody<Vec3<S>> = SmallVec::with_capacity(self.nodes.len());
        for (i, (node, mass)) in self.nodes.iter().zip(&self.masses).enumerate() {
            let b = match i {
                0 => step.r[0].inverse_rotate(self.base_shift(step, f)),
                _ => {
                    let turn = step.f[node.parent].displacement();
                    let joint = displacements[node.parent] + turn.apply(node.at_parent.lift());
                    step.r[i].inverse_rotate(step.r[node.parent].rotate(joint))
                }
            };
            let (e, mb) = (step.f[i].displacement(), mass.apply(b));
            let turned = e.apply(node.at_self.lift());
            displacements.push(b - turned);
            sum += b.dot(mb).times(0.5) - mb.dot(turned) - e.trace_with(node.jd);
            if self.is_coupled {
                let own = self.turned_momentum(i, &step.turn::<Any>(i));
                sum += (b - turned).dot(own);
            }
        }
        sum / h - h * self.potential((step.r, step.now), g)
    }

    /// The displacement of the first body's mass centre, or of its joint where it is held.
    #[inline(always)]
    fn base_shift<S: Scalar>(&self, step: Step<S>, f: &Configuration<S>) -> Vec3<S> {
        match self.is_free() {
            true => f.1[0].vec3(),
            false => step.shift,
        }
    }
}

/// $\left(J_d F - F^T J_d\right)^\vee$ from $E = F - I$: the identity cancels.
#[inline(always)]
fn rotation_momentum<S: Scalar>(jd: Mat3, e: &Mat3<S>) -> Vec3<S> {
    (jd.lift::<S>() * *e).skew_vee()
}

/// $\frac12 (\mathrm{tr} F - F)\, C^T Y$ from $E = F - I$, (S27).
#[inline(always)]
fn coupled_rotation<S: Scalar>(coupling: Mat3, e: &Mat3<S>, y: Vec3<S>) -> Vec3<S> {
    let x = coupling.transpose().apply(y);
    let trace = S::from_f64(2.0) + e.trace();
    (x * trace - *e * x) * S::from_f64(0.5)
}

/// What the derivatives need of a body, all in its own frame. These are the rows of $E_i = F_i - I$, the displacement of its joint,
/// $B_i$ of (28), and that of its centre, $Y_i = B_i - E_i d_{ip}$. The last is the sum of the momenta on the joints that it carries.
type Moved<S> = [Vec3<S>; 6];

#[inline(always)]
fn turn<S: Scalar>(moved: &Moved<S>) -> Mat3<S> {
    Mat3([moved[0].0, moved[1].0, moved[2].0])
}

/// Storage of the steps of a tree of bodies.
#[derive(Clone, Debug)]
pub struct StepWorkspace<S = f64> {
    moved: Vec<Moved<S>>,
    expansion: Expansion<S>,
    by_body: ByBody<S>,
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
            expansion: Expansion::default(),
            by_body: ByBody::default(),
            inertia: Elimination::default(),
            r0: SO3::identity(),
            total_mass: Ldl3::identity(),
        }
    }
}

/// What is collected body by body.
#[derive(Clone, Debug)]
struct ByBody<S> {
    /// By the attitudes of all bodies.
    d_f: Vec<Cotangent<3, S>>,
    d_g: Vec<Cotangent<3, S>>,
    /// Of the loads that are no gradient.
    forces: ForceWork<S>,
}

impl<S> Default for ByBody<S> {
    fn default() -> Self {
        let (d_f, d_g, forces) = (Vec::new(), Vec::new(), ForceWork::default());
        Self { d_f, d_g, forces }
    }
}

impl ArticulatedBody {
    /// The displacements that the turns alone make, $\Delta x = 0$, from the first body on.
    #[inline(always)]
    fn displace<K: Kinds, S: Scalar>(&self, step: Step<S>, moved: &mut Vec<Moved<S>>) {
        if moved.len() != self.nodes.len() {
            moved.resize(self.nodes.len(), [Vec3::zero(); 6]);
        }
        for (i, node) in self.nodes.iter().enumerate() {
            let e = step.turn::<K>(i);
            let b = match i {
                0 => Vec3::zero(),
                _ => {
                    let parent: &Moved<S> = &moved[node.parent];
                    let joint = parent[4] + turn(parent) * node.at_parent.lift();
                    step.r[i].inverse_rotate(step.r[node.parent].rotate(joint))
                }
            };
            let y = b - e * node.at_self.lift();
            moved[i] = [e.row(0), e.row(1), e.row(2), b, y, Vec3::zero()];
        }
    }

    /// $\sum_i R_i M_i Y_i$ of these displacements.
    #[inline(always)]
    fn turning_momentum<K: Kinds, S: Scalar>(&self, r: &[SO3<S>], moved: &[Moved<S>]) -> Vec3<S> {
        let bodies = moved.iter().zip(r).enumerate();
        bodies.fold(Vec3::zero(), |sum, (i, (moved, r))| {
            let momentum = self.masses[i].apply(moved[4]);
            sum + r.rotate(match self.couples::<K>() {
                true => momentum + self.turned_momentum(i, &turn(moved)),
                false => momentum,
            })
        })
    }

    /// $C_i w_i$ with $w = (F - F^T)^\vee / 2$, (S27).
    #[inline(always)]
    fn turned_momentum<S: Scalar>(&self, i: usize, e: &Mat3<S>) -> Vec3<S> {
        let w = e.skew_vee() * S::from_f64(0.5);
        self.nodes[i].coupling.apply(w)
    }

    /// (29)–(33) from the displacements, to which that of the base is added: momenta, back from the leaves.
    #[inline(always)]
    fn collect<K: Kinds, S: Scalar>(
        &self,
        (t, g): (S, &Configuration<S>),
        step: Step<S>,
        (dx, h): (Vec3<S>, S),
        moved: &mut [Moved<S>],
        ByBody {
            d_f: own_f,
            d_g: own_g,
            forces,
        }: &mut ByBody<S>,
        out: &mut Derivatives<Configuration, S>,
    ) {
        let Derivatives { d_f, d_g, .. } = out;
        let at = Scenery { t, g, r: step.r };
        let (on_base, pushed) = if !K::ARE_BALLS && self.has_inner() {
            own_f.resize(self.nodes.len(), Cotangent::zero());
            own_g.resize(self.nodes.len(), Cotangent::zero());
            let on_base =
                self.collect_by_body::<K, S>(step, dx, h, moved, [&mut *own_f, &mut *own_g]);
            let pushed = self.push::<K, S>(at, (dx, h), moved, forces, own_g);
            self.gather_derivatives(step, [own_f, own_g], [&mut *d_f, &mut *d_g]);
            self.loads.add_to_hinges(&g.2, h, &mut d_g.2);
            (on_base, pushed)
        } else {
            let on_base =
                self.collect_by_body::<K, S>(step, dx, h, moved, [&mut d_f.0, &mut d_g.0]);
            (
                on_base,
                self.push::<K, S>(at, (dx, h), moved, forces, &mut d_g.0),
            )
        };
        if self.floats::<K>() {
            d_f.1[0] = on_base.into();
            let falling = self.loads.force().map(|force| force * h);
            d_g.1[0] = (falling.unwrap_or(Vec3::zero()) + pushed).into();
        }
    }

    /// Adds the impulses $f^-$ of what is no gradient, all at the start of the step; that on the whole is returned.
    ///
    /// Each acts on a joint's two bodies at one instant, so that the momentum is kept whatever is solved, (S19).
    #[inline(always)]
    fn push<K: Kinds, S: Scalar>(
        &self,
        at: Scenery<S>,
        (dx, h): (Vec3<S>, S),
        moved: &[Moved<S>],
        work: &mut ForceWork<S>,
        d_g: &mut [Cotangent<3, S>],
    ) -> Vec3<S> {
        let forces = &self.loads.forces;
        if K::ARE_BALLS || forces.are_none() {
            return Vec3::zero();
        }
        let rate = S::one() / h;
        let twist = |i: usize| {
            let (e, y) = (turn(&moved[i]), moved[i][4]);
            // By the vector of Cayley's map.
            let scale = S::from_f64(2.0) / (S::from_f64(4.0) + e.trace());
            let v = y + at.r[i].inverse_rotate(dx);
            [e.skew_vee() * (scale * rate), v * rate]
        };
        forces.add(self, at, (twist, h), work, d_g)
    }

    /// The derivatives by the attitudes of all bodies; the one by the base is returned.
    #[inline(always)]
    fn collect_by_body<K: Kinds, S: Scalar>(
        &self,
        step: Step<S>,
        dx: Vec3<S>,
        h: S,
        moved: &mut [Moved<S>],
        [d_f, d_g]: [&mut [Cotangent<3, S>]; 2],
    ) -> Vec3<S> {
        let Step { r, f, .. } = step;
        let (inverse_h, mut on_base) = (S::one() / h, Vec3::zero());
        d_f.fill(Vec3::zero().into());
        d_g.fill(Vec3::zero().into());
        for (i, node) in self.nodes.iter().enumerate().rev() {
            let (e, [.., b, y, carried]) = (turn(&moved[i]), moved[i]);
            let shift = r[i].inverse_rotate(dx);
            let (b, y) = (b + shift, y + shift);
            let (mut mb, mut my) = (self.masses[i].apply(b), self.masses[i].apply(y));
            let mut turned = rotation_momentum(node.jd, &e);
            if self.couples::<K>() {
                let own = self.turned_momentum(i, &e);
                (mb, my) = (mb + own, my + own);
                turned += coupled_rotation(node.coupling, &e, y);
            }
            let joint = node
                .at_self
                .lift::<S>()
                .cross(f[i].inverse_rotate(mb + carried));
            let slot = &mut d_f[i];
            *slot = ((slot.vec3() + turned - joint) * inverse_h).into();
            let slot = &mut d_g[i];
            *slot = ((slot.vec3() + my.cross(b)) * inverse_h).into();
            let on_joint = r[i].rotate(my + carried);
            if i == 0 {
                on_base = on_joint * inverse_h;
                continue;
            }
            let on_parent = r[node.parent].inverse_rotate(on_joint);
            let parent: &mut Moved<S> = &mut moved[node.parent];
            parent[5] += on_parent;
            let slot = &mut d_f[node.parent];
            let pushed = f[node.parent].inverse_rotate(on_parent);
            *slot = (slot.vec3() + node.at_parent.lift::<S>().cross(pushed)).into();
            let slot = &mut d_g[node.parent];
            let swept = turn(parent) * node.lever.lift();
            *slot = (slot.vec3() + swept.cross(on_parent)).into();
        }
        self.loads.add_torques(r, h, d_g);
        on_base
    }
}

impl ArticulatedBody {
    /// (31) $= p_x$, and the impulse of the weight with it, solved for $\Delta x$.
    #[inline(always)]
    fn eliminate_with<K: Kinds>(
        &self,
        work: &mut StepWorkspace,
        ((t, g, mu), h): ((f64, &Configuration, &Momentum), f64),
        f: &mut Configuration,
        c: &mut Velocity,
        out: &mut Derivatives<Configuration, f64>,
    ) {
        let step = self.step((t, h), g, (&f.0, &f.2), &mut work.expansion);
        self.displace::<K, f64>(step, &mut work.moved);
        let mut shift = step.shift;
        if self.floats::<K>() {
            let mut rest =
                mu.1[0].vec3() * h - self.turning_momentum::<K, f64>(step.r, &work.moved);
            if let Some(force) = self.loads.force::<f64>() {
                rest += force * (h * h);
            }
            shift = work.total_mass.solve(rest);
            (f.1[0], c.1[0]) = (shift.into(), shift.into());
        }
        let (moved, by_body) = (&mut work.moved, &mut work.by_body);
        self.collect::<K, f64>((t, g), step, (shift, h), moved, by_body, out);
    }

    /// What moves as told is at rest: the matrix of a step.
    #[inline(always)]
    fn solve_with<K: Kinds>(&self, work: &mut StepWorkspace, mu: &Momentum, xi: &mut Velocity) {
        let still = Drive::at_rest();
        work.inertia.begin::<K>(self, &work.r0, still, mu);
        work.inertia.finish::<K>(self, &work.r0, still, xi);
    }
}

impl DiscreteLagrangian for ArticulatedBody {
    type Workspace<S: Scalar> = StepWorkspace<S>;
    const HAS_INERTIA: bool = true;

    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Configuration<S>,
        f: &Configuration<S>,
        h: S,
    ) -> S {
        self.action(at.t, g, f, h)
    }

    /// (29)–(33) by recursion: displacements from the first body on, momenta back from the leaves.
    ///
    /// $ h\,d_{f_i} = (J^\prime_d F_i - F_i^T J^\prime_d)^\vee - d_{ip} \times F_i^T (M_i B_i + S_i) + \sum_k d_{ik} \times F_i^T C_k G_k$ and
    /// $ h\,d_{g_i} = M_i Y_i \times B_i + \sum_k E_i l_k \times C_k G_k$ with $G_i = M_i Y_i + S_i$, $S_i = \sum_k C_k G_k$.
    #[inline(always)]
    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Configuration<S>,
        f: &Configuration<S>,
        h: S,
        work: &mut StepWorkspace<S>,
        out: &mut Derivatives<Configuration, S>,
    ) {
        let step = self.step((at.t, h), g, (&f.0, &f.2), &mut work.expansion);
        self.displace::<Any, S>(step, &mut work.moved);
        let shift = (self.base_shift(step, f), h);
        let (moved, by_body) = (&mut work.moved, &mut work.by_body);
        self.collect::<Any, S>((at.t, g), step, shift, moved, by_body, out);
    }

    fn is_defined(&self, t: f64, _: &Configuration, _: &Still<Configuration>) -> bool {
        self.is_plain() || self.knows(t)
    }

    #[inline(always)]
    fn factorise(&self, (t, h): (f64, f64), g: &Configuration, work: &mut StepWorkspace) {
        let (r, pose) = self.pose(t, g, &mut work.expansion.now);
        work.r0 = r[0];
        match self.is_plain() {
            true => work.inertia.factorise::<Balls>(self, r, &pose.c),
            false => {
                work.inertia.resist(self, h);
                work.inertia.factorise::<Damped>(self, r, &pose.c);
            }
        }
        if self.is_free() {
            work.total_mass = self.total_mass(r).ldl();
        }
    }

    #[inline(always)]
    fn solve(&self, work: &mut StepWorkspace, mu: &Momentum, xi: &mut Velocity) {
        match self.is_plain() {
            true => self.solve_with::<Balls>(work, mu, xi),
            false => self.solve_with::<Damped>(work, mu, xi),
        }
    }

    fn solve_cyclic(&self, work: &mut StepWorkspace, mu: &Momentum, xi: &mut Velocity) {
        xi.0.fill(Vec3::zero().into());
        xi.2.fill(Tangent([0.0]));
        xi.1[0] = work.total_mass.solve(mu.1[0].vec3()).into();
    }

    /// The displacement $\Delta x$, under a weight too: its impulse is constant. With drag (31) is not linear.
    fn eliminated(&self) -> Range<usize> {
        match self.loads.forces.act_on_bodies() {
            true => 0..0,
            false => self.translation(),
        }
    }

    #[inline(always)]
    fn eliminate(
        &self,
        work: &mut StepWorkspace,
        (State { t, g, mu }, h): (&State<Configuration>, f64),
        f: &mut Configuration,
        c: &mut Velocity,
        out: &mut Derivatives<Configuration, f64>,
    ) {
        match self.is_plain() {
            true => self.eliminate_with::<Balls>(work, ((*t, g, mu), h), f, c, out),
            false => self.eliminate_with::<Damped>(work, ((*t, g, mu), h), f, c, out),
        }
    }
}
