//! Contenders on their way.

use std::time::Instant;

use articulated_fluid::Configuration;
use dvi::{Pilot, State};
use sim::{BoxedIntegrator, Clock, Due};

use super::{Contender, Cost, Failure, Problem, Setting};
use crate::baseline::{Motion, Tolerance};

impl Contender {
    /// The integrator of a contender that takes steps of one size; `None` of any other.
    pub fn integrator(self, problem: &Problem) -> Option<BoxedIntegrator<Configuration>> {
        self.fixed(problem).map(|(integrator, _)| integrator)
    }

    /// The same, with its evaluations in a step that its reports do not count.
    fn fixed(self, problem: &Problem) -> Option<(BoxedIntegrator<Configuration>, u64)> {
        let Problem { model, start, .. } = problem;
        match self {
            Self::Structure(method) => Some((method.integrator(model.clone()), 0)),
            Self::Pilot => None,
            Self::Baseline(baseline) => {
                Some((baseline.integrator(model, start)?, baseline.stages() as u64))
            }
        }
    }

    fn misused(self, setting: Setting) -> Failure {
        Failure::Control {
            name: self.name(),
            given: setting.to_string(),
        }
    }

    /// Runs to the end without looking at what is between.
    ///
    /// # Errors
    /// [`Failure`].
    pub fn run(self, problem: &Problem, setting: Setting) -> Result<Cost, Failure> {
        let mut run = Run::begin(self, problem, setting)?;
        let begin = Instant::now();
        run.at(1, 1)?;
        let time = begin.elapsed();
        Ok(Cost { time, ..run.cost() })
    }

    /// The states at $k T / n$ for $k = 0, \dots, n$, with the end $T$ and $n$ = `samples`.
    ///
    /// The steps are those of [`run`](Self::run). A sample inside a step is a shorter step of the method, not interpolated.
    ///
    /// # Errors
    /// [`Failure`].
    pub fn sample(
        self,
        problem: &Problem,
        setting: Setting,
        samples: u64,
    ) -> Result<Vec<State<Configuration>>, Failure> {
        let mut run = Run::begin(self, problem, setting)?;
        let n = samples.max(1);
        (0..=samples).map(|k| run.at(k, n)).collect()
    }
}

/// A run on its way.
enum Run<'a> {
    Fixed(Walk<'a>),
    Adaptive(Motion, &'a Problem),
}

impl<'a> Run<'a> {
    fn begin(
        contender: Contender,
        problem: &'a Problem,
        setting: Setting,
    ) -> Result<Self, Failure> {
        let (model, start, until) = (&problem.model, &problem.start, problem.until);
        let misused = || contender.misused(setting);
        match (contender, setting) {
            (_, Setting::Steps(steps)) => {
                let fixed = contender.fixed(problem).ok_or_else(misused)?;
                Ok(Self::Fixed(Walk::new(problem, steps, fixed)))
            }
            (Contender::Pilot, Setting::Accuracy(accuracy)) => {
                let pilot = Pilot::run(model, start, until, accuracy)?;
                // A whole number but for rounding; of a long run only the beginning was tried, and its steps get no longer.
                let steps = (until / pilot.h - 1e-6).ceil() as u64;
                let fixed = (pilot.integrator(model.clone()), 0);
                Ok(Self::Fixed(Walk::new(problem, steps, fixed)))
            }
            (Contender::Baseline(baseline), Setting::Tolerance(tolerance)) => {
                let tolerance = Tolerance::uniform(tolerance);
                let motion = baseline.motion(model, start, until, tolerance);
                Ok(Self::Adaptive(motion.ok_or_else(misused)??, problem))
            }
            _ => Err(misused()),
        }
    }

    /// The state at $k T / n$, not before the last one asked for.
    fn at(&mut self, k: u64, n: u64) -> Result<State<Configuration>, Failure> {
        match self {
            Self::Fixed(walk) => walk.at(k, n),
            Self::Adaptive(motion, problem) => Ok(motion.at(problem.time(k, n))?.clone()),
        }
    }

    /// The cost so far, but for the time.
    fn cost(&self) -> Cost {
        match self {
            Self::Fixed(walk) => walk.cost(),
            Self::Adaptive(motion, _) => {
                let work = motion.work();
                Cost {
                    steps: work.accepted as u64,
                    evaluations: work.evaluations as u64,
                    ..Cost::default()
                }
            }
        }
    }
}

/// Steps of one size.
struct Walk<'a> {
    run: sim::Run<BoxedIntegrator<Configuration>>,
    problem: &'a Problem,
    /// In a step, beside those that are reported.
    evaluations: u64,
}

impl<'a> Walk<'a> {
    fn new(
        problem: &'a Problem,
        steps: u64,
        (integrator, evaluations): (BoxedIntegrator<Configuration>, u64),
    ) -> Self {
        let clock = Clock::counted(steps, problem.until / steps as f64);
        Self {
            run: sim::Run::new(integrator, problem.start.clone(), clock),
            problem,
            evaluations,
        }
    }

    fn at(&mut self, k: u64, n: u64) -> Result<State<Configuration>, Failure> {
        let clock = self.run.clock();
        // In integers, so that a sample at a step's end is that step's.
        let position = u128::from(k) * u128::from(clock.steps());
        let (whole, rest) = (position / u128::from(n), position % u128::from(n));
        let due = Due {
            steps: whole as u64,
            ahead: clock.step() * rest as f64 / n as f64,
            t: self.problem.time(k, n),
        };
        self.run.advance(due.steps)?;
        Ok(self.run.look(&due)?)
    }

    fn cost(&self) -> Cost {
        let sim::Cost {
            steps,
            iterations,
            evaluations,
            ..
        } = *self.run.cost();
        Cost {
            steps,
            evaluations: steps * self.evaluations + evaluations,
            iterations,
            ..Cost::default()
        }
    }
}
