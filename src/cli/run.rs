//! `lgvi run`: simulates a scene.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use articulated_fluid::{ArticulatedBody, Configuration, scene};
use dvi::{Integrator, Pilot, State, StepReport};
use study::accuracy;
use study::methods::{BoxedIntegrator, Method};
use study::watch::{Sample, Watch};

use super::args;
use super::clock::Clock;
use super::error::CliError;
use super::interrupt::Interrupt;
use super::output::{Output, OutputError, same};
use super::print;
use super::progress;
use super::scene::{Loaded, load};
use super::schedule::{Due, Schedule};
use super::summary::Summary;
use super::table::{COLUMNS, Table};

/// Steps after which the progress bar moves and interrupts are noticed, at the latest.
const CHUNK: u64 = 100;

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
    /// The integrator; see `lgvi methods`
    #[arg(long, value_name = "NAME", default_value_t = Method::default(), value_parser = args::method())]
    method: Method,
    /// Step size, in seconds; a little shorter where whole steps would not end at --until [default: the method's, 0.001 for lgvi]
    #[arg(long, value_name = "SECONDS", value_parser = args::seconds, allow_hyphen_values = true)]
    step: Option<f64>,
    /// Let a short pilot run choose Gauss collocation's stages and step: the attitudes' error, in radians, and the position's, in metres, by the end
    #[arg(long, value_name = "ERROR", value_parser = args::accuracy, allow_hyphen_values = true, conflicts_with_all = ["method", "step", "full"])]
    accuracy: Option<f64>,
    /// Write the trajectory to this CSV file: whole, or not at all
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
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

/// The method of a run, and the step to take at most.
struct Chosen {
    method: Method,
    step: f64,
    pilot: Option<Pilot>,
}

impl Args {
    /// The method and the step that were asked for, or that a pilot run finds.
    fn choose(&self, loaded: &Loaded) -> Result<Chosen, CliError> {
        let Some(accuracy) = self.accuracy else {
            return Ok(Chosen {
                method: self.method,
                step: self.step.unwrap_or_else(|| self.method.default_step()),
                pilot: None,
            });
        };
        let _spinner = progress::waiting("choosing stages and step");
        let pilot = accuracy::pilot(&loaded.smallest, self.until, accuracy)?;
        Ok(Chosen {
            method: accuracy::method(&pilot),
            step: pilot.h,
            pilot: Some(pilot),
        })
    }

    fn integrator(&self, loaded: &Loaded, chosen: &Chosen) -> BoxedIntegrator<Configuration> {
        let smallest = &loaded.smallest;
        match &chosen.pilot {
            Some(pilot) => accuracy::integrator(smallest, pilot),
            None if self.full => {
                let full = loaded.model.clone().keep_translation();
                chosen.method.integrator(full)
            }
            None => chosen.method.integrator_of_smallest(smallest),
        }
    }

    fn schedule(&self) -> Schedule {
        let steps = Schedule::Steps(self.every);
        self.every_seconds.map_or(steps, Schedule::Seconds)
    }
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
  lgvi run scenes/planar-fish.toml --full        the same motion without reductions, to compare
  lgvi run --method gauss-4 --every-seconds 0.04 --out film.csv
                                                 order 8 in long steps, 25 rows a second
  lgvi run --accuracy 1e-9                       stages and step as an error of 1e-9 rad and m asks for
  lgvi run --json | jq .energy_error_max_relative

CSV columns, with 17 significant digits; the first row is t = 0, the last one --until:
{COLUMNS}

A scene:
{example}
The keys of a scene:
{keys}
A scene that moves in a coordinate plane is stepped in the plane where all numbers out of it are exactly zero; one in a tilted
plane is stepped in space.
Nothing acts but weight, buoyancy and elastic joints: the first body floats free, every joint is a ball joint, at rest, if
it is elastic, where both frames are aligned, and no scene has a fixed base, a hinge, a motor or damping. Forces take the
library. Under a net weight the bodies speed up, and the energy error grows with their speed: that of lgvi in proportion
to step and time.
With --accuracy the step is found before the run and then fixed: one that follows the motion would give up the symplectic
form, and the bounded energy error with it. The error it is chosen by is an estimate, by a run of shorter steps; no bound.
A method's default step suits the motion of the built-in scene; a livelier one needs a shorter --step.

Exit codes:
  0    done
  1    the run or a write failed; no CSV file is left, an old one is as it was
  2    an argument or the scene is wrong
  130  interrupted (143: terminated); as 1, the second time at once"
    )
}

/// Simulates the scene and prints the summary.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let loaded = load(args.scene.as_deref())?;
    loaded.overlaps.iter().for_each(print::warning);
    let chosen = args.choose(&loaded)?;
    let clock = Clock::new(args.until, chosen.step)?;
    args.schedule().check(&clock)?;
    // Before there is a file that an early signal would leave behind.
    let interrupt = Interrupt::listen().map_err(CliError::Signals)?;
    let table = open(args, &loaded)?;
    let mut integrator = args.integrator(&loaded, &chosen);
    let mut run = Run::new(args, clock, &loaded, table, interrupt)?;
    run.simulate(&mut *integrator)?;
    let summary = run.summary(args, &loaded, &chosen);
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
    if path == Path::new("-") {
        return Err(CliError::OutputIsDash);
    }
    if args.scene.as_ref().is_some_and(|scene| same(scene, path)) {
        return Err(CliError::OutputIsScene(path.clone()));
    }
    let table = Output::create(path).and_then(|output| Ok(Table::new(output, &loaded.scene)?));
    table.map(Some).map_err(|source| refused(path, source))
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
    schedule: Schedule,
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
            schedule: args.schedule(),
            out: args.out.as_deref().zip(table),
            model,
            state: state.clone(),
            done: 0,
            solver: Solver::default(),
            watch: Watch::new(model, sample),
            interrupt,
        };
        run.write(&state, &sample)?;
        Ok(run)
    }

    /// Steps and samples to the end.
    fn simulate(
        &mut self,
        integrator: &mut dyn Integrator<Group = Configuration>,
    ) -> Result<(), CliError> {
        let bar = progress::bar(self.clock.steps, "{bar:40} {percent:>3}%, {eta} left");
        for k in 1.. {
            let due = self.schedule.due(&self.clock, k);
            while self.done < due.steps {
                self.advance(integrator, due.steps.min(self.done + CHUNK))?;
                bar.set_position(self.done);
                self.heed_signals()?;
            }
            self.sample(integrator, &due)?;
            self.heed_signals()?;
            if due.steps == self.clock.steps {
                break;
            }
        }
        Ok(())
    }

    fn heed_signals(&self) -> Result<(), CliError> {
        let t = self.state.t;
        match self.interrupt.signal() {
            Some(signal) => Err(CliError::Interrupted { t, signal }),
            None => Ok(()),
        }
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

    fn sample(
        &mut self,
        integrator: &mut dyn Integrator<Group = Configuration>,
        due: &Due,
    ) -> Result<(), CliError> {
        let mut state = match due.ahead {
            0.0 => self.state.clone(),
            ahead => integrator.peek(&self.state, ahead)?,
        };
        state.t = due.t;
        let sample = Sample::take(self.model, &state).ok_or(CliError::NotFinite { t: due.t })?;
        self.watch.add(&sample);
        self.write(&state, &sample)
    }

    fn write(&mut self, state: &State<Configuration>, sample: &Sample) -> Result<(), CliError> {
        let Some((path, table)) = &mut self.out else {
            return Ok(());
        };
        table
            .row(self.model, state, sample)
            .map_err(|error| refused(path, error.into()))
    }

    fn summary(&self, args: &Args, loaded: &Loaded, chosen: &Chosen) -> Summary {
        let (clock, solver, watch) = (&self.clock, &self.solver, &self.watch);
        let (method, steps) = (chosen.method, clock.steps as f64);
        let account = &loaded.smallest.account;
        let iterations = solver.iterations as f64 / steps;
        let (every_steps, every_seconds) = match self.schedule {
            Schedule::Steps(steps) => (Some(steps), None),
            Schedule::Seconds(seconds) => (None, Some(seconds)),
        };
        Summary {
            title: loaded.scene.title.clone(),
            scene: loaded.file.clone(),
            bodies: loaded.scene.bodies.len(),
            group: match args.full {
                true => account.full_group.clone(),
                false => account.group.clone(),
            },
            unknowns: match args.full {
                true => account.full_dimension,
                false => account.unknowns,
            },
            reductions: match args.full {
                true => vec![],
                false => account.taken().collect(),
            },
            method: method.name(),
            method_description: method.description(),
            method_order: method.order(),
            family: method.family(),
            steps: clock.steps,
            step_seconds: clock.step(),
            step_asked_seconds: clock.asked,
            step_is_adjusted: clock.is_adjusted(),
            step_is_default: args.step.is_none() && chosen.pilot.is_none(),
            accuracy_asked: args.accuracy,
            accuracy_estimate: chosen.pilot.map(|pilot| pilot.estimate),
            accuracy_horizon_seconds: chosen.pilot.map(|pilot| pilot.horizon),
            until_seconds: clock.until,
            time_per_step_us: solver.time.as_secs_f64() * 1e6 / steps,
            sample_every_steps: every_steps,
            sample_every_seconds: every_seconds,
            samples: watch.count(),
            energy_initial_joules: watch.initial_energy(),
            energy_error_max_joules: watch.energy(),
            energy_error_max_relative: watch.energy_relative(),
            energy_slope_per_second: watch.energy_slope(),
            gravity_acts: watch.has_weight(),
            linear_momentum_deviation_max: watch.linear(),
            angular_momentum_deviation_max: watch.angular(),
            angular_momentum_deviation_max_relative: watch.angular_relative(),
            orthogonality_error_max: watch.orthogonality(),
            solver_residual_max: solver.residual,
            solver_iterations_max: solver.most_iterations,
            solver_iterations_mean: iterations,
            evaluation: method.evaluation().to_string(),
            evaluations_per_step_mean: iterations * f64::from(method.evaluations_per_iteration()),
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
