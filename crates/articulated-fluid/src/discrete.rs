//! The discrete Lagrangian (22) and its derivatives (29)–(33), for any number of tails.

use core::ops::Range;

use dvi::{Derivatives, DiscreteLagrangian};
use lie::{Mat3, SO3, Scalar, Vec3};

use crate::model::Tail;
use crate::{ArticulatedBody, Configuration};

impl ArticulatedBody {
    /// (22), with the displacement of the head $\Delta x$ in the reference frame.
    ///
    /// With $E = F - I$, $B_i$ of (28) and $\mathrm{tr}[(I - F) J_d] = -\mathrm{tr}[E J_d]$.
    pub(crate) fn action<S: Scalar>(
        &self,
        (r0, r): (&SO3<S>, &[SO3<S>]),
        (f0, dx, f): (&SO3<S>, Vec3<S>, &[SO3<S>]),
        h: S,
    ) -> S {
        let (y, e0) = (r0.inverse_rotate(dx), f0.displacement());
        let mut sum = y.dot(self.head.m.apply(y)).times(0.5) - e0.trace_with(self.head.jd);
        for ((tail, r), f) in self.tails.iter().zip(r).zip(f) {
            let (e, joint) = (f.displacement(), e0.apply(tail.on_head.lift()));
            let b = r.inverse_rotate(dx + r0.rotate(joint));
            let mb = tail.m.apply(b);
            sum += b.dot(mb).times(0.5) - mb.dot(e.apply(tail.on_tail.lift()));
            sum -= e.trace_with(tail.jd);
        }
        sum / h
    }
}

/// $\left(J_d F - F^T J_d\right)^\vee$ from $E = F - I$: the identity cancels.
#[inline(always)]
fn rotation_momentum<S: Scalar>(jd: Mat3, e: Mat3<S>) -> Vec3<S> {
    (jd.lift::<S>() * e).skew_vee()
}

/// What one tail gives to the derivatives, each times $h$.
struct TailTerms<S> {
    /// $R_0^T A_i$ with (27).
    a: Vec3<S>,
    /// (30).
    d_f: Vec3<S>,
    /// (33).
    d_g: Vec3<S>,
}

impl Tail {
    /// (27), (30) and (33), from $b_0 = R_0^T B_i$.
    #[inline(always)]
    fn terms<S: Scalar>(&self, r0: &SO3<S>, r: &SO3<S>, f: &SO3<S>, b0: Vec3<S>) -> TailTerms<S> {
        let (m, d) = (self.m.lift::<S>(), self.on_tail.lift::<S>());
        let e = f.minus_identity();
        let b = r.inverse_rotate(r0.rotate(b0));
        let mb = m * b;
        let a = mb - m * (e * d);
        TailTerms {
            a: r0.inverse_rotate(r.rotate(a)),
            d_f: rotation_momentum(self.jd, e) - d.cross(f.inverse_rotate(mb)),
            d_g: a.cross(b),
        }
    }
}

impl DiscreteLagrangian for ArticulatedBody {
    type Group = Configuration;

    fn value<S: Scalar>(&self, g: &Configuration<S>, f: &Configuration<S>, h: S) -> S {
        self.action((&g.0, &g.2), (&f.0, f.1.vec3(), &f.2), h)
    }

    #[inline(always)]
    fn derivatives<S: Scalar>(
        &self,
        _t: S,
        g: &Configuration<S>,
        f: &Configuration<S>,
        h: S,
        out: &mut Derivatives<Configuration, S>,
    ) {
        let ((r0, _, r), (f0, dx, f)) = (g, f);
        let inverse_h = S::one() / h;
        let (y, e0) = (r0.inverse_rotate(dx.vec3()), f0.minus_identity());
        let m0y = self.head.m.lift::<S>() * y;
        // The sums of (29), (31) and (32), in the head's frame.
        let mut d_f0 = Vec3::zero();
        let mut d_dx = m0y;
        let mut d_r0 = m0y.cross(y);
        let (_, _, d_f) = &mut out.d_f;
        let (_, _, d_g) = &mut out.d_g;
        let outputs = d_f.iter_mut().zip(d_g.iter_mut());
        let inputs = self.tails.iter().zip(r.iter()).zip(f.iter());
        for (((tail, r), f), (d_f, d_g)) in inputs.zip(outputs) {
            let d0 = tail.on_head.lift::<S>();
            let e0d0 = e0 * d0;
            let terms = tail.terms(r0, r, f, y + e0d0);
            d_f0 += d0.cross(f0.inverse_rotate(terms.a));
            d_dx += terms.a;
            d_r0 += e0d0.cross(terms.a);
            *d_f = (terms.d_f * inverse_h).into();
            *d_g = (terms.d_g * inverse_h).into();
        }
        let d_f0 = rotation_momentum(self.head.jd, e0) + d_f0;
        out.d_f.0 = (d_f0 * inverse_h).into();
        out.d_f.1 = (r0.rotate(d_dx) * inverse_h).into();
        out.d_g.0 = (d_r0 * inverse_h).into();
        out.d_g.1 = Vec3::zero().into();
    }

    /// The head's displacement $\Delta x$: (31) is linear in it, and $x$ enters nowhere.
    fn cyclic(&self) -> Range<usize> {
        3..6
    }

    fn fits(&self, g: &Configuration) -> bool {
        g.2.len() == self.tails.len()
    }
}
