//! The first guess of a step: the velocities and forces of the step before, continued.

use std::collections::VecDeque;

use lie::{Batch, Retraction};

use super::stages::{Matrix, Stages};
use super::sweep::Sweep;
use super::tableau::Tableau;
use crate::{ContinuousSystem, State};

/// Steps that are remembered.
const STEPS: usize = 3;
/// After a first sweep that changes the rates more than this, the motion is no polynomial over several steps.
const ROUGH: f64 = 0.05;

/// Continues the velocities and forces of the last steps by a least-squares polynomial; they do not depend on the chart.
pub(super) struct Predictor<S> {
    /// The last steps, the oldest first; all of the same size.
    past: VecDeque<Past<S>>,
    /// Of the last step; zero where there is none.
    h: f64,
    /// How many of them the guess is continued from, at most.
    reach: usize,
    /// The next step's size over the last one's, that the matrices are for.
    ratio: f64,
    /// For a guess from one, two, three steps: a matrix for each of them.
    matrices: Vec<Vec<Matrix<S>>>,
}

/// Velocities and forces at the stages of a step.
struct Past<S> {
    xi: Stages<S>,
    tau: Stages<S>,
}

impl<S: Batch<Item = f64>> Predictor<S> {
    pub(super) fn new() -> Self {
        Self {
            past: VecDeque::with_capacity(STEPS),
            h: 0.0,
            reach: 1,
            ratio: 0.0,
            matrices: Vec::new(),
        }
    }

    pub(super) fn is_known(&self) -> bool {
        !self.past.is_empty()
    }

    pub(super) fn forget(&mut self) {
        self.past.clear();
        self.reach = 1;
    }

    /// Takes over the velocities and forces of a step that was taken.
    pub(super) fn record<C: ContinuousSystem>(&mut self, h: f64, sweep: &Sweep<C, S>) {
        if h != self.h {
            self.past.clear();
        }
        self.h = h;
        let full = self.past.len() == STEPS;
        let oldest = if full { self.past.pop_front() } else { None };
        let mut past = oldest.unwrap_or_else(|| Past {
            xi: sweep.xi.clone(),
            tau: sweep.tau.clone(),
        });
        past.xi.copy_from(&sweep.xi);
        past.tau.copy_from(&sweep.tau);
        self.past.push_back(past);
    }

    /// Places the stages of a step from `state`; false where there is no step before, and they start from the state's own velocity.
    pub(super) fn guess<C: ContinuousSystem, R: Retraction>(
        &mut self,
        (system, tableau): (&C, &Tableau),
        (state, h): (&State<C::Group>, f64),
        sweep: &mut Sweep<C, S>,
    ) -> bool {
        let known = self.is_known();
        if known {
            self.extrapolate(tableau, h, sweep);
        } else {
            sweep.rates_at(system, state.t, &state.mu);
        }
        sweep.place_by_velocities::<R>(h, &state.mu);
        known
    }

    fn extrapolate<C: ContinuousSystem>(
        &mut self,
        tableau: &Tableau,
        h: f64,
        sweep: &mut Sweep<C, S>,
    ) {
        let ratio = h / self.h;
        if ratio != self.ratio {
            self.ratio = ratio;
            let from = |steps| matrices(tableau, steps, ratio);
            self.matrices = (1..=STEPS).map(from).collect();
        }
        let steps = self.past.len().min(self.reach);
        let past = self.past.range(self.past.len() - steps..);
        S::run(
            #[inline(always)]
            || {
                sweep.xi.set_zero();
                sweep.tau.set_zero();
                for (matrix, past) in self.matrices[steps - 1].iter().zip(past) {
                    matrix.add(&mut sweep.xi, &past.xi);
                    matrix.add(&mut sweep.tau, &past.tau);
                }
            },
        );
    }

    /// Learns from how much the first sweep has changed the rates that the guess led to.
    pub(super) fn judge(&mut self, change: f64) {
        let smooth = change < ROUGH;
        self.reach = if smooth { STEPS.min(self.reach + 1) } else { 1 };
    }
}

/// The degree of the polynomial through so many steps: higher ones follow the past closer and extrapolate worse.
fn degree(stages: usize, steps: usize) -> usize {
    match stages {
        0..=5 => stages + 1,
        _ => [5, 9, 12][steps - 1],
    }
}

fn matrices<S: Batch>(tableau: &Tableau, steps: usize, ratio: f64) -> Vec<Matrix<S>> {
    let stages = tableau.nodes.len();
    let rows = tableau.extrapolation(steps, ratio, degree(stages, steps));
    let matrix = |m: usize| Matrix::new(stages, |i, j| rows[i][m * stages + j]);
    (0..steps).map(matrix).collect()
}
