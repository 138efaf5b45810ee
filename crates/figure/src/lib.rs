//! Grids of line charts and of maps, written as SVG and PNG.
//!
//! A [`Figure`] is data: panels of lines, a title, a number of columns.
//! [`Figure::save`] lays it out (panels of a column aligned, one legend on top
//! for all panels or a name at each line's end), thins long series to what a pixel column can show, and
//! writes `<stem>.svg` and `<stem>.png`.
//!
//! A [`Mosaic`] is a grid of maps of coloured tiles, drawn in the same way.
//!
//! Colours are the palette of Okabe and Ito, told apart with any colour vision.
//! The PNG is set in the bundled subset of DejaVu Sans, so that it looks the
//! same everywhere; the SVG names that font with generic fallbacks.
//!
//! ```no_run
//! use std::path::Path;
//! use figure::{Colour, Figure, Line, Panel, Scale, Style};
//!
//! let error: Vec<(f64, f64)> = (1..=1000)
//!     .map(|k| (0.1 * f64::from(k), 1e-13 * f64::from(k).sqrt()))
//!     .collect();
//! let figure = Figure {
//!     title: "Energy".into(),
//!     panels: vec![Panel {
//!         title: "(a) energy error".into(),
//!         x_label: "t [s]".into(),
//!         y_label: "|ΔE| [J]".into(),
//!         y_scale: Scale::Log,
//!         lines: vec![Line {
//!             label: "LGVI".into(),
//!             colour: Colour::Vermillion,
//!             style: Style::Solid,
//!             marker: None,
//!             points: error,
//!         }],
//!         ..Panel::default()
//!     }],
//!     ..Figure::default()
//! };
//! let saved = figure.save(Path::new("energy"))?;
//! println!("{} and {}", saved.svg.display(), saved.png.display());
//! # Ok::<(), figure::FigureError>(())
//! ```

mod axis;
mod dash;
mod draw;
mod ends;
mod error;
mod font;
mod layout;
mod legend;
mod mark;
mod mosaic;
mod surface;
mod thin;
mod write;

pub use error::FigureError;
pub use mosaic::{Kind, Mosaic, Tiles};

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
    /// # use figure::Colour;
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
    /// So wide that others are drawn on it.
    Broad,
    /// Markers alone.
    Invisible,
}

/// What is drawn at each point of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Marker {
    Circle,
    Square,
    Diamond,
    Triangle,
    TriangleDown,
    Plus,
    Cross,
}

/// How values of an axis are placed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Scale {
    /// Proportionally.
    #[default]
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
    /// Name in the legend or at the line's end; in a legend, lines of the same label, colour and style share one
    /// entry, an empty label has none.
    pub label: String,
    /// Colour of the stroke.
    pub colour: Colour,
    /// Style of the stroke.
    pub style: Style,
    /// Drawn at each point.
    pub marker: Option<Marker>,
    /// Points `(x, y)` in drawing order, in the units of the axis labels.
    pub points: Vec<(f64, f64)>,
}

/// A named height across a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Printed at its right end where lines are named at their [`Ends`](Labels::Ends), nowhere else.
    pub label: String,
    /// In the unit of the axis.
    pub y: f64,
}

/// One chart of the grid.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Panel {
    /// Printed above the chart.
    pub title: String,
    /// Quantity and unit of the horizontal axis.
    pub x_label: String,
    /// Scale of the horizontal axis.
    pub x_scale: Scale,
    /// Quantity and unit of the vertical axis.
    pub y_label: String,
    /// Scale of the vertical axis.
    pub y_scale: Scale,
    /// Drawn dashed, below the curves.
    pub levels: Vec<Level>,
    /// Curves, the first one at the bottom.
    pub lines: Vec<Line>,
}

/// Where lines are named.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Labels {
    /// In one legend on top.
    #[default]
    Legend,
    /// At their ends, on the right of each panel.
    Ends,
}

/// A grid of charts, filled row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Printed above everything; may be empty.
    pub title: String,
    /// Number of columns, at least one; no more are drawn than there are panels.
    pub columns: usize,
    /// Where lines are named.
    pub labels: Labels,
    /// Height of the charts inside their axes, in pixels; at most [`Figure::TALLEST`].
    pub plot_height: f64,
    /// The charts, at least one.
    pub panels: Vec<Panel>,
    /// Paragraphs below the charts.
    pub notes: Vec<String>,
}

impl Default for Figure {
    /// One column of low charts below a legend.
    fn default() -> Self {
        Self {
            title: String::new(),
            columns: 1,
            labels: Labels::Legend,
            plot_height: 250.0,
            panels: vec![],
            notes: vec![],
        }
    }
}

/// A figure that is drawn but not written.
#[derive(Debug, Clone, PartialEq)]
pub struct Rendered {
    /// The vector drawing.
    pub svg: String,
    /// The bitmap, encoded.
    pub png: Vec<u8>,
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
    /// The tallest chart, in pixels.
    pub const TALLEST: f64 = 2000.0;

    /// Draws the figure.
    ///
    /// # Errors
    ///
    /// [`FigureError`] as for [`save`](Self::save), but for what is the files'.
    pub fn render(&self) -> Result<Rendered, FigureError> {
        self.check()?;
        font::register()?;
        let layout = layout::Layout::new(self)?;
        surface::render(&(self, &layout))
    }

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
        let rendered = self.render()?;
        let svg = write::with_ending(stem, "svg")?;
        let png = write::with_ending(stem, "png")?;
        let drawing = write::Pending::new(&svg, rendered.svg.as_bytes())?;
        let bitmap = write::Pending::new(&png, &rendered.png)?;
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
        if !(1.0..=Self::TALLEST).contains(&self.plot_height) {
            return Err(FigureError::PlotHeight {
                height: self.plot_height,
            });
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
