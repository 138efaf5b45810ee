//! Grids of line charts and of maps, drawn as SVG and PNG without any font of the system.
//!
//! A [`Figure`] is data: panels of lines, a title, a number of columns. [`Figure::render`] lays it out: panels of a column
//! are aligned, and lines are named in one legend on top or each at its end. Long series are thinned to what a pixel column
//! can show. A [`Mosaic`] is a grid of maps of coloured tiles, drawn in the same way.
//!
//! The drawing is SVG, and the PNG is that SVG as a bitmap, so that both look the same. The PNG is set in the bundled subset
//! of DejaVu Sans. The SVG only names that font: viewers without it take Verdana, which is as wide, or any sans-serif.
//! The same figure gives the same bytes.
//!
//! ```no_run
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
//! let drawn = figure.render()?;
//! std::fs::write("energy.svg", drawn.svg)?;
//! std::fs::write("energy.png", drawn.png)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod colour;
mod ends;
mod error;
mod figure;
mod font;
mod grid;
mod heat;
mod legend;
mod line;
mod mark;
mod mosaic;
mod number;
mod page;
mod panel;
mod plot;
mod png;
mod svg;
mod text;
mod thin;

pub use axis::Scale;
pub use colour::Colour;
pub use ends::Labels;
pub use error::FigureError;
pub use figure::Figure;
pub use heat::Heat;
pub use line::{Level, Line, Style};
pub use mark::Marker;
pub use mosaic::{Kind, Mosaic, Tiles};
pub use panel::Panel;

/// A drawn picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rendered {
    /// The drawing, as text of an SVG document.
    pub svg: String,
    /// Its bitmap, of the same size in pixels, as a PNG file.
    pub png: Vec<u8>,
}

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
