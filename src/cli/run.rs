//! `lgvi run`: simulates a scene.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use articulated_fluid::scene;
use sim::table::{COLUMNS, Column};
use sim::{Schedule, Simulation};

use super::args;
use super::beside::{Beside, beside};
use super::error::CliError;
use super::interrupt::Interrupt;
use super::outputs::{Extras, Format, Outputs, Writers};
use super::print;
use super::progress;
use super::scene::{Loaded, load};
use super::settings::Settings;
use super::summary::{Origin, Summary};

/// Simulate a scene, and tell how well the motion's constants were kept.
///
/// Steps the scene's bodies from t = 0 with a Lie group variational integrator. It ends with a summary: the
/// cost of a step and the errors of energy, momenta and rotations. With --out the run becomes a table, a moving picture, or both.
#[derive(clap::Args)]
#[command(after_long_help = after_long_help())]
pub struct Args {
    #[command(flatten)]
    settings: Settings,
    /// Estimate the trajectory's error by runs in steps twice and four times as long; needless with --accuracy
    #[arg(long)]
    estimate: bool,
    /// Write the run to this file, whole or not at all; may be given several times. Its ending chooses: .csv a table, .html a page with a moving picture, .glb glTF for editors, .npz NumPy arrays
    #[arg(long, value_name = "FILE")]
    out: Vec<PathBuf>,
    /// Write all columns to the CSV file: also the bodies' places, the head's velocity, the centre of mass and the angular momentum about it
    #[arg(long, requires = "out")]
    all_columns: bool,
    /// Show the same scene by a second method on the page, an explicit one in the run's steps or at a relative tolerance of 1e-3
    #[arg(long, value_name = "METHOD", value_parser = beside(), requires = "out", hide_possible_values = true)]
    beside: Option<Beside>,
    /// Steps between samples; t = 0 and the end are always sampled [default: 10; with .html or .glb, 2500 samples over the run]
    #[arg(long, value_name = "N", value_parser = args::count, allow_hyphen_values = true)]
    every: Option<u64>,
    /// Seconds between samples, whatever the step; those inside a step are computed by a shorter step of the method, not interpolated
    #[arg(long, value_name = "SECONDS", value_parser = args::seconds, allow_hyphen_values = true, conflicts_with = "every")]
    every_seconds: Option<f64>,
    /// Print the summary as one JSON object
    #[arg(long)]
    json: bool,
}

impl Args {
    fn schedule(&self) -> Schedule {
        let is_seen = |path: &PathBuf| Format::of(path).is_ok_and(Format::is_seen);
        match (self.every_seconds, self.every) {
            (Some(seconds), _) => Schedule::Seconds(seconds),
            (_, Some(steps)) => Schedule::Steps(steps),
            _ if self.out.iter().any(is_seen) => seen(self.settings.until),
            _ => Schedule::Steps(EVERY),
        }
    }

    /// A second method needs a page, and something to solve.
    fn check_beside(&self, loaded: &Loaded) -> Result<(), CliError> {
        let is_page = |path: &PathBuf| matches!(Format::of(path), Ok(Format::Page));
        match self.beside.is_some() && !self.out.iter().any(is_page) {
            true => Err(CliError::BesideWithoutPage),
            false => self
                .beside
                .map_or(Ok(()), |beside| beside.check(loaded, self.settings.until)),
        }
    }
}

/// Steps between samples.
const EVERY: u64 = 10;
/// Frames of a run that is looked at.
const FRAMES: f64 = 2500.0;

/// So many frames that the motion between two of them is smooth to the eye.
pub fn seen(until: f64) -> Schedule {
    Schedule::Seconds(until / FRAMES)
}

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
  lgvi run --out fish.html --out fish.glb        a moving picture for the browser, and one for editors
  lgvi run --out fish.html --beside dp54         two motions in one picture
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

Other files: .html is one page without network; drag, wheel, space and arrows move it. It has at most 3000 samples, attitudes to 3e-4 rad and
the head's place to a millionth of its way. Bodies without a shape are drawn as ellipsoids of their inertia. A second motion by --beside
is a ghost in the same picture and has dashed curves. .glb is glTF 2.0 with as many samples. .npz has all samples as doubles: `t`, `position`,
`velocity`, `attitude` (matrices), `angular_velocity`, `centre`, `hinge` (angle, rate), `work`, `energy`, `momentum`, `angular_momentum`,
`orthogonality`, and the names in `bodies`, `hinges`, `drives`.

A scene:
{example}
The keys of a scene:
{keys}
A scene that moves in a coordinate plane is stepped in the plane where all numbers out of it are exactly zero; one in a tilted
plane is stepped in space.
Nothing acts but weight, buoyancy and what has keys above: other forces take the library. Hinge angles have no limits. What moves
as told and loads do work: then the summary tells how well energy less work is kept. A scene of that kind is stepped by composition-2 where only a --step is given. Under a net weight the bodies speed up, and the energy error grows with their speed: that of lgvi in proportion
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
  1    the run or a write failed, that of the summary too; no file is left, an old one is as it was
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
    let (settings, scene) = (&args.settings, args.settings.scene.as_deref());
    let loaded = load(scene)?;
    loaded.warn_of_overlaps();
    args.check_beside(&loaded)?;
    let simulation = settings.simulation(&loaded, args.schedule(), args.estimate)?;
    // Before there is a file that an early signal would leave behind.
    let interrupt = Interrupt::listen().map_err(CliError::Signals)?;
    let outputs = Outputs::begin(&args.out, scene)?;
    let extras = Extras {
        all_columns: args.all_columns,
        beside: args.beside,
    };
    let writers = outputs.writers(&loaded, &simulation, extras)?;
    let simulation = simulate(simulation, writers, &interrupt)?;
    let outputs = outputs.complete()?;
    let is_default = settings.step.is_none() && settings.accuracy.is_none();
    let is_chosen = settings.choice(&loaded).is_none() && !loaded.is_papers();
    let origin = Origin {
        step_is_default: is_default,
        is_chosen,
    };
    let summary = Summary::new(&simulation, &loaded.file, &args.out, origin);
    print::stdout(&match args.json {
        true => print::json(&summary)?,
        false => summary.text(),
    })?;
    // Last: a command that fails leaves the old files.
    outputs.place()
}

/// Goes to the end, or to a signal.
pub fn simulate(
    simulation: Simulation,
    mut writers: Writers,
    interrupt: &Interrupt,
) -> Result<Simulation, CliError> {
    let steps = simulation.clock().steps();
    let bar = progress::bar(steps, "{bar:40} {percent:>3}%, {eta} left");
    let (mut simulation, shown) = (simulation, bar.clone());
    let reached = Arc::new(Mutex::new(0.0));
    let reach = reached.clone();
    let done = interrupt.heeding(move || {
        while !simulation.is_done() {
            if let Some(frame) = simulation.advance()? {
                writers.write(&frame)?;
            }
            shown.set_length(simulation.clock().steps());
            shown.set_position(simulation.steps());
            *reach.lock().unwrap_or_else(PoisonError::into_inner) = simulation.state().t;
        }
        writers.end(&simulation)?;
        Ok(simulation)
    });
    bar.finish_and_clear();
    let t = *reached.lock().unwrap_or_else(PoisonError::into_inner);
    done.unwrap_or_else(|signal| Err(CliError::Interrupted { t, signal }))
}
