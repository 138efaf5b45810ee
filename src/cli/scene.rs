//! The scene of a command: a file, or the one that is built in.

use std::path::Path;

use articulated_fluid::scene::Overlap;
use articulated_fluid::{ArticulatedBody, Configuration, ModelError, Scene, Smallest};
use dvi::State;

use super::error::CliError;

const BUILT_IN: &str = include_str!("../../scenes/fish-chain.toml");
const BUILT_IN_NAME: &str = "fish-chain.toml (built in)";

/// A scene with its models and the state at t = 0.
pub struct Loaded {
    /// Where it is from.
    pub file: String,
    pub scene: Scene,
    /// Of the whole, whatever is integrated.
    pub model: ArticulatedBody,
    pub smallest: Smallest,
    pub start: State<Configuration>,
    /// Bodies that share a place at the start.
    pub overlaps: Vec<Overlap>,
}

/// Loads the scene in the file `path`, or the one that is built in.
pub fn load(path: Option<&Path>) -> Result<Loaded, CliError> {
    let (scene, file) = match path {
        Some(path) => (Scene::load(path)?, path.display().to_string()),
        None => (
            Scene::parse(BUILT_IN, BUILT_IN_NAME)?,
            BUILT_IN_NAME.to_owned(),
        ),
    };
    modelled(scene, file.clone()).map_err(|source| CliError::Model { file, source })
}

fn modelled(scene: Scene, file: String) -> Result<Loaded, ModelError> {
    Ok(Loaded {
        model: scene.model()?,
        smallest: scene.smallest()?,
        start: scene.initial_state()?,
        overlaps: scene.overlaps(),
        file,
        scene,
    })
}
