//! The ellipsoid in a perfect fluid.

use articulated_fluid::Ellipsoid;
use dvi::{Integrator, Lagrangian, Quadrature, Variational};
use lie::{Exp, LieGroup, SE3, Tangent};
use study::baseline::on_group;
use study::problems::{Kirchhoff, Problem, ProblemError, Solution, Steady};

use super::{TIGHT, distance, measure};

fn ellipsoid(semi_axes: [f64; 3]) -> Kirchhoff {
    let body = Ellipsoid::new(semi_axes).expect("an ellipsoid");
    let density = 0.3;
    Kirchhoff::new(&body, body.neutral_mass(density), density).expect("a body")
}

fn pose() -> SE3 {
    SE3::exp(&Tangent([0.4, -1.1, 0.7, 0.3, 2.0, -1.0]))
}

fn steady(body: Kirchhoff, axis: usize, spin: f64) -> Problem<Kirchhoff, Steady<SE3>> {
    body.steady(pose(), axis, 0.8, spin).expect("a motion")
}

/// The third axis is the shortest: broadside on.
const AXES: [f64; 3] = [1.6, 1.0, 0.6];

#[test]
fn steady_motions_solve_the_equations() {
    for axis in 0..3 {
        for spin in [0.0, 1.5] {
            let problem = steady(ellipsoid(AXES), axis, spin);
            let measured = measure(&problem, 3.0);
            assert!(measured.conserved < 1e-13 && measured.equations < 1e-10);
            // Broadside on nothing grows; along the other axes rounding does.
            let limit = if axis == 2 { 1e-12 } else { 1e-8 };
            assert!(measured.reference < limit);
        }
    }
}

/// The rate at which the impulse along `j` grows about the translation along `axis`: it goes as $\cosh \lambda t$.
fn measured_rate(body: Kirchhoff, axis: usize, j: usize) -> f64 {
    const PERTURBATION: f64 = 1e-7;
    let (speed, mut start) = (0.8, steady(body, axis, 0.0).start);
    start.mu[3 + j] += PERTURBATION;
    let expected = body.growth_rate(axis, speed).expect("an axis");
    let times = [5.0, 6.0, 7.0].map(|foldings| foldings / expected);
    let states = on_group::sample(&body.hamiltonian(), &start, &times, TIGHT).expect("a reference");
    let rates = states
        .iter()
        .map(|state| (state.mu[3 + j] / PERTURBATION).abs().max(1.0).acosh() / state.t);
    rates.sum::<f64>() / 3.0
}

#[test]
fn instabilities_grow_at_the_linear_rate() {
    let body = ellipsoid(AXES);
    for axis in [0, 1] {
        let expected = body.growth_rate(axis, 0.8).expect("an axis");
        let others = (0..3).filter(|&j| j != axis);
        let measured = others
            .map(|j| measured_rate(body, axis, j))
            .fold(0.0, f64::max);
        println!("axis {axis}: growth rate {expected}, measured {measured}");
        // Second order leaves (1e-7 e^7)^2, the reference 1e-14 / 1e-7.
        assert!((measured / expected - 1.0).abs() < 1e-6);
    }
}

#[test]
fn broadside_on_is_stable() {
    let body = ellipsoid(AXES);
    assert_eq!(body.growth_rate(2, 0.8), Ok(0.0));
    let mut start = steady(body, 2, 0.0).start;
    start.mu[3] += 1e-7;
    let times: Vec<f64> = (1..=60).map(f64::from).collect();
    let states = on_group::sample(&body.hamiltonian(), &start, &times, TIGHT).expect("a reference");
    assert!(states.iter().all(|state| state.mu[3].abs() < 1.01e-7));
}

#[test]
fn the_unstable_are_all_but_the_heaviest() {
    let body = ellipsoid(AXES);
    let masses = body.masses();
    assert!(masses[0] < masses[1] && masses[1] < masses[2]);
    let rates = [0, 1, 2].map(|axis| body.growth_rate(axis, -2.0).expect("an axis"));
    assert!(rates[0] > 0.0 && rates[1] > 0.0 && rates[2] == 0.0);
    assert_eq!(
        body.growth_rate(5, 1.0),
        Err(ProblemError::NoSuchAxis { axis: 5 })
    );
    let round = steady(ellipsoid([1.0, 1.0, 0.5]), 2, 0.0);
    assert_eq!(round.symmetries.len(), 7);
}

/// Constant motions on SE(3) stay $g_0 \exp(t\xi)$: rotation and translation are one motion, not two.
#[test]
fn a_variational_integrator_keeps_constant_motions() {
    for (name, body) in [
        ("ball", ellipsoid([0.7; 3])),
        ("ellipsoid", ellipsoid(AXES)),
    ] {
        for spin in [0.0, 1.5] {
            let (problem, h) = (steady(body, 2, spin), 0.05);
            let mut state = problem.start.clone();
            let discrete = problem
                .lagrangian
                .discretise(Quadrature::Midpoint)
                .with_retraction::<Exp>();
            let mut integrator = Variational::new(discrete).with_tolerance(1e-15);
            let mut worst = 0.0_f64;
            for k in 1..=1000 {
                integrator.step(&mut state, h).expect("a step");
                let exact = problem.exact.at(h * f64::from(k)).expect("a state");
                worst = worst.max(distance(&state, &exact));
            }
            println!("{name}, spin {spin}: 1000 steps off by {worst:.1e}");
            // C eps sqrt(N) of a random walk of rotations, times the 40 m of the way.
            assert!(worst < 40.0 * 10.0 * f64::EPSILON * 1000.0_f64.sqrt());
        }
    }
}
