//! Grids of line charts, written as SVG and PNG.
//!
//! A [`Figure`] is data: panels of lines, a title, a number of columns.
//! [`Figure::save`] lays it out (panels of a column aligned, one legend on top
//! for all panels), thins long series to what a pixel column can show, and
//! writes `<stem>.svg` and `<stem>.png`.
//!
//! Colours are the palette of Okabe and Ito, told apart with any colour vision.
//! The PNG is set in the bundled subset of DejaVu Sans, so that it looks the
//! same everywhere; the SVG names that font with generic fallbacks.
//!
//! ```no_run
//! use std::path::Path;
//! use study::figure::{Colour, Figure, Line, Panel, Scale, Style};
//!
//! let error: Vec<(f64, f64)> = (1..=1000)
//!     .map(|k| (0.1 * f64::from(k), 1e-13 * f64::from(k).sqrt()))
//!     .collect();
//! let figure = Figure {
//!     title: "Energy".into(),
//!     columns: 1,
//!     panels: vec![Panel {
//!         title: "(a) energy error".into(),
//!         x_label: "t [s]".into(),
//!         y_label: "|ΔE| [J]".into(),
//!         y_scale: Scale::Log,
//!         lines: vec![Line {
//!             label: "LGVI".into(),
//!             colour: Colour::Vermillion,
//!             style: Style::Solid,
//!             points: error,
//!         }],
//!     }],
//! };
//! let saved = figure.save(Path::new("energy"))?;
//! println!("{} and {}", saved.svg.display(), saved.png.display());
//! # Ok::<(), study::figure::FigureError>(())
//! ```

mod axis;
mod dash;
mod draw;
mod error;
mod font;
mod layout;
mod legend;
mod surface;
mod thin;
mod write;

pub use error::FigureError;

use std::path::{Path, PathBuf};

/// A colour of the Okabe–Ito palette.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Colour {
    Black,
    Orange,
    SkyBlue,
    BluishGreen,
    Yellow,
    Blue,
    Vermillion,
    ReddishPurple,
}

impl Colour {
    /// Red, green and blue, 0 to 255 each.
    ///
    /// ```
    /// # use study::figure::Colour;
    /// assert_eq!(Colour::Vermillion.rgb(), (213, 94, 0));
    /// ```
    #[must_use]
    pub const fn rgb(self) -> (u8, u8, u8) {
        match self {
            Colour::Black => (0, 0, 0),
            Colour::Orange => (230, 159, 0),
            Colour::SkyBlue => (86, 180, 233),
            Colour::BluishGreen => (0, 158, 115),
            Colour::Yellow => (240, 228, 66),
            Colour::Blue => (0, 114, 178),
            Colour::Vermillion => (213, 94, 0),
            Colour::ReddishPurple => (204, 121, 167),
        }
    }
}

/// How a line is stroked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Style {
    Solid,
    Dashed,
    Dotted,
}

/// How values of the vertical axis are placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scale {
    /// Proportionally.
    Linear,
    /// By their logarithm; values that are not positive are left out.
    Log,
}

/// One curve.
///
/// Points that cannot be placed are skipped: non-finite ones, magnitudes above
/// `1e300`, and on a logarithmic axis values below `1e-300`.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Name in the legend; lines of the same label, colour and style share one
    /// entry, an empty label has none.
    pub label: String,
    /// Colour of the stroke.
    pub colour: Colour,
    /// Style of the stroke.
    pub style: Style,
    /// Points `(x, y)` in drawing order, in the units of the axis labels.
    pub points: Vec<(f64, f64)>,
}

/// One chart of the grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Printed above the chart.
    pub title: String,
    /// Quantity and unit of the horizontal axis.
    pub x_label: String,
    /// Quantity and unit of the vertical axis.
    pub y_label: String,
    /// Scale of the vertical axis.
    pub y_scale: Scale,
    /// Curves, the first one at the bottom.
    pub lines: Vec<Line>,
}

/// A grid of charts, filled row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Printed above everything; may be empty.
    pub title: String,
    /// Number of columns, at least one; no more are drawn than there are panels.
    pub columns: usize,
    /// The charts, at least one.
    pub panels: Vec<Panel>,
}

/// The files written by [`Figure::save`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Saved {
    /// The vector drawing.
    pub svg: PathBuf,
    /// The bitmap; two columns are 1600 pixels wide.
    pub png: PathBuf,
}

impl Figure {
    /// Draws the figure into `<stem>.svg` and `<stem>.png`.
    ///
    /// `.svg` and `.png` are appended to the stem, whose folder must exist;
    /// files of these names are replaced. Each file is written whole or not at
    /// all: it grows under a temporary name beside its place.
    ///
    /// # Errors
    ///
    /// [`FigureError`] if the figure has no panel, no column or too many of
    /// them, if the stem does not end in a name, or if a file cannot be written.
    pub fn save(&self, stem: &Path) -> Result<Saved, FigureError> {
        self.check()?;
        let svg = write::with_ending(stem, "svg")?;
        let png = write::with_ending(stem, "png")?;
        font::register()?;
        let layout = layout::Layout::new(self)?;
        let drawing = write::Pending::new(&svg, surface::svg(self, &layout)?.as_bytes())?;
        let bitmap = write::Pending::new(&png, &surface::png(self, &layout)?)?;
        drawing.commit()?;
        bitmap.commit()?;
        Ok(Saved { svg, png })
    }

    fn check(&self) -> Result<(), FigureError> {
        if self.panels.is_empty() {
            return Err(FigureError::NoPanel);
        }
        if self.columns == 0 {
            return Err(FigureError::NoColumn);
        }
        let columns = self.columns.min(self.panels.len());
        let rows = self.panels.len().div_ceil(columns);
        if columns > layout::MAX_COLUMNS || rows > layout::MAX_ROWS {
            return Err(FigureError::TooLarge {
                columns,
                rows,
                max_columns: layout::MAX_COLUMNS,
                max_rows: layout::MAX_ROWS,
            });
        }
        Ok(())
    }
}
