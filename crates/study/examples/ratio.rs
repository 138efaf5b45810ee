//! The time of adaptive Dormand–Prince 8(5,3) over that of variational Gauss, where both have the same error.
//!
//! `cargo run --release -p lgvi-study --example ratio -- [SCENE] [UNTIL]`: by default the paper's scene over 10 s. The error is
//! the largest angle between an attitude and that of a fine run of the other family, over the whole run. A setting counts only
//! where all shorter steps, or smaller tolerances, of its family have no larger error than asked. Both methods evaluate the
//! same right-hand side by the same instructions; each time is the shortest of repeated runs, on one core. `lgvi chart`
//! compares more methods, with Gauss iterated to rounding; here, steps are solved as far as the error asks.

use std::time::{Duration, Instant};

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{Gauss, Integrator, State};
use study::baseline::Tolerance;
use study::work_precision::Errors;
use study::{dop853, raw};

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

struct Problem {
    model: ArticulatedBody,
    start: State<Configuration>,
    until: f64,
}

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
    let (model, start) = (scene.model()?, scene.initial_state()?);
    let problem = Problem {
        model,
        start,
        until,
    };
    let explicit = [problem.explicit()?];
    let gauss = problem.gauss()?;
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

impl Problem {
    /// The attitudes at so many equal parts of the time.
    fn samples(&self, parts: usize, tolerance: f64) -> Result<Vec<State<Configuration>>, Error> {
        let mut samples = Vec::with_capacity(parts);
        let every = self.until / parts as f64;
        let mut keep = |t, y: &[f64]| samples.extend(raw::unpack(t, y));
        let tolerance = Tolerance::uniform(tolerance);
        // A little more, so that rounding does not leave the end out.
        let until = self.until * (1.0 + 1e-12);
        dop853::sample(
            &self.model,
            &self.start,
            until,
            (every, &mut keep),
            tolerance,
        )?;
        Ok(samples)
    }

    /// The largest angle between attitudes over a run, rad.
    fn apart(
        &self,
        states: &[State<Configuration>],
        exact: &[State<Configuration>],
    ) -> Result<f64, Error> {
        if states.len() != exact.len() {
            return Err("states at the wrong times".into());
        }
        Ok(Errors::new(&self.model, states, exact)?.attitude)
    }

    fn explicit(&self) -> Result<Vec<Point>, Error> {
        let parts = (REFERENCE_RATE * self.until).round() as usize;
        let mut exact = Vec::with_capacity(parts);
        self.run::<8>(0.0, parts, |state| exact.push(state.clone()))?;
        let references = self.apart(&self.samples(parts, REFERENCE)?, &exact)?;
        println!("the references are apart by {references:.1e} rad");
        let mut family = Vec::new();
        for quarter in 0..50 {
            let tolerance = 10_f64.powf(-2.0 - 0.25 * f64::from(quarter));
            let error = self.apart(&self.samples(parts, tolerance)?, &exact)?;
            let uniform = Tolerance::uniform(tolerance);
            let time = shortest(|| {
                Ok(dop853::integrate(
                    &self.model,
                    &self.start,
                    self.until,
                    uniform,
                )?)
            })?;
            let setting = format!("tol {tolerance:.1e}");
            family.push(Point {
                setting,
                time,
                error,
            });
        }
        Ok(family)
    }

    /// A family for each number of stages and tolerance.
    fn gauss(&self) -> Result<Vec<Vec<Point>>, Error> {
        let steps = RATES.map(|rate| (rate * self.until).round() as usize);
        let mut exact = Vec::new();
        for steps in steps {
            exact.push((steps, self.samples(steps, REFERENCE)?));
        }
        let mut families = Vec::new();
        for decade in 3..=14 {
            let tolerance = 10_f64.powi(-decade);
            families.push(self.family::<4>(tolerance, &exact)?);
            families.push(self.family::<5>(tolerance, &exact)?);
            families.push(self.family::<6>(tolerance, &exact)?);
            families.push(self.family::<7>(tolerance, &exact)?);
            families.push(self.family::<8>(tolerance, &exact)?);
        }
        Ok(families)
    }

    fn family<const S: usize>(
        &self,
        tolerance: f64,
        exact: &[(usize, Vec<State<Configuration>>)],
    ) -> Result<Vec<Point>, Error> {
        let mut family = Vec::new();
        for (steps, exact) in exact {
            let run = || self.run::<S>(tolerance, *steps, |_| ());
            let mut states = Vec::with_capacity(*steps);
            let mut point = Point {
                setting: String::new(),
                time: Duration::MAX,
                error: f64::INFINITY,
            };
            if let Ok(sweeps) = self.run::<S>(tolerance, *steps, |state| states.push(state.clone()))
            {
                point.error = self.apart(&states, exact)?;
                point.time = shortest(run)?;
                let (h, mean) = (
                    self.until / *steps as f64,
                    f64::from(sweeps) / *steps as f64,
                );
                point.setting = format!("{S}, h {h:.3}, tol {tolerance:.0e}, {mean:.1}");
            }
            family.push(point);
        }
        Ok(family)
    }

    /// A run, and its sweeps.
    fn run<const S: usize>(
        &self,
        tolerance: f64,
        steps: usize,
        mut each: impl FnMut(&State<Configuration>),
    ) -> Result<u32, Error> {
        let mut integrator = Gauss::<_, S>::new(self.model.clone()).with_tolerance(tolerance);
        let (mut state, h) = (self.start.clone(), self.until / steps as f64);
        let mut sweeps = 0;
        for _ in 0..steps {
            sweeps += integrator.step(&mut state, h)?.iterations;
            each(&state);
        }
        Ok(sweeps)
    }
}

fn shortest<T>(run: impl Fn() -> Result<T, Error>) -> Result<Duration, Error> {
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
