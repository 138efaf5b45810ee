//! A step as the bodies see it: attitudes at its start, and the displacement of each, (S7).

use lie::{Cotangent, Mat3, Rn, SO3, Scalar, Vec3};

use crate::joints::{Any, Kinds, Role};
use crate::pose::Pose;
use crate::tree::{ArticulatedBody, Configuration, Momentum};

/// Storage for a step of a tree in which not every attitude is an unknown, or the base is held.
#[derive(Clone, Debug)]
pub(crate) struct Expansion<S> {
    pub(crate) now: Pose<S>,
    pub(crate) next: Pose<S>,
    /// $F_i$ and $F_i - I$.
    f: Vec<SO3<S>>,
    e: Vec<Mat3<S>>,
}

impl<S: Scalar> Default for Expansion<S> {
    fn default() -> Self {
        Self {
            now: Pose::default(),
            next: Pose::default(),
            f: Vec::new(),
            e: Vec::new(),
        }
    }
}

/// The turns and the hinge angles of a displacement.
pub(crate) type Turns<'a, S> = (&'a [SO3<S>], Angles<'a, S>);

/// The hinge angles of a displacement.
pub(crate) type Angles<'a, S> = &'a [Rn<1, S>];

/// A step as the bodies see it.
#[derive(Clone, Copy)]
pub(crate) struct Step<'a, S> {
    /// $R_i$ at the start.
    pub(crate) r: &'a [SO3<S>],
    /// $F_i = R_i^T R_{i+}$.
    pub(crate) f: &'a [SO3<S>],
    /// $F_i - I$ where it is known better than from $F_i$.
    e: &'a [Mat3<S>],
    pub(crate) now: &'a Pose<S>,
    next: &'a Pose<S>,
    /// By how much the place of a held base moves.
    pub(crate) shift: Vec3<S>,
}

impl<S: Scalar> Step<'_, S> {
    /// $F_i - I$.
    #[inline(always)]
    pub(crate) fn turn<K: Kinds>(&self, i: usize) -> Mat3<S> {
        match self.e.get(i).filter(|_| !K::ARE_BALLS) {
            Some(e) => *e,
            None => self.f[i].minus_identity(),
        }
    }
}

impl ArticulatedBody {
    /// The step of `h` from `t` as the bodies see it.
    #[inline(always)]
    pub(crate) fn step<'a, S: Scalar>(
        &self,
        (t, h): (S, S),
        g: &'a Configuration<S>,
        turns: Turns<'a, S>,
        work: &'a mut Expansion<S>,
    ) -> Step<'a, S> {
        if !self.is_simple() {
            self.expand((t, h), g, turns, work);
        }
        let Expansion {
            now,
            next,
            f: all,
            e,
        } = work;
        let (r, f, e) = match self.has_inner() {
            true => (&now.r[..], &all[..], &e[..]),
            false => (&g.0[..], turns.0, &[][..]),
        };
        Step {
            r,
            f,
            e,
            now,
            next,
            shift: next.place[0] - now.place[0],
        }
    }

    /// $F_i - I = C_i^T (F_p - I) C_{i+} + (C_i^T C_{i+} - I)$ outwards: nothing cancels.
    fn expand<S: Scalar>(
        &self,
        (t, h): (S, S),
        g: &Configuration<S>,
        (turns, angles): Turns<S>,
        work: &mut Expansion<S>,
    ) {
        let Expansion {
            now,
            next,
            f: all,
            e,
        } = work;
        self.pose(t, g, now);
        self.read_motions_at(t + h, next);
        if !self.has_inner() {
            return;
        }
        all.resize(self.nodes.len(), SO3::identity());
        e.resize(self.nodes.len(), Mat3::zero());
        for (i, node) in self.nodes.iter().enumerate() {
            if let Role::Ball(k) = node.role {
                (all[i], e[i]) = (turns[k], turns[k].minus_identity());
                continue;
            }
            let own = self.own_turn(i, (g, angles), [&mut *now, &mut *next]);
            e[i] = match i {
                0 => own,
                _ => {
                    let (c, c_next) = (*now.c[i].matrix(), *next.c[i].matrix());
                    c.transpose() * e[node.parent] * c_next + own
                }
            };
            all[i] = SO3::from_matrix_unchecked(Mat3::identity() + e[i]);
        }
    }

    /// The derivatives by what the joints leave free from those by the bodies, (S8)–(S9).
    ///
    /// With $n^-_i = (d_{g_i} - F_i d_{f_i}) + \sum_k C_k n^-_k$ and $n^+_i = d_{f_i} + \sum_k C_{k+} n^+_k$ a root has $n^+$ and $n^- + F n^+$, a hinge
    /// $s \cdot n^+$ and $s \cdot (n^- + n^+)$.
    #[inline(always)]
    pub(crate) fn gather_derivatives<S: Scalar>(
        &self,
        step: Step<S>,
        [n_plus, n_minus]: [&mut [Cotangent<3, S>]; 2],
        [d_f, d_g]: [&mut Momentum<S>; 2],
    ) {
        for ((minus, plus), f) in n_minus.iter_mut().zip(n_plus.iter()).zip(step.f) {
            *minus = (minus.vec3() - f.rotate(plus.vec3())).into();
        }
        for (i, node) in self.nodes.iter().enumerate().rev() {
            let (plus, minus) = (n_plus[i].vec3(), n_minus[i].vec3());
            // An attitude is moved at the start of the step, an angle at both ends alike.
            let at_start = match node.role.is_root() {
                true => step.f[i].rotate(plus),
                false => plus,
            };
            self.project::<Any, S>(i, minus + at_start, d_g);
            if self.project::<Any, S>(i, plus, d_f) {
                let parent = node.parent;
                let on_parent = step.next.c[i].rotate(plus);
                n_plus[parent] = (n_plus[parent].vec3() + on_parent).into();
                let on_parent = step.now.c[i].rotate(minus);
                n_minus[parent] = (n_minus[parent].vec3() + on_parent).into();
            }
        }
    }
}
