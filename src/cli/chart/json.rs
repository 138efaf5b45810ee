//! What a chart says, as JSON.

use serde::Serialize;
use study::contender::{Control, Setting};
use study::work_precision::{Choice, Curve, Measured, Point};

use super::report::{Report, Row, ratio};

/// All numbers; units are in the names, or SI.
#[derive(Serialize)]
pub struct Object<'a> {
    title: Option<&'a str>,
    scene: &'a str,
    until_seconds: f64,
    reference: ReferenceObject,
    cheapest: Vec<RowObject>,
    methods: Vec<CurveObject>,
    files: Vec<String>,
}

#[derive(Serialize)]
struct ReferenceObject {
    attitude_uncertainty_radians: f64,
    position_uncertainty_metres: f64,
    check_steps: u64,
    growth_of_a_difference: f64,
    horizon_seconds: f64,
    horizon_is_lower_bound: bool,
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
struct CurveObject {
    name: &'static str,
    description: String,
    order: u32,
    keeps_structure: bool,
    points: Vec<PointObject>,
}

#[derive(Serialize)]
struct PointObject {
    #[serde(flatten)]
    setting: SettingObject,
    #[serde(flatten)]
    measured: Option<MeasuredObject>,
    failure: Option<String>,
}

#[derive(Serialize)]
struct MeasuredObject {
    seconds: f64,
    runs: u32,
    steps: u64,
    evaluations: u64,
    iterations: u64,
    attitude_error_radians: f64,
    position_error_metres: f64,
    energy_error_relative: Option<f64>,
    energy_slope_per_second: Option<f64>,
    linear_momentum_deviation: f64,
    angular_momentum_deviation: f64,
    orthogonality_error: f64,
}

impl<'a> From<&'a Report<'a>> for Object<'a> {
    fn from(report: &'a Report) -> Self {
        let (until, reference) = (report.problem.until, report.reference);
        Self {
            title: report.loaded.scene.title.as_deref(),
            scene: &report.loaded.file,
            until_seconds: until,
            reference: ReferenceObject {
                attitude_uncertainty_radians: reference.attitude,
                position_uncertainty_metres: reference.position,
                check_steps: reference.check_steps,
                growth_of_a_difference: reference.horizon.growth,
                horizon_seconds: reference.horizon.time,
                horizon_is_lower_bound: reference.horizon.is_bound,
            },
            cheapest: report
                .rows
                .iter()
                .map(|row| RowObject::new(row, until))
                .collect(),
            methods: report
                .curves
                .iter()
                .map(|curve| CurveObject::new(curve, until))
                .collect(),
            files: report
                .files
                .iter()
                .map(|file| file.display().to_string())
                .collect(),
        }
    }
}

impl RowObject {
    fn new(row: &Row, until: f64) -> Self {
        let object = |choice: &Option<Choice>| {
            choice.as_ref().map(|choice| ChoiceObject {
                method: choice.contender.name(),
                setting: SettingObject::new(choice.setting, until),
                seconds: choice.time().as_secs_f64(),
                evaluations: choice.measured.cost.evaluations,
                time_of_dp853: ratio(choice, row.dp853.as_ref()),
            })
        };
        Self {
            error_radians: row.error,
            cheapest: object(&row.cheapest),
            cheapest_keeping_structure: object(&row.keeping),
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

impl CurveObject {
    fn new(curve: &Curve, until: f64) -> Self {
        let contender = curve.contender;
        let point = |Point { setting, outcome }: &Point| PointObject {
            setting: SettingObject::new(*setting, until),
            measured: outcome.as_ref().ok().map(MeasuredObject::from),
            failure: outcome.as_ref().err().map(ToString::to_string),
        };
        Self {
            name: contender.name(),
            description: contender.description(),
            order: contender.order(),
            keeps_structure: contender.keeps_structure(),
            points: curve.points.iter().map(point).collect(),
        }
    }
}

impl From<&Measured> for MeasuredObject {
    fn from(
        Measured {
            cost, runs, errors, ..
        }: &Measured,
    ) -> Self {
        Self {
            seconds: cost.time.as_secs_f64(),
            runs: *runs,
            steps: cost.steps,
            evaluations: cost.evaluations,
            iterations: cost.iterations,
            attitude_error_radians: errors.attitude,
            position_error_metres: errors.position,
            energy_error_relative: errors.energy,
            energy_slope_per_second: errors.energy_slope,
            linear_momentum_deviation: errors.linear_momentum,
            angular_momentum_deviation: errors.angular_momentum,
            orthogonality_error: errors.orthogonality,
        }
    }
}
