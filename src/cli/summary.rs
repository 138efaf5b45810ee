//! What a run reports at its end, as text and as JSON.

use std::path::PathBuf;

use serde::Serialize;
use sim::method::Family;
use sim::number::{decimal, scientific};
use sim::{DriveReport, Report, Simulation};

use super::outputs::Format;
use super::print::one_line;

/// The report of a run, and what only the command knows of it.
#[derive(Serialize)]
pub struct Summary<'a> {
    pub scene: &'a str,
    #[serde(flatten)]
    pub report: Report,
    pub csv: Option<String>,
    /// All files, the table among them.
    pub written: Vec<String>,
    #[serde(skip)]
    pub files: &'a [PathBuf],
    #[serde(skip)]
    pub family: Family,
    #[serde(skip)]
    pub step_is_adjusted: bool,
    #[serde(skip)]
    pub step_of_method: f64,
    #[serde(skip)]
    pub origin: Origin,
}

/// Drives that have a line of their own, at most.
const MOST_DRIVES: usize = 6;

/// What was left open by a user.
#[derive(Clone, Copy)]
pub struct Origin {
    pub step_is_default: bool,
    /// Method, step and accuracy, of a scene that is not the paper's.
    pub is_chosen: bool,
}

impl<'a> Summary<'a> {
    pub fn new(
        simulation: &Simulation,
        scene: &'a str,
        files: &'a [PathBuf],
        origin: Origin,
    ) -> Self {
        let name = |path: &PathBuf| path.display().to_string();
        let is_table = |path: &&PathBuf| matches!(Format::of(path), Ok(Format::Csv));
        let table = files.iter().find(is_table);
        Self {
            scene,
            report: simulation.report(),
            csv: table.map(name),
            written: files.iter().map(name).collect(),
            files,
            family: simulation.method().family(),
            step_is_adjusted: simulation.clock().is_adjusted(),
            step_of_method: simulation.method().default_step(),
            origin,
        }
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
        let report = &self.report;
        let without = match report.reductions.join(", ") {
            none if none.is_empty() => none,
            some => format!(" (reductions: {some})"),
        };
        let unknowns = match report.unknowns {
            1 => "1 unknown".to_owned(),
            count => format!("{count} unknowns"),
        };
        let model = format!("{}, {unknowns} a step{without}", report.group);
        let mut rows = vec![];
        if let Some(title) = &report.title {
            rows.push(("scene", one_line(title)));
        }
        rows.extend([
            ("file", one_line(self.scene)),
            ("bodies", report.bodies.to_string()),
            ("model", model),
            ("method", self.method()),
            ("steps", report.steps.to_string()),
            ("step size", self.step()),
            (
                "simulated time",
                format!("{} s", decimal(report.until_seconds)),
            ),
            (
                "time per step",
                format!("{:.3} us", report.time_per_step_us),
            ),
            ("samples", self.samples()),
        ]);
        rows.push(self.error());
        for (path, name) in self.files.iter().zip(&self.written) {
            rows.push((Format::of(path).map_or("", Format::label), one_line(name)));
        }
        rows
    }

    /// What is known of the trajectory's error, and what that has cost.
    fn error(&self) -> (&'static str, String) {
        let report = &self.report;
        let more = |steps: u64| {
            let times = steps as f64 / report.steps.max(1) as f64;
            format!("{steps} more steps ({times:.1} times the run's)")
        };
        let accuracy = report.accuracy_asked.zip(report.accuracy_estimate);
        if let Some((asked, estimate)) = accuracy {
            let checked = more(report.accuracy_check_steps.unwrap_or(0));
            let (chosen, papers) = match self.origin.is_chosen {
                true => (
                    "by default for this scene",
                    "; the paper's is --method lgvi --step 0.001",
                ),
                false => ("asked for", ""),
            };
            return (
                "accuracy",
                format!(
                    "{asked:e} {chosen}; {estimate:.1e} rad or m apart from longer steps until the end; {checked}{papers}"
                ),
            );
        }
        let told = match (report.estimate_steps, report.trajectory_error_estimate) {
            (None, _) => "not estimated; --estimate does".to_owned(),
            (Some(_), None) if report.step_halvings > 0 => {
                "unknown: the step was halved on the way".to_owned()
            }
            (Some(_), None) if report.steps < 2 => "unknown: there is one step only".to_owned(),
            (Some(_), None) => "unknown: steps twice as long are not solved".to_owned(),
            (Some(steps), Some(error)) => {
                let steps = more(steps);
                format!("{error:.1e} rad or m by steps of twice and four times the size; {steps}")
            }
        };
        ("trajectory error", told)
    }

    fn quality(&self) -> Vec<(&'static str, String)> {
        let report = &self.report;
        let (linear, angular) = (
            scientific(report.linear_momentum_deviation_max),
            scientific(report.angular_momentum_deviation_max),
        );
        let share = optional(report.angular_momentum_deviation_max_relative);
        let (by_weight, about) = match report.gravity_acts {
            true => (
                " from its start plus weight times time",
                ", about the vertical",
            ),
            false => ("", ""),
        };
        let start = (
            "energy at the start",
            format!("{} J", decimal(report.energy_initial_joules)),
        );
        let momenta = match report.momentum_is_kept {
            true => vec![
                (
                    "linear momentum deviation, worst",
                    format!("{linear} kg m/s{by_weight}"),
                ),
                (
                    "angular momentum deviation, worst",
                    format!("{angular} kg m^2/s (relative {share}){about}"),
                ),
            ],
            false => vec![(
                "momentum",
                "not kept: the first body hangs on the world".to_owned(),
            )],
        };
        let orthogonality = (
            "orthogonality error, worst",
            scientific(report.orthogonality_error_max),
        );
        let mut rows = vec![("", String::new()), start];
        rows.extend(
            self.drives()
                .into_iter()
                .chain(self.energy())
                .chain(momenta),
        );
        rows.extend([orthogonality, self.residual(), self.iterations()]);
        rows
    }

    /// What drives have done: those that have had most power, and all.
    fn drives(&self) -> Vec<(&'static str, String)> {
        let mut drives: Vec<&DriveReport> = self.report.drives.iter().collect();
        drives.sort_by(|a, b| b.power_max_watts.total_cmp(&a.power_max_watts));
        let line = |drive: &&DriveReport| {
            let torque = match drive.torque_max_newton_metres {
                0.0 => String::new(),
                torque => format!(" and {} N m", scientific(torque)),
            };
            let text = format!(
                "{} J by {}; up to {} W{torque}",
                scientific(drive.work_joules),
                one_line(&drive.name),
                scientific(drive.power_max_watts),
            );
            ("work", text)
        };
        let mut rows: Vec<_> = drives.iter().take(MOST_DRIVES).map(line).collect();
        if drives.len() > 1 {
            let total: f64 = drives.iter().map(|drive| drive.work_joules).sum();
            let of = match drives.len() > MOST_DRIVES {
                true => format!("all {}, the strongest of them above", drives.len()),
                false => "all".to_owned(),
            };
            rows.push(("work", format!("{} J by {of}", scientific(total))));
        }
        rows
    }

    fn energy(&self) -> Vec<(&'static str, String)> {
        let report = &self.report;
        let (worst, slope) = match report.energy_is_kept {
            true => ("energy error, worst", "energy error, slope"),
            false => ("energy less work, error", "energy less work, slope"),
        };
        vec![
            (
                worst,
                format!(
                    "{} J ({} of the run's largest kinetic energy, {} J)",
                    scientific(report.energy_error_max_joules),
                    optional(report.energy_error_max_relative),
                    scientific(report.energy_kinetic_max_joules)
                ),
            ),
            (
                slope,
                format!(
                    "{} per second (relative)",
                    optional(report.energy_slope_per_second)
                ),
            ),
        ]
    }

    /// What a residual is depends on how the steps are solved.
    fn residual(&self) -> (&'static str, String) {
        let (name, of) = match self.family {
            Family::Gauss { .. } => ("last change of the stages, largest", "relative"),
            _ => ("solver residual, largest", "relative to the momentum"),
        };
        let residual = scientific(self.report.solver_residual_max);
        (name, format!("{residual} ({of})"))
    }

    fn iterations(&self) -> (&'static str, String) {
        let count = format!(
            "{} at most, {:.2} on average",
            self.report.solver_iterations_max, self.report.solver_iterations_mean
        );
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
        let Report {
            method,
            method_order,
            method_description,
            ..
        } = &self.report;
        format!("{method}, order {method_order}: {method_description}")
    }

    fn samples(&self) -> String {
        let report = &self.report;
        let every = match (report.sample_every_steps, report.sample_every_seconds) {
            (Some(1), _) => "at every step".to_owned(),
            (Some(steps), _) => format!("every {steps} steps"),
            (None, Some(seconds)) => format!("every {} s", decimal(seconds)),
            (None, None) => return report.samples.to_string(),
        };
        format!("{}, {every}", report.samples)
    }

    fn step(&self) -> String {
        let report = &self.report;
        let since = report.step_shortened_at_seconds;
        if let Some((at, from)) = since.zip(report.step_shortened_from_seconds) {
            let (from, at) = (decimal(from), decimal(at));
            let (to, times) = (decimal(report.step_seconds), report.step_halvings);
            let halved = match times {
                1 => "halved".to_owned(),
                times => format!("halved {times} times"),
            };
            return format!(
                "{from} s, the method's default; {halved} from t = {at} s on, where it was not solved, to {to} s"
            );
        }
        let step = decimal(report.step_seconds);
        let asked = decimal(self.report.step_asked_seconds);
        let until = decimal(self.report.until_seconds);
        let default = match self.report.step_asked_seconds / self.step_of_method {
            1.0 => "the method's default",
            longer if longer > 1.0 => "the method's default, longer for this scene",
            _ => "the method's default, shortened for this scene",
        };
        let instead = match (self.step_is_adjusted, self.origin.step_is_default) {
            _ if self.report.accuracy_asked.is_some() => {
                return format!("{step} s, chosen for the accuracy");
            }
            (false, true) => return format!("{step} s, {default}"),
            (false, false) => return format!("{step} s"),
            (true, true) => format!("the default {asked} s"),
            (true, false) => format!("{asked} s as asked"),
        };
        format!("{step} s, not {instead}: whole steps have to end at {until} s")
    }
}

/// A relative value, which is none where the start is zero.
fn optional(value: Option<f64>) -> String {
    value.map_or_else(|| "undefined".to_owned(), scientific)
}
