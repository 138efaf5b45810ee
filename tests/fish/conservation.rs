//! 100 s of the paper's scene at h = 1e-3: what must be exact, and what must stay bounded.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{Cause, Integrator, State, StepError, Variational};
use lgvi::{articulated_fluid, dvi};

use crate::by_duals::ByDuals;
use crate::common::paper;

const H: f64 = 1e-3;
const STEPS: u32 = 100_000;

/// The slope of the line through equally spaced values, per sample, by least squares.
fn slope(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let (mean_x, mean_y) = ((n - 1.0) / 2.0, values.iter().sum::<f64>() / n);
    let centred = values
        .iter()
        .enumerate()
        .map(|(i, y)| (i as f64 - mean_x, y - mean_y));
    let (xy, xx) = centred.fold((0.0, 0.0), |(xy, xx), (x, y)| (xy + x * y, xx + x * x));
    xy / xx
}

#[test]
fn a_hundred_seconds_of_the_paper() {
    let (model, start) = paper();
    let kept = model.conserved(&start).unwrap();
    let (mut state, mut integrator) = (start, Variational::new(model.clone()));
    let mut energies = vec![0.0];
    let (mut linear, mut angular, mut orthogonal) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut residual = 0.0_f64;
    for k in 1..=STEPS {
        let report = integrator.step(&mut state, H).unwrap();
        residual = residual.max(report.residual);
        if k % 100 == 0 {
            let now = model.conserved(&state).unwrap();
            energies.push(now.energy / kept.energy - 1.0);
            angular = angular.max((now.angular - kept.angular).norm());
            orthogonal = orthogonal.max(model.orthogonality_error(&state.g));
            linear = linear.max((now.linear - kept.linear).norm());
        }
        if k % 10_000 == 0 {
            the_equation_was_solved(&model, &state);
        }
    }
    let band = energies.iter().fold(0.0_f64, |max, e| max.max(e.abs()));
    let drift = slope(&energies) / (100.0 * H);
    println!(
        "orthogonality {orthogonal:.1e}, linear momentum {linear:.1e}, angular momentum {angular:.1e}, residual {residual:.1e}, energy {band:.2e}, slope {drift:.1e} /s"
    );
    assert!(orthogonal < 1e-13, "{orthogonal:e}");
    assert!(linear < 1e-13, "{linear:e}");
    assert!(angular < 1e-11, "{angular:e}");
    assert!(residual <= 1e-13, "{residual:e}");
    assert!(band < 6e-4, "{band:e}");
    assert!(drift.abs() < 1e-7, "{drift:e}");
}

/// The carried momentum says nothing about whether the step was solved: the derivatives of $L_d$ do.
fn the_equation_was_solved(model: &ArticulatedBody, state: &State<Configuration>) {
    let mut integrator = Variational::new(model.clone());
    let f = integrator.displacement(state, H).unwrap();
    let before = dvi::legendre_minus(model, state.t, &state.g, &f, H);
    let after = dvi::legendre_plus(model, state.t, &state.g, &f, H);
    let mut next = state.clone();
    integrator.step(&mut next, H).unwrap();
    let size = state.mu.0[0].vec3().norm();
    // D_{Delta x} L_d, whose value here is 1e-4 kg m/s, the sum of terms of the order of 1 kg m/s.
    let linear = (after.1[0].vec3() - state.mu.1[0].vec3()).norm();
    assert!(linear < 1e-13, "{linear:e}");
    for (carried, derived) in [(&next.mu, &after), (&state.mu, &before)] {
        let bodies = carried.0.iter().zip(derived.0.iter());
        let worst = bodies
            .map(|(a, b)| (a.vec3() - b.vec3()).norm())
            .fold(0.0, f64::max);
        // The solver's tolerance, 1e-13 of the whole momentum, which is a few times the head's.
        assert!(worst < 1e-12 * size, "{worst:e} of {size}");
    }
}

/// With a loose tolerance the momentum map still holds to rounding, and the residual says how loose the solution is.
#[test]
fn the_momentum_map_does_not_need_a_solved_step() {
    let (model, start) = paper();
    let kept = model.conserved(&start).unwrap();
    let mut loose = Variational::new(model.clone()).with_tolerance(1e-6);
    let (mut state, mut residual) = (start, 0.0_f64);
    for _ in 0..10_000 {
        residual = residual.max(loose.step(&mut state, H).unwrap().residual);
    }
    let now = model.conserved(&state).unwrap();
    let drift = (now.angular - kept.angular).norm() / kept.angular.norm();
    println!("residual {residual:.1e}, angular momentum {drift:.1e}");
    assert!(residual > 1e-10, "the tolerance was not used: {residual:e}");
    // A random walk of rounding, 10 eps sqrt(N).
    assert!(drift < 10.0 * f64::EPSILON * 100.0, "{drift:e}");
}

#[test]
fn a_step_too_long_is_refused_and_the_state_kept() {
    let (model, start) = paper();
    let (mut state, mut integrator) = (start.clone(), Variational::new(model));
    let error = integrator.step(&mut state, 5.0).unwrap_err();
    assert!(
        matches!(
            error,
            StepError {
                step: 0,
                h: 5.0,
                cause: Cause::NotConverged { .. },
                ..
            }
        ),
        "{error}"
    );
    assert_eq!(state, start);
    integrator.step(&mut state, H).unwrap();
}

/// A state with another number of bodies than the model, or than its own momentum, is an error and stays as it is.
#[test]
fn a_state_of_another_shape_is_refused() {
    let (model, start) = paper();
    let cut = |attitudes: usize, momenta: usize| {
        let mut state = start.clone();
        let factors = |n: usize| (0..n).map(move |i| i % 3);
        state.g.0 = factors(attitudes).map(|i| start.g.0[i]).collect();
        state.mu.0 = factors(momenta).map(|i| start.mu.0[i]).collect();
        state
    };
    for (attitudes, momenta) in [(3, 2), (3, 4), (2, 3), (2, 2), (1, 1), (0, 0), (4, 4)] {
        let integrators: [Box<dyn Integrator<Group = Configuration>>; 2] = [
            Box::new(Variational::new(model.clone())),
            Box::new(Variational::new(ByDuals(model.clone()))),
        ];
        for mut integrator in integrators {
            let mut state = cut(attitudes, momenta);
            let error = integrator.step(&mut state, H).unwrap_err();
            let named = matches!(error.cause, Cause::Shape { .. } | Cause::Misfit);
            assert!(named, "{attitudes} attitudes, {momenta} momenta: {error}");
            assert_eq!(state, cut(attitudes, momenta));
        }
    }
}
