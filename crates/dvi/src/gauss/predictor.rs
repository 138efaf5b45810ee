//! The first guess of a step: the velocities and forces of the step before, continued.

use lie::{Batch, DualOver, Retraction, Scalar};

use super::extrapolation::{Rows, STEPS, continuation, extrapolation};
use super::stages::{Matrix, Stages};
use super::sweep::Sweep;
use super::tableau::Tableau;
use crate::ContinuousSystem;

/// After a first sweep that changes the rates more than this, the motion is no polynomial over several steps.
const ROUGH: f64 = 0.05;

/// Continues the velocities and forces of the last steps by a least-squares polynomial; they do not depend on the chart.
pub(super) struct Predictor<S> {
    /// The last steps, the oldest first; all of the same size. Only the last so many are known.
    past: [Past<S>; STEPS],
    known: usize,
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

impl<S: Batch> Predictor<S> {
    pub(super) fn new(stages: usize, dim: usize) -> Self {
        let past = || Past {
            xi: Stages::new(stages, dim),
            tau: Stages::new(stages, dim),
        };
        let matrices = |steps| (0..steps).map(|_| Matrix::new(stages)).collect();
        Self {
            past: [past(), past(), past()],
            known: 0,
            h: 0.0,
            reach: 1,
            ratio: 0.0,
            matrices: (1..=STEPS).map(matrices).collect(),
        }
    }

    pub(super) fn is_known(&self) -> bool {
        self.known > 0
    }

    pub(super) fn forget(&mut self) {
        self.known = 0;
        self.reach = 1;
    }

    /// Takes over the velocities and forces of a step that was taken.
    pub(super) fn record<C: ContinuousSystem>(&mut self, h: f64, sweep: &Sweep<C, S>) {
        if h != self.h {
            self.known = 0;
        }
        self.h = h;
        self.known = STEPS.min(self.known + 1);
        self.past.rotate_left(1);
        let [.., past] = &mut self.past;
        sweep.write_velocities(&mut past.xi, &mut past.tau);
    }

    /// Places the stages of a step from the time `t` and the momentum `mu`; false where there is no step before, and they start from the velocity there.
    pub(super) fn guess<C: ContinuousSystem, R: Retraction>(
        &mut self,
        (system, tableau): (&C, &Tableau),
        (t, mu, h): (S::Item, &DualOver<C::Group, S::Item>, f64),
        sweep: &mut Sweep<C, S>,
    ) -> bool {
        let known = self.is_known();
        if known {
            self.extrapolate(tableau, h, sweep);
        } else {
            sweep.rates_at(system, t, mu);
        }
        sweep.place_by_velocities::<R>(S::Item::from_f64(h), mu);
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
            self.matrices
                .iter_mut()
                .for_each(|m| set(m, tableau, ratio));
        }
        let steps = self.known.min(self.reach);
        let past = &self.past[STEPS - steps..];
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

/// Sets the matrices, one for each step that is continued.
fn set<S: Batch>(matrices: &mut [Matrix<S>], tableau: &Tableau, ratio: f64) {
    let (stages, steps) = (tableau.nodes.len(), matrices.len());
    let mut set = |rows: &Rows| {
        for (m, matrix) in matrices.iter_mut().enumerate() {
            matrix.set(stages, |i, j| rows[i][m * stages + j]);
        }
    };
    if ratio == 1.0 {
        set(continuation(tableau, steps));
    } else {
        set(&extrapolation(tableau, steps, ratio));
    }
}
