//! The first guess of a step: the velocities and forces of the step before, continued.

use lie::{Batch, Retraction};

use super::stages::{Matrix, Stages};
use super::sweep::Sweep;
use super::tableau::Tableau;
use crate::{ContinuousSystem, State};

/// The highest degree of the continued polynomial: higher ones follow the last step closer and extrapolate worse.
const DEGREE: usize = 5;

/// Continues the last step's velocities and forces by a least-squares polynomial; they do not depend on the chart.
pub(super) struct Predictor<S> {
    /// Of the last step; zero where there is none.
    h: f64,
    ratio: f64,
    matrix: Matrix<S>,
    xi: Stages<S>,
    tau: Stages<S>,
}

impl<S: Batch<Item = f64>> Predictor<S> {
    pub(super) fn new(stages: usize, dim: usize) -> Self {
        Self {
            h: 0.0,
            ratio: 0.0,
            matrix: Matrix::new(stages, |_, _| 0.0),
            xi: Stages::new(stages, dim),
            tau: Stages::new(stages, dim),
        }
    }

    pub(super) fn is_known(&self) -> bool {
        self.h != 0.0
    }

    pub(super) fn forget(&mut self) {
        self.h = 0.0;
    }

    /// Takes over the velocities and forces of a step that was taken.
    pub(super) fn record<C: ContinuousSystem>(&mut self, h: f64, sweep: &Sweep<C, S>) {
        self.h = h;
        self.xi.copy_from(&sweep.xi);
        self.tau.copy_from(&sweep.tau);
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
            let matrix = tableau.extrapolation(ratio, DEGREE);
            self.matrix.set(matrix.len(), |i, j| matrix[i][j]);
        }
        S::run(
            #[inline(always)]
            || {
                self.matrix.apply(&mut sweep.xi, &self.xi);
                self.matrix.apply(&mut sweep.tau, &self.tau);
            },
        );
    }
}
