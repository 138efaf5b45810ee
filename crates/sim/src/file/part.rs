//! Files in the making: beside their targets, known by their names, and locked as long as somebody writes them.
//!
//! A process that is killed leaves its part, and the system gives up its lock. So a file with the name of a part that nobody has locked
//! is stale, and the next part made in its directory [sweeps](sweep) it. Where files cannot be locked, none is swept.

use std::ffi::OsStr;
use std::fs::{self, File, OpenOptions, Permissions, TryLockError};
use std::io;
use std::path::Path;

use tempfile::{Builder, NamedTempFile};

const PREFIX: &str = ".lgvi-";
const SUFFIX: &str = ".part";
/// Letters and digits between the two, drawn at random.
const DRAWN: usize = 12;

/// A new part in a directory, with the permissions of the file that it is to replace, if any; stale ones go.
pub(super) fn make(directory: &Path, replaced: Option<&Permissions>) -> io::Result<NamedTempFile> {
    sweep(directory)?;
    let mut builder = Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX).rand_bytes(DRAWN);
    builder.make_in(directory, |path| {
        let file = create(path, replaced)?;
        // A sweep may have come between the two: then this part is lost, and another name is drawn.
        let lost = matches!(file.try_lock(), Err(TryLockError::WouldBlock))
            || fs::symlink_metadata(path).is_err();
        match lost {
            true => Err(io::ErrorKind::AlreadyExists.into()),
            false => Ok(file),
        }
    })
}

/// Private until it has the permissions of the file that it is to replace; else as any new file.
fn create(path: &Path, replaced: Option<&Permissions>) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    if replaced.is_some() {
        use std::os::unix::fs::OpenOptionsExt;
        options.mode(0o600);
    }
    let file = options.open(path)?;
    if let Some(permissions) = replaced
        && let Err(error) = file.set_permissions(permissions.clone())
    {
        // It is not yet one that goes by itself.
        let _ = fs::remove_file(path);
        return Err(error);
    }
    Ok(file)
}

/// Removes the stale parts of a directory; what cannot be read or removed stays.
fn sweep(directory: &Path) -> io::Result<()> {
    fs::metadata(directory)?;
    let entries = fs::read_dir(directory).into_iter().flatten().flatten();
    for entry in entries.filter(|entry| is_part(&entry.file_name())) {
        // Not behind a link, and nothing that opening would wait for.
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        if let (true, Ok(file)) = (is_file, File::open(entry.path()))
            && file.try_lock().is_ok()
        {
            let _ = fs::remove_file(entry.path());
        }
    }
    Ok(())
}

fn is_part(name: &OsStr) -> bool {
    let drawn = name.to_str().and_then(|name| {
        let name = name.strip_prefix(PREFIX)?;
        name.strip_suffix(SUFFIX)
    });
    drawn.is_some_and(|drawn| {
        drawn.len() == DRAWN && drawn.bytes().all(|byte| byte.is_ascii_alphanumeric())
    })
}
