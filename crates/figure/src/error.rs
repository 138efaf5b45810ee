//! Why a figure was not drawn.

use core::error::Error;

/// Failure of [`Figure::render`](crate::Figure::render) or [`Mosaic::render`](crate::Mosaic::render).
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
    /// The SVG could not be made a bitmap.
    #[error("drawing failed: {source}; this is a defect, report it with the data drawn")]
    Draw {
        /// What the rasteriser or the encoder answered.
        source: Box<dyn Error + Send + Sync>,
    },
}

impl FigureError {
    pub(crate) fn draw(source: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self::Draw {
            source: source.into(),
        }
    }
}
