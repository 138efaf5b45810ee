//! What a chart says, as JSON.

use serde::Serialize;
use study::contender::{Contender, Control, Setting};
use study::work_precision::{Choice, Curve, Measured, Point, Reference};

use super::report::{Report, Row, ratio};

/// All numbers; units are in the names, or SI.
#[derive(Serialize)]
pub struct Object<'a> {
    title: Option<&'a str>,
    scene: &'a str,
    until_seconds: f64,
    reference: &'a Reference,
    cheapest: Vec<RowObject>,
    methods: Vec<CurveObject<'a>>,
    files: Vec<String>,
}

#[derive(Serialize)]
struct RowObject {
    error_radians: f64,
    cheapest: Option<ChoiceObject>,
    cheapest_keeping_structure: Option<ChoiceObject>,
}

#[derive(Serialize)]
struct ChoiceObject {
    method: &'static str,
    #[serde(flatten)]
    setting: SettingObject,
    seconds: f64,
    evaluations: u64,
    time_of_dp853: Option<f64>,
}

#[derive(Serialize)]
struct SettingObject {
    step_seconds: Option<f64>,
    tolerance: Option<f64>,
    accuracy: Option<f64>,
}

#[derive(Serialize)]
struct CurveObject<'a> {
    #[serde(flatten)]
    contender: Contender,
    points: Vec<PointObject<'a>>,
}

#[derive(Serialize)]
struct PointObject<'a> {
    #[serde(flatten)]
    setting: SettingObject,
    #[serde(flatten)]
    measured: Option<&'a Measured>,
    failure: Option<String>,
}

impl<'a> Object<'a> {
    pub fn new(report: &'a Report) -> Self {
        let until = report.problem.until;
        let rows = report.rows.iter().map(|row| RowObject::new(row, until));
        let curve = |curve: &'a Curve| CurveObject::new(curve, until);
        let files = report.files.iter().map(|file| file.display().to_string());
        Self {
            title: report.loaded.scene.title.as_deref(),
            scene: &report.loaded.file,
            until_seconds: until,
            reference: report.reference,
            cheapest: rows.collect(),
            methods: report.curves.iter().map(curve).collect(),
            files: files.collect(),
        }
    }
}

impl RowObject {
    fn new(row: &Row, until: f64) -> Self {
        let object = |choice: &Choice| ChoiceObject {
            method: choice.contender.name(),
            setting: SettingObject::new(choice.setting, until),
            seconds: choice.time().as_secs_f64(),
            evaluations: choice.measured.cost.evaluations,
            time_of_dp853: ratio(choice, row.dp853.as_ref()),
        };
        Self {
            error_radians: row.error,
            cheapest: row.cheapest.as_ref().map(object),
            cheapest_keeping_structure: row.keeping.as_ref().map(object),
        }
    }
}

impl SettingObject {
    fn new(setting: Setting, until: f64) -> Self {
        let value = setting.value(until);
        let of = |control| (setting.control() == control).then_some(value);
        Self {
            step_seconds: of(Control::Step),
            tolerance: of(Control::Tolerance),
            accuracy: of(Control::Accuracy),
        }
    }
}

impl<'a> CurveObject<'a> {
    fn new(curve: &'a Curve, until: f64) -> Self {
        let point = |Point { setting, outcome }: &'a Point| PointObject {
            setting: SettingObject::new(*setting, until),
            measured: outcome.as_ref().ok(),
            failure: outcome.as_ref().err().map(ToString::to_string),
        };
        Self {
            contender: curve.contender,
            points: curve.points.iter().map(point).collect(),
        }
    }
}
