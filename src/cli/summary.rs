//! What a run reports at its end, as text and as JSON.

use serde::Serialize;
use study::methods::Family;

use super::error::CliError;
use super::print::{self, decimal, one_line};

/// The result of a run; units are in the names, or SI.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    pub title: Option<String>,
    pub scene: String,
    pub bodies: usize,
    pub group: String,
    pub unknowns: usize,
    /// The reductions of `lgvi inspect` that were taken.
    pub reductions: Vec<&'static str>,
    pub method: &'static str,
    pub method_description: String,
    pub method_order: u32,
    pub steps: u64,
    pub step_seconds: f64,
    pub step_asked_seconds: f64,
    pub until_seconds: f64,
    /// Radians and metres, as the estimate, which compares with shorter steps over the horizon.
    pub accuracy_asked: Option<f64>,
    pub accuracy_estimate: Option<f64>,
    pub accuracy_horizon_seconds: Option<f64>,
    pub time_per_step_us: f64,
    pub sample_every_steps: Option<u64>,
    pub sample_every_seconds: Option<f64>,
    pub samples: u64,
    pub energy_initial_joules: f64,
    pub energy_error_max_joules: f64,
    /// To the largest kinetic energy, as the slope.
    pub energy_error_max_relative: Option<f64>,
    pub energy_slope_per_second: Option<f64>,
    /// Then the linear momentum deviates from its start plus weight times time, and the angular one about the vertical.
    pub gravity_acts: bool,
    pub linear_momentum_deviation_max: f64,
    pub angular_momentum_deviation_max: f64,
    pub angular_momentum_deviation_max_relative: Option<f64>,
    pub orthogonality_error_max: f64,
    pub solver_residual_max: f64,
    pub solver_iterations_max: u32,
    pub solver_iterations_mean: f64,
    pub evaluation: String,
    pub evaluations_per_step_mean: f64,
    pub csv: Option<String>,
    #[serde(skip)]
    pub family: Family,
    #[serde(skip)]
    pub step_is_adjusted: bool,
    #[serde(skip)]
    pub step_is_default: bool,
}

impl Summary {
    /// One JSON object on a line.
    pub fn json(&self) -> Result<String, CliError> {
        print::json(self)
    }

    /// A line for each quantity, aligned.
    pub fn text(&self) -> String {
        let rows: Vec<_> = self.run().into_iter().chain(self.quality()).collect();
        let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        let line = |(name, value): &(&str, String)| match name.is_empty() {
            true => "\n".to_owned(),
            false => format!("{name:width$}  {value}\n"),
        };
        rows.iter().map(line).collect()
    }

    fn run(&self) -> Vec<(&'static str, String)> {
        let mut rows = vec![];
        let without = match self.reductions.join(", ") {
            none if none.is_empty() => none,
            some => format!(" (reductions: {some})"),
        };
        if let Some(title) = &self.title {
            rows.push(("scene", one_line(title)));
        }
        rows.extend([
            ("file", one_line(&self.scene)),
            ("bodies", self.bodies.to_string()),
            (
                "model",
                format!("{}, {} unknowns a step{without}", self.group, self.unknowns),
            ),
            ("method", self.method()),
            ("steps", self.steps.to_string()),
            ("step size", self.step()),
            (
                "simulated time",
                format!("{} s", decimal(self.until_seconds)),
            ),
            ("time per step", format!("{:.3} us", self.time_per_step_us)),
            ("samples", self.samples()),
        ]);
        if let Some(accuracy) = self.accuracy() {
            rows.push(("accuracy", accuracy));
        }
        if let Some(path) = &self.csv {
            rows.push(("CSV", one_line(path)));
        }
        rows
    }

    /// What was asked for, and how far runs of shorter steps were away.
    fn accuracy(&self) -> Option<String> {
        let asked = self.accuracy_asked?;
        let (estimate, horizon) = (self.accuracy_estimate?, self.accuracy_horizon_seconds?);
        Some(format!(
            "{asked:e} asked for; estimated error {estimate:.1e} rad or m over {} s, against shorter steps",
            decimal(horizon)
        ))
    }

    fn quality(&self) -> Vec<(&'static str, String)> {
        let (linear, angular) = (
            self.linear_momentum_deviation_max,
            self.angular_momentum_deviation_max,
        );
        let share = optional(self.angular_momentum_deviation_max_relative);
        let (by_weight, about) = match self.gravity_acts {
            true => (
                " from its start plus weight times time",
                ", about the vertical",
            ),
            false => ("", ""),
        };
        vec![
            ("", String::new()),
            (
                "energy at the start",
                format!("{} J", decimal(self.energy_initial_joules)),
            ),
            (
                "energy error, worst",
                format!(
                    "{} J (relative to the kinetic {})",
                    number(self.energy_error_max_joules),
                    optional(self.energy_error_max_relative)
                ),
            ),
            (
                "energy error, slope",
                format!(
                    "{} per second (relative)",
                    optional(self.energy_slope_per_second)
                ),
            ),
            (
                "linear momentum deviation, worst",
                format!("{} kg m/s{by_weight}", number(linear)),
            ),
            (
                "angular momentum deviation, worst",
                format!("{} kg m^2/s (relative {share}){about}", number(angular)),
            ),
            (
                "orthogonality error, worst",
                number(self.orthogonality_error_max),
            ),
            self.residual(),
            self.iterations(),
        ]
    }

    /// What a residual is depends on how the steps are solved.
    fn residual(&self) -> (&'static str, String) {
        let (name, of) = match self.family {
            Family::Gauss { .. } => ("last change of the stages, largest", "relative"),
            _ => ("solver residual, largest", "relative to the momentum"),
        };
        (name, format!("{} ({of})", number(self.solver_residual_max)))
    }

    fn iterations(&self) -> (&'static str, String) {
        let (most, mean) = (self.solver_iterations_max, self.solver_iterations_mean);
        let count = format!("{most} at most, {mean:.2} on average");
        match self.family {
            Family::Gauss { stages: 1 } => ("sweeps a step", format!("{count}, over one stage")),
            Family::Gauss { stages } => ("sweeps a step", format!("{count}, over {stages} stages")),
            Family::Composition { substeps } => (
                "solver iterations a step",
                format!("{count}, in {substeps} substeps"),
            ),
            _ => ("solver iterations a step", count),
        }
    }

    fn method(&self) -> String {
        let (name, what, order) = (self.method, &self.method_description, self.method_order);
        format!("{name}, order {order}: {what}")
    }

    fn samples(&self) -> String {
        let every = match (self.sample_every_steps, self.sample_every_seconds) {
            (Some(1), _) => "at every step".to_owned(),
            (Some(steps), _) => format!("every {steps} steps"),
            (None, Some(seconds)) => format!("every {} s", decimal(seconds)),
            (None, None) => return self.samples.to_string(),
        };
        format!("{}, {every}", self.samples)
    }

    fn step(&self) -> String {
        let step = decimal(self.step_seconds);
        let asked = decimal(self.step_asked_seconds);
        let until = decimal(self.until_seconds);
        let instead = match (self.step_is_adjusted, self.step_is_default) {
            _ if self.accuracy_asked.is_some() => {
                return format!("{step} s, chosen for the accuracy");
            }
            (false, true) => return format!("{step} s, the method's default"),
            (false, false) => return format!("{step} s"),
            (true, true) => format!("the default {asked} s"),
            (true, false) => format!("{asked} s as asked"),
        };
        format!("{step} s, not {instead}: whole steps have to end at {until} s")
    }
}

fn number(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        _ => format!("{value:.3e}"),
    }
}

/// A relative value, which is none where the start is zero.
fn optional(value: Option<f64>) -> String {
    value.map_or_else(|| "undefined".to_owned(), number)
}
