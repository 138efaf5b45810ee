//! A picture twice and its numbers: three files.

use std::io::Write;
use std::path::{Path, PathBuf};

use figure::Rendered;
use sim::file::{AtomicFile, FileError, is_same};

use super::error::CliError;

/// Files in the making, in the order of [`ENDINGS`].
pub struct Files(Vec<(PathBuf, AtomicFile)>);

const ENDINGS: [&str; 3] = ["svg", "png", "csv"];

impl Files {
    /// Begins them: what is wrong with them shows before the runs.
    pub fn create(stem: &Path, scene: Option<&Path>) -> Result<Self, CliError> {
        if stem == Path::new("-") {
            return Err(CliError::OutputIsDash);
        }
        let create = |ending| {
            let path = with_ending(stem, ending).ok_or_else(|| CliError::Output {
                path: stem.to_owned(),
                source: FileError::Directory,
            })?;
            if scene.is_some_and(|scene| is_same(scene, &path)) {
                return Err(CliError::OutputIsScene(path));
            }
            match AtomicFile::create(&path) {
                Ok(output) => Ok((path, output)),
                Err(source) => Err(CliError::Output { path, source }),
            }
        };
        let files: Result<_, _> = ENDINGS.into_iter().map(create).collect();
        Ok(Self(files?))
    }

    /// Writes all of them, and only then puts them in their places.
    pub fn finish(mut self, drawn: &Rendered, table: &str) -> Result<Vec<PathBuf>, CliError> {
        let contents = [drawn.svg.as_bytes(), &drawn.png, table.as_bytes()];
        let refused = |path: &Path, source: FileError| CliError::Output {
            path: path.to_owned(),
            source,
        };
        for ((path, output), content) in self.0.iter_mut().zip(contents) {
            let written = output.write_all(content).and_then(|()| output.flush());
            written.map_err(|error| refused(path, error.into()))?;
        }
        let finish = |(path, output): (PathBuf, AtomicFile)| match output.finish() {
            Ok(()) => Ok(path),
            Err(source) => Err(refused(&path, source)),
        };
        self.0.into_iter().map(finish).collect()
    }
}

/// The stem's name with an ending after it, whatever dots it has; none where the stem is a directory's.
fn with_ending(stem: &Path, ending: &str) -> Option<PathBuf> {
    let text = stem.as_os_str().as_encoded_bytes();
    let is_directory = |&byte: &u8| std::path::is_separator(byte.into());
    if text.last().is_some_and(is_directory) {
        return None;
    }
    let mut name = stem.file_name()?.to_owned();
    name.push(".");
    name.push(ending);
    Some(stem.with_file_name(name))
}
