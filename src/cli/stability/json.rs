//! What a map says, as JSON.

use serde::Serialize;
use study::contender::Contender;
use study::stability::{Class, Grid, Limit, Outcome};

use super::report::Report;

/// All numbers; units are in the names, or SI.
#[derive(Serialize)]
pub struct Object<'a> {
    title: Option<&'a str>,
    scene: &'a str,
    #[serde(flatten)]
    grid: &'a Grid,
    counts: Vec<CountObject>,
    methods: Vec<MethodObject<'a>>,
    seconds: f64,
    files: Vec<String>,
}

#[derive(Serialize)]
struct CountObject {
    class: Class,
    runs: usize,
}

#[derive(Serialize)]
struct MethodObject<'a> {
    #[serde(flatten)]
    contender: Contender,
    limits: Vec<LimitObject<'a>>,
    runs: Vec<RunObject<'a>>,
}

#[derive(Serialize)]
struct LimitObject<'a> {
    value: f64,
    #[serde(flatten)]
    limit: &'a Limit,
    next_step_seconds: Option<f64>,
    cause: Option<String>,
}

#[derive(Serialize)]
struct RunObject<'a> {
    value: f64,
    step_seconds: f64,
    #[serde(flatten)]
    outcome: &'a Outcome,
}

impl<'a> Object<'a> {
    pub fn new(report: &'a Report) -> Self {
        let count = |class| CountObject {
            class,
            runs: report.map.count(class),
        };
        let methods = 0..report.map.grid.methods.len();
        let files = report.files.iter().map(|file| file.display().to_string());
        Self {
            title: report.loaded.scene.title.as_deref(),
            scene: &report.loaded.file,
            grid: &report.map.grid,
            counts: Class::ALL.map(count).into(),
            methods: methods.map(|m| MethodObject::new(report, m)).collect(),
            seconds: report.seconds,
            files: files.collect(),
        }
    }
}

impl<'a> MethodObject<'a> {
    fn new(report: &'a Report, method: usize) -> Self {
        let (map, grid) = (report.map, &report.map.grid);
        let values = || grid.values.iter().copied().enumerate();
        let limits = values().map(|(v, value)| {
            let limit = map.limit(method, v);
            LimitObject {
                value,
                limit,
                next_step_seconds: limit.next.map(|next| grid.steps[next]),
                cause: report.cause(method, v),
            }
        });
        let runs = values().flat_map(|(v, value)| {
            let steps = grid.steps.iter().copied().enumerate();
            steps.map(move |(s, step_seconds)| RunObject {
                value,
                step_seconds,
                outcome: map.cell(method, v, s),
            })
        });
        Self {
            contender: grid.methods[method],
            limits: limits.collect(),
            runs: runs.collect(),
        }
    }
}
