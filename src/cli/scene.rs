//! The scene of a command: a file, or the one that is built in.

use std::path::Path;

use articulated_fluid::scene::Overlaps;
use articulated_fluid::{Scene, Smallest};
#[cfg(feature = "chart")]
use lie::VectorSpace;

use super::error::CliError;
use super::print;

const BUILT_IN: &str = include_str!("../../scenes/fish-chain.toml");
const BUILT_IN_NAME: &str = "fish-chain.toml (built in)";

/// Overlaps that are told one by one.
const TOLD: usize = 10;

/// A scene, and what it is modelled with.
pub struct Loaded {
    /// Where it is from.
    pub file: String,
    pub scene: Scene,
    pub smallest: Smallest,
    /// Bodies that share a place at the start.
    pub overlaps: Overlaps,
}

impl Loaded {
    /// Tells of the first overlaps, and how many more there are.
    pub fn warn_of_overlaps(&self) {
        self.overlaps.first.iter().for_each(print::warning);
        if let Some(rest) = self.overlaps.rest() {
            print::warning(&format_args!("and {rest}"));
        }
    }
}

impl Loaded {
    /// Refuses to compare methods where there is nothing to solve, or where its tables do not tell the whole run.
    #[cfg(feature = "chart")]
    pub fn check_methods(&self, until: f64) -> Result<(), CliError> {
        let start = &self.smallest.start;
        match start.mu.dim() {
            0 => Err(CliError::NothingToSolve),
            _ => Ok(sim::check_told(&self.smallest.model, until)?),
        }
    }

    /// What it shows: its title, or the file's name.
    pub fn title(&self) -> &str {
        self.scene.title.as_deref().unwrap_or(&self.file)
    }

    /// Whether it is the paper's scene, from a file or built in.
    pub fn is_papers(&self) -> bool {
        let papers = Scene::parse(BUILT_IN, BUILT_IN_NAME);
        papers.is_ok_and(|papers| papers == self.scene)
    }
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
    match scene.smallest() {
        Ok(smallest) => Ok(Loaded {
            smallest,
            overlaps: scene.overlaps(TOLD),
            file,
            scene,
        }),
        Err(source) => Err(CliError::Model { file, source }),
    }
}
