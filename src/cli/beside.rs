//! The same scene by a second method, for the eye.

use articulated_fluid::Scene;
use sim::{Choice, Method, Plan, Schedule, Simulation};
#[cfg(feature = "chart")]
use study::{baseline::Baseline, contender::Contender};
use view::{Recording, facts};

use super::error::CliError;
use super::scene::Loaded;

/// A second method.
#[derive(Clone, Copy, Debug)]
pub enum Beside {
    /// One that keeps the structure, in steps of its own.
    Structure(Method),
    /// An explicit one.
    #[cfg(feature = "chart")]
    Explicit(&'static Baseline),
}

/// A second motion.
pub struct Second {
    pub recording: Recording,
    pub facts: String,
}

#[cfg(feature = "chart")]
impl TryFrom<Contender> for Beside {
    type Error = &'static str;

    fn try_from(contender: Contender) -> Result<Self, Self::Error> {
        match contender {
            Contender::Structure(method) => Ok(Self::Structure(method)),
            Contender::Baseline(baseline) => Ok(Self::Explicit(baseline)),
            _ => Err("it has no step of its own; give a method of `lgvi methods`"),
        }
    }
}

/// A second method by its name; help and errors tell them all.
pub fn beside() -> impl clap::builder::TypedValueParser<Value = Beside> {
    use clap::builder::TypedValueParser;
    #[cfg(feature = "chart")]
    return super::contenders::contender().try_map(Beside::try_from);
    #[cfg(not(feature = "chart"))]
    super::args::method().map(Beside::Structure)
}

impl Beside {
    pub fn name(self) -> &'static str {
        match self {
            Self::Structure(method) => method.name(),
            #[cfg(feature = "chart")]
            Self::Explicit(baseline) => baseline.name,
        }
    }

    /// Refuses what an explicit method cannot do, before a run begins.
    #[cfg(feature = "chart")]
    pub fn check(self, loaded: &Loaded, until: f64) -> Result<(), CliError> {
        match self {
            Self::Structure(_) => Ok(()),
            Self::Explicit(_) => loaded.check_methods(until),
        }
    }

    /// There is none.
    #[cfg(not(feature = "chart"))]
    pub fn check(self, _: &Loaded, _: f64) -> Result<(), CliError> {
        Ok(())
    }

    /// The scene's motion by this method beside a run, with a frame at each of its times.
    pub fn record(
        self,
        scene: &Scene,
        run: &Simulation,
        times: impl ExactSizeIterator<Item = f64>,
    ) -> Result<Second, CliError> {
        match self {
            Self::Structure(method) => structure(scene, method, (run.clock().until(), times.len())),
            #[cfg(feature = "chart")]
            Self::Explicit(baseline) => explicit::record(scene, baseline, run, times),
        }
    }
}

fn structure(
    scene: &Scene,
    method: Method,
    (until, frames): (f64, usize),
) -> Result<Second, CliError> {
    let plan = Plan {
        choice: Choice::from(method),
        until,
        schedule: Schedule::Seconds(until / frames.max(2) as f64),
        ..Plan::default()
    };
    let mut simulation = Simulation::new(scene, &plan)?;
    let mut recording = Recording::new(simulation.model());
    for frame in simulation.by_ref() {
        recording.add(&frame?);
    }
    let facts = facts(&simulation.report());
    Ok(Second { recording, facts })
}

#[cfg(feature = "chart")]
mod explicit {
    use std::fmt::Display;

    use sim::number::{decimal, three_digits};
    use sim::{Clock, Due, Frame, Run};
    use study::baseline::Tolerance;

    use super::*;

    /// What general-purpose codes take unless told otherwise.
    const TOLERANCE: Tolerance = Tolerance {
        relative: 1e-3,
        absolute: 1e-6,
    };

    /// By its own step control, or in steps of the run's size. What fails on the way ends there, and is told.
    pub fn record(
        scene: &Scene,
        baseline: &Baseline,
        run: &Simulation,
        times: impl Iterator<Item = f64>,
    ) -> Result<Second, CliError> {
        let (model, start) = (
            run.model(),
            scene.initial_state().map_err(sim::SimError::from)?,
        );
        let (until, step) = (run.clock().until(), run.clock().step());
        let mut recording = Recording::new(model);
        let (how, ended) = match baseline.motion(model, &start, until, TOLERANCE) {
            Some(motion) => {
                let how = format!("relative tolerance {:e}", TOLERANCE.relative);
                let mut motion = motion.map_err(told)?;
                let ended = fill(&mut recording, times, |t| {
                    let state = motion.at(t).map_err(text)?.clone();
                    Frame::new(model, state).map_err(text)
                });
                (how, ended)
            }
            None => {
                let clock = Clock::new(until, step)?;
                let integrator = baseline.integrator(model, &start);
                let integrator = integrator.ok_or_else(|| told("it has no steps"))?;
                let mut run = Run::new(integrator, start, clock);
                let how = format!("steps of {} s", three_digits(clock.step()));
                let ended = fill(&mut recording, times, |t| {
                    let due = Due::at(&clock, t);
                    run.advance(due.steps).map_err(text)?;
                    let state = run.look(&due).map_err(text)?;
                    Frame::new(model, state).map_err(text)
                });
                (how, ended)
            }
        };
        let ended = ended.map_or(String::new(), |(t, why)| {
            format!(", ended at t = {} s: {why}", decimal(t))
        });
        let facts = format!("order {}, {how}{ended}", baseline.order());
        Ok(Second { recording, facts })
    }

    /// Records frames until one fails; then when and why.
    fn fill(
        recording: &mut Recording,
        times: impl Iterator<Item = f64>,
        mut frame: impl FnMut(f64) -> Result<Frame, String>,
    ) -> Option<(f64, String)> {
        for t in times {
            match frame(t) {
                Ok(frame) => recording.add(&frame),
                Err(why) => return Some((t, why)),
            }
        }
        None
    }

    fn text(error: impl Display) -> String {
        error.to_string()
    }

    fn told(error: impl Display) -> CliError {
        CliError::Beside(error.to_string())
    }
}
