//! Every scene of the collection is a model in motion.

use std::path::{Path, PathBuf};

use articulated_fluid::Scene;
use lie::VectorSpace;

fn files() -> Vec<PathBuf> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let entries = std::fs::read_dir(scenes).expect("the scenes");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect()
}

#[test]
fn every_scene_has_a_model_and_an_initial_state() {
    for path in files() {
        let scene = Scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
        let model = scene.model().expect("a model");
        let state = scene.initial_state().expect("a state");
        assert_eq!(model.bodies().len(), scene.bodies.len());
        assert_eq!(state.t, 0.0);
        assert_eq!(state.g.1.0, scene.position);
        // The momentum's velocity is the scene's: rounding times the condition of the inertia.
        let xi = model.velocity(&state).expect("the model's state");
        let heads = [scene.bodies[0].angular_velocity, scene.velocity];
        let tails = scene.bodies[1..].iter().map(|body| body.angular_velocity);
        let given: Vec<f64> = heads.into_iter().chain(tails).flatten().collect();
        for (found, given) in xi.coordinates().into_iter().zip(given) {
            assert!((found - given).abs() < 1e-12, "{}", path.display());
        }
        let kept = model.conserved(&state).expect("the model's state");
        assert!(
            kept.energy > 0.0 && kept.energy.is_finite(),
            "{}",
            path.display()
        );
    }
}
