//! Work against precision on the paper's scene: what is found, what fails, what is chosen, what is drawn.

use std::time::Duration;

use figure::{Labels, Marker};
use study::contender::{Problem, Setting};
use study::work_precision::{
    Curve, Measured, Point, Reference, Sweep, Timing, cheapest, csv, picture,
};

use crate::common::{named, paper};

fn curve(name: &str, problem: &Problem, reference: &Reference) -> Curve {
    let contender = named(name);
    let timing = Timing {
        longest: Duration::from_millis(100),
        ..Timing::ONCE
    };
    let points = Sweep::new(contender, problem, reference, timing).collect();
    Curve { contender, points }
}

fn measured(point: &Point) -> Option<Measured> {
    point.outcome.clone().ok()
}

#[test]
fn two_families_agree_and_the_growth_is_that_of_the_scene() {
    let reference = Reference::new(&paper(10.0)).unwrap();
    assert!(
        reference.attitude > 0.0 && reference.attitude < 1e-11,
        "{reference:?}"
    );
    // No trajectory of this scene means much after 200 s.
    let horizon = reference.horizon;
    assert!(
        !horizon.is_bound && (100.0..400.0).contains(&horizon.time),
        "{horizon:?}"
    );
    assert!((10.0..1e4).contains(&horizon.growth), "{horizon:?}");
}

#[test]
fn what_fails_is_on_the_chart_with_its_cause() {
    let problem = paper(4.0);
    let reference = Reference::new(&problem).unwrap();
    let curves = ["composition-2", "gauss-4", "dp54"].map(|name| curve(name, &problem, &reference));

    let [composition, gauss, pair] = &curves;
    let failed = composition
        .points
        .iter()
        .take_while(|point| point.outcome.is_err());
    assert!(
        failed.count() >= 1
            && composition
                .failures(4.0)
                .unwrap()
                .contains("no solution found for h")
    );
    assert!(
        measured(gauss.points.last().unwrap())
            .unwrap()
            .errors
            .attitude
            < 1e-11
    );
    assert!(pair.failures(4.0).is_none() && pair.points.len() == 12);

    let figure = picture(&curves, &problem, &reference, "chart");
    assert_eq!((figure.panels.len(), figure.labels), (3, Labels::Ends));
    let failures = composition
        .points
        .iter()
        .filter(|point| point.outcome.is_err())
        .count();
    for panel in &figure.panels {
        let level = panel
            .levels
            .iter()
            .find(|level| level.label == "failed")
            .unwrap();
        let crosses = panel
            .lines
            .iter()
            .find(|line| line.marker == Some(Marker::Cross))
            .unwrap();
        assert_eq!(crosses.points.len(), failures);
        assert!(
            crosses
                .points
                .iter()
                .all(|(x, y)| *x > 0.0 && *y == level.y)
        );
        let labels = panel.lines.iter().filter(|line| !line.label.is_empty());
        assert!(labels.clone().count() == 3 && labels.clone().all(|line| line.marker.is_some()));
    }
    assert!(
        figure
            .notes
            .iter()
            .any(|note| note.starts_with("× composition-2"))
    );
    assert!(figure.render().unwrap().svg.contains("unknown below"));

    let table = csv(&curves, 4.0);
    let columns = |line: &str| line.split('"').next().unwrap().matches(',').count();
    assert!(table.lines().all(|line| columns(line) == 16), "{table}");
    let points = curves.iter().flat_map(|curve| &curve.points);
    let failures = points.filter(|point| point.outcome.is_err()).count();
    assert_eq!(table.matches("no solution found for h").count(), failures);
}

#[test]
fn a_method_that_only_fails_is_on_the_chart_by_name() {
    let problem = paper(1.0);
    let reference = Reference::new(&problem).unwrap();
    let contender = named("rk4");
    let setting = Setting::Tolerance(1.0);
    let failure = contender.run(&problem, setting).unwrap_err();
    let points = vec![Point {
        setting,
        outcome: Err(failure),
    }];
    let figure = picture(&[Curve { contender, points }], &problem, &reference, "");
    for panel in &figure.panels {
        let named = panel.lines.iter().filter(|line| line.label == "rk4");
        assert!(
            named.clone().any(|line| line.points.len() == 1),
            "{panel:?}"
        );
    }
    assert!(
        figure
            .render()
            .unwrap()
            .svg
            .contains("rk4 is not run with a tolerance")
    );
}

#[test]
fn an_error_reached_by_luck_is_not_reached() {
    let problem = paper(1.0);
    let reference = Reference::new(&problem).unwrap();
    let sweep = curve("rk4", &problem, &reference);
    let good = sweep.points.iter().filter_map(measured).next().unwrap();
    let at = |steps: u64, attitude: f64| {
        let mut measured = good;
        measured.errors.attitude = attitude;
        measured.cost.time = Duration::from_millis(steps);
        Point {
            setting: Setting::Steps(steps),
            outcome: Ok(measured),
        }
    };
    let failed = |steps| Point {
        setting: Setting::Steps(steps),
        outcome: named("rk4")
            .run(&problem, Setting::Tolerance(1.0))
            .map(|_| good),
    };
    let lucky = Curve {
        contender: named("rk4"),
        points: vec![
            failed(1),
            at(2, 1e-7),
            at(4, 1e-3),
            at(8, 1e-5),
            at(16, 1e-6),
        ],
    };
    let choice = |curve: &Curve, error| curve.cheapest(error).map(|choice| choice.setting);
    assert_eq!(choice(&lucky, 1e-2), Some(Setting::Steps(2)));
    assert_eq!(choice(&lucky, 1e-4), Some(Setting::Steps(8)));
    assert_eq!(choice(&lucky, 1e-7), None);
    let fails_late = Curve {
        contender: named("cf4"),
        points: vec![at(1, 1e-9), failed(2)],
    };
    assert_eq!(choice(&fails_late, 1.0), None);
    let best = cheapest([&fails_late, &lucky], 1e-4).unwrap();
    assert_eq!(best.contender, named("rk4"));
}
