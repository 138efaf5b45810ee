//! Scenes with one mistake each, and what they are told.

use std::path::Path;

use articulated_fluid::Scene;

#[test]
fn each_wrong_scene_is_told_its_mistake() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/wrong");
    let entries = std::fs::read_dir(&folder).expect("the wrong scenes");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    paths.sort();
    let message = |path: &std::path::PathBuf| {
        let message = match Scene::load(path) {
            Ok(_) => "no mistake".to_owned(),
            Err(error) => error.to_string(),
        };
        message.replace(&format!("{}/", folder.display()), "")
    };
    let found: String = paths.iter().map(|path| message(path) + "\n").collect();
    let told = include_str!("wrong.txt");
    assert_eq!(found, told);
}

#[test]
fn the_swimming_scenes_run() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/swim");
    for entry in std::fs::read_dir(&folder).expect("the scenes") {
        use dvi::Integrator;
        let path = entry.expect("an entry").path();
        let scene = Scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
        let (model, mut state) = (
            scene.model().expect("a model"),
            scene.initial_state().expect("a state"),
        );
        let mut integrator = dvi::Composition::new::<2>(model.clone());
        for _ in 0..500 {
            integrator
                .step(&mut state, 0.005)
                .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        }
        let kept = model.conserved(&state).expect("finite");
        if scene.mount.is_none() {
            // Rounding of 500 steps, beside momenta of single bodies up to 1e4.
            assert!(
                kept.angular.norm() < 1e-9 && kept.linear.norm() < 1e-7,
                "{}: {kept:?}",
                path.display()
            );
        }
    }
}
