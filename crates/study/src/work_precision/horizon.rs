//! How long a trajectory means anything.

use articulated_fluid::Configuration;
use dvi::State;
use lie::VectorSpace;
use serde::Serialize;

use super::errors::apart;
use crate::baseline::Tolerance;
use crate::baseline::on_group::{self, ReferenceError};
use crate::contender::Problem;

/// Of the reference's steps.
pub(super) const TOLERANCE: f64 = 1e-13;
/// Of the momenta, relative to the largest.
const PERTURBATION: f64 = 1e-10;
/// A difference in attitude that is still small, rad: its growth tells that of smaller ones.
const GROWN: f64 = 1e-3;
/// The growth is followed for at most so many times the run's length.
const FURTHEST: f64 = 16.0;
/// Times at which it is looked at by the end of the run; beyond, the time grows by its share at each look.
const LOOKS: u32 = 32;

/// The growth of a perturbation of the momenta by 1e-10 of the largest of them.
///
/// One pair of trajectories is one throw of the dice: take the time for its size, not its digits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Horizon {
    /// What the largest difference in attitude by the end of the run is of the perturbation, rad.
    #[serde(rename = "growth_of_a_difference")]
    pub growth: f64,
    /// When a difference of one rounding would have grown to a radian, s: extrapolated as an exponential from the growth to 1e-3.
    #[serde(rename = "horizon_seconds")]
    pub time: f64,
    /// Whether it did not grow so far while it was followed; then the time is a lower bound.
    #[serde(rename = "horizon_is_lower_bound")]
    pub is_bound: bool,
}

/// In no special direction: along the flow, or in proportion to the momentum, differences only grow in proportion to time.
fn perturb(mu: &mut impl VectorSpace<Scalar = f64>) {
    let size = PERTURBATION * mu.max_magnitude();
    for i in 0..mu.dim() {
        let weight = (1.0 + 2.4 * i as f64).sin();
        mu.set(i, mu.get(i) + size * weight);
    }
}

impl Horizon {
    /// Follows a motion and its neighbour, beyond the run's end if need be.
    ///
    /// # Errors
    /// [`ReferenceError`] before the run's end; beyond it, what was seen must do.
    pub fn new(problem: &Problem) -> Result<Self, ReferenceError> {
        let mut pair = Neighbours::new(problem);
        for look in 1..=LOOKS {
            pair.advance(problem.until * f64::from(look) / f64::from(LOOKS))?;
        }
        let growth = pair.largest / PERTURBATION;
        while pair.grown.is_none() && pair.t < FURTHEST * problem.until {
            if pair
                .advance(pair.t * (1.0 + 1.0 / f64::from(LOOKS)))
                .is_err()
            {
                break;
            }
        }
        let (t, largest) = pair.grown.unwrap_or((pair.t, pair.largest));
        let exponent = (largest / PERTURBATION).ln() / t;
        let most = (1.0 / f64::EPSILON).ln();
        Ok(Self {
            growth,
            time: (most / exponent).min(f64::MAX),
            is_bound: pair.grown.is_none(),
        })
    }
}

/// Two trajectories that start side by side.
struct Neighbours<'a> {
    problem: &'a Problem,
    states: [State<Configuration>; 2],
    t: f64,
    /// The largest angle between them so far, rad; no smaller than the perturbation.
    largest: f64,
    /// When it was [`GROWN`], and to what.
    grown: Option<(f64, f64)>,
}

impl<'a> Neighbours<'a> {
    fn new(problem: &'a Problem) -> Self {
        let mut states = [problem.start.clone(), problem.start.clone()];
        perturb(&mut states[1].mu);
        Self {
            problem,
            states,
            t: 0.0,
            largest: PERTURBATION,
            grown: None,
        }
    }

    fn advance(&mut self, t: f64) -> Result<(), ReferenceError> {
        let tolerance = Tolerance::uniform(TOLERANCE);
        for state in &mut self.states {
            *state = on_group::integrate(&self.problem.model, state, t, tolerance)?;
        }
        self.t = t;
        let [a, b] = &self.states;
        self.largest = self.largest.max(apart(&self.problem.model, a, b));
        if self.grown.is_none() && self.largest >= GROWN {
            self.grown = Some((t, self.largest));
        }
        Ok(())
    }
}
