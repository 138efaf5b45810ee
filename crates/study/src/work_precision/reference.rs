//! What errors are measured against, and how well that is known.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::State;
use serde::Serialize;
use sim::Method;
use sim::number::decimal;
use thiserror::Error;

use super::horizon::TOLERANCE;
use super::{Errors, Horizon, SAMPLES};
use crate::baseline::Tolerance;
use crate::baseline::on_group::{self, ReferenceError};
use crate::contender::{Contender, Failure, Problem, Setting};

/// The method that must agree with it.
const CHECK: Contender = Contender::Structure(Method::gauss(8).unwrap());
/// The check's steps are halved at most this often.
const HALVINGS: u32 = 8;

/// The motion at the sample times, by an explicit pair of order 8 in charts at a tolerance of 1e-13, checked by an implicit method of
/// another family, gauss-8.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Reference {
    /// At the $k T / n$, $n$ = [`SAMPLES`].
    #[serde(skip)]
    pub states: Vec<State<Configuration>>,
    /// The largest angle between the two methods' attitudes, rad: errors below are not known.
    #[serde(rename = "attitude_uncertainty_radians")]
    pub attitude: f64,
    /// The largest distance between the two methods' mass centres, m.
    #[serde(rename = "position_uncertainty_metres")]
    pub position: f64,
    /// Steps of the check.
    pub check_steps: u64,
    /// How long a trajectory means anything.
    #[serde(flatten)]
    pub horizon: Horizon,
    /// The time in which the fastest body turns by a radian, s; at most the run's length.
    #[serde(skip)]
    pub radian: f64,
}

/// There is nothing to measure errors against.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum UnknownReference {
    /// The reference's own integration failed.
    #[error("there is no reference to measure errors by: {0}")]
    Integration(#[from] ReferenceError),
    /// No run of the check came to its end.
    #[error("the reference is not confirmed, {CHECK} failed: {0}")]
    Check(#[from] Failure),
}

impl Reference {
    /// Finds the motion, and what is known of it.
    ///
    /// # Errors
    /// [`UnknownReference`].
    pub fn new(problem: &Problem) -> Result<Self, UnknownReference> {
        let (times, tolerance) = (problem.times(SAMPLES), Tolerance::uniform(TOLERANCE));
        let states = on_group::sample(&problem.model, &problem.start, &times, tolerance)?;
        let radian = radian(&problem.model, &states, problem.until);
        let (check_steps, check) = confirm(problem, &states, radian)?;
        Ok(Self {
            horizon: Horizon::new(problem)?,
            attitude: check.attitude,
            position: check.position,
            check_steps,
            radian,
            states,
        })
    }
}

impl Reference {
    /// In a sentence or two: what it is, how exact, and how long it means anything.
    pub fn describe(&self, until: f64) -> String {
        let Horizon {
            growth,
            time,
            is_bound,
        } = self.horizon;
        let about = if is_bound { "not before" } else { "at about" };
        // A bound without any growth to tell it may be any number.
        let time = if time < 1e6 {
            format!("{time:.0}")
        } else {
            format!("{time:.0e}")
        };
        format!(
            "Reference: 8(5,3) in charts at {TOLERANCE:e}, which {CHECK} in {} steps confirms to {:.1e} rad and {:.1e} m. By t = {} s a \
             difference has grown {growth:.0e} times; rounding would be a radian {about} t = {time} s, and no trajectory means \
             anything beyond.",
            self.check_steps,
            self.attitude,
            self.position,
            decimal(until)
        )
    }
}

/// Shorter and shorter steps of the check, until the difference no longer shrinks: then it is rounding's, and the larger of the last two
/// is not small by luck.
fn confirm(
    problem: &Problem,
    states: &[State<Configuration>],
    radian: f64,
) -> Result<(u64, Errors), Failure> {
    let coarsest = (2.0 * problem.until / radian).ceil() as u64;
    let mut best: Result<(u64, Errors), Failure> = Err(Failure::NotFinite { t: 0.0 });
    for halving in 0..HALVINGS {
        let steps = coarsest << halving;
        let run = CHECK.sample(problem, Setting::Steps(steps), SAMPLES);
        let errors = run.and_then(|run| Errors::new(&problem.model, &run, states));
        match (errors, &best) {
            (Ok(errors), Ok((_, last))) if errors.attitude >= 0.5 * last.attitude => {
                let is_larger = errors.attitude > last.attitude;
                return if is_larger { Ok((steps, errors)) } else { best };
            }
            (Ok(errors), _) => best = Ok((steps, errors)),
            (Err(failure), Err(_)) => best = Err(failure),
            (Err(_), Ok(_)) => break,
        }
    }
    best
}

/// The inverse of the fastest body's largest rate.
fn radian(model: &ArticulatedBody, states: &[State<Configuration>], until: f64) -> f64 {
    let rates = states.iter().filter_map(|state| fastest_rate(model, state));
    (1.0 / rates.fold(0.0, f64::max)).min(until)
}

/// The largest angular velocity of a body, rad/s; `None` where the state does not fit the model.
pub(crate) fn fastest_rate(model: &ArticulatedBody, state: &State<Configuration>) -> Option<f64> {
    let xi = model.velocity(state).ok()?;
    Some(
        xi.0.iter()
            .map(|omega| omega.vec3().norm())
            .fold(0.0, f64::max),
    )
}
