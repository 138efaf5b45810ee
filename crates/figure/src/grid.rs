//! Where the panels of a figure are.

use crate::FigureError;
use crate::text::Pixel;

const MAX_COLUMNS: usize = 6;
const MAX_ROWS: usize = 24;

/// Cells of one size, filled row by row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grid {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
}

impl Grid {
    /// A grid of `count` cells, in the columns wanted or in as many as there are cells.
    pub(crate) fn new(columns: usize, count: usize) -> Result<Self, FigureError> {
        if count == 0 {
            return Err(FigureError::NoPanel);
        }
        if columns == 0 {
            return Err(FigureError::NoColumn);
        }
        let columns = columns.min(count);
        let rows = count.div_ceil(columns);
        if columns > MAX_COLUMNS || rows > MAX_ROWS {
            return Err(FigureError::TooLarge {
                columns,
                rows,
                max_columns: MAX_COLUMNS,
                max_rows: MAX_ROWS,
            });
        }
        Ok(Self { columns, rows })
    }

    /// The column of a cell.
    pub(crate) fn column(&self, cell: usize) -> usize {
        cell % self.columns
    }

    /// The upper left corner of a cell, from that of the first one.
    pub(crate) fn corner(&self, cell: usize, (left, top): Pixel, (wide, high): Pixel) -> Pixel {
        let (row, column) = (cell / self.columns, self.column(cell));
        (left + column as f64 * wide, top + row as f64 * high)
    }
}
