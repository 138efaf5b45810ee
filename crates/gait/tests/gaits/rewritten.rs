//! Scenes with another stroke.

use articulated_fluid::Scene;
use gait::{Chain, Fourier, Told, net_motion, with_stroke};
use lie::LieGroup;

/// Both kinds of lists, and a gait that goes.
const TEXTS: [&str; 2] = [
    include_str!("../../../../scenes/swim/eel.toml"),
    include_str!("../../../../scenes/swim/fish.toml"),
];

#[test]
fn a_scene_with_a_stroke_does_it() {
    for text in TEXTS {
        let scene = Scene::parse(text, "scene.toml").expect("a scene");
        let chain = Chain::new(&scene).expect("a chain");
        let of_one = 5;
        let random = |k: usize| 0.3 * ((k * k + 1) as f64).sin();
        let coefficients = (0..of_one * chain.dim()).map(random).collect();
        let stroke = Fourier::new(1.7, 2, coefficients).expect("a stroke");
        let rewritten = with_stroke(text, &chain, &stroke).expect("a text");
        let scene = Scene::parse(&rewritten, "rewritten.toml")
            .unwrap_or_else(|error| panic!("{error}: {rewritten}"));
        let told = Told::new(&scene.model().expect("a model")).expect("a stroke");
        let [found, known] =
            [net_motion(&chain, &told), net_motion(&chain, &stroke)].map(|g| g.expect("a motion"));
        let apart = found.inverse().compose(&known);
        assert!(
            apart.translation.norm() < 1e-12 && apart.rotation.matrix().skew_vee().norm() < 1e-12
        );
    }
}
