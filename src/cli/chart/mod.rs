//! `lgvi chart`: work against precision.

mod json;
mod report;

use std::path::PathBuf;
use std::sync::Arc;

use figure::Rendered;
use indicatif::ProgressBar;
use sim::number::decimal;
use study::contender::{Contender, Problem};
use study::work_precision::{Curve, MEANINGFUL, Reference, Sweep, Timing, csv, picture};

use super::args;
use super::contenders;
use super::error::CliError;
use super::files::Files;
use super::interrupt::Interrupt;
use super::print::{self, one_line};
use super::progress;
use super::scene::{Loaded, load};
use report::Report;

/// Chart what each method costs for which error, on a scene of your own.
///
/// Runs each method from long steps, or loose tolerances, to short ones, and measures the largest errors over the run against a
/// reference that two methods have found independently. Writes a chart (SVG and PNG) and all numbers (CSV), and prints which method
/// is the cheapest for an error. What fails is on the chart, with its cause.
#[derive(clap::Args)]
#[command(after_long_help = AFTER_LONG_HELP)]
pub struct Args {
    /// The scene, a TOML file [default: three bodies, from Lee, Leok & McClamroch (2009)]
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Simulated time, in seconds
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = args::seconds, allow_hyphen_values = true)]
    until: f64,
    /// The methods to compare, separated by commas
    #[arg(long, value_name = "NAMES", default_value = METHODS, value_delimiter = ',', value_parser = contenders::contender())]
    methods: Vec<Contender>,
    /// Write STEM.svg, STEM.png and STEM.csv: whole, or not at all
    #[arg(long, value_name = "STEM", default_value = "chart")]
    out: PathBuf,
    /// Print all numbers as one JSON object
    #[arg(long)]
    json: bool,
}

/// Without those that are never the cheapest and would only fill the chart.
const METHODS: &str = "lgvi,composition-2,composition-4,composition-8,gauss-2,gauss-4,gauss-6,gauss-8,pilot,\
rk4,rkmk4,rkmk4-plain,cf4,dp54,dp853";

const AFTER_LONG_HELP: &str = "\
Examples:
  lgvi chart                                       the built-in scene for 10 s: two minutes
  lgvi chart boat.toml --until 60 --out boat       boat.svg, boat.png, boat.csv of your scene
  lgvi chart --methods lgvi,gauss-4,dp853          three methods
  lgvi chart --json | jq '.cheapest[] | {error_radians, cheapest}'

What is measured:
  error        the largest angle between a body's attitude and the reference's, at 200 times over the run
  time         of stepping alone: the least of 20 runs, or of what fits into 2 s, at two times, one after the other
  evaluations  of the continuous model, for lgvi and composition of the discrete one; they do not depend on the machine
  pilot        the choice of lgvi run --accuracy for ever smaller errors; the pilot run before it is not in the time, so
               it is in the chart and not in the table
  setting      one counts as reaching an error only if all finer settings of its method do
rk4, rkmk4, cf4, dp54 evaluate the model one state at a time; gauss and dp853 do it by the processor's widest instructions.
All methods step the same model in space, that of lgvi run but for a plane: where lgvi inspect finds one, lgvi run is faster than
the chart says. Places are relative to the frame of that model. A method's line ends at the reference's own error, or after two runs of more than half a second.

Exit codes:
  0    done, even if single runs of the chart failed
  1    there is no reference, or a write failed; each file is whole, or as it was
  2    an argument or the scene is wrong
  130  interrupted (143: terminated, 129: hung up); as 1, the second time at once";

/// Runs the methods, writes the files and prints the table.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let loaded = load(args.scene.as_deref())?;
    loaded.warn_of_overlaps();
    let interrupt = Interrupt::listen().map_err(CliError::Signals)?;
    loaded.check_methods(args.until)?;
    let files = Files::begin(&args.out, args.scene.as_deref())?;
    let problem = Arc::new(Problem {
        model: loaded.smallest.model.clone(),
        start: loaded.smallest.start.clone(),
        until: args.until,
    });
    let reference = Arc::new(reference(&problem, &interrupt)?);
    if reference.attitude > MEANINGFUL {
        print::warning(&format_args!(
            "the reference is known to {:.0e} rad only, and errors of attitudes say little: trajectories mean nothing beyond t = {:.0} s, \
             see --until",
            reference.attitude, reference.horizon.time
        ));
    }
    let Charted { curves, drawn } = charted(args, &loaded, &problem, &reference, &interrupt)?;
    let files = files.complete(&drawn, &csv(&curves, args.until))?;
    let paths = files.paths();
    let report = Report::new(&loaded, &problem, &reference, &curves, &paths);
    print::stdout(&match args.json {
        true => print::json(&json::Object::new(&report))?,
        false => report.text(),
    })?;
    files.place()
}

fn reference(problem: &Arc<Problem>, interrupt: &Interrupt) -> Result<Reference, CliError> {
    let _waiting = progress::waiting("finding the reference");
    let problem = problem.clone();
    let found = interrupt.heeding(move || Ok(Reference::new(&problem)?));
    found.unwrap_or_else(|signal| Err(CliError::Stopped { signal }))
}

/// What was measured, and its picture.
struct Charted {
    curves: Vec<Curve>,
    drawn: Rendered,
}

fn charted(
    args: &Args,
    loaded: &Loaded,
    problem: &Arc<Problem>,
    reference: &Arc<Reference>,
    interrupt: &Interrupt,
) -> Result<Charted, CliError> {
    let (methods, title) = (args.methods.clone(), title(loaded, args.until));
    let (problem, reference) = (problem.clone(), reference.clone());
    let template = "{bar:40} {pos} of {len} methods, {msg}";
    let bar = progress::bar(methods.len() as u64, template);
    let shown = bar.clone();
    let charted = interrupt.heeding(move || {
        let curves = sweep(&methods, &problem, &reference, &shown);
        let drawn = picture(&curves, &problem, &reference, &title).render()?;
        Ok(Charted { curves, drawn })
    });
    bar.finish_and_clear();
    charted.unwrap_or_else(|signal| Err(CliError::Stopped { signal }))
}

fn title(loaded: &Loaded, until: f64) -> String {
    let title = loaded.scene.title.as_ref().unwrap_or(&loaded.file);
    format!("{}: {} s", one_line(title), decimal(until))
}

/// One method after the other: what runs beside would be in the times.
fn sweep(
    methods: &[Contender],
    problem: &Problem,
    reference: &Reference,
    bar: &ProgressBar,
) -> Vec<Curve> {
    let mut curves: Vec<Curve> = vec![];
    for &contender in methods {
        if curves.iter().any(|curve| curve.contender == contender) {
            continue;
        }
        bar.set_message(contender.name());
        let points = Sweep::new(contender, problem, reference, Timing::BEST_OF_10).collect();
        curves.push(Curve { contender, points });
        bar.inc(1);
    }
    bar.set_message("timing once more");
    for curve in &mut curves {
        curve.time_again(problem, Timing::BEST_OF_10);
    }
    curves
}
