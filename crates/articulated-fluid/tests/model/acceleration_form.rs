//! The Euler–Lagrange equations (14)–(17) against Hamilton's equations (18)–(20).
//!
//! Departures from the print of Lee, Leok & McClamroch (2009): (14) has $J_0$ for $J$ and (15) $\dot R_0 = R_0 \hat\Omega_0$.

use lie::{Jet, Mat3, Vec3, VectorSpace};
use proptest::prelude::*;

use crate::common::*;

/// The accelerations of (14), by a dense solve with (4).
fn accelerations(sample: &Sample) -> Vec<f64> {
    let (p, r) = (Paper::new(sample), matrices(&sample.g));
    let Paper { m, j, d_0, d } = &p;
    let t = r.map(Mat3::transpose);
    let (xi, v) = (&sample.xi, sample.xi.1[0].vec3());
    let omega = [0, 1, 2].map(|i| xi.0[i].vec3());
    let hat = omega.map(Vec3::hat);
    // (16) and (17).
    let joint = |i: usize| t[i] * v - t[i] * r[0] * d_0[i].hat() * omega[0];
    let centre = |i: usize| joint(i) + d[i].hat() * omega[i];
    let w = |i: usize| {
        (hat[i] * m[i] - m[i] * hat[i]) * joint(i)
            - m[i] * t[i] * r[0] * hat[0] * d_0[i].hat() * omega[0]
            + hat[i] * m[i] * d[i].hat() * omega[i]
    };
    let y = t[0] * v;
    let lever = |i: usize| d_0[i].hat() * t[0] * r[i] * w(i);
    let head = omega[0].cross(j[0] * omega[0]) + y.hat() * m[0] * y + lever(1) + lever(2);
    let linear = r[0] * (hat[0] * m[0] - m[0] * hat[0]) * y + r[1] * w(1) + r[2] * w(2);
    let tail = |i: usize| {
        omega[i].cross(j[i] * omega[i]) + centre(i).cross(m[i] * centre(i)) - d[i].hat() * w(i)
    };
    let forces = stacked([-head, -linear, -tail(1), -tail(2)]);
    solve(&p.inertia(r), &forces)
}

proptest! {
    #[test]
    fn both_forms_have_the_same_accelerations(sample in three_bodies()) {
        let (g, mu) = flow(&sample);
        let (xi, _) = velocity_and_force::<J>(&sample.model, &g, &mu);
        let along_the_flow: Vec<f64> = xi.coordinates().into_iter().map(|x| x.partial(0)).collect();
        // Rounding of forces up to 1e2 times the condition of the inertia.
        assert_close(&along_the_flow, &accelerations(&sample), 5e-12);
    }
}
