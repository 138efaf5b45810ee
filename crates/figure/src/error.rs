//! Why a figure was not written.

use std::io;
use std::path::PathBuf;

/// Failure of [`Figure::save`](super::Figure::save).
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// There is nothing to draw.
    #[error("the figure has no panel: add at least one")]
    NoPanel,
    /// The grid has no column.
    #[error("the figure has no column: set columns to at least one")]
    NoColumn,
    /// The grid is too large for one bitmap.
    #[error(
        "{columns} columns and {rows} rows are too large (at most {max_columns} and {max_rows}): split the figure"
    )]
    TooLarge {
        /// Columns to be drawn.
        columns: usize,
        /// Rows to be drawn.
        rows: usize,
        /// Columns possible.
        max_columns: usize,
        /// Rows possible.
        max_rows: usize,
    },
    /// The charts are too low or too tall.
    #[error("charts {height} pixels high cannot be drawn: give between 1 and 2000")]
    PlotHeight {
        /// The height asked for.
        height: f64,
    },
    /// The path to write to does not end in a file name.
    #[error("the path {} does not end in a file name: give the files a name", path.display())]
    NoFileName {
        /// The path given.
        path: PathBuf,
    },
    /// A file could not be written.
    #[error("cannot write {}: {source}; check that its folder exists and is writable", path.display())]
    Write {
        /// The file that was to be written.
        path: PathBuf,
        /// What the system answered.
        source: io::Error,
    },
    /// The drawing library failed.
    #[error("drawing failed: {reason}; this is a defect, report it with the data drawn")]
    Draw {
        /// What the library answered.
        reason: String,
    },
}

impl FigureError {
    pub(crate) fn draw(reason: impl ToString) -> Self {
        Self::Draw {
            reason: reason.to_string(),
        }
    }
}
