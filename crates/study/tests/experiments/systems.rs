//! Four systems and a few methods each: what the table of the example `systems` says, within bounds.
//!
//! The figures are printed: `cargo test -p lgvi-study --test experiments systems -- --nocapture`.

use std::f64::consts::PI;

use dvi::laws::{self, LawError};
use dvi::{Integrator, Lagrangian, Quadrature, State, Variational};
use lie::{Cayley, Exp, SO3, Vec3};
use study::problems::{Problem, Solution, Translation};
use study::survey::wrong::{ByHand, Mistake, Rederived};
use study::survey::{
    self, Convergence, LongRun, Method, composition, convergence, gauss, long_run, systems,
    variational,
};

/// Steps in one time of the problem, and times of the problem, of a long run.
const STEPS: u32 = 40;
const TIMES: u32 = 100;
/// Where the order is measured, in times of the problem. After a whole period a rule of order 1 that is conjugate to one of order
/// 2 shows that one's order.
const UNTIL: f64 = 0.7;
/// Errors below are those of rounding and of the references.
const PLATEAU: f64 = 2e-12;

fn brief(numbers: &[f64]) -> String {
    let each: Vec<_> = numbers.iter().map(|x| format!("{x:.1e}")).collect();
    each.join(" ")
}

fn errors(found: &Convergence) -> String {
    brief(
        &found
            .errors
            .iter()
            .map(|(_, error)| *error)
            .collect::<Vec<_>>(),
    )
}

/// Asserts all that a method keeps of a problem, and its `order`.
fn prove<L, X>(
    problem: &Problem<L, X>,
    name: &str,
    make: fn(L) -> Method<L::Group>,
    (order, steps): (f64, [u32; 3]),
) where
    L: Lagrangian + Copy,
    X: Solution<L::Group>,
{
    let make = || make(problem.lagrangian);
    let exact = problem.exact.at(UNTIL * problem.time).expect("a state");
    let found = convergence(make, &problem.start, &exact, &steps, PLATEAU).expect("runs");
    let h = problem.time / f64::from(STEPS);
    let run = long_run(problem, &mut make(), h, STEPS * TIMES, 7).expect("a run");
    let defect = laws::symplectic_defect(&mut make(), &problem.start, h).expect("a step");
    println!(
        "{}, {name}: order {:.3} {}; energy band {:.1e}, drift {:.1e}/s; maps {}; residual {:.1e}; defect {defect:.1e}",
        problem.name,
        found.order,
        errors(&found),
        run.band,
        run.drift,
        brief(&run.momenta),
        run.residual
    );
    assert!((found.order - order).abs() < 0.1);
    assert!(defect < 1e-11);
    assert!(run.drift.abs() < drift_bound(problem, &run));
    for (named, change) in problem.symmetries.iter().zip(&run.momenta) {
        let bound = map_bound(&named.symmetry, &run);
        assert!(
            *change < bound,
            "{}: {change:e}, bound {bound:e}",
            named.name
        );
    }
}

/// The largest slope of a bounded error.
///
/// An error $y$ of magnitude $B$ at most and mean zero over every time $\tau$ has a primitive within $B \tau / 2$; so, by parts,
/// $\int (t - T/2)\ y\ \mathrm dt$ is at most $B \tau T$, and the slope, which is that over $T^3 / 12$, at most $12 B \tau / T^2$: a
/// secular error of the size of the band would make $B / T$. Motions with several frequencies have slower beats: $\tau$ is five times of the problem.
fn drift_bound<L: Lagrangian, X>(problem: &Problem<L, X>, run: &LongRun) -> f64 {
    let total = problem.time * f64::from(TIMES);
    12.0 * run.band * 5.0 * problem.time / total.powi(2)
}

/// The largest change of a momentum map.
///
/// Motions of space are kept by the transport $\mathrm{Ad}^\ast_f$ whatever $f$ is: rounding only, a random walk. Turns of the
/// body against its frame are symmetries of the solved step alone: each step adds up to its residual.
fn map_bound<A>(symmetry: &Translation<A>, run: &LongRun) -> f64 {
    let steps = f64::from(STEPS * TIMES);
    let walk = 10.0 * f64::EPSILON * steps.sqrt();
    match symmetry {
        Translation::Left(_) => walk,
        Translation::Right(_) => walk + steps * run.residual,
    }
}

/// The rules are one method here, symmetric and of order 2: the Lagrangian does not depend on the configuration.
#[test]
fn free_rigid_body() {
    let body = systems::free_rigid_body().expect("a problem");
    let midpoint = |system| variational::<_, Cayley>(system, Quadrature::Midpoint);
    prove(&body, "midpoint, Cayley", midpoint, (2.0, [400, 800, 1600]));
    prove(
        &body,
        "Gauss, 2 stages",
        gauss::<_, 2>,
        (4.0, [200, 400, 800]),
    );
    let exact = body.exact.at(100.0 * body.time).expect("a state");
    let after_100 = |make: fn(_) -> Method<SO3>, steps: [u32; 2]| {
        let make = || make(body.lagrangian);
        let found = convergence(make, &body.start, &exact, &steps, PLATEAU).expect("runs");
        println!(
            "after 100 periods: order {:.3} {}",
            found.order,
            errors(&found)
        );
        found.order
    };
    assert!((after_100(midpoint, [60_000, 120_000]) - 2.0).abs() < 0.1);
    assert!((after_100(gauss::<_, 2>, [6_000, 12_000]) - 4.0).abs() < 0.1);
}

/// The mean rate, rad/s, at which the axis of a top goes round over its whole nutations.
fn precession_rate(mut method: Method<SO3>, start: &State<SO3>, until: f64, steps: u32) -> f64 {
    let azimuth = |state: &State<SO3>| {
        let axis = state.g.rotate(Vec3([0.0, 0.0, 1.0]));
        axis[1].atan2(axis[0])
    };
    let (mut state, mut total) = (start.clone(), 0.0);
    for _ in 0..steps {
        let before = azimuth(&state);
        method
            .step(&mut state, until / f64::from(steps))
            .expect("a step");
        let turn = azimuth(&state) - before;
        total += turn - 2.0 * PI * (turn / (2.0 * PI)).round();
    }
    total / until
}

#[test]
fn lagrange_top() {
    let top = systems::heavy_top().expect("a problem");
    let left = |system| variational::<_, Cayley>(system, Quadrature::LeftPoint);
    let trapezoid = |system| variational::<_, Exp>(system, Quadrature::Trapezoid);
    prove(&top, "left, Cayley", left, (1.0, [800, 1600, 3200]));
    prove(&top, "trapezoidal, exp", trapezoid, (2.0, [200, 400, 800]));
    prove(
        &top,
        "composition 4",
        composition::<_, 4>,
        (4.0, [100, 200, 400]),
    );
    let (exact, until) = (top.exact.mean_precession_rate(), 50.0 * top.time);
    let order = |make: fn(_) -> Method<SO3>, steps: [u32; 2]| {
        let error = |n: u32| {
            let found = precession_rate(make(top.lagrangian), &top.start, until, n);
            (f64::from(n).ln(), (found - exact).abs().ln())
        };
        let order = -survey::slope(&steps.map(error));
        println!("mean precession rate {exact}: order {order:.3}");
        order
    };
    assert!((order(trapezoid, [4_000, 8_000]) - 2.0).abs() < 0.1);
    assert!((order(composition::<_, 4>, [3_000, 6_000]) - 4.0).abs() < 0.1);
}

#[test]
fn pendulum_in_space() {
    let pendulum = systems::pendulum().expect("a problem");
    let right = |system| variational::<_, Exp>(system, Quadrature::RightPoint);
    prove(&pendulum, "right, exp", right, (1.0, [800, 1600, 3200]));
    prove(
        &pendulum,
        "Gauss, 2 stages",
        gauss::<_, 2>,
        (4.0, [100, 200, 400]),
    );
}

#[test]
fn ellipsoid_in_a_fluid() {
    let flutter = systems::flutter().expect("a problem");
    let right = |system| variational::<_, Exp>(system, Quadrature::RightPoint);
    prove(&flutter, "right, exp", right, (2.0, [200, 400, 800]));
    let screw = systems::screw().expect("a problem");
    let exact = screw.exact.at(10.0 * screw.time).expect("a state");
    let make = || right(screw.lagrangian);
    let found = convergence(make, &screw.start, &exact, &[1000], 0.0).expect("a run");
    let error = found.errors[0].1;
    println!("a motion of constant velocity: {error:.1e}");
    // The exponential has it, up to what the solver leaves in each step: relative to the 34 m of the way.
    assert!(error < 34.0 * 1000.0 * 1e-13);
}

#[track_caller]
fn caught(verdict: Result<laws::Report, LawError>, law: &str) {
    match verdict {
        Err(LawError::Law(lie::laws::LawError::Violated {
            formula,
            left,
            right,
            tolerance,
            ..
        })) => {
            println!("{formula}: {left:.3e} and {right:.3e}, tolerance {tolerance:.1e}");
            assert_eq!(formula, law);
        }
        other => panic!("the mistake was not caught: {other:?}"),
    }
}

#[test]
fn what_is_wrong_is_caught() {
    let top = systems::heavy_top().expect("a problem");
    let (h, states) = (top.time / f64::from(STEPS), [top.start.clone()]);
    let check = |mistake| laws::check(&ByHand(mistake), &states, h);
    check(Mistake::None).unwrap();
    laws::check_consistency(&ByHand(Mistake::None), &top.lagrangian, &states).unwrap();
    caught(check(Mistake::SignOfDg), "d_g = T*L_g D_g L_d, by duals");
    caught(check(Mistake::FactorOfDf), "d_f = T*L_f D_f L_d, by duals");
    let right = ByHand(Mistake::None);
    let mut loose = Rederived::new(right, 1e-3);
    let verdict = laws::check_step(&mut loose, &right, &states, h);
    caught(verdict, "F^- L_d (g_k, f_k) = mu_k");
    laws::check_step(&mut Rederived::new(right, 1e-13), &right, &states, h).unwrap();
}

/// The figures of the table tell the right method from the wrong ones.
#[test]
fn what_is_wrong_shows() {
    let top = systems::heavy_top().expect("a problem");
    let exact = top.exact.at(UNTIL * top.time).expect("a state");
    let h = top.time / f64::from(STEPS);
    let show = |make: &dyn Fn() -> Method<SO3>| {
        let found = convergence(make, &top.start, &exact, &[1600, 3200], PLATEAU).expect("runs");
        let run = long_run(&top, &mut make(), h, STEPS * TIMES, 7).expect("a run");
        let defect = laws::symplectic_defect(&mut make(), &top.start, h).expect("a step");
        println!(
            "order {:.2}, drift {:.1e}, maps {}, defect {defect:.1e}",
            found.order,
            run.drift,
            brief(&run.momenta)
        );
        (found.order, run, defect)
    };
    let hand = |mistake| move || Method::new(Variational::new(ByHand(mistake)));
    let (order, run, defect) = show(&hand(Mistake::None));
    assert!((order - 1.0).abs() < 0.1 && defect < 1e-11);
    assert!(run.drift.abs() < drift_bound(&top, &run));
    // A wrong sign or factor throughout is another system's method: symplectic, and no approximation of this one.
    for mistake in [Mistake::SignOfDg, Mistake::FactorOfDf] {
        let (order, run, defect) = show(&hand(mistake));
        assert!(order.abs() < 0.1 && defect < 1e-11 && run.momenta[0] < 1e-12);
    }
    let (order, run, defect) = show(&hand(Mistake::MissingTerm));
    assert!(order.abs() < 0.1 && defect > 1e-3 && run.momenta[0] > 1e-3);
    // Carried, the vertical momentum holds however loose the step; derived anew, nothing does.
    let loose = || Variational::new(ByHand(Mistake::None)).with_tolerance(1e-3);
    let (_, run, defect) = show(&|| Method::new(loose()));
    assert!(run.momenta[0] < 1e-12 && run.momenta[1] > 1e-4 && defect > 1e-8);
    let (_, run, defect) = show(&|| Method::new(Rederived::new(ByHand(Mistake::None), 1e-3)));
    assert!(run.drift.abs() > drift_bound(&top, &run) && defect > 1e-5);
    assert!(run.momenta.iter().all(|change| *change > 1e-3));
}
