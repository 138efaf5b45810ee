//! The scene of a command: a file, or the one that is built in.

use std::path::Path;

use articulated_fluid::{ArticulatedBody, Configuration, ModelError, Scene};
use dvi::State;

use super::error::CliError;

const BUILT_IN: &str = include_str!("../../scenes/fish-chain.toml");
const BUILT_IN_NAME: &str = "fish-chain.toml (built in)";

/// A scene with its model and the state at t = 0.
pub struct Loaded {
    /// Where it is from.
    pub file: String,
    pub scene: Scene,
    pub model: ArticulatedBody,
    pub start: State<Configuration>,
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
    match model_and_start(&scene) {
        Ok((model, start)) => Ok(Loaded {
            file,
            scene,
            model,
            start,
        }),
        Err(source) => Err(CliError::Model { file, source }),
    }
}

fn model_and_start(scene: &Scene) -> Result<(ArticulatedBody, State<Configuration>), ModelError> {
    Ok((scene.model()?, scene.initial_state()?))
}
