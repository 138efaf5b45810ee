//! What a map says, as JSON.

use serde::Serialize;
use study::stability::{Class, Outcome, Wall};

use super::report::Report;

/// All numbers; units are in the names, or SI.
#[derive(Serialize)]
pub struct Object<'a> {
    title: Option<&'a str>,
    scene: &'a str,
    until_seconds: f64,
    parameter: &'static str,
    values: &'a [f64],
    steps_seconds: &'a [f64],
    counts: Vec<CountObject>,
    methods: Vec<MethodObject>,
    seconds: f64,
    files: Vec<String>,
}

#[derive(Serialize)]
struct CountObject {
    class: &'static str,
    runs: usize,
}

#[derive(Serialize)]
struct MethodObject {
    name: &'static str,
    description: String,
    order: u32,
    keeps_structure: bool,
    limits: Vec<LimitObject>,
    runs: Vec<RunObject>,
}

#[derive(Serialize)]
struct LimitObject {
    value: f64,
    largest_good_step_seconds: Option<f64>,
    shorter_steps_without_time: usize,
    wall: &'static str,
    equation_ends_at_step_seconds: Option<f64>,
    next_step_seconds: Option<f64>,
    cause: Option<String>,
}

#[derive(Serialize)]
struct RunObject {
    value: f64,
    step_seconds: f64,
    class: &'static str,
    time_seconds: f64,
    energy_error_relative: Option<f64>,
    energy_drift_relative: Option<f64>,
    energy_trend: f64,
    momentum_error_relative: Option<f64>,
    orthogonality_error: f64,
    attitude_error_radians: Option<f64>,
    failure: Option<String>,
}

impl<'a> From<&'a Report<'a>> for Object<'a> {
    fn from(report: &'a Report) -> Self {
        let grid = &report.map.grid;
        let count = |class: Class| CountObject {
            class: class.name(),
            runs: report.map.count(class),
        };
        let files = report.files.iter().map(|file| file.display().to_string());
        Self {
            title: report.loaded.scene.title.as_deref(),
            scene: &report.loaded.file,
            until_seconds: grid.until,
            parameter: grid.parameter.name(),
            values: &grid.values,
            steps_seconds: &grid.steps,
            counts: Class::ALL.map(count).into(),
            methods: (0..grid.methods.len())
                .map(|method| MethodObject::new(report, method))
                .collect(),
            seconds: report.seconds,
            files: files.collect(),
        }
    }
}

impl MethodObject {
    fn new(report: &Report, method: usize) -> Self {
        let (map, grid) = (report.map, &report.map.grid);
        let contender = grid.methods[method];
        let values = grid.values.iter().enumerate();
        let steps = || grid.steps.iter().enumerate();
        let runs = values.flat_map(|(v, value)| {
            steps().map(move |(s, step)| RunObject::new(map.cell(method, v, s), *value, *step))
        });
        Self {
            name: contender.name(),
            description: contender.description(),
            order: contender.order(),
            keeps_structure: contender.keeps_structure(),
            limits: (0..grid.values.len())
                .map(|value| LimitObject::new(report, method, value))
                .collect(),
            runs: runs.collect(),
        }
    }
}

impl LimitObject {
    fn new(report: &Report, method: usize, value: usize) -> Self {
        let limit = report.map.limit(method, value);
        let grid = &report.map.grid;
        Self {
            value: grid.values[value],
            largest_good_step_seconds: limit.step,
            shorter_steps_without_time: limit.untried,
            wall: limit.wall.name(),
            equation_ends_at_step_seconds: match limit.wall {
                Wall::Equation { ends } => Some(ends),
                _ => None,
            },
            next_step_seconds: limit.next.map(|next| grid.steps[next]),
            cause: report.cause(method, value),
        }
    }
}

impl RunObject {
    fn new(outcome: &Outcome, value: f64, step_seconds: f64) -> Self {
        // An angle to what is no rotation may be no number.
        let attitude = outcome.attitude.filter(|angle| angle.is_finite());
        Self {
            value,
            step_seconds,
            class: outcome.class.name(),
            time_seconds: outcome.t,
            energy_error_relative: outcome.energy,
            energy_drift_relative: outcome.drift,
            energy_trend: outcome.trend,
            momentum_error_relative: outcome.momentum,
            orthogonality_error: outcome.orthogonality,
            attitude_error_radians: attitude,
            failure: outcome.failure.as_ref().map(ToString::to_string),
        }
    }
}
