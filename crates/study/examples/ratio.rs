//! The time of adaptive Dormand–Prince 8(5,3) over that of variational Gauss, where both have the same error.
//!
//! `cargo run --release -p lgvi-study --example ratio -- [SCENE] [UNTIL]`: by default the paper's scene over 10 s. The error is
//! the largest angle between an attitude and that of a fine run of the other family, over the whole run. A setting counts only
//! where all shorter steps, or smaller tolerances, of its family have no larger error than asked. Both methods evaluate the
//! same right-hand side by the same instructions; each time is the shortest of repeated runs, on one core. `lgvi chart`
//! compares more methods, with Gauss iterated to rounding; here, steps are solved as far as the error asks.

use std::time::{Duration, Instant};

use articulated_fluid::{Configuration, Scene};
use dvi::{Gauss, Integrator, State};
use sim::Method;
use study::baseline::{Motion, Pair, Tolerance};
use study::contender::{Contender, Problem, Setting};
use study::work_precision::Errors;

/// Errors that are asked for, rad.
const ASKED: [f64; 7] = [1e-3, 1e-4, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12];
/// Steps of a second, from a few to many.
const RATES: [f64; 26] = {
    let mut rates = [1.8; 26];
    let mut i = 1;
    while i < 26 {
        rates[i] = rates[i - 1] / 0.93;
        i += 1;
    }
    rates
};
/// Repeats of a timed run: until so many, or so long.
const REPEATS: usize = 20;
const LONG: Duration = Duration::from_millis(100);
/// Tolerance of the explicit reference, and steps of a second of the other.
const REFERENCE: f64 = 3e-14;
const REFERENCE_RATE: f64 = 10.0;

type Error = Box<dyn std::error::Error>;

type States = Vec<State<Configuration>>;

/// What a setting costs, and how far it is off.
struct Point {
    setting: String,
    time: Duration,
    error: f64,
}

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or("scenes/fish-chain.toml".into());
    let until: f64 = arguments.next().map_or(Ok(10.0), |t| t.parse())?;
    let scene = Scene::load(path.as_ref())?;
    let problem = Problem::of(&scene, until)?;
    let explicit = [explicit(&problem)?];
    let gauss = gauss(&problem)?;
    println!("{path}, t = {until} s");
    println!(
        "{:>6}  {:>9} {:<14}  {:>9} {:<30}  {:>5}",
        "rad", "us", "dop853", "us", "gauss", "ratio"
    );
    for asked in ASKED {
        let (Some(a), Some(b)) = (cheapest(&explicit, asked), cheapest(&gauss, asked)) else {
            continue;
        };
        let us = |point: &Point| 1e6 * point.time.as_secs_f64();
        println!(
            "{asked:>6.0e}  {:>9.1} {:<14}  {:>9.1} {:<30}  {:>5.2}",
            us(a),
            a.setting,
            us(b),
            b.setting,
            us(a) / us(b)
        );
    }
    Ok(())
}

/// The cheapest setting of families that start with the coarsest.
fn cheapest(families: &[Vec<Point>], asked: f64) -> Option<&Point> {
    let good = |family: &'_ Vec<Point>| {
        let coarse = family.iter().rposition(|point| point.error > asked);
        coarse.map_or(0, |last| last + 1)
    };
    let counting = families.iter().flat_map(|family| &family[good(family)..]);
    counting.min_by_key(|point| point.time)
}

/// The largest angle between attitudes over a run, rad.
fn apart(problem: &Problem, states: &States, exact: &States) -> Result<f64, Error> {
    Ok(Errors::new(&problem.model, states, exact)?.attitude)
}

fn explicit(problem: &Problem) -> Result<Vec<Point>, Error> {
    let parts = (REFERENCE_RATE * problem.until).round() as u64;
    let gauss = Contender::Structure(Method::gauss(8).expect("one of eight stages"));
    let exact = gauss.sample(problem, Setting::Steps(parts), parts)?;
    let dp853: Contender = "dp853".parse()?;
    let error = |tolerance| {
        let states = dp853.sample(problem, Setting::Tolerance(tolerance), parts)?;
        apart(problem, &states, &exact)
    };
    println!("the references are apart by {:.1e} rad", error(REFERENCE)?);
    let point = |quarter| {
        let tolerance = 10_f64.powf(-2.0 - 0.25 * f64::from(quarter));
        let run = || {
            let tolerance = Tolerance::uniform(tolerance);
            let (model, start, until) = (&problem.model, &problem.start, problem.until);
            Motion::new(&Pair::DP853, model, start, until, tolerance)?
                .at(until)
                .map(drop)
        };
        Ok(Point {
            setting: format!("tol {tolerance:.1e}"),
            time: shortest(run)?,
            error: error(tolerance)?,
        })
    };
    (0..50).map(point).collect()
}

/// A family for each number of stages and tolerance.
fn gauss(problem: &Problem) -> Result<Vec<Vec<Point>>, Error> {
    let (mut exact, dp853) = (Vec::new(), "dp853".parse::<Contender>()?);
    for rate in RATES {
        let steps = (rate * problem.until).round() as u64;
        let reference = Setting::Tolerance(REFERENCE);
        exact.push((steps, dp853.sample(problem, reference, steps)?));
    }
    let mut families = Vec::new();
    for decade in 3..=14 {
        let tolerance = 10_f64.powi(-decade);
        families.push(family::<4>(problem, tolerance, &exact)?);
        families.push(family::<5>(problem, tolerance, &exact)?);
        families.push(family::<6>(problem, tolerance, &exact)?);
        families.push(family::<7>(problem, tolerance, &exact)?);
        families.push(family::<8>(problem, tolerance, &exact)?);
    }
    Ok(families)
}

/// In steps of every size; one that is refused is infinitely far off.
fn family<const S: usize>(
    problem: &Problem,
    tolerance: f64,
    exact: &[(u64, States)],
) -> Result<Vec<Point>, Error> {
    let mut family = Vec::new();
    for (steps, exact) in exact {
        let mut states = vec![problem.start.clone()];
        let keep = |state: &State<Configuration>| states.push(state.clone());
        let Ok(sweeps) = run::<S>(problem, tolerance, *steps, keep) else {
            family.push(Point {
                setting: String::new(),
                time: Duration::MAX,
                error: f64::INFINITY,
            });
            continue;
        };
        let (h, mean) = (problem.until / *steps as f64, sweeps as f64 / *steps as f64);
        family.push(Point {
            setting: format!("{S}, h {h:.3}, tol {tolerance:.0e}, {mean:.1}"),
            time: shortest(|| run::<S>(problem, tolerance, *steps, |_| ()))?,
            error: apart(problem, &states, exact)?,
        });
    }
    Ok(family)
}

/// A run, and its sweeps.
fn run<const S: usize>(
    problem: &Problem,
    tolerance: f64,
    steps: u64,
    mut each: impl FnMut(&State<Configuration>),
) -> Result<u64, dvi::StepError> {
    let mut integrator = Gauss::new::<S>(problem.model.clone()).with_tolerance(tolerance);
    let (mut state, h) = (problem.start.clone(), problem.until / steps as f64);
    let mut sweeps = 0;
    for _ in 0..steps {
        sweeps += u64::from(integrator.step(&mut state, h)?.iterations);
        each(&state);
    }
    Ok(sweeps)
}

/// The least time of several runs.
fn shortest<T, E>(run: impl Fn() -> Result<T, E>) -> Result<Duration, E> {
    let (mut shortest, begun) = (Duration::MAX, Instant::now());
    for _ in 0..REPEATS {
        let start = Instant::now();
        std::hint::black_box(run()?);
        shortest = shortest.min(start.elapsed());
        if begun.elapsed() > LONG {
            break;
        }
    }
    Ok(shortest)
}
