//! Loads in joints and on bodies: states told by other code, momentum to rounding, and balances by order.

use articulated_fluid::{Evaluation, Scene};
use dvi::{Composition, Gauss, Integrator, Variational};

use crate::vectors::{apart, begin, numbers, scene};

/// Follows the states and the works that are told.
fn follows(name: &str, h: f64, [states, works]: [f64; 2]) {
    let (model, mut state, case) = begin(name);
    let mut integrator = Gauss::new::<4>(model.clone());
    let (mut drives, mut work, mut steps) = (model.drives(), Evaluation::default(), 0);
    let is_joint = |kind| matches!(kind, articulated_fluid::DriveKind::Joint { .. });
    let of_joints = drives.iter().filter(|drive| is_joint(drive.kind));
    assert_eq!(scene(name).driven_joints().count(), of_joints.count());
    let before = model.conserved(&state).expect("finite").energy;
    for told in case["at"].as_array().expect("states") {
        let t = told["t"].as_f64().expect("a time");
        while state.t < t - 0.5 * h {
            let add = &mut |path: dvi::Path<_>| model.add_drives(path, &mut work, &mut drives);
            integrator.step_along(&mut state, h, add).expect("a step");
            steps += 1;
            state.t = f64::from(steps) * h;
        }
        let [r, x] = apart(&model, &state, told);
        assert!(
            r < states && x < states,
            "{name} at {t} s is {r:e} and {x:e} off"
        );
        let told_works = numbers(&told["joint_work"]);
        let drag = told["drag_work"].as_f64().expect("a number");
        let scale = told_works.iter().fold(drag.abs(), |m, x| m.max(x.abs()));
        for drive in &drives {
            let told = match drive.kind {
                articulated_fluid::DriveKind::Joint { body } => told_works[body],
                _ => drag,
            };
            let off = (drive.work - told).abs() / scale;
            assert!(
                off < works,
                "{name} at {t} s: {drive:?} is {off:e} off {told}"
            );
        }
        let energy = model.conserved(&state).expect("finite").energy;
        let done: f64 = drives.iter().map(|drive| drive.work).sum();
        let off = (energy - before - done).abs() / scale;
        assert!(off < works, "{name} at {t} s: balance {off:e}");
    }
}

#[test]
fn a_fish_with_torques_in_its_joints_moves_as_told() {
    follows("fish-torques", 0.025, [1e-9, 1e-9]);
}

#[test]
fn an_eel_by_servos_with_drag_moves_as_told() {
    follows("eel-servo-linear", 0.005, [1e-9, 1e-9]);
}

#[test]
fn a_tree_of_every_joint_and_load_moves_as_told() {
    follows("tree-mixed", 0.02, [1e-9, 1e-9]);
}

#[test]
fn a_foil_with_a_damper_moves_as_told() {
    follows("foil", 0.005, [1e-9, 1e-9]);
}

/// An eel with motors, dampers and torques in all its joints, and nothing outside.
const MOTORS: &str = "
    fluid.density = 1000
    body = [
      { name = 'a', semi_axes = [0.3, 0.05, 0.1] }, { name = 'b', semi_axes = [0.2, 0.03, 0.1] },
      { name = 'c', semi_axes = [0.2, 0.03, 0.1] }, { name = 'd', semi_axes = [0.2, 0.03, 0.1] },
    ]
    joint = [
      { parent = 'a', child = 'b', at_parent = [-0.32, 0, 0], at_child = [0.22, 0, 0], damping = 0.2, torque = { amplitude = [0.1, 0.3, 0.2], frequency = 0.7 } },
      { parent = 'b', child = 'c', at_parent = [-0.22, 0, 0], at_child = [0.22, 0, 0], type = 'hinge', axis = [0, 0.3, 1], servo = { kp = 5, kd = 0.5, target = { amplitude = 0.5, frequency = 1 } } },
      { parent = 'c', child = 'd', at_parent = [-0.22, 0, 0], at_child = [0.22, 0, 0], servo = { kp = 3, kd = 0.2, target = { amplitude = [0.1, 0.2, 0.5], frequency = 1 } } },
    ]
";

#[test]
fn motors_and_dampers_keep_the_momentum_whatever_the_tolerance() {
    let scene = Scene::parse(MOTORS, "motors.toml").expect("a scene");
    let model = scene.model().expect("a model");
    assert!(model.keeps_momentum() && !model.keeps_energy());
    for tolerance in [None, Some(1e-6)] {
        let mut integrator = Variational::new(model.clone());
        if let Some(tolerance) = tolerance {
            integrator = integrator.with_tolerance(tolerance);
        }
        let mut state = scene.initial_state().expect("a state");
        for k in 1..=100_000 {
            integrator.step(&mut state, 0.002).expect("a step");
            state.t = f64::from(k) * 0.002;
        }
        let end = model.conserved(&state).expect("finite");
        // From rest, beside momenta of single bodies of about 1 kg m²/s: rounding of 1e5 steps.
        assert!(
            end.angular.norm() < 1e-11,
            "{tolerance:?}: {:?}",
            end.angular
        );
        assert!(end.kinetic > 1e-4, "it moves: {end:?}");
    }
}

/// The largest difference of energy and work in a second, J, and the work.
pub fn balance(
    scene: &Scene,
    integrator: &mut dyn Integrator<Group = articulated_fluid::Configuration>,
    h: f64,
) -> [f64; 2] {
    let model = scene.model().expect("a model");
    let mut state = scene.initial_state().expect("a state");
    let (mut drives, mut work, mut worst) = (model.drives(), Evaluation::default(), 0.0_f64);
    let before = model.conserved(&state).expect("finite").energy;
    for k in 1..=(1.0 / h).round() as u32 {
        let add = &mut |path: dvi::Path<_>| model.add_drives(path, &mut work, &mut drives);
        integrator.step_along(&mut state, h, add).expect("a step");
        state.t = f64::from(k) * h;
        let energy = model.conserved(&state).expect("finite").energy;
        let done: f64 = drives.iter().map(|drive| drive.work).sum();
        worst = worst.max((energy - before - done).abs());
    }
    [worst, drives.iter().map(|drive| drive.work).sum()]
}

#[test]
fn energy_and_the_work_of_every_load_balance_with_the_order() {
    let drag = "drag = { linear = [1, 5, 5], angular_linear = [0.01, 0.1, 0.1] }, thrust = { force = [2, 0, 0.3], at = [-0.1, 0.02, 0] }";
    let dragged = MOTORS.replacen(
        "semi_axes = [0.3, 0.05, 0.1]",
        &format!("semi_axes = [0.3, 0.05, 0.1], {drag}"),
        1,
    );
    let held = dragged.replacen("joint = [", "joint = [ { parent = 'world', child = 'a', at_parent = [0, 0, 0], at_child = [0.1, 0, 0], place = { amplitude = [0.1, 0, 0.05], frequency = 1 } },", 1);
    for text in [MOTORS, &dragged, &held] {
        let scene = Scene::parse(text, "motors.toml").expect("a scene");
        let model = scene.model().expect("a model");
        type Boxed = Box<dyn Integrator<Group = articulated_fluid::Configuration>>;
        let methods: [(Boxed, f64); 4] = [
            (Box::new(Variational::new(model.clone())), 0.005),
            (Box::new(Composition::new::<2>(model.clone())), 0.01),
            (Box::new(Gauss::new::<1>(model.clone())), 0.01),
            (Box::new(Gauss::new::<2>(model.clone())), 0.02),
        ];
        for (mut integrator, h) in methods {
            let order = integrator.order();
            let [long, short] = [h, 0.5 * h].map(|h| {
                integrator.reset();
                balance(&scene, integrator.as_mut(), h)[0]
            });
            let observed = (long / short).log2();
            println!("order {order}, {h} s: {long:.1e} J, {short:.1e} J, observed {observed:.2}");
            assert!(observed > f64::from(order) - 0.3, "{order}: {observed}");
        }
    }
}
