//! One curve of a chart.

use crate::Marker;
use crate::colour::Colour;
use crate::plot::Plot;
use crate::svg::{Pen, Svg};
use crate::text::Pixel;
use crate::thin::thin;

/// Of strokes, in pixels.
const CURVE: f64 = 2.0;
const BROAD: f64 = 12.0;

/// Length of the stroke that stands for a line in a legend.
pub(crate) const SAMPLE: f64 = 48.0;

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

/// Lengths of the dashes and gaps of [`Style::Dashed`], in pixels.
pub(crate) const DASHES: &str = "9 5.5";
const DOTS: &str = "2.2 4";

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

impl Line {
    /// Those points that can be placed.
    pub(crate) fn pixels(&self, plot: &Plot) -> Vec<Pixel> {
        let points = self.points.iter();
        points.filter_map(|point| plot.pixel(*point)).collect()
    }

    pub(crate) fn draw(&self, svg: &mut Svg, plot: &Plot) {
        let pixels = self.pixels(plot);
        let width = match self.style {
            Style::Broad => BROAD,
            _ => CURVE,
        };
        self.stroke(svg, &thin(&pixels), width);
        self.draw_marks(svg, &pixels);
    }

    /// What stands for the line in a legend, from its left end.
    pub(crate) fn draw_sample(&self, svg: &mut Svg, (x, y): Pixel) {
        self.stroke(svg, &[(x, y), (x + SAMPLE, y)], 1.4 * CURVE);
    }

    pub(crate) fn draw_marks(&self, svg: &mut Svg, points: &[Pixel]) {
        if let Some(marker) = self.marker {
            svg.marks(points, marker.outline(), self.colour.rgb());
        }
    }

    fn stroke(&self, svg: &mut Svg, path: &[Pixel], width: f64) {
        let dashes = match self.style {
            Style::Invisible => return,
            Style::Dashed => DASHES,
            Style::Dotted => DOTS,
            Style::Solid | Style::Broad => "",
        };
        svg.stroke(path, Pen::new(self.colour.rgb(), width, dashes));
    }
}

/// A named height across a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Printed at its right end where lines are named at their [`Ends`](crate::Labels::Ends), nowhere else.
    pub label: String,
    /// In the unit of the axis.
    pub y: f64,
}
