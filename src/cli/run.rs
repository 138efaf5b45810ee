//! `lgvi run`: simulates a scene.

use std::fs;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use articulated_fluid::{ArticulatedBody, Configuration, scene};
use dvi::{Integrator, State, StepReport, Variational};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};

use super::args;
use super::clock::Clock;
use super::error::CliError;
use super::interrupt::Interrupt;
use super::output::{Output, OutputError};
use super::print;
use super::sample::{Sample, Watch};
use super::scene::{Loaded, load};
use super::summary::Summary;
use super::table::{COLUMNS, Table};

const METHOD: &str = "Lie group variational integrator";

/// Steps after which the progress bar moves and interrupts are noticed, at the latest.
const CHUNK: u64 = 1000;

/// Simulate a scene, and tell how well the motion's constants were kept.
///
/// Steps the scene's bodies from t = 0 with the Lie group variational integrator, and ends with a summary: the
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
    /// Step size, in seconds; a little shorter where whole steps would not end at --until
    #[arg(long, value_name = "SECONDS", default_value = "0.001", value_parser = args::seconds, allow_hyphen_values = true)]
    step: f64,
    /// Write the trajectory to this CSV file: whole, or not at all
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Steps between samples; t = 0 and the end are always sampled
    #[arg(long, value_name = "N", default_value = "10", value_parser = args::count, allow_hyphen_values = true)]
    every: u64,
    /// Print the summary as one JSON object
    #[arg(long)]
    json: bool,
}

fn after_long_help() -> String {
    let keys: String = scene::reference()
        .lines()
        .map(|line| format!("  {line}\n"))
        .collect();
    let example: String = scene::EXAMPLE
        .lines()
        .map(|line| format!("  {line}\n").replace("  \n", "\n"))
        .collect();
    format!(
        "\
Examples:
  lgvi run                                       the built-in scene for 100 s
  lgvi run --until 10 --out fish.csv             10 s of it, a row every 10 ms
  lgvi run boat.toml --step 0.01 --every 1       a scene of one's own, a row for each step
  lgvi run --json | jq .energy_error_max_relative

CSV columns, with 17 significant digits; the first row is t = 0, the last one --until:
{COLUMNS}

A scene:
{example}
The keys of a scene:
{keys}
Exit codes:
  0    done
  1    the run or a write failed; no CSV file is left, an old one is as it was
  2    an argument or the scene is wrong
  130  interrupted (143: terminated); as 1"
    )
}

/// Simulates the scene and prints the summary.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let loaded = load(args.scene.as_deref())?;
    let clock = Clock::new(args.until, args.step)?;
    // Before there is a file that an early signal would leave behind.
    let interrupt = Interrupt::listen().map_err(CliError::Signals)?;
    let table = open(args, &loaded)?;
    let mut integrator = Variational::with_inertia(loaded.model.clone());
    let order = integrator.order();
    let mut run = Run::new(args, clock, &loaded, table, interrupt)?;
    run.simulate(&mut integrator)?;
    let summary = run.summary(args, &loaded, order);
    run.finish()?;
    let text = match args.json {
        true => summary.json()?,
        false => summary.text(),
    };
    print::stdout(&text)
}

/// Begins the CSV file: what is wrong with it shows before the run.
fn open(args: &Args, loaded: &Loaded) -> Result<Option<Table<Output>>, CliError> {
    let Some(path) = &args.out else {
        return Ok(None);
    };
    if args.scene.as_ref().is_some_and(|scene| same(scene, path)) {
        return Err(CliError::OutputIsScene(path.clone()));
    }
    let table = Output::create(path).and_then(|output| Ok(Table::new(output, &loaded.scene)?));
    table.map(Some).map_err(|source| refused(path, source))
}

fn same(a: &Path, b: &Path) -> bool {
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}

fn refused(path: &Path, source: OutputError) -> CliError {
    CliError::Output {
        path: path.to_owned(),
        source,
    }
}

/// A run in progress.
struct Run<'a> {
    clock: Clock,
    every: u64,
    out: Option<(&'a Path, Table<Output>)>,
    model: &'a ArticulatedBody,
    state: State<Configuration>,
    done: u64,
    solver: Solver,
    watch: Watch,
    interrupt: Interrupt,
}

/// What the steps cost.
#[derive(Default)]
struct Solver {
    time: Duration,
    iterations: u64,
    most_iterations: u32,
    residual: f64,
}

impl Solver {
    fn add(&mut self, report: StepReport) {
        self.iterations += u64::from(report.iterations);
        self.most_iterations = self.most_iterations.max(report.iterations);
        self.residual = self.residual.max(report.residual);
    }
}

impl<'a> Run<'a> {
    /// The run at t = 0, with the first row written.
    fn new(
        args: &'a Args,
        clock: Clock,
        loaded: &'a Loaded,
        table: Option<Table<Output>>,
        interrupt: Interrupt,
    ) -> Result<Self, CliError> {
        let (model, state) = (&loaded.model, loaded.start.clone());
        let sample = Sample::take(model, &state).ok_or(CliError::NotFinite { t: 0.0 })?;
        let mut run = Self {
            clock,
            every: args.every,
            out: args.out.as_deref().zip(table),
            model,
            state,
            done: 0,
            solver: Solver::default(),
            watch: Watch::new(sample),
            interrupt,
        };
        run.write(&sample)?;
        Ok(run)
    }

    /// Steps and samples to the end.
    fn simulate(
        &mut self,
        integrator: &mut dyn Integrator<Group = Configuration>,
    ) -> Result<(), CliError> {
        let bar = progress_bar(self.clock.steps);
        while self.done < self.clock.steps {
            let sample_at = self.next_sample();
            self.advance(integrator, sample_at.min(self.done + CHUNK))?;
            bar.set_position(self.done);
            if let Some(signal) = self.interrupt.signal() {
                let t = self.state.t;
                return Err(CliError::Interrupted { t, signal });
            }
            if self.done == sample_at {
                self.sample()?;
            }
        }
        Ok(())
    }

    /// The step after which a sample is due.
    fn next_sample(&self) -> u64 {
        let sample = (self.done / self.every + 1).saturating_mul(self.every);
        sample.min(self.clock.steps)
    }

    /// Takes the steps up to number `stop`: only they are timed.
    fn advance(
        &mut self,
        integrator: &mut dyn Integrator<Group = Configuration>,
        stop: u64,
    ) -> Result<(), CliError> {
        let h = self.clock.step();
        let begin = Instant::now();
        for _ in self.done..stop {
            self.solver.add(integrator.step(&mut self.state, h)?);
        }
        self.solver.time += begin.elapsed();
        self.done = stop;
        self.state.t = self.clock.time(stop);
        Ok(())
    }

    fn sample(&mut self) -> Result<(), CliError> {
        let t = self.state.t;
        let sample = Sample::take(self.model, &self.state).ok_or(CliError::NotFinite { t })?;
        self.watch.add(&sample);
        self.write(&sample)
    }

    fn write(&mut self, sample: &Sample) -> Result<(), CliError> {
        let Some((path, table)) = &mut self.out else {
            return Ok(());
        };
        table
            .row(self.model, &self.state, sample)
            .map_err(|error| refused(path, error.into()))
    }

    fn summary(&self, args: &Args, loaded: &Loaded, order: u32) -> Summary {
        let (clock, solver, watch) = (&self.clock, &self.solver, &self.watch);
        let steps = clock.steps as f64;
        Summary {
            title: loaded.scene.title.clone(),
            scene: loaded.file.clone(),
            bodies: loaded.scene.bodies.len(),
            method: METHOD,
            method_order: order,
            steps: clock.steps,
            step_seconds: clock.step(),
            step_asked_seconds: clock.asked,
            step_is_adjusted: clock.is_adjusted(),
            until_seconds: clock.until,
            time_per_step_us: solver.time.as_secs_f64() * 1e6 / steps,
            sample_every_steps: self.every,
            samples: watch.count(),
            energy_initial_joules: watch.initial_energy(),
            energy_error_max_relative: watch.energy_relative(),
            energy_slope_per_second: watch.energy_slope(),
            linear_momentum_deviation_max: watch.linear(),
            angular_momentum_deviation_max: watch.angular(),
            angular_momentum_deviation_max_relative: watch.angular_relative(),
            orthogonality_error_max: watch.orthogonality(),
            solver_residual_max: solver.residual,
            solver_iterations_max: solver.most_iterations,
            solver_iterations_mean: solver.iterations as f64 / steps,
            csv: args.out.as_ref().map(|path| path.display().to_string()),
        }
    }

    /// Puts the CSV file in its place.
    fn finish(self) -> Result<(), CliError> {
        match self.out {
            Some((path, table)) => table
                .into_inner()
                .finish()
                .map_err(|source| refused(path, source)),
            None => Ok(()),
        }
    }
}

/// A bar on a terminal's stderr, and none elsewhere; it goes when it is dropped.
fn progress_bar(steps: u64) -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template("{bar:40} {percent:>3}%, {eta} left");
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        .with_finish(ProgressFinish::AndClear)
}
