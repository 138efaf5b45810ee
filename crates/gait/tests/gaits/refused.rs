//! What is no gait, or no search.

use articulated_fluid::Scene;
use gait::{Fourier, GaitError, Limits, Objective, Report, Search};

use crate::swimmers::three_links;

const LIMITS: Limits = Limits {
    angle: 1.0,
    rate: 5.0,
};

fn links() -> Scene {
    let motion = |phase: f64| format!("{{ amplitude = 0.5, frequency = 1, phase = {phase} }}");
    three_links([&motion(1.5), &motion(0.0)])
}

fn search(scene: &Scene, limits: Limits) -> Result<Search, GaitError> {
    Search::new(scene, Objective::Advance, limits)
}

#[test]
fn a_weight_is_refused() {
    let mut heavy = links();
    heavy.gravity = [0.0, 0.0, -9.81];
    heavy.bodies[1].net_mass = 0.1;
    assert!(matches!(Report::of(&heavy, 1), Err(GaitError::Weight)));
}

#[test]
fn one_coordinate_leads_nowhere() {
    let motion = "{ amplitude = 0.5, frequency = 1 }";
    let scene = three_links([motion, "{ bias = 0.2 }"]);
    let report = Report::of(&scene, 3).expect("a report");
    // There and back: but for rounding, and the quadrature's 1e-13.
    assert!(
        report
            .net
            .displacement_metres
            .iter()
            .all(|x| x.abs() < 1e-11)
    );
    assert_eq!(report.cost_of_transport, None);
}

#[test]
fn limits_that_are_none_are_refused() {
    for angle in [0.0, -1.0, 4.0, f64::NAN, f64::INFINITY] {
        let limits = Limits { angle, ..LIMITS };
        assert!(matches!(
            search(&links(), limits),
            Err(GaitError::Limits { .. })
        ));
    }
}

#[test]
fn harmonics_are_as_many_as_a_stroke_needs_and_no_thousands() {
    let two = three_links([
        "{ amplitude = 0.5, frequency = 2 }",
        "{ amplitude = 0.5, frequency = 3 }",
    ]);
    let search = search(&two, LIMITS).expect("a search");
    assert!(matches!(search.own(2), Err(GaitError::Harmonics { .. })));
    assert!(search.own(3).is_ok());
    assert!(matches!(
        search.own(usize::MAX),
        Err(GaitError::Order { .. })
    ));
    assert!(matches!(
        Fourier::new(1.0, 1_000_000_000, vec![0.0]),
        Err(GaitError::Order { .. })
    ));
}

#[test]
fn a_stroke_at_rest_is_no_start_of_a_ratio() {
    let scene = links();
    let search = Search::new(&scene, Objective::AdvancePerLength, LIMITS).expect("a search");
    let still = Fourier::new(1.0, 1, vec![0.1, 0.0, 0.0, 0.2, 0.0, 0.0]).expect("a stroke");
    assert!(matches!(search.improve(&still, &|| true), Ok(None)));
    assert!(matches!(search.value(&still), Err(GaitError::Still)));
}

#[test]
fn more_strokes_than_a_path_can_tell_are_refused() {
    assert!(matches!(
        Report::of(&links(), u32::MAX),
        Err(GaitError::Strokes { .. })
    ));
}

#[test]
fn strokes_of_other_coordinates_are_refused() {
    let search = search(&links(), LIMITS).expect("a search");
    let other = Fourier::new(1.0, 1, vec![0.1; 9]).expect("a stroke");
    assert!(matches!(
        search.improve(&other, &|| true),
        Err(GaitError::Shape { .. })
    ));
}
