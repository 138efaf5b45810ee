//! What a run reports at its end, as text and as JSON.

use serde::Serialize;

use super::error::CliError;
use super::print::decimal;

/// The result of a run; units are in the names, or SI.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    pub title: Option<String>,
    pub scene: String,
    pub bodies: usize,
    pub method: &'static str,
    pub method_order: u32,
    pub steps: u64,
    pub step_seconds: f64,
    pub step_asked_seconds: f64,
    pub until_seconds: f64,
    pub time_per_step_us: f64,
    pub sample_every_steps: u64,
    pub samples: u64,
    pub energy_initial_joules: f64,
    pub energy_error_max_relative: Option<f64>,
    pub energy_slope_per_second: Option<f64>,
    pub linear_momentum_deviation_max: f64,
    pub angular_momentum_deviation_max: f64,
    pub angular_momentum_deviation_max_relative: Option<f64>,
    pub orthogonality_error_max: f64,
    pub solver_residual_max: f64,
    pub solver_iterations_max: u32,
    pub solver_iterations_mean: f64,
    pub csv: Option<String>,
    #[serde(skip)]
    pub step_is_adjusted: bool,
}

impl Summary {
    /// One JSON object on a line.
    pub fn json(&self) -> Result<String, CliError> {
        let mut text =
            serde_json::to_string(self).map_err(|error| CliError::Stdout(error.into()))?;
        text.push('\n');
        Ok(text)
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
        if let Some(title) = &self.title {
            rows.push(("scene", one_line(title)));
        }
        let (every, samples) = (self.sample_every_steps, self.samples);
        rows.extend([
            ("file", one_line(&self.scene)),
            ("bodies", self.bodies.to_string()),
            (
                "method",
                format!("{}, order {}", self.method, self.method_order),
            ),
            ("steps", self.steps.to_string()),
            ("step size", self.step()),
            (
                "simulated time",
                format!("{} s", decimal(self.until_seconds)),
            ),
            ("time per step", format!("{:.3} us", self.time_per_step_us)),
            ("samples", format!("{samples}, {}", frequency(every))),
        ]);
        if let Some(path) = &self.csv {
            rows.push(("CSV", one_line(path)));
        }
        rows
    }

    fn quality(&self) -> Vec<(&'static str, String)> {
        let (linear, angular) = (
            self.linear_momentum_deviation_max,
            self.angular_momentum_deviation_max,
        );
        let (most, mean) = (self.solver_iterations_max, self.solver_iterations_mean);
        let share = optional(self.angular_momentum_deviation_max_relative);
        vec![
            ("", String::new()),
            (
                "energy at the start",
                format!("{} J", decimal(self.energy_initial_joules)),
            ),
            (
                "energy error, worst",
                format!("{} (relative)", optional(self.energy_error_max_relative)),
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
                format!("{} kg m/s", number(linear)),
            ),
            (
                "angular momentum deviation, worst",
                format!("{} kg m^2/s (relative {share})", number(angular)),
            ),
            (
                "orthogonality error, worst",
                number(self.orthogonality_error_max),
            ),
            (
                "solver residual, largest",
                format!(
                    "{} (relative to the momentum)",
                    number(self.solver_residual_max)
                ),
            ),
            (
                "solver iterations",
                format!("{most} at most, {mean:.2} on average"),
            ),
        ]
    }

    fn step(&self) -> String {
        let step = decimal(self.step_seconds);
        if !self.step_is_adjusted {
            return format!("{step} s");
        }
        let asked = decimal(self.step_asked_seconds);
        let until = decimal(self.until_seconds);
        format!("{step} s, not {asked} s as asked: whole steps have to end at {until} s")
    }
}

fn frequency(every: u64) -> String {
    match every {
        1 => "at every step".to_owned(),
        _ => format!("every {every} steps"),
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

/// Names are the user's own, and may hold what breaks lines.
fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}
