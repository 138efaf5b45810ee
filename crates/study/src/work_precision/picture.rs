//! The points as a chart.

use super::cheapest::frontier;
use super::{Choice, Curve, Measured, Point, Reference};
use crate::contender::{Contender, Control, Kind, Problem};
use figure::{Colour, Figure, Labels, Level, Line, Marker, Panel, Scale, Style};

/// Where failed runs are drawn, above the largest attitude error there is.
const FAILED_ATTITUDE: f64 = 30.0;
const PLOT_HEIGHT: f64 = 430.0;
const MARKERS: [Marker; 6] = [
    Marker::Circle,
    Marker::Square,
    Marker::Diamond,
    Marker::Triangle,
    Marker::TriangleDown,
    Marker::Plus,
];

const LEGEND: &str = "Solid: keep the group, the symplectic form and the momentum maps; dashed: do not. A point is a step size, a tolerance \
or an accuracy. Yellow: the cheapest of all, but for pilot, which has run before the time counts. Errors are the largest over the run. Time is the least of up to 20 runs. Failed runs (×) stand where their number of steps \
would have put them.";

/// A quantity of a measured run.
type Quantity = fn(&Measured) -> Option<f64>;

#[derive(Clone, Copy)]
struct Axis {
    label: &'static str,
    quantity: Quantity,
}

const TIME: Axis = Axis {
    label: "time of stepping [s]",
    quantity: |measured| Some(measured.cost.time.as_secs_f64()),
};
const EVALUATIONS: Axis = Axis {
    label: "evaluations of the model (lgvi, composition: of the discrete one)",
    quantity: |measured| Some(measured.cost.evaluations as f64),
};
const ATTITUDE: Axis = Axis {
    label: "largest attitude error [rad]",
    quantity: |measured| Some(measured.errors.attitude),
};
const ENERGY: Axis = Axis {
    label: "largest energy error, relative",
    quantity: |measured| measured.errors.energy,
};

/// Attitude error against time and against evaluations, energy error against time.
///
/// A method's failed runs stand on a line above all errors, at the cost in proportion to their steps; the notes have their causes.
pub fn picture(curves: &[Curve], problem: &Problem, reference: &Reference, title: &str) -> Figure {
    let chart = Chart { curves, problem };
    let floor = Some(reference.attitude);
    let failed_energy = 10.0 * chart.largest(ENERGY.quantity).max(1e-3);
    let mut first = chart.panel(
        "(a) accuracy and time",
        [TIME, ATTITUDE],
        FAILED_ATTITUDE,
        floor,
    );
    first.lines.insert(0, chart.cheapest());
    Figure {
        title: title.to_owned(),
        columns: 1,
        labels: Labels::Ends,
        plot_height: PLOT_HEIGHT,
        panels: vec![
            first,
            chart.panel(
                "(b) accuracy and evaluations",
                [EVALUATIONS, ATTITUDE],
                FAILED_ATTITUDE,
                floor,
            ),
            chart.panel("(c) energy and time", [TIME, ENERGY], failed_energy, None),
        ],
        notes: chart.notes(reference),
    }
}

struct Chart<'a> {
    curves: &'a [Curve],
    problem: &'a Problem,
}

impl Chart<'_> {
    fn panel(&self, title: &str, [x, y]: [Axis; 2], failed: f64, floor: Option<f64>) -> Panel {
        let level = |label: &str, y| Level {
            label: label.to_owned(),
            y,
        };
        let floor = floor.map(|error| level("unknown below", error));
        Panel {
            title: title.to_owned(),
            x_label: x.label.to_owned(),
            x_scale: Scale::Log,
            y_label: y.label.to_owned(),
            y_scale: Scale::Log,
            levels: core::iter::once(level("failed", failed))
                .chain(floor)
                .collect(),
            lines: self.lines((x.quantity, y.quantity), failed),
            heat: None,
        }
    }

    fn largest(&self, quantity: Quantity) -> f64 {
        let points = self.curves.iter().flat_map(|curve| &curve.points);
        let values = points.filter_map(|point| quantity(point.outcome.as_ref().ok()?));
        values.fold(0.0, f64::max)
    }

    /// What to take for which error.
    fn cheapest(&self) -> Line {
        let choices = frontier(self.curves).into_iter();
        let place = |choice: Choice| {
            let Measured { cost, errors, .. } = choice.measured;
            (cost.time.as_secs_f64(), errors.attitude)
        };
        Line {
            label: String::new(),
            colour: Colour::Yellow,
            style: Style::Broad,
            marker: None,
            points: choices.map(place).collect(),
        }
    }

    fn lines(&self, axes: (Quantity, Quantity), failed: f64) -> Vec<Line> {
        let looks = self.curves.iter().enumerate().map(|(k, curve)| {
            let kind = |curve: &&Curve| curve.contender.kind() == self.curves[k].contender.kind();
            let same = self.curves[..k].iter().filter(kind).count();
            (curve, MARKERS[same % MARKERS.len()])
        });
        looks
            .flat_map(|(curve, marker)| self.curve(curve, marker, axes, failed))
            .collect()
    }

    /// The line of what succeeded, the crosses of what failed, and what joins them.
    fn curve(
        &self,
        curve: &Curve,
        marker: Marker,
        (x, y): (Quantity, Quantity),
        failed: f64,
    ) -> [Line; 3] {
        let place = |point: &Point| {
            let measured = point.outcome.as_ref().ok()?;
            Some((x(measured)?, y(measured)?))
        };
        let reached: Vec<_> = curve.points.iter().filter_map(place).collect();
        let points = curve.points.iter().enumerate();
        let crosses: Vec<_> = points
            .filter(|(_, point)| point.outcome.is_err())
            .map(|(k, _)| (self.expected(curve, k, x), failed))
            .collect();
        let coarse = curve
            .points
            .iter()
            .take_while(|point| point.outcome.is_err());
        let last = coarse.count().checked_sub(1).map(|k| crosses[k]);
        let bridge = last
            .zip(reached.first())
            .map(|(cross, first)| vec![cross, *first]);
        let line = |label: &str, style, marker, points| Line {
            label: label.to_owned(),
            colour: colour(curve.contender),
            style,
            marker,
            points,
        };
        let cross = Some(Marker::Cross);
        // Where nothing was reached, what failed has the name.
        let name = curve.contender.name();
        let of_failed = if reached.is_empty() { name } else { "" };
        [
            line("", Style::Dotted, None, bridge.unwrap_or_default()),
            line(of_failed, Style::Invisible, cross, crosses),
            line(name, style(curve.contender), Some(marker), reached),
        ]
    }

    /// What a failed run would have cost, from the nearest one that did not fail; as the least of all where there is none, or one.
    fn expected(&self, curve: &Curve, k: usize, x: Quantity) -> f64 {
        let size = |point: &Point| {
            let value = point.setting.value(self.problem.until);
            match point.setting.control() {
                Control::Step => value,
                // Steps are in proportion to this power.
                Control::Tolerance | Control::Accuracy => {
                    value.powf(1.0 / f64::from(curve.contender.order()))
                }
            }
        };
        let cost = |(i, point): (usize, &Point)| {
            let cost = x(point.outcome.as_ref().ok()?)?;
            Some((i.abs_diff(k), cost * size(point) / size(&curve.points[k])))
        };
        let costs = curve.points.iter().enumerate().filter_map(cost);
        let nearest = costs.min_by_key(|(distance, _)| *distance);
        let cost = nearest.map(|(_, cost)| cost);
        cost.or_else(|| self.least(x)).unwrap_or(1.0)
    }

    fn least(&self, x: Quantity) -> Option<f64> {
        let points = self.curves.iter().flat_map(|curve| &curve.points);
        let costs = points.filter_map(|point| x(point.outcome.as_ref().ok()?));
        costs.min_by(f64::total_cmp)
    }

    /// What the reference is, how long it means anything, and the causes of failures.
    fn notes(&self, reference: &Reference) -> Vec<String> {
        let mut notes = vec![LEGEND.to_owned(), reference.describe(self.problem.until)];
        let failures = self.curves.iter();
        let failures = failures.filter_map(|curve| curve.failures(self.problem.until));
        notes.extend(failures.map(|failure| format!("× {failure}")));
        notes
    }
}

fn colour(contender: Contender) -> Colour {
    match contender.kind() {
        Kind::Variational => Colour::Vermillion,
        Kind::Gauss => Colour::Blue,
        Kind::Group => Colour::BluishGreen,
        Kind::Raw => Colour::ReddishPurple,
        Kind::Adaptive => Colour::Black,
    }
}

fn style(contender: Contender) -> Style {
    match contender.keeps_structure() {
        true => Style::Solid,
        false => Style::Dashed,
    }
}
