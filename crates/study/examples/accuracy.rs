//! Whether a run keeps the accuracy that it was asked for: random scenes, horizons and accuracies against references of two families.
//!
//! `cargo run --release -p lgvi-study --example accuracy [SCENES [FIRST]]`: by default 100 scenes, from number 0.
//! The scenes are one body, free in a vacuum, falling or drifting in a fluid, and trees of up to six bodies, in turns.
//! Horizons go from 1 s to 10 000 s, to 100 s of what falls and of trees; accuracies from 1e-2 to 1e-9.
//!
//! One reference is the explicit pair 8(5,3) in charts at 1e-13. The other is gauss-8 in steps shorter by a half than the run's.
//! Where they differ by more than a fifth of what was asked, the truth is unknown.

#[path = "laws/random.rs"]
mod random;

use std::collections::BTreeMap;
use std::time::Instant;

use articulated_fluid::{Configuration, Scene};
use dvi::State;
use rayon::prelude::*;
use sim::{Choice, Method, Plan, Schedule, SimError, Simulation, distance};
use study::baseline::{Tolerance, on_group};

const SEED: u64 = 21;
/// A reference is not asked for more steps of the run than this: it would take minutes.
const LONGEST: u64 = 100_000;
/// The part of the accuracy that references may differ by.
const AGREE: f64 = 0.2;
/// Times are compared of runs that take longer, s: a pilot takes its milliseconds however short the run.
const SHORT: f64 = 0.03;
/// What a run keeps is not missed by more than this.
const FACTOR: f64 = 2.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let numbers: Result<Vec<u64>, _> = std::env::args().skip(1).map(|n| n.parse()).collect();
    let numbers = numbers?;
    let count = numbers.first().copied().unwrap_or(100);
    let first = numbers.get(1).copied().unwrap_or(0);
    let rows: Vec<Row> = (first..first + count).into_par_iter().map(row).collect();
    let mut kinds: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
    for row in &rows {
        kinds.entry(row.kind).or_default().push(row);
        kinds.entry("all").or_default().push(row);
    }
    println!(
        "{:>9} {:>7} {:>6} {:>8} {:>8} {:>7} {:>7} | {:>11} | {:>11} {:>11}",
        "",
        "scenes",
        "kept",
        "unknown",
        "refused",
        "failed",
        "BROKEN",
        "worst/asked",
        "time, mean",
        "time, most"
    );
    for (kind, rows) in &kinds {
        summary(kind, rows);
    }
    let broken = rows.iter().filter(|row| row.is_broken());
    let failed = rows
        .iter()
        .filter(|row| matches!(row.outcome, Outcome::Failed(_)));
    for row in broken.chain(failed) {
        println!("{row:?}");
    }
    Ok(())
}

fn summary(kind: &str, rows: &[&Row]) {
    let many = |is: &dyn Fn(&Outcome) -> bool| rows.iter().filter(|row| is(&row.outcome)).count();
    let errors = rows.iter().filter_map(|row| match row.outcome {
        Outcome::Kept {
            error: Some(error), ..
        } => Some(error / row.accuracy),
        _ => None,
    });
    let mut times: Vec<f64> = rows.iter().filter_map(|row| row.outcome.times()).collect();
    times.sort_by(f64::total_cmp);
    let mean = (times.iter().map(|time| time.ln()).sum::<f64>() / times.len() as f64).exp();
    let broken = rows.iter().filter(|row| row.is_broken()).count();
    println!(
        "{kind:>9} {:>7} {:>6} {:>8} {:>8} {:>7} {:>7} | {:>11.2e} | {mean:>11.2} {:>11.2}",
        rows.len(),
        many(&|o| matches!(o, Outcome::Kept { error: Some(_), .. })) - broken,
        many(&|o| matches!(o, Outcome::Kept { error: None, .. })),
        many(&|o| matches!(o, Outcome::Refused)),
        many(&|o| matches!(o, Outcome::Failed(_))),
        broken,
        errors.fold(0.0, f64::max),
        times.last().copied().unwrap_or(f64::NAN),
    );
}

/// What became of a scene; printed when it is known.
#[derive(Debug)]
#[expect(dead_code, reason = "printed")]
struct Row {
    case: u64,
    kind: &'static str,
    until: f64,
    accuracy: f64,
    outcome: Outcome,
}

#[derive(Debug)]
#[expect(dead_code, reason = "printed")]
enum Outcome {
    Kept {
        /// The true error; unknown where the references differ.
        error: Option<f64>,
        /// Time of the whole over that of the run alone.
        times: f64,
        /// Time of the run alone, s.
        run: f64,
    },
    /// With the reason that the accuracy is out of reach.
    Refused,
    Failed(SimError),
}

impl Outcome {
    fn times(&self) -> Option<f64> {
        match self {
            Self::Kept { times, run, .. } => (*run >= SHORT).then_some(*times),
            _ => None,
        }
    }
}

impl Row {
    fn is_broken(&self) -> bool {
        matches!(self.outcome, Outcome::Kept { error: Some(error), .. } if error > FACTOR * self.accuracy)
    }
}

fn row(case: u64) -> Row {
    let (kind, scene) = scene(case);
    // Spread evenly over the decades, without repeating together.
    let spread = |step: f64| (case as f64 * step).fract();
    let until = round(10.0_f64.powf(decades(kind) * spread(0.618_034)));
    let accuracy = round(10.0_f64.powf(-2.0 - 7.0 * spread(0.414_214)));
    let row = Row {
        case,
        kind,
        until,
        accuracy,
        outcome: outcome(&scene, until, accuracy),
    };
    eprintln!("{row:?}");
    row
}

/// How long a run of a kind is at the most: a body that falls is ever faster, and a tree's error grows exponentially.
fn decades(kind: &str) -> f64 {
    match kind {
        "falling" | "tree" => 2.0,
        _ => 4.0,
    }
}

/// Two digits.
fn round(x: f64) -> f64 {
    format!("{x:.1e}").parse().unwrap_or(x)
}

/// The first scene from number `case` on that is of the kind whose turn it is.
fn scene(case: u64) -> (&'static str, Scene) {
    let mut scenes = (0..).map(|k| random::scene(SEED, 1_000_000 * k + case));
    let falls = |scene: &Scene| scene.gravity != [0.0; 3] && scene.bodies[0].net_mass != 0.0;
    let kind = ["free", "falling", "drifting", "tree"][(case % 4) as usize];
    let fits = |scene: &Scene| match kind {
        "free" => scene.density == 0.0 && scene.gravity == [0.0; 3],
        "falling" => falls(scene),
        "drifting" => scene.density > 0.0 && scene.gravity == [0.0; 3],
        _ => true,
    };
    let mut scene = scenes.find(fits).expect("there are all kinds");
    if kind != "tree" {
        scene.bodies.truncate(1);
        scene.joints.clear();
    }
    (kind, scene)
}

fn outcome(scene: &Scene, until: f64, accuracy: f64) -> Outcome {
    let plan = Plan {
        choice: Choice::Accuracy(accuracy),
        until,
        schedule: Schedule::Steps(u64::MAX),
        ..Plan::default()
    };
    let begin = Instant::now();
    let mut simulation = match Simulation::new(scene, &plan) {
        Ok(simulation) => simulation,
        Err(SimError::AccuracyOutOfReach { .. }) => return Outcome::Refused,
        Err(error) => return Outcome::Failed(error),
    };
    let chosen = begin.elapsed();
    while !simulation.is_done() {
        if let Err(error) = simulation.advance() {
            return Outcome::Failed(error);
        }
    }
    let whole = begin.elapsed().as_secs_f64();
    let run = whole - chosen.as_secs_f64();
    Outcome::Kept {
        error: error(scene, &simulation, accuracy),
        times: whole / run,
        run,
    }
}

/// The larger of the distances from two references, if these are close enough to tell.
fn error(scene: &Scene, simulation: &Simulation, accuracy: f64) -> Option<f64> {
    let (end, steps) = (simulation.state(), simulation.clock().steps());
    let until = simulation.clock().until();
    let start = scene.initial_state().ok()?;
    if steps > LONGEST {
        return None;
    }
    let explicit =
        on_group::integrate(simulation.model(), &start, until, Tolerance::uniform(1e-13)).ok()?;
    let implicit = implicit(scene, until, 2.0 * steps as f64)?;
    let apart = |a: &State<Configuration>, b: &State<Configuration>| distance(&a.g, &b.g);
    let known = apart(&explicit, &implicit) <= AGREE * accuracy;
    known.then(|| apart(end, &explicit).max(apart(end, &implicit)))
}

fn implicit(scene: &Scene, until: f64, steps: f64) -> Option<State<Configuration>> {
    let choice = Choice::Method {
        method: Method::gauss(8)?,
        step: Some(until / steps),
    };
    let plan = Plan {
        choice,
        until,
        schedule: Schedule::Steps(u64::MAX),
        ..Plan::default()
    };
    let frame = Simulation::new(scene, &plan).ok()?.last()?;
    frame.ok().map(|frame| frame.state)
}
