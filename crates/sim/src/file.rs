//! A file that is written whole or not at all.

use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf, is_separator};

use tempfile::{Builder, NamedTempFile, TempPath};
use thiserror::Error;

/// Why a file cannot be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileError {
    /// The path is that of a directory.
    #[error("this is a directory; give the name of a file")]
    Directory,
    /// What is there is a device, a pipe or the like.
    #[error("this is no ordinary file; give the name of a file")]
    Special,
    /// What is there may not be written.
    #[error("the file is read-only; give another name, or make it writable")]
    ReadOnly,
    /// The path leads nowhere.
    #[error("the path is of no use: {0}; give another name")]
    Path(#[source] io::Error),
    /// The directory takes no file.
    #[error(
        "no file can be made in {}: {source}; give a directory that exists and can be written",
        directory.display()
    )]
    Create {
        /// Where the file was to be made.
        directory: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// Writing failed.
    #[error("the file cannot be written: {0}; nothing was left there")]
    Write(#[from] io::Error),
}

/// A file in the making: beside its target until [`finish`](Self::finish), and gone without it.
///
/// ```
/// use std::io::Write;
/// use sim::file::AtomicFile;
///
/// let path = std::env::temp_dir().join(format!("lgvi-{}.txt", std::process::id()));
/// let mut file = AtomicFile::create(&path)?;
/// file.write_all(b"all of it")?;
/// assert!(!path.exists());
/// file.finish()?;
/// assert_eq!(std::fs::read(&path)?, b"all of it");
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct AtomicFile {
    file: BufWriter<File>,
    temporary: TempPath,
    target: PathBuf,
}

impl AtomicFile {
    /// Begins the file at `path`, which stays as it is for now.
    ///
    /// # Errors
    /// [`FileError`] of a path that no file can be put at.
    pub fn create(path: &Path) -> Result<Self, FileError> {
        let target = resolve(path)?;
        let directory = match target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let file = temporary(directory).map_err(|source| FileError::Create {
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
    ///
    /// # Errors
    /// [`FileError::Write`]; the old file, if any, is as it was.
    pub fn finish(self) -> Result<(), FileError> {
        let file = self.file.into_inner().map_err(|error| error.into_error())?;
        file.sync_all()?;
        drop(file);
        self.temporary
            .persist(self.target)
            .map_err(|error| error.error)?;
        Ok(())
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes a whole file, as [`fs::write`] does, or leaves the old one as it was.
///
/// # Errors
/// As [`AtomicFile::create`] and [`AtomicFile::finish`].
pub fn write(path: impl AsRef<Path>, contents: impl AsRef<[u8]>) -> Result<(), FileError> {
    let mut file = AtomicFile::create(path.as_ref())?;
    file.write_all(contents.as_ref())?;
    file.finish()
}

/// Whether two paths lead to one file.
pub fn is_same(a: &Path, b: &Path) -> bool {
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}

/// The file to replace: behind symbolic links, and one that may be replaced.
fn resolve(path: &Path) -> Result<PathBuf, FileError> {
    let text = path.as_os_str().as_encoded_bytes();
    if text.last().is_some_and(|&byte| is_separator(byte.into())) {
        return Err(FileError::Directory);
    }
    match fs::metadata(path) {
        Ok(old) => {
            check(&old)?;
            fs::canonicalize(path).map_err(FileError::Path)
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(path.to_owned()),
        Err(error) => Err(FileError::Path(error)),
    }
}

fn check(old: &Metadata) -> Result<(), FileError> {
    if old.is_dir() {
        Err(FileError::Directory)
    } else if !old.is_file() {
        Err(FileError::Special)
    } else if old.permissions().readonly() {
        Err(FileError::ReadOnly)
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
