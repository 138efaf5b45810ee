//! The Runge–Kutta baseline against exact solutions, and what it refuses.

use allocation_counter::measure;
use dvi::{Cause, Integrator};
use study::baseline::{
    self, BaselineError, Motion, Pair, RungeKutta, Samples, Tableau, Tolerance, Trajectory,
    integrate,
};

use crate::common::paper;

const PAIRS: [&Pair; 2] = [&Pair::DP54, &Pair::DP853];

fn oscillator(_t: f64, y: &[f64], dy: &mut [f64]) {
    dy[0] = y[1];
    dy[1] = -y[0];
}

fn oscillate(pair: &'static Pair, until: f64, every: f64, tolerance: f64) -> Samples {
    let tolerance = Tolerance::uniform(tolerance);
    integrate(pair, oscillator, &[1.0, 0.0], until, every, tolerance).expect("an oscillator")
}

fn worst(run: &Samples, exact: impl Fn(f64) -> Vec<f64>) -> f64 {
    let errors = run.t.iter().zip(&run.y).flat_map(|(&t, y)| {
        let exact = exact(t);
        y.iter()
            .zip(exact)
            .map(|(a, b)| (a - b).abs())
            .collect::<Vec<_>>()
    });
    errors.fold(0.0, f64::max)
}

fn cosine(t: f64) -> Vec<f64> {
    vec![t.cos(), -t.sin()]
}

/// Jacobi's sn, cn and dn by the descending arithmetic-geometric mean.
fn jacobi(u: f64, m: f64) -> [f64; 3] {
    let (mut a, mut b) = (1.0_f64, (1.0 - m).sqrt());
    let mut ratios = Vec::new();
    while (a - b).abs() > 1e-16 && ratios.len() < 8 {
        let (mean, half) = ((a + b) / 2.0, (a - b) / 2.0);
        b = (a * b).sqrt();
        a = mean;
        ratios.push(half / mean);
    }
    let mut phi = a * u * f64::from(1 << ratios.len());
    for ratio in ratios.iter().rev() {
        phi = (phi + (ratio * phi.sin()).asin()) / 2.0;
    }
    let (sn, cn) = phi.sin_cos();
    [sn, cn, (1.0 - m * sn * sn).sqrt()]
}

/// Free rigid body with inertia (1, 2, 3), started at ω = (1, 0, 1).
fn body(_t: f64, w: &[f64], dw: &mut [f64]) {
    dw[0] = -w[1] * w[2];
    dw[1] = w[2] * w[0];
    dw[2] = -w[0] * w[1] / 3.0;
}

/// Its exact motion (Landau and Lifshitz, § 37).
fn body_exact(t: f64) -> Vec<f64> {
    let [sn, cn, dn] = jacobi(t, 1.0 / 3.0);
    vec![cn, sn, dn]
}

#[test]
fn jacobi_solves_the_rigid_body() {
    for k in 0..40 {
        let (t, h) = (0.37 * f64::from(k), 1e-5);
        let (a, b) = (body_exact(t - h), body_exact(t + h));
        let mut rate = [0.0; 3];
        body(t, &body_exact(t), &mut rate);
        for i in 0..3 {
            assert!(((b[i] - a[i]) / (2.0 * h) - rate[i]).abs() < 1e-9);
        }
    }
}

#[test]
fn a_tight_tolerance_is_a_reference() {
    let error = worst(&oscillate(&Pair::DP853, 100.0, 0.0137, 1e-13), cosine);
    assert!(error < 4e-12, "oscillator {error:e}");

    let tolerance = Tolerance::uniform(1e-13);
    let run = integrate(
        &Pair::DP853,
        body,
        &[1.0, 0.0, 1.0],
        100.0,
        0.0137,
        tolerance,
    )
    .expect("a rigid body");
    let error = worst(&run, body_exact);
    assert!(error < 4e-12, "rigid body {error:e}");
}

#[test]
fn the_error_follows_the_tolerance() {
    for pair in PAIRS {
        let mut last = f64::INFINITY;
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let error = worst(&oscillate(pair, 20.0, 0.1, tolerance), cosine);
            assert!(error < 100.0 * tolerance, "{pair} {tolerance:e}: {error:e}");
            assert!(error < last / 20.0, "{pair} {tolerance:e}: {error:e}");
            last = error;
        }
    }
}

#[test]
fn the_right_hand_side_may_depend_on_time() {
    // Two phases: the error estimate of a single component passes through zero.
    let forced = |t: f64, y: &[f64], dy: &mut [f64]| {
        dy[0] = -y[0] * t.cos();
        dy[1] = -y[1] * (t + 1.0).cos();
    };
    let exact = |t: f64| [t, t + 1.0].map(|phase| (-phase.sin()).exp()).to_vec();
    let solve = |pair, tolerance| {
        let tolerance = Tolerance::uniform(tolerance);
        integrate(pair, forced, &exact(0.0), 200.0, 0.3, tolerance).expect("a motion")
    };
    for (pair, order) in PAIRS.into_iter().zip([5.0, 8.0]) {
        let steps = [1e-8, 1e-11].map(|tolerance| {
            let run = solve(pair, tolerance);
            let error = worst(&run, exact);
            assert!(error < 100.0 * tolerance, "{pair} {tolerance:e}: {error:e}");
            run.work.accepted as f64
        });
        let slope = 1e3_f64.log10() / (steps[1] / steps[0]).log10();
        assert!((slope - order).abs() < 0.5, "{pair}: {slope}");
    }
}

#[test]
fn the_number_of_steps_shows_the_order() {
    for (pair, order) in PAIRS.into_iter().zip([5.0, 8.0]) {
        let steps = |tolerance| oscillate(pair, 200.0, 200.0, tolerance).work.accepted as f64;
        let slope = 1e3_f64.log10() / (steps(1e-11) / steps(1e-8)).log10();
        assert!((slope - order).abs() < 0.3, "{pair}: {slope}");
    }
}

#[test]
fn samples_between_steps_are_as_exact_as_steps() {
    for pair in PAIRS {
        let tolerance = 1e-10;
        // One long step: where an interpolant would be at its worst.
        let run = oscillate(pair, 0.5, 0.003, tolerance);
        let error = worst(&run, cosine);
        assert!(error < 5.0 * tolerance, "{pair}: {error:e}");
    }
}

#[test]
fn sampling_does_not_change_the_steps() {
    for pair in PAIRS {
        let (coarse, fine) = (
            oscillate(pair, 30.0, 30.0, 1e-8),
            oscillate(pair, 30.0, 0.01, 1e-8),
        );
        assert_eq!(coarse.y.last(), fine.y.last());
        assert_eq!(coarse.work.evaluations, fine.work.evaluations);
        assert_eq!(coarse.work.accepted, fine.work.accepted);
        assert_eq!(coarse.work.sampling_evaluations, 0);
        assert!(fine.work.sampling_evaluations > 0);
    }
}

#[test]
fn the_grid_is_exact() {
    for pair in PAIRS {
        let run = oscillate(pair, 1.0, 0.3, 1e-6);
        assert_eq!(run.t, [0.0, 0.3, 0.6, 0.3 * 3.0, 1.0]);
        assert_eq!(run.y[0], [1.0, 0.0]);
        assert_eq!(run.y.len(), run.t.len());

        let run = oscillate(pair, 0.3, 0.1, 1e-6);
        assert_eq!(run.t, [0.0, 0.1, 0.2, 0.3]);

        let run = oscillate(pair, 50.0, 0.001, 1e-9);
        assert_eq!(run.t.len(), 50_001);
        assert!(run.t.windows(2).all(|w| w[0] < w[1]));
        assert_eq!(run.t[33_333], 0.001 * 33_333.0);
    }
}

#[test]
fn rounding_makes_no_twin_of_the_end() {
    let times = |until, every| oscillate(&Pair::DP853, until, every, 1e-3).t;
    assert_eq!(times(1.0, 0.25), [0.0, 0.25, 0.5, 0.75, 1.0]);
    assert_eq!(times(1.0, 0.4), [0.0, 0.4, 0.8, 1.0]);
    assert_eq!(times(1.0, 7.0), [0.0, 1.0]);
    for n in (1..2000).step_by(7) {
        let every = 0.1;
        assert_eq!(times(every * f64::from(n), every).len(), n as usize + 1);
        assert_eq!(times(f64::from(n) / 10.0, every).len(), n as usize + 1);
    }
}

#[test]
fn every_call_is_counted() {
    for pair in PAIRS {
        let mut calls = 0;
        let rhs = |t: f64, y: &[f64], dy: &mut [f64]| {
            calls += 1;
            oscillator(t, y, dy);
        };
        let run = integrate(pair, rhs, &[1.0, 0.0], 10.0, 0.1, Tolerance::uniform(1e-6)).unwrap();
        assert_eq!(calls, run.work.evaluations + run.work.sampling_evaluations);
        assert!(run.work.evaluations >= 6 * run.work.accepted);
    }
}

#[test]
fn more_steps_than_the_stepper_takes_in_one_go() {
    let run = oscillate(&Pair::DP54, 2000.0, 100.0, 1e-13);
    assert!(run.work.accepted > 150_000, "{}", run.work.accepted);
    let error = worst(&run, cosine);
    assert!(error < 1e-9, "{error:e}");
}

#[test]
fn a_stiff_problem_is_slow_but_done() {
    let rhs = |t: f64, y: &[f64], dy: &mut [f64]| dy[0] = -2000.0 * (y[0] - t.cos());
    for pair in PAIRS {
        let run = integrate(pair, rhs, &[1.0], 20.0, 1.0, Tolerance::uniform(1e-6)).unwrap();
        assert!(run.work.accepted > 5000);
        assert!((run.y[20][0] - 20.0_f64.cos()).abs() < 1e-2);
    }
}

#[test]
fn rest_stays_at_rest() {
    for pair in PAIRS {
        let still = |_t: f64, _y: &[f64], dy: &mut [f64]| dy.fill(0.0);
        let run = integrate(pair, still, &[0.0, 2.0], 5.0, 0.5, Tolerance::uniform(1e-9)).unwrap();
        assert!(run.y.iter().all(|y| y[..] == [0.0, 2.0]));
    }
}

#[test]
fn inputs_out_of_range_are_named() {
    let run = |y0: &[f64], until, every, relative, absolute| {
        let tolerance = Tolerance { relative, absolute };
        integrate(&Pair::DP54, oscillator, y0, until, every, tolerance)
            .expect_err("an input out of range")
    };
    let y0 = [1.0, 0.0];
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let is_tolerance = |e| matches!(e, BaselineError::Tolerance { .. });
        assert!(is_tolerance(run(&y0, 1.0, 0.1, bad, 1e-9)));
        assert!(is_tolerance(run(&y0, 1.0, 0.1, 1e-9, bad)));
        assert!(matches!(
            run(&y0, bad, 0.1, 1e-9, 1e-9),
            BaselineError::Until { .. }
        ));
        assert!(matches!(
            run(&y0, 1.0, bad, 1e-9, 1e-9),
            BaselineError::Every { .. }
        ));
    }
    assert_eq!(run(&[], 1.0, 0.1, 1e-9, 1e-9), BaselineError::EmptyState);
    assert!(matches!(
        run(&[1.0, f64::NAN], 1.0, 0.1, 1e-9, 1e-9),
        BaselineError::InitialState { index: 1, .. }
    ));
    for every in [1e-12, 1e-300] {
        assert!(matches!(
            run(&y0, 1.0, every, 1e-9, 1e-9),
            BaselineError::TooManySamples { .. }
        ));
    }
}

#[test]
fn a_right_hand_side_that_stays_nan_is_an_error() {
    for pair in PAIRS {
        let never = |_t: f64, _y: &[f64], dy: &mut [f64]| dy[0] = f64::NAN;
        let error = integrate(pair, never, &[1.0], 1.0, 0.1, Tolerance::uniform(1e-9));
        assert_eq!(error, Err(BaselineError::NonFiniteRhs { t: 0.0 }));

        let later = |t: f64, _y: &[f64], dy: &mut [f64]| dy[0] = (0.5 - t).sqrt();
        match integrate(pair, later, &[1.0], 1.0, 0.1, Tolerance::uniform(1e-9)) {
            Err(BaselineError::NonFiniteRhs { t }) => assert!((t - 0.5).abs() < 1e-6, "{t}"),
            other => panic!("{pair}: {other:?}"),
        }

        let forgets = |_t: f64, y: &[f64], dy: &mut [f64]| dy[0] = y[0];
        let error = integrate(
            pair,
            forgets,
            &[1.0, 2.0],
            1.0,
            0.1,
            Tolerance::uniform(1e-9),
        );
        assert!(matches!(error, Err(BaselineError::NonFiniteRhs { .. })));
    }
}

#[test]
fn a_trial_step_out_of_the_domain_is_only_shortened() {
    // y = (1 - t/2)², defined for y ≥ 0 only.
    let rhs = |_t: f64, y: &[f64], dy: &mut [f64]| dy[0] = -y[0].sqrt();
    for pair in PAIRS {
        let run = integrate(pair, rhs, &[1.0], 1.99, 0.1, Tolerance::uniform(1e-10)).unwrap();
        let error = worst(&run, |t| vec![(1.0 - t / 2.0).powi(2)]);
        assert!(error < 1e-8, "{pair}: {error:e}");
    }
}

#[test]
fn a_solution_that_ends_is_an_error_there() {
    for pair in PAIRS {
        let square = |_t: f64, y: &[f64], dy: &mut [f64]| dy[0] = y[0] * y[0];
        match integrate(pair, square, &[1.0], 2.0, 0.1, Tolerance::uniform(1e-9)) {
            Err(
                BaselineError::StepUnderflow { t }
                | BaselineError::NonFiniteRhs { t }
                | BaselineError::NonFiniteState { t },
            ) => assert!((t - 1.0).abs() < 1e-6, "{t}"),
            other => panic!("{pair}: {other:?}"),
        }
        let grow = |_t: f64, y: &[f64], dy: &mut [f64]| dy[0] = y[0];
        let error = integrate(pair, grow, &[1.0], 1000.0, 1.0, Tolerance::uniform(1e-6));
        match error {
            Err(
                BaselineError::NonFiniteState { t }
                | BaselineError::NonFiniteRhs { t }
                | BaselineError::StepUnderflow { t },
            ) => {
                assert!(t > 600.0, "{t}");
            }
            other => panic!("{pair}: {other:?}"),
        }
    }
}

type Oscillator = fn(f64, &[f64], &mut [f64]);

fn trajectory(pair: &'static Pair, (from, until): (f64, f64)) -> Trajectory<Oscillator> {
    let (start, tolerance) = ((from, cosine(from)), Tolerance::uniform(1e-10));
    let rhs = oscillator as Oscillator;
    Trajectory::new(pair, rhs, (start.0, &start.1), until, tolerance).expect("a start")
}

#[test]
fn a_state_is_found_when_it_is_asked_for() {
    for pair in PAIRS {
        let mut motion = trajectory(pair, (-3.0, 7.0));
        assert_eq!(motion.reached(), (-3.0, &cosine(-3.0)[..]));
        for t in [-3.0, -2.9, -2.9, 0.0, 0.001, 5.0, 7.0] {
            let error = (motion.at(t).expect("a state")[0] - t.cos()).abs();
            assert!(error < 1e-8, "{pair}, t = {t}: {error:e}");
        }
        assert_eq!(motion.reached().0, 7.0);
        let whole = motion.work();
        motion.step().expect("nothing");
        assert_eq!(motion.work(), whole);
    }
}

#[test]
fn a_time_that_is_past_or_beyond_the_end_is_refused() {
    for pair in PAIRS {
        let mut motion = trajectory(pair, (0.0, 20.0));
        for t in [-1.0, 20.1, f64::NAN, f64::INFINITY] {
            let refused = motion.at(t).expect_err("no state");
            assert!(matches!(refused, BaselineError::Time { .. }), "{refused}");
        }
        motion.at(19.0).expect("a state");
        let refused = motion.at(1.0).expect_err("a step that is over");
        assert!(matches!(refused, BaselineError::Time { t: 1.0, .. }));
        assert!((motion.at(20.0).expect("an end")[0] - 20.0_f64.cos()).abs() < 1e-7);
    }
}

#[test]
fn what_was_reached_stays_after_a_failure() {
    for pair in PAIRS {
        let ends = |t: f64, _: &[f64], dy: &mut [f64]| dy[0] = (0.5 - t).sqrt();
        let start = (0.0, [1.0].as_slice());
        let mut motion: Trajectory<_> =
            Trajectory::new(pair, ends, start, 1.0, Tolerance::uniform(1e-9)).expect("a start");
        let before = motion.at(0.25).expect("a state")[0];
        let refused = motion.at(0.75).expect_err("no state");
        assert!(matches!(refused, BaselineError::NonFiniteRhs { .. }));
        let (t, y) = motion.reached();
        let (t, y) = (t, y[0]);
        assert!(
            t > 0.25 && t <= 0.5 && y.is_finite() && y > before,
            "{t}: {y}"
        );
        assert_eq!(motion.at(t).expect("a state")[0], y);
        let past = motion.at(t - 1e-3).expect_err("no state any more");
        assert!(matches!(past, BaselineError::Time { .. }), "{past}");
        motion.at(1.0).expect_err("no state either");
        assert_eq!(motion.reached().1, [y]);
    }
}

#[test]
fn a_refused_step_leaves_the_state() {
    let problem = paper(1.0);
    for baseline in &baseline::ALL {
        let Some(mut integrator) = baseline.integrator(&problem.model, &problem.start) else {
            continue;
        };
        let mut state = problem.start.clone();
        for h in [1e300, f64::NAN, 0.0] {
            let refused = integrator.step(&mut state, h).expect_err("no step");
            let invalid = refused.cause == Cause::InvalidStep;
            let lost = refused.cause == Cause::NotFinite;
            assert!(if h == 1e300 { lost } else { invalid }, "{refused}");
            assert_eq!(state, problem.start);
        }
        integrator.step(&mut state, 0.01).expect("a step");
    }
}

#[test]
fn steps_on_vectors_do_not_allocate() {
    let problem = paper(10.0);
    let (model, start) = (&problem.model, &problem.start);
    for pair in PAIRS {
        let motion = Motion::new(pair, model, start, 10.0, Tolerance::uniform(1e-8));
        let mut motion = motion.expect("a start");
        let mut run = || (0..=100).for_each(|k| _ = motion.at(f64::from(k) / 10.0).unwrap());
        assert_eq!(measure(&mut run).count_total, 0, "{pair}");
    }
    let mut integrator = RungeKutta::new(&Tableau::CLASSICAL, model.clone(), start);
    let mut state = start.clone();
    let mut run =
        |steps: u32| (0..steps).for_each(|_| _ = integrator.step(&mut state, 0.01).unwrap());
    // The first makes the model's storage.
    run(1);
    assert_eq!(measure(|| run(100)).count_total, 0);
}

#[test]
fn pairs_have_names() {
    assert_eq!(Pair::DP54.to_string(), "Dormand–Prince 5(4)");
    assert_eq!(Pair::DP853.to_string(), "Dormand–Prince 8(5,3)");
}
