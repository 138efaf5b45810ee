//! Files that a command is asked to write.

use std::path::Path;

use sim::file::{AtomicFile, is_same};

use super::error::CliError;

/// Begins a file that is not the scene: what is wrong with it shows before the runs.
pub fn begin(path: &Path, scene: Option<&Path>) -> Result<AtomicFile, CliError> {
    refuse_dash(path)?;
    if scene.is_some_and(|scene| is_same(scene, path)) {
        return Err(CliError::OutputIsScene(path.to_owned()));
    }
    AtomicFile::create(path).map_err(|source| CliError::output(path, source))
}

/// Refuses what stands for stdout elsewhere.
pub fn refuse_dash(path: &Path) -> Result<(), CliError> {
    match path == Path::new("-") {
        true => Err(CliError::OutputIsDash),
        false => Ok(()),
    }
}
