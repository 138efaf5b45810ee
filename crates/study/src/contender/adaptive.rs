//! Contenders that choose their steps.

use articulated_fluid::Configuration;
use dvi::State;

use super::problem::timed;
use super::{Contender, Cost, Failure, Problem, Setting};
use crate::baseline::{self, Pair, Samples, Tolerance};
use crate::{dop853, raw};

pub(super) fn run(
    contender: Contender,
    problem: &Problem,
    tolerance: f64,
) -> Result<Cost, Failure> {
    let (outcome, time) = timed(|| cost(contender, problem, tolerance));
    let (accepted, evaluations) = outcome?;
    Ok(Cost {
        time,
        steps: accepted as u64,
        evaluations: evaluations as u64,
        iterations: 0,
    })
}

/// Accepted steps and evaluations.
fn cost(
    contender: Contender,
    problem: &Problem,
    tolerance: f64,
) -> Result<(usize, usize), Failure> {
    let Problem {
        model,
        start,
        until,
    } = problem;
    match contender {
        Contender::Dp853 => {
            let run = dop853::integrate(model, start, *until, Tolerance::uniform(tolerance))?;
            Ok((run.accepted, run.evaluations))
        }
        Contender::Dp54 => {
            let run = pair_54(problem, tolerance, *until)?;
            Ok((run.accepted, run.evaluations))
        }
        _ => Err(contender.misused(Setting::Tolerance(tolerance))),
    }
}

pub(super) fn sample(
    contender: Contender,
    problem: &Problem,
    tolerance: f64,
    samples: u64,
) -> Result<Vec<State<Configuration>>, Failure> {
    let Problem {
        model,
        start,
        until,
    } = problem;
    let every = until / samples as f64;
    match contender {
        Contender::Dp853 => {
            let mut states = vec![start.clone()];
            let mut each = |t: f64, y: &[f64]| states.extend(raw::unpack(t, y));
            // The last sample is the end, which rounding may put past it.
            let every = every * (1.0 - f64::EPSILON);
            let tolerance = Tolerance::uniform(tolerance);
            dop853::sample(model, start, *until, (every, &mut each), tolerance)?;
            let times = problem.times(samples);
            states
                .iter_mut()
                .zip(times)
                .for_each(|(state, t)| state.t = t);
            Ok(states)
        }
        Contender::Dp54 => {
            let run = pair_54(problem, tolerance, every)?;
            Ok(run
                .t
                .iter()
                .zip(&run.y)
                .filter_map(|(t, y)| raw::unpack(*t, y))
                .collect())
        }
        _ => Err(contender.misused(Setting::Tolerance(tolerance))),
    }
}

fn pair_54(problem: &Problem, tolerance: f64, every: f64) -> Result<Samples, Failure> {
    let rhs = raw::right_hand_side(&problem.model, &problem.start);
    let (y, until) = (raw::pack(&problem.start), problem.until);
    let tolerance = Tolerance::uniform(tolerance);
    Ok(baseline::integrate(
        Pair::DormandPrince54,
        rhs,
        &y,
        until,
        every,
        tolerance,
    )?)
}
