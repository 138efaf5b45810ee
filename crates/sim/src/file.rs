//! A file that is written whole or not at all.

use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf, is_separator};

use tempfile::{Builder, NamedTempFile, TempPath};
use thiserror::Error;

/// Why a file cannot be written.
#[derive(Debug, Error)]
pub enum OutputError {
    #[error("this is a directory; give the name of a file")]
    Directory,
    #[error("this is no ordinary file; give the name of a file")]
    Special,
    #[error("the file is read-only; give another name, or make it writable")]
    ReadOnly,
    #[error("the path is of no use: {0}; give another name")]
    Path(#[source] io::Error),
    #[error(
        "no file can be made in {}: {source}; give a directory that exists and can be written",
        directory.display()
    )]
    Create {
        directory: PathBuf,
        source: io::Error,
    },
    #[error("the file cannot be written: {0}; nothing was left there")]
    Write(#[from] io::Error),
}

/// A file in the making: beside its target until [`finish`](Self::finish), and gone without it.
pub struct Output {
    file: BufWriter<File>,
    temporary: TempPath,
    target: PathBuf,
}

impl Output {
    /// Begins the file at `path`, which stays as it is for now.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        let target = resolve(path)?;
        let directory = match target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let file = temporary(directory).map_err(|source| OutputError::Create {
            directory: directory.to_owned(),
            source,
        })?;
        let (file, temporary) = file.into_parts();
        Ok(Self {
            file: BufWriter::new(file),
            temporary,
            target,
        })
    }

    /// Puts the file in its place.
    pub fn finish(self) -> Result<(), OutputError> {
        let file = self.file.into_inner().map_err(|error| error.into_error())?;
        file.sync_all()?;
        drop(file);
        self.temporary
            .persist(self.target)
            .map_err(|error| error.error)?;
        Ok(())
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Whether two paths lead to one file.
pub fn same(a: &Path, b: &Path) -> bool {
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}

/// The file to replace: behind symbolic links, and one that may be replaced.
fn resolve(path: &Path) -> Result<PathBuf, OutputError> {
    let text = path.as_os_str().as_encoded_bytes();
    if text.last().is_some_and(|&byte| is_separator(byte.into())) {
        return Err(OutputError::Directory);
    }
    match fs::metadata(path) {
        Ok(old) => {
            check(&old)?;
            fs::canonicalize(path).map_err(OutputError::Path)
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(path.to_owned()),
        Err(error) => Err(OutputError::Path(error)),
    }
}

fn check(old: &Metadata) -> Result<(), OutputError> {
    if old.is_dir() {
        Err(OutputError::Directory)
    } else if !old.is_file() {
        Err(OutputError::Special)
    } else if old.permissions().readonly() {
        Err(OutputError::ReadOnly)
    } else {
        Ok(())
    }
}

fn temporary(directory: &Path) -> io::Result<NamedTempFile> {
    fs::metadata(directory)?;
    let mut builder = Builder::new();
    builder.prefix(".lgvi-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any new file, less the user's mask: temporary files are private otherwise.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let file = builder.tempfile_in(directory);
    // Its own message has the temporary file's name, which tells the user nothing.
    file.map_err(|error| error.kind().into())
}
