//! The scenes of the collection: read, apart, in motion, and what each of them shows.

use std::path::{Path, PathBuf};

use articulated_fluid::scene::StartVelocity;
use articulated_fluid::{ArticulatedBody, Configuration, Conserved, Scene};
use dvi::{Integrator, State, Variational};
use lie::{Vec3, VectorSpace};

fn directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

#[track_caller]
fn load(file: &str) -> Scene {
    Scene::load(&directory().join(file)).unwrap_or_else(|error| panic!("{error}"))
}

/// Every scene in a folder of the scenes with the name of its file.
fn all_in(folder: &str) -> Vec<(String, Scene)> {
    let entries = std::fs::read_dir(directory().join(folder)).expect("the scenes");
    let files = entries.map(|entry| entry.expect("an entry").path());
    let names = files.filter(|path| path.is_file()).map(|path| {
        let name = path.file_name().and_then(|name| name.to_str());
        format!("{folder}{}", name.expect("a name"))
    });
    names.map(|name| (name.clone(), load(&name))).collect()
}

fn all() -> Vec<(String, Scene)> {
    all_in("")
}

fn start(scene: &Scene) -> (ArticulatedBody, State<Configuration>, Conserved) {
    let model = scene.model().expect("a model");
    let state = scene.initial_state().expect("a state");
    let conserved = model.conserved(&state).expect("the model's state");
    (model, state, conserved)
}

/// Every TOML file in and below a folder, but for the scenes that are wrong on purpose.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let below = paths.flat_map(|path| match path.is_dir() {
        true if path.ends_with("wrong") => Vec::new(),
        true => files_below(&path),
        false => vec![path],
    });
    let toml = |path: &PathBuf| {
        path.extension()
            .is_some_and(|extension| extension == "toml")
    };
    below.filter(toml).collect()
}

#[test]
fn every_file_of_the_collection_is_a_whole_scene() {
    let files = files_below(&directory());
    assert!(files.len() >= 30);
    for file in files {
        let scene = Scene::load(&file).unwrap_or_else(|error| panic!("{error}"));
        scene.model().expect("a model");
        scene.initial_state().expect("a state");
    }
}

#[test]
fn every_scene_is_read_and_has_a_title() {
    let scenes = all();
    let hard = all_in("hard/");
    assert!(scenes.len() >= 7 && hard.len() >= 12);
    let mut titles = scenes.iter().chain(&hard).map(|(_, scene)| &scene.title);
    assert!(titles.all(Option::is_some));
}

#[test]
fn no_bodies_overlap() {
    for (name, scene) in all().into_iter().chain(all_in("hard/")) {
        assert_eq!(scene.overlaps(1).first, [], "{name}");
    }
}

#[test]
fn every_scene_has_a_model_and_an_initial_state() {
    for (name, scene) in all() {
        let (model, state, conserved) = start(&scene);
        assert_eq!(model.bodies().len(), scene.bodies.len());
        assert_eq!(state.t, 0.0);
        assert_eq!(state.g.1[0].0, scene.position);
        assert!(
            conserved.energy > 0.0 && conserved.energy.is_finite(),
            "{name}"
        );
        // The momentum's velocity is the scene's: rounding times the condition of the inertia.
        let (rates, velocity, _) = model.velocity(&state).expect("the model's state");
        if let StartVelocity::Given(given) = scene.velocity {
            assert_close(&name, velocity[0].vec3(), given);
        }
        for (rate, body) in rates.iter().zip(&scene.bodies) {
            assert_close(&name, rate.vec3(), body.angular_velocity);
        }
    }
}

#[track_caller]
fn assert_close(name: &str, found: Vec3, given: [f64; 3]) {
    assert!(
        (found - Vec3(given)).norm() < 1e-11,
        "{name}: {found:?} for {given:?}"
    );
}

#[test]
fn a_start_without_momentum_has_none_to_rounding() {
    for (name, scene) in all() {
        if scene.velocity == StartVelocity::ZeroMomentum {
            let (_, state, conserved) = start(&scene);
            let size = state.mu.max_magnitude();
            for linear in [state.mu.1[0].vec3(), conserved.linear] {
                println!("{name}: {:.1e} of {size:.1e}", linear.norm());
                assert!(linear.norm() < 1e-13 * size.max(1.0), "{name}: {linear:?}");
            }
        }
    }
}

#[test]
fn the_dry_chain_has_the_energy_and_momentum_worked_out_by_hand() {
    let (_, _, conserved) = start(&load("dry-chain.toml"));
    assert!(
        (conserved.energy - 4.540_184_583_3).abs() < 1e-10,
        "{conserved:?}"
    );
    let expected = Vec3([0.25, 9.7545, 21.3294]);
    assert!(
        (conserved.angular - expected).norm() < 1e-10,
        "{conserved:?}"
    );
}

#[test]
fn every_scene_moves_on() {
    for (name, scene) in all() {
        let (model, mut state, before) = start(&scene);
        step(&model, &mut state);
        let after = model.conserved(&state).expect("the model's state");
        let size = before.energy.max(state.mu.max_magnitude());
        assert!((after.energy - before.energy).abs() < 1e-2 * size, "{name}");
        if scene.gravity == [0.0; 3] {
            for (after, before) in [
                (after.linear, before.linear),
                (after.angular, before.angular),
            ] {
                assert!(
                    (after - before).norm() < 1e-12 * size.max(before.norm()),
                    "{name}"
                );
            }
        }
    }
}

/// 100 steps of 10 ms.
fn step(model: &ArticulatedBody, state: &mut State<Configuration>) {
    let mut integrator = Variational::new(model.clone());
    for _ in 0..100 {
        integrator
            .step(state, 1e-2)
            .unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn the_planar_fish_stays_in_its_plane() {
    let (model, mut state, _) = start(&load("planar-fish.toml"));
    step(&model, &mut state);
    let (rates, velocity, _) = model.velocity(&state).expect("the model's state");
    let heights = model
        .centre_positions(state.t, &state.g)
        .unwrap()
        .into_iter()
        .map(|x| x[2]);
    let tilts = rates.iter().flat_map(|rate| [rate[0], rate[1]]);
    let mut out_of_plane = heights.chain(tilts).chain([velocity[0][2]]);
    assert!(out_of_plane.all(|x| x == 0.0));
}

#[test]
fn the_eel_floats_and_the_robot_sinks() {
    assert!(
        load("eel.toml")
            .bodies
            .iter()
            .all(|body| body.net_mass == 0.0)
    );
    let robot = load("branching-robot.toml");
    let net: f64 = robot.bodies.iter().map(|body| body.net_mass).sum();
    println!("the robot: {net} kg heavier than the water");
    assert!(net > 0.5 && net < 5.0);
    assert_eq!(robot.gravity, [0.0, 0.0, -9.81]);
}

/// The paper prints the points of the joints on the tails with the opposite sign.
#[test]
fn the_sign_slip_of_the_print_is_an_overlap() {
    let mut fish = load("fish-chain.toml");
    for joint in &mut fish.joints {
        joint.at_child = joint.at_child.map(|x| -x);
    }
    let messages: Vec<String> = fish
        .overlaps(usize::MAX)
        .first
        .iter()
        .map(ToString::to_string)
        .collect();
    for (message, tail) in messages.iter().zip(["tail-1", "tail-2"]) {
        let expected = format!(
            "bodies \"head\" and {tail:?} overlap by 9.7 m along the line of their centres; \
             check the signs of the joint's points"
        );
        assert_eq!(*message, expected);
    }
    // The tails, whose centres lie in the head on either side of its centre, overlap as well.
    assert_eq!(messages.len(), 3);
}

#[test]
fn the_printed_fish_follows_from_its_semi_axes() {
    let (printed, computed) = (
        load("fish-chain.toml"),
        load("fish-chain-from-semi-axes.toml"),
    );
    assert_eq!(printed.joints, computed.joints);
    assert_eq!(printed.velocity, computed.velocity);
    assert_eq!(printed.density, 1.0 / (32.0 * std::f64::consts::PI));
    assert_eq!(printed.density, computed.density);
    for (printed, computed) in printed.bodies.iter().zip(&computed.bodies) {
        assert_eq!(printed.name, computed.name);
        assert_eq!(printed.semi_axes(), computed.semi_axes());
        assert_eq!(printed.angular_velocity, computed.angular_velocity);
        for (table, value) in [
            (printed.total_mass, computed.total_mass),
            (printed.total_inertia, computed.total_inertia),
        ] {
            for (table, value) in diagonal(table).into_iter().zip(diagonal(value)) {
                assert_eq!(table, (value * 1e4).round() / 1e4);
            }
        }
    }
}

fn diagonal(matrix: [[f64; 3]; 3]) -> [f64; 3] {
    [matrix[0][0], matrix[1][1], matrix[2][2]]
}

#[test]
fn the_printed_fish_has_no_linear_momentum() {
    let (_, _, conserved) = start(&load("fish-chain.toml"));
    // The velocity is printed to 5e-5, for a total mass of about 3.5 kg.
    assert!(
        conserved.linear.0.iter().all(|p| p.abs() < 2e-4),
        "{conserved:?}"
    );
}
