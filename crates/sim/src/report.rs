//! What a run comes to.

use serde::Serialize;

use crate::choice::Choice;
use crate::drives::DriveReport;
use crate::estimate::Estimator;
use crate::method::Evaluation;
use crate::schedule::Schedule;
use crate::simulation::Simulation;

/// What a run has come to so far: cost of the steps, errors of what the motion keeps; units are in the names, or SI.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Report {
    /// The scene's.
    pub title: Option<String>,
    /// How many.
    pub bodies: usize,
    /// The group of the model that is stepped.
    pub group: String,
    /// The unknowns of a step of the discrete Lagrangian.
    pub unknowns: usize,
    /// The reductions that were taken.
    pub reductions: Vec<&'static str>,
    /// The method's name.
    pub method: &'static str,
    /// What it is.
    pub method_description: &'static str,
    /// Its order.
    pub method_order: u32,
    /// Steps taken.
    pub steps: u64,
    /// The step taken; the last one, where a default step was shortened on the way.
    pub step_seconds: f64,
    /// When a default step was not solved, so that shorter ones were taken from there on.
    pub step_shortened_at_seconds: Option<f64>,
    /// The step until then.
    pub step_shortened_from_seconds: Option<f64>,
    /// How often it was halved from then on.
    pub step_halvings: u32,
    /// The longest step that was to be taken.
    pub step_asked_seconds: f64,
    /// The time to run to.
    pub until_seconds: f64,
    /// The error that was asked for, in radians and metres.
    pub accuracy_asked: Option<f64>,
    /// What a rehearsal says of it: the largest difference from a run in steps a quarter longer.
    pub accuracy_estimate: Option<f64>,
    /// How far that went: to the end.
    pub accuracy_horizon_seconds: Option<f64>,
    /// The steps that choosing and checking took, beside those of the run.
    pub accuracy_check_steps: Option<u64>,
    /// The largest error of the trajectory so far, in radians and metres, estimated by runs in longer steps.
    pub trajectory_error_estimate: Option<f64>,
    /// The steps of those.
    pub estimate_steps: Option<u64>,
    /// Of stepping alone, microseconds.
    pub time_per_step_us: f64,
    /// Steps between frames.
    pub sample_every_steps: Option<u64>,
    /// Time between frames.
    pub sample_every_seconds: Option<f64>,
    /// The number of frames.
    pub samples: u64,
    /// Whether the motion keeps the energy: joints that move as told do work.
    pub energy_is_kept: bool,
    /// What they do.
    pub drives: Vec<DriveReport>,
    /// Whether it keeps the momenta: a body on the world does not.
    pub momentum_is_kept: bool,
    /// At t = 0.
    pub energy_initial_joules: f64,
    /// The largest error of the energy, or of its balance with the work of drives, over all steps, as of what follows.
    pub energy_error_max_joules: f64,
    /// The largest kinetic energy.
    pub energy_kinetic_max_joules: f64,
    /// The largest error relative to the largest kinetic energy.
    pub energy_error_max_relative: Option<f64>,
    /// The slope of that by least squares.
    pub energy_slope_per_second: Option<f64>,
    /// Then the linear momentum deviates from its start plus weight times time, and the angular one about the vertical.
    pub gravity_acts: bool,
    /// kg m/s.
    pub linear_momentum_deviation_max: f64,
    /// kg m²/s.
    pub angular_momentum_deviation_max: f64,
    /// The same relative to the start.
    pub angular_momentum_deviation_max_relative: Option<f64>,
    /// The largest $\lVert I - R^T R \rVert_F$ of a body.
    pub orthogonality_error_max: f64,
    /// The largest residual of a step.
    pub solver_residual_max: f64,
    /// The most iterations of a step.
    pub solver_iterations_max: u32,
    /// The mean over the steps.
    pub solver_iterations_mean: f64,
    /// What an iteration evaluates.
    pub evaluation: Evaluation,
    /// The mean over the steps, Newton's matrices included.
    pub evaluations_per_step_mean: f64,
}

impl Simulation {
    /// What the run has come to so far.
    pub fn report(&self) -> Report {
        let (account, method, checked) = (&self.account, self.chosen.method, self.chosen.checked);
        let (clock, cost, watch) = (self.run.clock(), self.run.cost(), &self.watch);
        let steps = cost.steps.max(1) as f64;
        let iterations = cost.iterations as f64 / steps;
        let (group, unknowns, reductions) = match self.plan.full {
            true => (&account.full_group, account.full_dimension, vec![]),
            false => (&account.group, account.unknowns, account.taken().collect()),
        };
        let (every_steps, every_seconds) = match self.plan.schedule {
            Schedule::Steps(steps) => (Some(steps), None),
            Schedule::Seconds(seconds) => (None, Some(seconds)),
        };
        let accuracy = match self.plan.choice {
            Choice::Accuracy(accuracy) => Some(accuracy),
            Choice::Method { .. } => None,
        };
        Report {
            title: self.title.clone(),
            bodies: self.model.bodies().len(),
            group: group.clone(),
            unknowns,
            reductions,
            method: method.name(),
            method_description: method.description(),
            method_order: method.order(),
            steps: cost.steps,
            step_seconds: clock.step(),
            step_shortened_at_seconds: self.shortened.map(|shortened| shortened.at),
            step_shortened_from_seconds: self.shortened.map(|shortened| shortened.from),
            step_halvings: self.shortened.map_or(0, |shortened| shortened.halvings),
            step_asked_seconds: clock.asked(),
            until_seconds: clock.until(),
            accuracy_asked: accuracy,
            accuracy_estimate: checked.map(|checked| checked.estimate),
            accuracy_horizon_seconds: checked.map(|_| clock.until()),
            accuracy_check_steps: checked.map(|checked| checked.steps),
            trajectory_error_estimate: self.estimator.as_ref().and_then(Estimator::error),
            estimate_steps: self.estimator.as_ref().map(Estimator::steps),
            time_per_step_us: cost.time.as_secs_f64() * 1e6 / steps,
            sample_every_steps: every_steps,
            sample_every_seconds: every_seconds,
            samples: self.frames,
            energy_is_kept: self.model.keeps_energy(),
            drives: self.drives.report(&self.driven),
            momentum_is_kept: self.model.keeps_momentum(),
            energy_initial_joules: watch.initial_energy(),
            energy_error_max_joules: watch.energy(),
            energy_kinetic_max_joules: watch.kinetic(),
            energy_error_max_relative: watch.energy_relative(),
            energy_slope_per_second: watch.energy_slope(),
            gravity_acts: watch.has_weight(),
            linear_momentum_deviation_max: watch.linear(),
            angular_momentum_deviation_max: watch.angular(),
            angular_momentum_deviation_max_relative: watch.angular_relative(),
            orthogonality_error_max: watch.orthogonality(),
            solver_residual_max: cost.residual,
            solver_iterations_max: cost.most_iterations,
            solver_iterations_mean: iterations,
            evaluation: method.evaluation(),
            evaluations_per_step_mean: cost.evaluations as f64 / steps,
        }
    }
}
