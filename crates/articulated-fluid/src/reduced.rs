//! The inertia (4) reduced to the head: the tails are eliminated with constant inverses.
//!
//! A tail's momentum is $p_i = J'_i \Omega_i - \hat d_{i0} M_i u_i$ with the velocity of its joint in its own frame,
//! $u_i = R_i^T (\dot x - R_0 \hat d_{0i} \Omega_0)$. Solved for $\Omega_i$, its force on the joint is
//! $M_i V_i = M^\ast_i u_i + M_i \hat d_{i0} J'^{-1}_i p_i$ with a constant $M^\ast_i$: the head sees six unknowns.

use dvi::Inertia;
use lie::{Cotangent, Mat3, Power, SO3, Scalar, Tangent, Vec3};

use crate::{ArticulatedBody, Configuration};

/// The six by six system of the head, in the head's frame, factorised by 3×3 blocks.
///
/// With $v = R_0^T \dot x$: $\begin{pmatrix} A & -K \\ -K^T & H \end{pmatrix} \begin{pmatrix} v \\ \Omega_0 \end{pmatrix} = \begin{pmatrix} q \\ q_0 \end{pmatrix}$.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HeadSystem<S> {
    a_inverse: Mat3<S>,
    k: Mat3<S>,
    schur_inverse: Mat3<S>,
}

impl<S: Scalar> HeadSystem<S> {
    #[inline(always)]
    fn solve(&self, q: Vec3<S>, q0: Vec3<S>) -> (Vec3<S>, Vec3<S>) {
        let omega = self.schur_inverse * (q0 + self.k.transpose_mul(self.a_inverse * q));
        (self.a_inverse * (q + self.k * omega), omega)
    }
}

type Velocity<S> = (Tangent<3, S>, Tangent<3, S>, Power<Tangent<3, S>>);
type Momentum<S> = (Cotangent<3, S>, Cotangent<3, S>, Power<Cotangent<3, S>>);

impl ArticulatedBody {
    /// Fills the attitudes of the tails in the head's frame, $C_i = R_0^T R_i$, and factorises the head's system.
    #[inline(always)]
    pub(crate) fn head_system<S: Scalar>(
        &self,
        r0: &SO3<S>,
        r: &[SO3<S>],
        c: &mut [Mat3<S>],
    ) -> HeadSystem<S> {
        let mut a = self.head.m.lift::<S>();
        let (mut k, mut h) = (Mat3::zero(), self.head.j.lift::<S>());
        let back = r0.matrix().transpose();
        for ((tail, r), c) in self.tails.iter().zip(r).zip(c) {
            *c = back * *r.matrix();
            let n = c.conjugate(tail.m_joint.lift());
            let d = tail.on_head.lift::<S>().hat();
            let nd = n * d;
            a += n;
            k += nd;
            h -= d * nd;
        }
        let a_inverse = a.inverse();
        let schur = h - k.transpose() * (a_inverse * k);
        HeadSystem {
            a_inverse,
            k,
            schur_inverse: schur.inverse(),
        }
    }

    /// Solves $\mathbb I(g) \xi = \mu$; (10) inverted.
    #[inline(always)]
    pub(crate) fn solve_inertia<S: Scalar>(
        &self,
        r0: &SO3<S>,
        c: &[Mat3<S>],
        system: &HeadSystem<S>,
        mu: &Momentum<S>,
        xi: &mut Velocity<S>,
    ) {
        let (p0, px, p) = mu;
        let (mut q, mut q0) = (r0.inverse_rotate(px.vec3()), p0.vec3());
        for ((tail, c), p) in self.tails.iter().zip(c).zip(p.iter()) {
            let force = *c * (tail.recoil.lift::<S>() * p.vec3());
            q -= force;
            q0 -= tail.on_head.lift::<S>().cross(force);
        }
        let (v, omega0) = system.solve(q, q0);
        let tails = self.tails.iter().zip(c).zip(p.iter().zip(xi.2.iter_mut()));
        for ((tail, c), (p, xi)) in tails {
            let u = c.transpose_mul(v + omega0.cross(tail.on_head.lift()));
            let lever = tail.on_tail.lift::<S>().cross(tail.m.lift::<S>() * u);
            *xi = (tail.j_inverse.lift::<S>() * (p.vec3() + lever)).into();
        }
        xi.0 = omega0.into();
        xi.1 = r0.rotate(v).into();
    }
}

/// The inertia at a configuration, ready for solves; what a step's iteration uses as its matrix.
#[derive(Clone, Debug)]
pub struct Factor {
    r0: SO3,
    c: Vec<Mat3>,
    system: HeadSystem<f64>,
    /// $\left(M_0 + \sum_i C_i M_i C_i^T\right)^{-1}$: (31) solved for $R_0^T \Delta x$.
    total_mass_inverse: Mat3,
}

impl Inertia for ArticulatedBody {
    type Factor = Factor;

    fn factor(&self) -> Factor {
        let zero = Mat3::zero();
        Factor {
            r0: SO3::identity(),
            c: vec![zero; self.tails.len()],
            system: HeadSystem {
                a_inverse: zero,
                k: zero,
                schur_inverse: zero,
            },
            total_mass_inverse: zero,
        }
    }

    #[inline(always)]
    fn factorise(&self, g: &Configuration, factor: &mut Factor) {
        let (r0, _, r) = g;
        factor.r0 = *r0;
        factor.system = self.head_system(r0, r, &mut factor.c);
        let mut total = self.head.m;
        for (tail, c) in self.tails.iter().zip(&factor.c) {
            total += c.conjugate(tail.m);
        }
        factor.total_mass_inverse = total.inverse();
    }

    #[inline(always)]
    fn solve(&self, factor: &Factor, mu: &Momentum<f64>, xi: &mut Velocity<f64>) {
        self.solve_inertia(&factor.r0, &factor.c, &factor.system, mu, xi);
    }

    /// (31) $= p_x$, solved for $\Delta x$.
    #[inline(always)]
    fn eliminate(
        &self,
        factor: &Factor,
        mu: &Momentum<f64>,
        h: f64,
        f: &mut Configuration,
        c: &mut Velocity<f64>,
    ) {
        let (f0, dx, f) = f;
        let e0 = f0.minus_identity();
        let mut rest = factor.r0.inverse_rotate(mu.1.vec3()) * h;
        for ((tail, c), f) in self.tails.iter().zip(&factor.c).zip(f.iter()) {
            let moved = c.transpose_mul(e0 * tail.on_head) - f.minus_identity() * tail.on_tail;
            rest -= *c * (tail.m * moved);
        }
        let solved = factor.r0.rotate(factor.total_mass_inverse * rest);
        (*dx, c.1) = (solved.into(), solved.into());
    }
}
