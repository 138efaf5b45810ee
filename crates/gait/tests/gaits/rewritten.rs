//! Scenes with another stroke.

use articulated_fluid::Scene;
use articulated_fluid::scene::StartVelocity;
use gait::{Chain, Fourier, Stroke, Told, with_stroke};

/// When the stroke begins, s.
const FROM: f64 = 0.85;

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
        let rewritten = with_stroke(text, &chain, &stroke, FROM).expect("a text");
        let scene = Scene::parse(&rewritten, "rewritten.toml")
            .unwrap_or_else(|error| panic!("{error}: {rewritten}"));
        let told = Told::new(&scene.model().expect("a model")).expect("a stroke");
        assert_eq!(scene.velocity, StartVelocity::NoMomentum);
        for t in [0.0, 0.3, 1.1] {
            let [found, known] = [told.derivative(FROM + t, 0), stroke.derivative(t, 0)];
            let off = found.iter().zip(&known).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-12, "{found:?} {known:?}");
        }
    }
}
