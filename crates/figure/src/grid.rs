//! How many panels a figure may have.

use crate::FigureError;

const MAX_COLUMNS: usize = 6;
const MAX_ROWS: usize = 24;

/// The columns that are drawn of a grid of `count` panels, filled row by row.
pub(crate) fn columns(wanted: usize, count: usize) -> Result<usize, FigureError> {
    if count == 0 {
        return Err(FigureError::NoPanel);
    }
    if wanted == 0 {
        return Err(FigureError::NoColumn);
    }
    let columns = wanted.min(count);
    let rows = count.div_ceil(columns);
    if columns > MAX_COLUMNS || rows > MAX_ROWS {
        return Err(FigureError::TooLarge {
            columns,
            rows,
            max_columns: MAX_COLUMNS,
            max_rows: MAX_ROWS,
        });
    }
    Ok(columns)
}
