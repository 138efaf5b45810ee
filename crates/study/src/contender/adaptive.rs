//! Contenders that choose their steps.

use articulated_fluid::Configuration;
use dvi::State;

use super::problem::timed;
use super::{Contender, Cost, Failure, Problem, Setting};
use crate::baseline::{self, Pair, Samples, Tolerance};
use crate::raw;

pub(super) fn run(
    contender: Contender,
    problem: &Problem,
    tolerance: f64,
) -> Result<Cost, Failure> {
    let (outcome, time) = timed(|| integrate(contender, problem, tolerance, problem.until));
    let run = outcome?;
    Ok(Cost {
        time,
        steps: run.accepted as u64,
        evaluations: run.evaluations as u64,
        iterations: 0,
    })
}

pub(super) fn sample(
    contender: Contender,
    problem: &Problem,
    tolerance: f64,
    samples: u64,
) -> Result<Vec<State<Configuration>>, Failure> {
    let every = problem.until / samples as f64;
    let run = integrate(contender, problem, tolerance, every)?;
    let states = run.t.iter().zip(&run.y);
    Ok(states.filter_map(|(t, y)| raw::unpack(*t, y)).collect())
}

fn integrate(
    contender: Contender,
    problem: &Problem,
    tolerance: f64,
    every: f64,
) -> Result<Samples, Failure> {
    let pair = match contender {
        Contender::Dp54 => Pair::DormandPrince54,
        Contender::Dp853 => Pair::DormandPrince853,
        _ => return Err(contender.misused(Setting::Tolerance(tolerance))),
    };
    let rhs = raw::right_hand_side(&problem.model, &problem.start);
    let (y, until) = (raw::pack(&problem.start), problem.until);
    let tolerance = Tolerance::uniform(tolerance);
    Ok(baseline::integrate(pair, rhs, &y, until, every, tolerance)?)
}
