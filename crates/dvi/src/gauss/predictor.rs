//! The first guess of a step: the velocities and forces of the step before, continued.

use lie::{RealGroup, Retraction, VectorSpace};

use super::sweep::{Sweep, combine, combine_plain};
use super::tableau::Tableau;
use crate::{ContinuousSystem, State};

/// The highest degree of the continued polynomial: higher ones follow the last step closer and extrapolate worse.
const DEGREE: usize = 5;

/// Continues the last step's velocities and forces by a least-squares polynomial; they do not depend on the chart.
pub(super) struct Predictor<G: RealGroup> {
    /// Of the last step; zero where there is none.
    h: f64,
    ratio: f64,
    matrix: Vec<Vec<f64>>,
    xi: Vec<G::Algebra>,
    tau: Vec<G::Dual>,
}

impl<G: RealGroup> Predictor<G> {
    pub(super) fn new(stages: usize, g: &G) -> Self {
        Self {
            h: 0.0,
            ratio: 0.0,
            matrix: vec![vec![0.0; stages]; stages],
            xi: vec![g.zero_algebra(); stages],
            tau: vec![g.zero_dual(); stages],
        }
    }

    pub(super) fn is_known(&self) -> bool {
        self.h != 0.0
    }

    pub(super) fn forget(&mut self) {
        self.h = 0.0;
    }

    /// Takes over the velocities and forces of a step that was taken.
    pub(super) fn record<C>(&mut self, h: f64, sweep: &Sweep<C, f64>)
    where
        C: ContinuousSystem<Group = G>,
    {
        self.h = h;
        for (i, stage) in sweep.stages.iter().enumerate() {
            self.xi[i].copy_from(&stage.xi);
            self.tau[i].copy_from(&stage.tau);
        }
    }

    /// Places the stages of a step from `state`; false where there is no step before, and they start from the state's own velocity.
    pub(super) fn guess<C, R>(
        &mut self,
        (system, tableau): (&C, &Tableau),
        (state, h): (&State<G>, f64),
        sweep: &mut Sweep<C, f64>,
    ) -> bool
    where
        C: ContinuousSystem<Group = G>,
        R: Retraction,
    {
        let known = self.is_known();
        if known {
            self.extrapolate(tableau, h, sweep);
        } else {
            sweep.rates_at(system, state.t, &state.g, &state.mu);
        }
        self.chart::<C, R>(tableau, &state.mu, h, sweep);
        known
    }

    fn extrapolate<C>(&mut self, tableau: &Tableau, h: f64, sweep: &mut Sweep<C, f64>)
    where
        C: ContinuousSystem<Group = G>,
    {
        let ratio = h / self.h;
        if ratio != self.ratio {
            self.ratio = ratio;
            tableau.extrapolation(ratio, DEGREE, &mut self.matrix);
        }
        for (stage, row) in sweep.stages.iter_mut().zip(&self.matrix) {
            combine_plain(&mut stage.xi, 1.0, row, |j| &self.xi[j]);
            combine_plain(&mut stage.tau, 1.0, row, |j| &self.tau[j]);
        }
    }

    /// From velocities and forces to the chart: $\dot c = \mathrm d\tau_c^{-1} \xi$ twice over, and the momenta by transport.
    fn chart<C, R>(&mut self, tableau: &Tableau, mu: &G::Dual, h: f64, sweep: &mut Sweep<C, f64>)
    where
        C: ContinuousSystem<Group = G>,
        R: Retraction,
    {
        for stage in &mut sweep.stages {
            stage.c_dot.copy_from(&stage.xi);
            stage.pi.set_zero();
        }
        for _ in 0..2 {
            for i in 0..sweep.stages.len() {
                sweep.place_coordinates(tableau, i, h);
            }
            for stage in &mut sweep.stages {
                R::retract_into::<G>(&stage.c, &mut stage.f);
                stage.rates::<R>();
            }
        }
        for i in 0..sweep.stages.len() {
            let (stages, row) = (&sweep.stages, &tableau.forward[i]);
            combine(&mut sweep.momentum, h, row, |j| &stages[j].force);
            sweep.momentum.add_scaled(1.0, mu);
            let stage = &mut sweep.stages[i];
            let out = (&mut stage.f, &mut stage.mu, &mut stage.pi);
            G::chart_leave_into::<R>(&stage.c, &sweep.momentum, out);
        }
    }
}
