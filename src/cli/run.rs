//! `lgvi run`: simulates a scene.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use articulated_fluid::scene;
use sim::file::{AtomicFile, CompleteFile, FileError};
use sim::table::{COLUMNS, Column};
use sim::{Choice, Frame, Method, Plan, Schedule, SimError, Simulation, Table};

use super::args;
use super::error::CliError;
use super::interrupt::Interrupt;
use super::output;
use super::print;
use super::progress;
use super::scene::{Loaded, load};
use super::summary::{Origin, Summary};

/// Simulate a scene, and tell how well the motion's constants were kept.
///
/// Steps the scene's bodies from t = 0 with a Lie group variational integrator, and ends with a summary: the
/// cost of a step and the errors of energy, momenta and rotations. With --out the trajectory becomes a CSV file.
#[derive(clap::Args)]
#[command(after_long_help = after_long_help())]
pub struct Args {
    /// The scene, a TOML file [default: three bodies, from Lee, Leok & McClamroch (2009)]
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Simulated time, in seconds
    #[arg(long, value_name = "SECONDS", default_value = "100", value_parser = args::seconds, allow_hyphen_values = true)]
    until: f64,
    /// The integrator; see `lgvi methods` [default: lgvi for the paper's scene; with a --step lgvi or composition-2; else as --accuracy 1e-6 chooses]
    #[arg(long, value_name = "NAME", value_parser = args::method())]
    method: Option<Method>,
    /// Step size, in seconds; a little shorter where whole steps would not end at --until [default: the method's, as the scene's motion asks for]
    #[arg(long, value_name = "SECONDS", value_parser = args::seconds, allow_hyphen_values = true)]
    step: Option<f64>,
    /// Let a rehearsal choose Gauss collocation's stages and step: the attitudes' error, in radians, and the position's, in metres, until the end
    #[arg(long, value_name = "ERROR", value_parser = args::accuracy, allow_hyphen_values = true, conflicts_with_all = ["method", "step"])]
    accuracy: Option<f64>,
    /// Estimate the trajectory's error by runs in steps twice and four times as long; needless with --accuracy
    #[arg(long)]
    estimate: bool,
    /// Write the trajectory to this CSV file: whole, or not at all
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Write all columns to the CSV file: also the bodies' places, the head's velocity, the centre of mass and the angular momentum about it
    #[arg(long, requires = "out")]
    all_columns: bool,
    /// Steps between samples; t = 0 and the end are always sampled
    #[arg(long, value_name = "N", default_value = "10", value_parser = args::count, allow_hyphen_values = true)]
    every: u64,
    /// Seconds between samples, whatever the step; those inside a step are computed by a shorter step of the method, not interpolated
    #[arg(long, value_name = "SECONDS", value_parser = args::seconds, allow_hyphen_values = true, conflicts_with = "every")]
    every_seconds: Option<f64>,
    /// Take no reduction: all coordinates are unknowns and all terms are computed; see `lgvi inspect`
    #[arg(long)]
    full: bool,
    /// Print the summary as one JSON object
    #[arg(long)]
    json: bool,
}

impl Args {
    fn plan(&self, choice: Choice) -> Plan {
        let steps = Schedule::Steps(self.every);
        Plan {
            choice,
            until: self.until,
            schedule: self.every_seconds.map_or(steps, Schedule::Seconds),
            full: self.full,
            estimate: self.estimate,
        }
    }

    /// What was asked for; none where that is left open.
    fn choice(&self, loaded: &Loaded) -> Option<Choice> {
        let (method, step) = (self.method, self.step);
        // By an unsymmetric method of order 1 a stroke that leads nowhere seems to swim.
        let keeps_energy = loaded.smallest.model.keeps_energy();
        let unless_asked = || match keeps_energy {
            true => Method::default(),
            false => DRIVEN.parse().unwrap_or_default(),
        };
        let fixed = || Choice::Method {
            method: method.unwrap_or_else(unless_asked),
            step,
        };
        let is_fixed = method.is_some() || step.is_some();
        let accuracy = self.accuracy.map(Choice::Accuracy);
        accuracy.or_else(|| is_fixed.then(fixed))
    }

    /// The run at t = 0, after the rehearsals of an accuracy.
    fn simulation(&self, loaded: &Loaded) -> Result<Simulation, CliError> {
        let _spinner = progress::waiting("choosing stages and step");
        let begin = |choice| Simulation::new(&loaded.scene, &self.plan(choice));
        match self.choice(loaded) {
            Some(choice) => Ok(begin(choice)?),
            None if loaded.is_papers() => Ok(begin(Choice::default())?),
            None => match begin(Choice::Accuracy(DEFAULT_ACCURACY)) {
                Err(error @ SimError::AccuracyOutOfReach { .. }) => {
                    print::warning(&format!("{error}; taking {FALLBACK} instead"));
                    let method: Result<Method, _> = FALLBACK.parse();
                    Ok(begin(method.unwrap_or_default().into())?)
                }
                begun => Ok(begun?),
            },
        }
    }
}

/// What a scene other than the paper's is run at where nothing is asked for, rad and m.
const DEFAULT_ACCURACY: f64 = 1e-6;
/// What steps a scene that moves as told where only a step is asked for.
const DRIVEN: &str = "composition-2";
/// What it is run with where rounding grows beyond that.
const FALLBACK: &str = "gauss-6";

fn after_long_help() -> String {
    let columns: Vec<_> = COLUMNS
        .iter()
        .map(|column: &Column| {
            let mark = if column.is_extra { "+" } else { "" };
            [mark.to_owned(), column.label(), column.meaning.to_owned()]
        })
        .collect();
    let columns = indented(&print::columns(&columns));
    let (example, keys) = (indented(scene::EXAMPLE), indented(&scene::reference()));
    format!(
        "\
Examples:
  lgvi run                                       the built-in scene for 100 s
  lgvi run --until 10 --out fish.csv             10 s of it, a row every 10 ms
  lgvi run boat.toml --step 0.01 --every 1       a scene of one's own, a row for each step
  lgvi run scenes/planar-fish.toml --full        the same motion without reductions, to compare
  lgvi run --method gauss-4 --every-seconds 0.04 --out film.csv
                                                 order 8 in long steps, 25 rows a second
  lgvi run --accuracy 1e-9                       stages and step as an error of 1e-9 rad and m asks for
  lgvi run --json | jq .energy_error_max_relative

CSV columns, with 17 significant digits; the first row is t = 0, the last one --until.
Those marked + are there with --all-columns:
{columns}
  NAME is the name of a body as in the scene. It may have dots: the column is what follows the last.
  The centre of mass is that of the bodies' own masses, without added mass. Where a body is given by
  total_mass, its own mass is not known: then all bodies count by their total masses, added mass
  included, in the mean of the three axes.

A scene:
{example}
The keys of a scene:
{keys}
A scene that moves in a coordinate plane is stepped in the plane where all numbers out of it are exactly zero; one in a tilted
plane is stepped in space.
Nothing acts but weight, buoyancy, springs, motors and dampers in joints, joints that move as told, drag and thrust: other forces
take the library. Hinge angles have no limits. What moves as told, motors and drag do work: then the summary tells how well
energy less work is kept. A scene of that kind is stepped by composition-2 where only a --step is given. Under a net weight the bodies speed up, and the energy error grows with their speed: that of lgvi in proportion
to step and time.
With --accuracy stages and step are found before the run and then fixed: a step that follows the motion would give up the
symplectic form, and the bounded energy error with it. A rehearsal goes to --until beside a second run in steps a quarter longer.
Their difference is the estimated error: no bound. Where it is too large the rehearsal begins again with shorter steps, and
where rounding leaves no step, the run is refused. All of it takes at least twice as many steps again as the run.
Without --method, --step and --accuracy the paper's scene is run by lgvi in steps of 0.001 s, and any other at an accuracy of 1e-6;
`--method lgvi --step 0.001` takes the paper's for any scene. A method's default step is the one of `lgvi methods`, doubled or
halved as a rough run finds the scene slower or faster than the paper's, and halved where the first steps are not solved.
Where one is not solved later, the run goes on from there in steps of half the size, and the summary says so.
The errors of energy, momenta and rotations are over all steps, whatever is sampled. A small one tells little of the trajectory:
--estimate does, by two more runs.

Exit codes:
  0    done
  1    the run or a write failed, that of the summary too; no CSV file is left, an old one is as it was
  2    an argument or the scene is wrong
  130  interrupted (143: terminated, 129: hung up); as 1, the second time at once"
    )
}

fn indented(text: &str) -> String {
    let line = |line: &str| format!("  {line}").trim_end().to_owned() + "\n";
    text.lines().map(line).collect()
}

/// Simulates the scene and prints the summary.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let loaded = load(args.scene.as_deref())?;
    loaded.warn_of_overlaps();
    let simulation = args.simulation(&loaded)?;
    // Before there is a file that an early signal would leave behind.
    let interrupt = Interrupt::listen().map_err(CliError::Signals)?;
    let csv = Csv::begin(args)?;
    let rows = csv
        .as_ref()
        .map(|csv| csv.rows(args, &loaded))
        .transpose()?;
    let simulation = simulate(simulation, rows, &interrupt)?;
    let csv = csv.map(Csv::complete).transpose()?;
    let is_default = args.step.is_none() && args.accuracy.is_none();
    let is_chosen = args.choice(&loaded).is_none() && !loaded.is_papers();
    let origin = Origin {
        step_is_default: is_default,
        is_chosen,
    };
    let summary = Summary::new(&simulation, &loaded.file, args.out.as_deref(), origin);
    print::stdout(&match args.json {
        true => print::json(&summary)?,
        false => summary.text(),
    })?;
    // Last: a command that fails leaves the old table.
    csv.map_or(Ok(()), CompleteCsv::place)
}

/// Goes to the end, or to a signal.
fn simulate(
    simulation: Simulation,
    mut rows: Option<Rows>,
    interrupt: &Interrupt,
) -> Result<Simulation, CliError> {
    let steps = simulation.clock().steps();
    let bar = progress::bar(steps, "{bar:40} {percent:>3}%, {eta} left");
    let (mut simulation, shown) = (simulation, bar.clone());
    let reached = Arc::new(Mutex::new(0.0));
    let reach = reached.clone();
    let done = interrupt.heeding(move || {
        while !simulation.is_done() {
            let frame = simulation.advance()?;
            if let (Some(rows), Some(frame)) = (&mut rows, frame) {
                rows.write(&frame)?;
            }
            shown.set_length(simulation.clock().steps());
            shown.set_position(simulation.steps());
            *reach.lock().unwrap_or_else(PoisonError::into_inner) = simulation.state().t;
        }
        rows.map_or(Ok(()), Rows::end)?;
        Ok(simulation)
    });
    bar.finish_and_clear();
    let t = *reached.lock().unwrap_or_else(PoisonError::into_inner);
    done.unwrap_or_else(|signal| Err(CliError::Interrupted { t, signal }))
}

/// The trajectory's file in the making.
struct Csv {
    path: PathBuf,
    file: AtomicFile,
}

impl Csv {
    /// Begins it, if there is to be one: what is wrong with it shows before the run.
    fn begin(args: &Args) -> Result<Option<Self>, CliError> {
        let Some(path) = args.out.as_deref() else {
            return Ok(None);
        };
        if path.extension().is_some_and(is_of_another_format) {
            return Err(CliError::OutputFormat(path.to_owned()));
        }
        let file = output::begin(path, args.scene.as_deref())?;
        let path = path.to_owned();
        Ok(Some(Self { path, file }))
    }

    /// What writes it, beside.
    fn rows(&self, args: &Args, loaded: &Loaded) -> Result<Rows, CliError> {
        let table = self.file.handle().and_then(|file| {
            let file = BufWriter::new(file);
            match args.all_columns {
                true => Table::with_all_columns(file, &loaded.scene),
                false => Table::new(file, &loaded.scene),
            }
        });
        let path = self.path.clone();
        match table {
            Ok(table) => Ok(Rows { path, table }),
            Err(error) => Err(CliError::output(&path, error.into())),
        }
    }

    fn complete(self) -> Result<CompleteCsv, CliError> {
        let path = self.path;
        match self.file.complete() {
            Ok(file) => Ok(CompleteCsv { path, file }),
            Err(source) => Err(CliError::output(&path, source)),
        }
    }
}

/// The trajectory on its way to the file.
struct Rows {
    path: PathBuf,
    table: Table<BufWriter<File>>,
}

impl Rows {
    fn write(&mut self, frame: &Frame) -> Result<(), CliError> {
        let written = self.table.row(frame).map_err(FileError::from);
        written.map_err(|source| CliError::output(&self.path, source))
    }

    fn end(self) -> Result<(), CliError> {
        let written = self.table.into_inner().flush().map_err(FileError::from);
        written.map_err(|source| CliError::output(&self.path, source))
    }
}

/// The trajectory's file, whole and not yet in its place.
struct CompleteCsv {
    path: PathBuf,
    file: CompleteFile,
}

impl CompleteCsv {
    fn place(self) -> Result<(), CliError> {
        let placed = self.file.place();
        placed.map_err(|source| CliError::output(&self.path, source))
    }
}

/// Whether a name that ends so promises what is no table.
fn is_of_another_format(ending: &OsStr) -> bool {
    let others = ["html", "htm", "json", "svg", "png", "pdf", "toml"];
    others
        .iter()
        .any(|other| ending.eq_ignore_ascii_case(other))
}
