//! Lagrange's top.

use std::f64::consts::PI;

use dvi::Lagrangian;
use lie::{LieGroup, SO3, Tangent};
use study::baseline::on_group;
use study::problems::{HeavyTop, Nutation, Problem, ProblemError, Solution};

use super::{TIGHT, distance, measure};

const TOP: [f64; 3] = [1.0, 0.6, 1.4];

fn top(tilt: f64, omega: [f64; 3]) -> Problem<HeavyTop, Nutation> {
    let [a, c, w] = TOP;
    let turn = |axis: [f64; 3]| SO3::exp(&Tangent(axis));
    let attitude = turn([0.0, 0.0, 0.8])
        .compose(&turn([0.0, tilt, 0.0]))
        .compose(&turn([0.0, 0.0, -2.1]));
    let top = HeavyTop::new(a, c, w).expect("a top");
    top.problem(attitude, omega).expect("a tilted top")
}

/// Cusps, loops, waves, a slow top that falls far, a hanging one.
fn tops() -> Vec<Problem<HeavyTop, Nutation>> {
    vec![
        top(0.7, [0.0, 0.0, 6.0]),
        top(0.7, [0.5, -0.3, 6.0]),
        top(0.7, [-0.9, 1.0, -9.0]),
        top(1.2, [0.2, 0.1, 1.0]),
        top(2.6, [0.6, -0.2, 0.3]),
    ]
}

#[test]
fn the_solution_is_the_motion() {
    for problem in tops() {
        let measured = measure(&problem, 5.0);
        assert!(measured.reference < 1e-11);
        assert!(measured.conserved < 1e-12);
        assert!(measured.equations < 1e-9);
    }
}

#[test]
fn a_hundred_nutations() {
    let problem = top(0.7, [0.5, -0.3, 6.0]);
    let t = 100.0 * problem.time;
    let end = problem.exact.at(t).expect("a state");
    let reference =
        on_group::integrate(&problem.lagrangian.hamiltonian(), &problem.start, t, TIGHT)
            .expect("a reference");
    let error = distance(&end, &reference);
    println!("100 nutations: reference {error:.1e}");
    assert!(error < 2e-10);
}

/// $\dot u^2$ and $\dot\varphi$ of the height $u$, and the sum of the roots, from the energy and the momenta.
struct Reduced {
    energy: f64,
    momentum: f64,
    spin: f64,
}

impl Reduced {
    fn new(problem: &Problem<HeavyTop, Nutation>) -> Self {
        let (energy, spin) = (problem.energy(&problem.start), problem.start.mu[2]);
        Self {
            energy: energy - spin * spin / (2.0 * TOP[1]),
            momentum: problem.momenta(&problem.start)[0],
            spin,
        }
    }

    fn climb_squared(&self, u: f64) -> f64 {
        let [a, _, w] = TOP;
        (1.0 - u * u) * 2.0 * (self.energy - w * u) / a
            - ((self.momentum - self.spin * u) / a).powi(2)
    }

    fn precession(&self, u: f64) -> f64 {
        (self.momentum - self.spin * u) / (TOP[0] * (1.0 - u * u))
    }

    fn sum_of_roots(&self) -> f64 {
        (2.0 * self.energy + self.spin * self.spin / TOP[0]) / (2.0 * TOP[2])
    }

    /// The zero of $\dot u^2$ between `outside`, where it is negative, and `inside`.
    fn turning_point(&self, mut outside: f64, mut inside: f64) -> f64 {
        for _ in 0..200 {
            let middle = 0.5 * (outside + inside);
            let out = self.climb_squared(middle) < 0.0;
            *(if out { &mut outside } else { &mut inside }) = middle;
        }
        0.5 * (outside + inside)
    }

    /// Period and precession of a nutation, by the midpoint rule in $s$ with $u = \frac12(u_1 + u_2) - \frac12 (u_2 - u_1) \cos s$:
    /// the integrands are smooth and periodic, the rule converges exponentially.
    fn nutation(&self, [lowest, highest]: [f64; 2]) -> [f64; 2] {
        const POINTS: u32 = 400;
        let outer = self.sum_of_roots() - lowest - highest;
        let ds = PI / f64::from(POINTS);
        let mut sums = [0.0; 2];
        for k in 0..POINTS {
            let cos = (ds * (f64::from(k) + 0.5)).cos();
            let u = 0.5 * (lowest + highest) - 0.5 * (highest - lowest) * cos;
            let dt = 2.0 * ds / (2.0 * TOP[2] / TOP[0] * (outer - u)).sqrt();
            sums[0] += dt;
            sums[1] += dt * self.precession(u);
        }
        sums
    }
}

#[test]
fn heights_period_and_precession_by_direct_quadrature() {
    for problem in tops() {
        let (reduced, [lowest, highest]) = (Reduced::new(&problem), problem.exact.heights());
        let middle = 0.5 * (lowest + highest);
        let found = [-1.0, 1.0].map(|end| reduced.turning_point(end, middle));
        for (found, height) in found.into_iter().zip([lowest, highest]) {
            assert!((found - height).abs() < 1e-13, "{found} {height}");
        }
        let [period, turned] = reduced.nutation(found);
        let errors = [
            (problem.exact.period() / period - 1.0).abs(),
            (problem.exact.mean_precession_rate() * period / turned - 1.0).abs(),
        ];
        println!("period, mean precession rate: {errors:?}");
        assert!(errors.into_iter().all(|error| error < 1e-12));
    }
}

#[test]
fn a_fast_top_precesses_at_weight_over_spin() {
    let error = |spin: f64| {
        let problem = top(0.7, [0.0, 0.0, spin]);
        let rate = TOP[2] / (TOP[1] * spin);
        (problem.exact.mean_precession_rate() / rate - 1.0).abs()
    };
    let errors = [error(100.0), error(1000.0)];
    println!("fast top: {errors:?}");
    // The limit is reached as the inverse square of the spin.
    assert!(errors[0] < 1e-3 && (errors[0] / errors[1] - 100.0).abs() < 5.0);
}

#[test]
fn steady_precession_has_no_nutation() {
    // A cos(theta) w^2 - C Omega_3 w + W = 0, with the body's velocity w (R^T e_3) + (Omega_3 - w cos(theta)) e_3.
    let ([a, c, w], tilt, spin) = (TOP, 0.7_f64, 6.0);
    let (l, root) = (
        c * spin,
        ((c * spin).powi(2) - 4.0 * a * tilt.cos() * w).sqrt(),
    );
    for rate in [
        (l - root) / (2.0 * a * tilt.cos()),
        (l + root) / (2.0 * a * tilt.cos()),
    ] {
        let vertical = top(tilt, [0.0, 0.0, spin]).start.g.matrix().row(2);
        let problem = top(tilt, [rate * vertical[0], rate * vertical[1], spin]);
        let [lowest, highest] = problem.exact.heights();
        println!("steady precession: nutation {:.1e}", highest - lowest);
        assert!(highest - lowest < 1e-14);
        assert!((problem.exact.mean_precession_rate() / rate - 1.0).abs() < 1e-14);
        assert!(measure(&problem, 5.0).reference < 1e-11);
    }
}

#[test]
fn the_vertical_is_refused() {
    let [a, c, w] = TOP;
    let top = HeavyTop::new(a, c, w).expect("a top");
    let upright = top.problem(SO3::identity(), [0.1, 0.0, 5.0]);
    assert!(matches!(upright, Err(ProblemError::Vertical { .. })));
    assert!(HeavyTop::new(a, c, 0.0).is_err());
}
