//! The formulas of Lee, Leok & McClamroch (2009) for three bodies, as printed, against the library.
//!
//! Departures from print: (22) is a one-sided rule, not the trapezoidal one; the second group of (36) has
//! $R_{0_{k+1}}$ on both sides of $M_0$; the last two terms of (40) have no factor $1/h$.

use articulated_fluid::Configuration;
use dvi::{Integrator, State, Variational};
use lie::{Mat3, Vec3, VectorSpace};
use proptest::prelude::*;

use crate::common::*;

/// One step in the paper's notation.
struct Step {
    p: Paper,
    r: [Mat3; 3],
    f: [Mat3; 3],
    dx: Vec3,
    jd: [Mat3; 3],
}

/// $\sum_{i=1}^2$.
fn sum(term: impl Fn(usize) -> Vec3) -> Vec3 {
    term(1) + term(2)
}

impl Step {
    fn new(sample: &Sample, g: &Configuration, f: &Configuration) -> Self {
        let p = Paper::new(sample);
        // (23) and (24).
        let nonstandard = |j: Mat3| Mat3::identity() * (0.5 * j.trace()) - j;
        let prime = |i: usize| p.j[i] - p.d[i].hat() * p.m[i] * p.d[i].hat();
        Self {
            jd: [p.j[0], prime(1), prime(2)].map(nonstandard),
            r: matrices(g),
            f: matrices(f),
            dx: f.1[0].vec3(),
            p,
        }
    }

    /// $F_i - I$.
    fn e(&self, i: usize) -> Mat3 {
        self.f[i] - Mat3::identity()
    }

    /// (27).
    fn a(&self, i: usize) -> Vec3 {
        let Self { p, r, .. } = self;
        r[i] * (p.m[i] * (r[i].transpose() * self.b(i) - self.e(i) * p.d[i]))
    }

    /// (28).
    fn b(&self, i: usize) -> Vec3 {
        self.dx + self.r[0] * (self.e(0) * self.p.d_0[i])
    }

    /// (22), times $h$.
    fn action(&self) -> f64 {
        let Self { p, r, f, dx, jd } = self;
        let (d_0, d, m, e0) = (&p.d_0, &p.d, &p.m, self.e(0));
        let trace = |i: usize| ((Mat3::identity() - f[i]) * jd[i]).trace();
        let head = dx.dot(r[0] * m[0] * r[0].transpose() * *dx) / 2.0 + trace(0);
        let tail = |i: usize| {
            let k = r[i] * m[i] * r[i].transpose();
            let back = e0.transpose() * r[0].transpose();
            dx.dot(k * *dx) / 2.0
                + trace(i)
                + d_0[i].dot(back * k * r[0] * e0 * d_0[i]) / 2.0
                + dx.dot(k * r[0] * e0 * d_0[i])
                - dx.dot(r[i] * m[i] * self.e(i) * d[i])
                - d_0[i].dot(back * r[i] * m[i] * self.e(i) * d[i])
        };
        head + tail(1) + tail(2)
    }

    /// $(J_d F - F^T J_d)^\vee$.
    fn rotation_after(&self, i: usize) -> Vec3 {
        (self.jd[i] * self.f[i] - self.f[i].transpose() * self.jd[i]).vee()
    }

    /// $(F J_d - J_d F^T)^\vee$.
    fn rotation_before(&self, i: usize) -> Vec3 {
        (self.f[i] * self.jd[i] - self.jd[i] * self.f[i].transpose()).vee()
    }

    /// $R_0 M_0 R_0^T \Delta x$.
    fn head_momentum(&self) -> Vec3 {
        self.r[0] * self.p.m[0] * self.r[0].transpose() * self.dx
    }

    /// $(M_0 R_0^T \Delta x)^\wedge R_0^T \Delta x$.
    fn head_moment(&self) -> Vec3 {
        let y = self.r[0].transpose() * self.dx;
        (self.p.m[0] * y).hat() * y
    }

    /// (29)–(31), times $h$.
    fn d_f(&self) -> [Vec3; 4] {
        let Self { p, r, f, .. } = self;
        let next = r[0] * f[0];
        let d_f0 = self.rotation_after(0) + sum(|i| p.d_0[i].hat() * next.transpose() * self.a(i));
        let d_dx = self.head_momentum() + self.a(1) + self.a(2);
        let d_fi = |i: usize| {
            let lever = p.d[i].hat() * f[i].transpose() * p.m[i] * r[i].transpose();
            self.rotation_after(i) - lever * self.b(i)
        };
        [d_f0, d_dx, d_fi(1), d_fi(2)]
    }

    /// (32) and (33), times $h$.
    fn d_g(&self) -> [Vec3; 4] {
        let Self { p, r, .. } = self;
        let lever = |i: usize| (self.e(0) * p.d_0[i]).hat();
        let d_r0 = self.head_moment() + sum(|i| lever(i) * r[0].transpose() * self.a(i));
        let d_ri = |i: usize| r[i].transpose() * self.a(i).hat() * self.b(i);
        [d_r0, Vec3::zero(), d_ri(1), d_ri(2)]
    }

    /// (39)–(41): $h \mu_k$.
    fn momentum_before(&self) -> [Vec3; 4] {
        let Self { p, r, f, .. } = self;
        let p0 = self.rotation_before(0) - self.head_moment()
            + sum(|i| p.d_0[i].hat() * r[0].transpose() * self.a(i));
        let px = self.head_momentum() + self.a(1) + self.a(2);
        let pi = |i: usize| {
            self.rotation_before(i)
                - (f[i] * p.d[i]).hat() * p.m[i] * r[i].transpose() * self.b(i)
                - r[i].transpose() * self.a(i).hat() * self.b(i)
        };
        [p0, px, pi(1), pi(2)]
    }

    /// (34)–(36): what vanishes between this step and the next.
    fn balance(&self, next: &Self) -> [Vec3; 4] {
        let Self { p, r, f, .. } = self;
        let back = next.r[0].transpose();
        let zeroth = self.rotation_after(0) - next.rotation_before(0)
            + next.head_moment()
            + sum(|i| p.d_0[i].hat() * back * (self.a(i) - next.a(i)));
        let linear = self.head_momentum() + self.a(1) + self.a(2)
            - next.head_momentum()
            - next.a(1)
            - next.a(2);
        let ith = |i: usize| {
            let lever = (next.f[i] * p.d[i]).hat() * p.m[i] * next.r[i].transpose();
            self.rotation_after(i)
                - next.rotation_before(i)
                - p.d[i].hat() * f[i].transpose() * p.m[i] * r[i].transpose() * self.b(i)
                + (lever + next.r[i].transpose() * next.a(i).hat()) * next.b(i)
        };
        [zeroth, linear, ith(1), ith(2)]
    }
}

/// A momentum times $h$.
fn times(mu: &Momentum, h: f64) -> Vec<f64> {
    mu.coordinates().into_iter().map(|p| h * p).collect()
}

proptest! {
    #[test]
    fn the_discrete_lagrangian_and_its_derivatives_are_the_printed_ones(sample in three_bodies()) {
        const H: f64 = 0.1;
        let Sample { model, g, f, .. } = &sample;
        let step = Step::new(&sample, g, f);
        // Rounding: the print subtracts numbers up to 1e2 from each other.
        let tolerance = 2e-13;
        let value = action(model, g, f, H);
        assert_close(&[H * value], &[step.action()], tolerance);
        let out = closed(model, g, f, H);
        assert_close(&times(&out.d_f, H), &stacked(step.d_f()), tolerance);
        assert_close(&times(&out.d_g, H), &stacked(step.d_g()), tolerance);
        let before = dvi::legendre_minus(model, 0.0, g, f, H);
        assert_close(&times(&before, H), &stacked(step.momentum_before()), tolerance);
    }

    #[test]
    fn a_step_solves_the_printed_equations(sample in three_bodies()) {
        const H: f64 = 0.01;
        let Sample { model, g, .. } = &sample;
        let start = State { t: 0.0, g: g.clone(), mu: sample.mu() };
        let mut integrator = Variational::new(model.clone());
        let f = integrator.displacement(&start, H).expect("a displacement");
        let mut end = start.clone();
        integrator.step(&mut end, H).expect("a step");
        let next_f = integrator.displacement(&end, H).expect("a displacement");
        let (step, next) = (Step::new(&sample, g, &f), Step::new(&sample, &end.g, &next_f));
        // The step's tolerance 1e-13 of momenta up to 1e2, times H, and the rounding of the print's differences.
        let tolerance = 2e-13;
        assert_close(&stacked(step.balance(&next)), &[0.0; 12], tolerance);
        // (37) and (38).
        for (next, (r, f)) in next.r.iter().zip(step.r.iter().zip(&step.f)) {
            assert_close(next.0.as_flattened(), (*r * *f).0.as_flattened(), 1e-15);
        }
        assert_close(&end.g.1[0].0, &(g.1[0].vec3() + step.dx).0, 1e-15);
        // (39)–(41), then (44)–(46).
        assert_close(&times(&start.mu, H), &stacked(step.momentum_before()), tolerance);
        let [p0, _, p1, p2] = step.d_f();
        let after = stacked([p0, start.mu.1[0].vec3() * H, p1, p2]);
        assert_close(&times(&end.mu, H), &after, tolerance);
    }
}
