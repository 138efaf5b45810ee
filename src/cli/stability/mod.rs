//! `lgvi stability`: where methods fail.

mod json;
mod report;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use figure::Rendered;
use sim::number::decimal;
use study::contender::Contender;
use study::stability::{Grid, Map, Pace, Parameter, csv, picture};

use super::args;
use super::contenders;
use super::error::CliError;
use super::files::Files;
use super::interrupt::Interrupt;
use super::print::{self, one_line};
use super::progress;
use super::scene::{Loaded, load};
use report::Report;

/// Map in which steps each method fails, and how, on a scene of your own.
///
/// Runs each method in steps of every size, over one parameter of the scene, for a long time, on all processors. Writes the
/// map (SVG and PNG) and all numbers (CSV). Prints the largest step in which each method is good and what ends there: the solver of
/// its step, or its dynamics.
#[derive(clap::Args)]
#[command(after_long_help = AFTER_LONG_HELP)]
pub struct Args {
    /// The scene, a TOML file [default: three bodies, from Lee, Leok & McClamroch (2009)]
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// What of the scene is varied
    #[arg(long, value_name = "NAME", default_value = "mass-ratio", value_parser = contenders::parameter())]
    parameter: Parameter,
    /// Its values, separated by commas: multiples of the scene's own, or N m, where 0 adds none [default: five of them]
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', value_parser = contenders::multiple, allow_hyphen_values = true)]
    values: Vec<f64>,
    /// The sizes of the steps, in seconds, separated by commas; none longer than --until [default: five to a decade, from 0.004 to 1]
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', value_parser = args::seconds, allow_hyphen_values = true)]
    steps: Vec<f64>,
    /// The methods to map, separated by commas; none that chooses its steps
    #[arg(long, value_name = "NAMES", default_value = METHODS, value_delimiter = ',', value_parser = contenders::stepper())]
    methods: Vec<Contender>,
    /// Simulated time, in seconds
    #[arg(long, value_name = "SECONDS", default_value = "1000", value_parser = args::seconds, allow_hyphen_values = true)]
    until: f64,
    /// Time for all runs, in seconds: what is not done by then is marked as not run
    #[arg(long, value_name = "SECONDS", default_value = "240", value_parser = args::seconds, allow_hyphen_values = true)]
    budget: f64,
    /// Write STEM.svg, STEM.png and STEM.csv: whole, or not at all
    #[arg(long, value_name = "STEM", default_value = "stability")]
    out: PathBuf,
    /// Print all numbers as one JSON object
    #[arg(long)]
    json: bool,
}

/// Five to a decade.
const STEPS: [f64; 13] = [
    0.004, 0.0063, 0.01, 0.016, 0.025, 0.04, 0.063, 0.1, 0.16, 0.25, 0.4, 0.63, 1.0,
];
/// Those whose shortest steps have time in the default budget.
const METHODS: &str =
    "lgvi,composition-2,gauss-2,gauss-4,gauss-6,gauss-8,rk4,rkmk4,rkmk4-plain,cf4";

const AFTER_LONG_HELP: &str = "\
Examples:
  lgvi stability                                   the built-in scene for 1000 s: minutes
  lgvi stability boat.toml --parameter spin        your scene, started faster and slower
  lgvi stability --values 1 --methods lgvi,rk4 --steps 0.05,0.1,0.15,0.2
  lgvi stability --json | jq '.methods[] | {name, limits}'

A run takes as many whole steps as --until has room for, and is judged by the first of these that holds:
  non-finite      a number was not finite; ends the run
  refused         a step was refused with an error; ends the run
  energy-band     the energy was off by 10 % of the largest kinetic energy; ends the run. It is not judged where joints move as told
  energy-drift    the line through the energy's error moved by 1 % of it, and explains half of the error's variance
  group-left      ||I - R^T R||_F above 1e-6
  momentum-lost   a momentum off by 1e-6 of the one that the largest kinetic energy would have
  silently-wrong  none of these, and an attitude off by a radian from two references: 32 times over the run these start from a state
                  of the method and follow it for one step, or for as many as turn a body by half a radian
  good            none of these
  not-run         its time was over, or there was no reference to compare with

What ends the good steps:
  solver     a step was refused, and shorter steps from the same state, made longer bit by bit, lead to a solution; what would come
             after that step is not known
  equation   they do not: no way on was found, as where two solutions meet and end
  dynamics   the energy left its band or drifted, or a number became infinite: the method's own motion, solved as it is
  structure  the method loses momenta or the group at any step, at shorter ones more slowly
  wrong      silently wrong, or a refused step whose solution is another motion
  unknown    the time was over, or there was no reference
'0.25 solver' is a largest good step and what ends there; 'none: solver', that no step was good; '1 or more', that all were.

Exit codes:
  0    done, even if runs failed or had no time
  1    a write failed; each file is whole, or as it was
  2    an argument or the scene is wrong
  130  interrupted (143: terminated, 129: hung up); as 1, the second time at once";

/// Runs the cells, writes the files and prints the table.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let begin = Instant::now();
    let loaded = load(args.scene.as_deref())?;
    loaded.warn_of_overlaps();
    let grid = args.grid()?;
    let interrupt = Interrupt::listen().map_err(CliError::Signals)?;
    loaded.check_methods(args.until)?;
    let files = Files::begin(&args.out, args.scene.as_deref())?;
    let title = title(&loaded, args);
    let Mapped { map, drawn } = mapped(args, grid, &loaded, &title, &interrupt)?;
    let files = files.complete(&drawn, &csv(&map))?;
    let report = Report {
        loaded: &loaded,
        map: &map,
        title,
        seconds: begin.elapsed().as_secs_f64(),
        files: &files.paths(),
    };
    print::stdout(&match args.json {
        true => print::json(&json::Object::new(&report))?,
        false => report.text(),
    })?;
    files.place()
}

fn title(loaded: &Loaded, args: &Args) -> String {
    let title = loaded.scene.title.as_ref().unwrap_or(&loaded.file);
    format!("{}: {} s", one_line(title), decimal(args.until))
}

impl Args {
    fn grid(&self) -> Result<Grid, CliError> {
        let values = match self.values.as_slice() {
            [] => self.parameter.default_values(),
            given => given,
        };
        let steps = self.steps()?;
        Ok(Grid::new(
            self.parameter,
            values,
            &self.methods,
            &steps,
            self.until,
        ))
    }

    /// Those asked for, or those of the usual ones that are not beyond the end.
    fn steps(&self) -> Result<Vec<f64>, CliError> {
        let until = self.until;
        let fits = |step: &f64| *step <= until;
        let usual = || STEPS.into_iter().filter(fits).collect();
        let steps: Vec<f64> = match self.steps.is_empty() {
            true => usual(),
            false => self.steps.clone(),
        };
        let beyond = match steps.is_empty() {
            true => Some(STEPS[0]),
            false => steps.iter().copied().find(|step| !fits(step)),
        };
        beyond.map_or(Ok(steps), |step| {
            Err(CliError::StepBeyondEnd { step, until })
        })
    }
}

/// What was run, and its picture.
struct Mapped {
    map: Map,
    drawn: Rendered,
}

fn mapped(
    args: &Args,
    grid: Grid,
    loaded: &Loaded,
    title: &str,
    interrupt: &Interrupt,
) -> Result<Mapped, CliError> {
    let template = "{bar:40} {pos} of {len} runs, {elapsed}";
    let bar = progress::bar(grid.len() as u64, template);
    let (shown, scene, title) = (bar.clone(), loaded.scene.clone(), title.to_owned());
    // A time beyond what can be counted is no bound.
    let budget = Duration::try_from_secs_f64(args.budget).unwrap_or(Duration::MAX);
    let mapped = interrupt.heeding(move || {
        let pace = Pace {
            budget,
            stop: &|| false,
            done: &|| shown.inc(1),
        };
        let map = Map::new(&scene, grid, &pace)?;
        let drawn = picture(&map, &title).render()?;
        Ok(Mapped { map, drawn })
    });
    bar.finish_and_clear();
    mapped.unwrap_or_else(|signal| Err(CliError::Stopped { signal }))
}
