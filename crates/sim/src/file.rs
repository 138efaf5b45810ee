//! A file that is written whole or not at all.

mod part;

use std::fs::{self, File, Metadata, Permissions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf, is_separator};

use tempfile::TempPath;
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
    #[error("no file can be made in {}: {source}{}", directory.display(), advice(source))]
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

impl FileError {
    /// Whether no file can be at this path, whatever the system allows.
    pub fn is_of_the_path(&self) -> bool {
        matches!(
            self,
            Self::Directory | Self::Special | Self::ReadOnly | Self::Path(_)
        )
    }
}

/// What helps where a directory takes no file.
fn advice(error: &io::Error) -> &'static str {
    match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => "; give a directory that exists",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "; give a directory that can be written"
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "; make room there, or give another directory"
        }
        _ => "",
    }
}

/// A file in the making: beside its target until [`finish`](Self::finish), and gone without it.
///
/// It takes the permissions of the file that it replaces. Where the path is a symbolic link, it replaces the file behind the link, or
/// makes it. A process that is killed leaves a hidden part beside the target, `.lgvi-*.part`; the next file made there removes it,
/// and never one that a running process writes.
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
        let (target, replaced) = resolve(path)?;
        let directory = match target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let file = part::make(directory, replaced.as_ref());
        let file = file.map_err(|source| FileError::Create {
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

    /// Another handle, for a thread that may be given up: the file is gone when this one is, whoever still writes.
    ///
    /// # Errors
    /// Those of the system.
    pub fn handle(&self) -> io::Result<File> {
        self.file.get_ref().try_clone()
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// [`FileError::Write`]; the old file, if any, is as it was.
    pub fn finish(self) -> Result<(), FileError> {
        self.complete()?.place()
    }

    /// Writes all of it to the disk, and leaves only the place to be taken.
    ///
    /// # Errors
    /// As [`finish`](Self::finish).
    pub fn complete(self) -> Result<CompleteFile, FileError> {
        let file = self.file.into_inner().map_err(|error| error.into_error())?;
        file.sync_all()?;
        Ok(CompleteFile {
            file,
            temporary: self.temporary,
            target: self.target,
        })
    }
}

/// A file that is whole, and not yet in its place: for what is to be done before the old one goes. It is gone without
/// [`place`](Self::place).
pub struct CompleteFile {
    /// Open, since its lock tells others that it is in use.
    file: File,
    temporary: TempPath,
    target: PathBuf,
}

impl CompleteFile {
    /// Puts the file in its place.
    ///
    /// # Errors
    /// As [`AtomicFile::finish`].
    pub fn place(self) -> Result<(), FileError> {
        let placed = self.temporary.persist(self.target);
        drop(self.file);
        Ok(placed.map_err(|error| error.error)?)
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

/// The file to replace, behind symbolic links, and its permissions; or the one to make.
fn resolve(path: &Path) -> Result<(PathBuf, Option<Permissions>), FileError> {
    let text = path.as_os_str().as_encoded_bytes();
    if text.last().is_some_and(|&byte| is_separator(byte.into())) {
        return Err(FileError::Directory);
    }
    match fs::metadata(path) {
        Ok(old) => {
            check(&old)?;
            let target = fs::canonicalize(path).map_err(FileError::Path)?;
            Ok((target, Some(old.permissions())))
        }
        // A chain of links that leads nowhere ends; one that goes round is another error.
        Err(error) if error.kind() == ErrorKind::NotFound => match fs::read_link(path) {
            Ok(to) => resolve(&path.parent().unwrap_or(Path::new("")).join(to)),
            Err(_) => Ok((path.to_owned(), None)),
        },
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
