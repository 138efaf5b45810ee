//! The paper's scene, and contenders by name.

use articulated_fluid::Scene;
use study::contender::{Contender, Problem};

/// For so many seconds.
pub fn paper(until: f64) -> Problem {
    let text = include_str!("../../../../scenes/fish-chain.toml");
    let scene = Scene::parse(text, "fish-chain.toml").unwrap();
    Problem {
        model: scene.model().unwrap(),
        start: scene.initial_state().unwrap(),
        until,
    }
}

pub fn named(name: &str) -> Contender {
    name.parse().unwrap()
}
