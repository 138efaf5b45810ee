//! The search for the best stroke, and what it tells.

use std::io::Write;
use std::path::Path;

use articulated_fluid::Scene;
use gait::{Found, Fourier, GaitError, Limits, Objective, Search, with_stroke};
use serde::Serialize;
use sim::file::{AtomicFile, FileError};

use super::super::error::CliError;
use super::super::interrupt::Interrupt;
use super::super::{output, print, progress};
use super::{Args, COUPLING, digits, failed};

/// The line that tells what a written scene is.
const HEAD: &str = "# The best stroke by ";

/// What was found, as JSON.
#[derive(Serialize)]
struct Best<'a> {
    objective: &'a str,
    unit: &'a str,
    /// Of the scene's own stroke.
    own: f64,
    best: f64,
    /// Of each start, the scene's own first; null where none was found within the limits.
    starts: Vec<Option<f64>>,
    evaluations: usize,
    coefficients: &'a [f64],
    written: String,
}

/// Searches from the scene's own stroke and from random ones, and writes the scene with the best.
pub(super) fn search(
    args: &Args,
    (scene, text): (&Scene, &str),
    objective: Objective,
    out: &Path,
) -> Result<(), CliError> {
    let limits = Limits {
        angle: args.angle,
        rate: args.rate.unwrap_or(f64::INFINITY),
    };
    let fail = |source| failed(args, source);
    let search = Search::new(scene, objective, limits).map_err(fail)?;
    let file = output::begin(out, Some(&args.scene))?;
    let interrupt = Interrupt::listen().map_err(CliError::Signals)?;
    let order = usize::try_from(args.order).unwrap_or(usize::MAX);
    let own = search.own(order).map_err(fail)?;
    let bar = progress::bar(args.starts, "starts {pos}/{len} {bar:30}");
    let go_on = || interrupt.signal().is_none();
    let found = search.from_starts(
        &own,
        args.starts,
        &mut |done| bar.set_position(done),
        &go_on,
    );
    drop(bar);
    let found = found.map_err(fail)?;
    let best = Found::best(&found).ok_or_else(|| match interrupt.signal() {
        Some(signal) => CliError::Stopped { signal },
        None => fail(GaitError::NoStroke),
    })?;
    let written = written(text, &search, (objective, best)).map_err(fail)?;
    write(file, &written).map_err(|source| CliError::output(out, source))?;
    tell(args, &search, (objective, &own, &found, best), out)?;
    match interrupt.signal() {
        Some(signal) => Err(CliError::BestSoFar { signal }),
        None => Ok(()),
    }
}

fn write(mut file: AtomicFile, text: &str) -> Result<(), FileError> {
    file.write_all(text.as_bytes())?;
    file.finish()
}

fn written(
    text: &str,
    search: &Search,
    (objective, best): (Objective, &Found),
) -> Result<String, GaitError> {
    let head = format!(
        "{HEAD}{}: {} {}.\n",
        objective.name(),
        digits(best.value),
        objective.unit()
    );
    let lines = text.split_inclusive('\n');
    let text: String = lines.skip_while(|line| line.starts_with(HEAD)).collect();
    Ok(head + &with_stroke(&text, search.chain(), &best.stroke, search.from())?)
}

fn tell(
    args: &Args,
    search: &Search,
    (objective, own, found, best): (Objective, &Fourier, &[Option<Found>], &Found),
    out: &Path,
) -> Result<(), CliError> {
    let own = search.value(own).map_err(|source| failed(args, source))?;
    let starts = found
        .iter()
        .map(|found| found.as_ref().map(|found| found.value));
    let told = Best {
        objective: objective.name(),
        unit: objective.unit(),
        own,
        best: best.value,
        starts: starts.collect(),
        evaluations: found.iter().flatten().map(|found| found.evaluations).sum(),
        coefficients: best.stroke.coefficients(),
        written: out.display().to_string(),
    };
    if args.json {
        return print::stdout(&print::json(&told)?);
    }
    let values: Vec<String> = told
        .starts
        .iter()
        .map(|value| value.map_or("none".to_owned(), digits))
        .collect();
    let rows = [
        ["objective", &format!("{}, {}", told.objective, told.unit)],
        ["scene's own", &digits(told.own)],
        ["best", &digits(told.best)],
        ["from the starts", &values.join(", ")],
        ["evaluations", &told.evaluations.to_string()],
        ["written", &told.written],
    ];
    let rows = rows.map(|row| row.map(str::to_owned));
    print::stdout(&(print::columns(&rows) + &format!("\nnote: {COUPLING}\n")))
}
