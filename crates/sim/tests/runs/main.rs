//! Runs of scenes: the methods by name, the laws of the loop, and the table. One program, for what they share is compiled once.

mod accuracy;
mod dense;
mod errors;
mod file;
mod methods;
mod simulation;
mod table;

use articulated_fluid::Scene;

/// The paper's three ellipsoids.
fn paper() -> Scene {
    let text = include_str!("../../../../scenes/fish-chain.toml");
    Scene::parse(text, "fish-chain.toml").unwrap()
}

/// A scene of the collection.
fn scene(name: &str) -> Scene {
    let scenes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    Scene::load(&scenes.join(name).with_extension("toml")).unwrap()
}

/// A chain in a vacuum that drifts and falls: its states depend on the time.
fn falling() -> Scene {
    let text = "
        gravity = [0, 0, -9.81]
        fluid.density = 0
        start.velocity = [3, 0, 1]
        [[body]]
        name = 'bus'
        mass = 100
        inertia = [20, 25, 30]
        angular_velocity = [0.3, 0.4, -0.2]
        [[body]]
        name = 'arm'
        mass = 20
        inertia = [0.5, 6, 6]
        angular_velocity = [-0.5, 0.3, 0.8]
        [[joint]]
        parent = 'bus'
        child = 'arm'
        at_parent = [0.8, 0, 0.3]
        at_child = [-1, 0, 0]";
    Scene::parse(text, "falling.toml").unwrap()
}
