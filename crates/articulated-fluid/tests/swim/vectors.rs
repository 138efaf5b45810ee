//! States that three independent ways agree on to 1e-12.

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{Composition, Gauss, Integrator, State, Variational};
use lie::{Mat3, Vec3};
use serde_json::Value;

pub fn scene(name: &str) -> Scene {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/swim/scenes");
    Scene::load(format!("{folder}/{name}.toml").as_ref()).expect("a scene")
}

pub fn vectors() -> Value {
    serde_json::from_str(include_str!("vectors.json")).expect("JSON")
}

pub fn numbers(value: &Value) -> Vec<f64> {
    let array = value.as_array().expect("an array");
    array
        .iter()
        .map(|x| x.as_f64().expect("a number"))
        .collect()
}

fn vec3(value: &Value) -> Vec3 {
    Vec3(numbers(value).try_into().expect("three numbers"))
}

fn matrices(value: &Value) -> Vec<Mat3> {
    let array = value.as_array().expect("an array").iter();
    let matrix = |m: &Value| {
        let rows: Vec<[f64; 3]> = m
            .as_array()
            .expect("rows")
            .iter()
            .map(|r| vec3(r).0)
            .collect();
        Mat3(rows.try_into().expect("three rows"))
    };
    array.map(matrix).collect()
}

/// How far the attitudes and the first body's mass centre are from those told.
pub fn apart(model: &ArticulatedBody, state: &State<Configuration>, told: &Value) -> [f64; 2] {
    let attitudes = model.attitudes(state.t, &state.g).expect("a state");
    let told_r = matrices(&told["R"]);
    assert_eq!(attitudes.len(), told_r.len());
    let off = attitudes
        .iter()
        .zip(told_r)
        .map(|(r, told)| (*r.matrix() - told).frobenius());
    let centre = model.centre_positions(state.t, &state.g).expect("a state")[0];
    [off.fold(0.0, f64::max), (centre - vec3(&told["x"])).norm()]
}

/// The model of a scene, its start, which is the one that is told, and all that is told.
pub fn begin(name: &str) -> (ArticulatedBody, State<Configuration>, Value) {
    let (scene, case) = (scene(name), vectors()[name].take());
    let model = scene.model().expect("a model");
    let state = scene.initial_state().expect("a state");
    let [r, x] = apart(&model, &state, &case["start"]);
    assert!(r < 1e-14 && x < 1e-14, "{name} starts {r:e} and {x:e} off");
    (model, state, case)
}

fn follows(name: &str, h: f64) {
    let (model, mut state, case) = begin(name);
    let start = model.conserved(&state).expect("finite");
    let energy = case["start"]["energy"].as_f64().expect("a number");
    assert!(
        (start.energy - energy).abs() < 1e-12 * energy.abs().max(1.0),
        "{name}: {start:?}"
    );
    let mut integrator = Gauss::new::<8>(model.clone());
    for told in case["at"].as_array().expect("states") {
        let t = told["t"].as_f64().expect("a time");
        while state.t < t - 0.5 * h {
            integrator.step(&mut state, h).expect("a step");
        }
        let [r, x] = apart(&model, &state, told);
        assert!(
            r < 1e-9 && x < 1e-9,
            "{name} at {t} s is {r:e} and {x:e} off"
        );
    }
}

#[test]
fn the_prescribed_fish_swims_as_told() {
    follows("fish-prescribed", 0.05);
}

#[test]
fn the_wave_of_an_eel_swims_as_told() {
    follows("eel-wave", 0.05);
}

#[test]
fn a_triple_pendulum_on_hinges_falls_as_told() {
    follows("pendulum-hinges", 0.02);
}

#[test]
fn a_triple_pendulum_on_balls_falls_as_told() {
    follows("pendulum-balls", 0.01);
}

/// The largest error of a coordinate of the head on the fish after a second, as they were found by other code, and how they fall.
#[test]
fn every_method_has_its_order_on_the_driven_fish() {
    let scene = scene("fish-prescribed");
    let model = scene.model().expect("a model");
    let start = scene.initial_state().expect("a state");
    let vectors = vectors();
    let told = &vectors["fish-prescribed"]["at"][0];
    let error = |integrator: Box<dyn Integrator<Group = Configuration>>, h: f64| {
        let (mut integrator, mut state) = (integrator, start.clone());
        for k in 1..=(1.0 / h).round() as u64 {
            integrator.step(&mut state, h).expect("a step");
            state.t = k as f64 * h;
        }
        let centre = model.centre_positions(state.t, &state.g).expect("a state")[0];
        let off = centre - vec3(&told["x"]);
        off.0.iter().fold(0.0_f64, |m, x| m.max(x.abs()))
    };
    type Make = fn(ArticulatedBody) -> Box<dyn Integrator<Group = Configuration>>;
    let methods: [(Make, f64, Option<[f64; 2]>); 6] = [
        (
            |m| Box::new(Variational::new(m)),
            0.01,
            Some([1.8e-2, 8.8e-3]),
        ),
        (|m| Box::new(Composition::new::<2>(m)), 0.02, None),
        (|m| Box::new(Composition::new::<4>(m)), 0.05, None),
        (
            |m| Box::new(Gauss::new::<1>(m)),
            0.05,
            Some([4.3e-3, 1.1e-3]),
        ),
        (
            |m| Box::new(Gauss::new::<2>(m)),
            0.1,
            Some([1.1e-4, 6.8e-6]),
        ),
        (
            |m| Box::new(Gauss::new::<4>(m)),
            0.2,
            Some([1.6e-5, 3.4e-8]),
        ),
    ];
    for (make, h, known) in methods {
        let order = make(model.clone()).order();
        let [long, short] = [h, 0.5 * h].map(|h| error(make(model.clone()), h));
        println!("order {order}, h = {h}: {long:.1e}, {short:.1e}");
        assert!((long / short).log2() > f64::from(order) - 0.3, "{order}");
        for (found, known) in [long, short].iter().zip(known.iter().flatten()) {
            // Told to two digits.
            assert!(
                (found / known - 1.0).abs() < 0.05,
                "{order}: {found:e} {known:e}"
            );
        }
    }
}
