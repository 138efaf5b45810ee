//! A picture twice and its numbers: three files.

use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};

use figure::Rendered;
use sim::file::{AtomicFile, CompleteFile, FileError};

use super::error::CliError;
use super::output::{begin, refuse_dash};

const ENDINGS: [&str; 3] = ["svg", "png", "csv"];

/// Files in the making, in the order of [`ENDINGS`].
pub struct Files(Vec<(PathBuf, AtomicFile)>);

/// Files that are whole, and not yet in their places.
pub struct CompleteFiles(Vec<(PathBuf, CompleteFile)>);

impl Files {
    /// Begins them: what is wrong with them shows before the runs.
    pub fn begin(stem: &Path, scene: Option<&Path>) -> Result<Self, CliError> {
        refuse_dash(stem)?;
        let directory = || CliError::output(stem, FileError::Directory);
        let file = |ending| -> Result<_, CliError> {
            let path = with_ending(stem, ending).ok_or_else(directory)?;
            let file = begin(&path, scene)?;
            Ok((path, file))
        };
        let files: Result<_, _> = ENDINGS.into_iter().map(file).collect();
        Ok(Self(files?))
    }

    /// Writes all of them.
    pub fn complete(self, drawn: &Rendered, table: &str) -> Result<CompleteFiles, CliError> {
        let contents = [drawn.svg.as_bytes(), &drawn.png, table.as_bytes()];
        let complete = |((path, mut file), content): ((PathBuf, AtomicFile), &[u8])| {
            let written = file.write_all(content).map_err(FileError::from);
            match written.and_then(|()| file.complete()) {
                Ok(file) => Ok((path, file)),
                Err(source) => Err(CliError::Output { path, source }),
            }
        };
        let files: Result<_, _> = self.0.into_iter().zip(contents).map(complete).collect();
        Ok(CompleteFiles(files?))
    }
}

impl CompleteFiles {
    pub fn paths(&self) -> Vec<PathBuf> {
        self.0.iter().map(|(path, _)| path.clone()).collect()
    }

    /// Puts them in their places.
    pub fn place(self) -> Result<(), CliError> {
        let place = |(path, file): (PathBuf, CompleteFile)| {
            file.place()
                .map_err(|source| CliError::Output { path, source })
        };
        self.0.into_iter().try_for_each(place)
    }
}

/// The stem's name with an ending after it, in place of another of them; none where the stem is a directory's.
fn with_ending(stem: &Path, ending: &str) -> Option<PathBuf> {
    let text = stem.as_os_str().as_encoded_bytes();
    let is_directory = |&byte: &u8| std::path::is_separator(byte.into());
    if text.last().is_some_and(is_directory) {
        return None;
    }
    let is_one_of_them = |own: &OsStr| ENDINGS.iter().any(|ending| own == *ending);
    let has_one = stem.extension().is_some_and(is_one_of_them);
    let name = if has_one {
        stem.file_stem()
    } else {
        stem.file_name()
    };
    let mut name = name?.to_owned();
    name.push(".");
    name.push(ending);
    Some(stem.with_file_name(name))
}
