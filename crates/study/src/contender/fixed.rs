//! Contenders of a fixed step.

use articulated_fluid::Configuration;
use dvi::State;
use sim::BoxedIntegrator;

use super::problem::timed;
use super::{Contender, Cost, Failure, Problem, Setting};
use crate::explicit::{ClassicalRungeKutta, GroupRungeKutta, STAGES, Scheme};

impl Contender {
    /// The integrator of a contender that takes steps of one size; `None` of an adaptive one.
    pub fn integrator(self, problem: &Problem) -> Option<BoxedIntegrator<Configuration>> {
        let model = problem.model.clone();
        Some(match self {
            Self::Structure(method) => method.integrator(model),
            Self::Rk4 => Box::new(ClassicalRungeKutta::new(model, &problem.start)),
            Self::Rkmk4 => Box::new(GroupRungeKutta::new(model, Scheme::MuntheKaas)),
            Self::Rkmk4Plain => Box::new(GroupRungeKutta::new(model, Scheme::WithoutDexp)),
            Self::Cf4 => Box::new(GroupRungeKutta::new(model, Scheme::CommutatorFree)),
            Self::Pilot | Self::Dp54 | Self::Dp853 => return None,
        })
    }

    /// Evaluations in `steps` steps that took `iterations` of the solver.
    fn evaluations(self, steps: u64, iterations: u64) -> u64 {
        match self {
            Self::Structure(method) => iterations * u64::from(method.evaluations_per_iteration()),
            _ => steps * u64::from(STAGES),
        }
    }
}

pub(super) fn run(contender: Contender, problem: &Problem, steps: u64) -> Result<Cost, Failure> {
    let mut cost = Walk::new(contender, problem, steps)?.run(steps)?;
    cost.evaluations = contender.evaluations(steps, cost.iterations);
    Ok(cost)
}

pub(super) fn sample(
    contender: Contender,
    problem: &Problem,
    steps: u64,
    samples: u64,
) -> Result<Vec<State<Configuration>>, Failure> {
    Walk::new(contender, problem, steps)?.sample((problem.until, steps), samples)
}

/// A run on its way.
pub(super) struct Walk {
    integrator: BoxedIntegrator<Configuration>,
    state: State<Configuration>,
    h: f64,
    done: u64,
    iterations: u64,
}

impl Walk {
    fn new(contender: Contender, problem: &Problem, steps: u64) -> Result<Self, Failure> {
        let misused = || contender.misused(Setting::Steps(steps));
        let integrator = contender.integrator(problem).ok_or_else(misused)?;
        Ok(Self::with(integrator, problem, steps))
    }

    pub(super) fn with(
        integrator: BoxedIntegrator<Configuration>,
        problem: &Problem,
        steps: u64,
    ) -> Self {
        Self {
            integrator,
            state: problem.start.clone(),
            h: problem.until / steps as f64,
            done: 0,
            iterations: 0,
        }
    }

    /// The cost of so many steps, but for the evaluations.
    pub(super) fn run(&mut self, steps: u64) -> Result<Cost, Failure> {
        let (outcome, time) = timed(|| self.to(steps));
        outcome?;
        Ok(Cost {
            time,
            steps,
            evaluations: 0,
            iterations: self.iterations,
        })
    }

    /// The states at the samples of a run of so many steps.
    pub(super) fn sample(
        &mut self,
        (until, steps): (f64, u64),
        samples: u64,
    ) -> Result<Vec<State<Configuration>>, Failure> {
        let mut states = vec![self.state.clone()];
        for k in 1..=samples {
            // In integers, so that a sample at a step's end is that step's.
            let position = u128::from(k) * u128::from(steps);
            let (whole, rest) = (
                position / u128::from(samples),
                position % u128::from(samples),
            );
            self.to(u64::try_from(whole).unwrap_or(steps))?;
            let mut state = match rest {
                0 => self.state.clone(),
                rest => {
                    let ahead = self.h * rest as f64 / samples as f64;
                    self.integrator.peek(&self.state, ahead)?
                }
            };
            state.t = until * k as f64 / samples as f64;
            states.push(state);
        }
        Ok(states)
    }

    /// Steps until `steps` are done.
    fn to(&mut self, steps: u64) -> Result<(), Failure> {
        for _ in self.done..steps {
            let report = self.integrator.step(&mut self.state, self.h)?;
            self.iterations += u64::from(report.iterations);
        }
        self.done = steps;
        Ok(())
    }
}
