//! Files that are whole or not there.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use crate::FigureError;

/// Appends an ending to the last part of a path (`set_extension` would replace
/// what follows a dot in the name).
pub(crate) fn with_ending(stem: &Path, ending: &str) -> Result<PathBuf, FigureError> {
    let ends_in_name = !stem.as_os_str().as_encoded_bytes().ends_with(b"/");
    match stem.file_name() {
        Some(name) if ends_in_name => {
            let mut name = name.to_owned();
            name.push(".");
            name.push(ending);
            Ok(stem.with_file_name(name))
        }
        _ => Err(FigureError::NoFileName {
            path: stem.to_owned(),
        }),
    }
}

/// A complete file beside the place where it belongs; removed unless committed.
pub(crate) struct Pending {
    temporary: PathBuf,
    path: PathBuf,
}

impl Pending {
    pub(crate) fn new(path: &Path, content: &[u8]) -> Result<Self, FigureError> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let ending = format!("{}-{number}.tmp", std::process::id());
        let failed = |source| failure(path, source);
        let temporary = with_ending(path, &ending)?;
        let mut options = OpenOptions::new();
        let file = options.write(true).create_new(true).open(&temporary);
        let file = file.map_err(failed)?;
        // From here on, dropping removes the file.
        let pending = Self {
            temporary,
            path: path.to_owned(),
        };
        fill(file, content).map_err(failed)?;
        Ok(pending)
    }

    pub(crate) fn commit(self) -> Result<(), FigureError> {
        fs::rename(&self.temporary, &self.path).map_err(|source| failure(&self.path, source))
    }
}

impl Drop for Pending {
    fn drop(&mut self) {
        // After a commit there is nothing left to remove.
        let _ = fs::remove_file(&self.temporary);
    }
}

fn fill(mut file: File, content: &[u8]) -> io::Result<()> {
    file.write_all(content)?;
    file.sync_all()
}

fn failure(path: &Path, source: io::Error) -> FigureError {
    FigureError::Write {
        path: path.to_owned(),
        source,
    }
}

/// Encodes rows of red, green and blue bytes.
pub(crate) fn encode_png(pixels: &[u8], (w, h): (u32, u32)) -> Result<Vec<u8>, FigureError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, w, h);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    // Large flat areas: runs of equal bytes compress best as they are.
    encoder.set_filter(png::FilterType::NoFilter);
    encoder.set_compression(png::Compression::Best);
    let mut writer = encoder.write_header().map_err(FigureError::draw)?;
    writer.write_image_data(pixels).map_err(FigureError::draw)?;
    writer.finish().map_err(FigureError::draw)?;
    Ok(file)
}
