//! The contender whose stages and step a pilot run chooses.

use articulated_fluid::Configuration;
use dvi::{Pilot, State};

use super::fixed::Walk;
use super::{Contender, Cost, Failure, Problem, Setting};

/// A method for the problem, and how many steps of it.
fn choose(
    contender: Contender,
    problem: &Problem,
    accuracy: f64,
) -> Result<(Pilot, u64, Walk), Failure> {
    if contender != Contender::Pilot {
        return Err(contender.misused(Setting::Accuracy(accuracy)));
    }
    let Problem {
        model,
        start,
        until,
    } = problem;
    let pilot = Pilot::run(model, start, *until, accuracy)?;
    // A whole number but for rounding; of a long run only the beginning was tried, and its steps get no longer.
    let steps = (until / pilot.h - 1e-6).ceil() as u64;
    let integrator = pilot.integrator(model.clone());
    Ok((pilot, steps, Walk::with(integrator, problem, steps)))
}

/// The cost of the run itself.
pub(super) fn run(contender: Contender, problem: &Problem, accuracy: f64) -> Result<Cost, Failure> {
    let (pilot, steps, mut walk) = choose(contender, problem, accuracy)?;
    let mut cost = walk.run(steps)?;
    cost.evaluations = cost.iterations * pilot.stages as u64;
    Ok(cost)
}

pub(super) fn sample(
    contender: Contender,
    problem: &Problem,
    accuracy: f64,
    samples: u64,
) -> Result<Vec<State<Configuration>>, Failure> {
    let (_, steps, mut walk) = choose(contender, problem, accuracy)?;
    walk.sample((problem.until, steps), samples)
}
