//! A map of values below the curves of a panel.

use crate::Colour;
use crate::colour::{PAPER, Rgb};
use crate::plot::Plot;
use crate::svg::{Area, Svg};

/// Steps of colour on each side of zero.
const STEPS: f64 = 10.0;

/// A map of values over a rectangle: blue below zero, red above, and as strong as the value is large.
#[derive(Debug, Clone, PartialEq)]
pub struct Heat {
    /// The ends of the horizontal axis.
    pub x: [f64; 2],
    /// Those of the vertical one.
    pub y: [f64; 2],
    /// Values in a row.
    pub columns: usize,
    /// Row by row from the lowest; one that is not finite is not drawn.
    pub values: Vec<f64>,
}

impl Heat {
    /// Draws the tiles; neighbours of one colour in a row are one.
    pub(crate) fn draw(&self, svg: &mut Svg, plot: &Plot) {
        let largest = self.values.iter().map(|value| value.abs());
        let largest = largest
            .filter(|value| value.is_finite())
            .fold(0.0, f64::max);
        let columns = self.columns.max(1);
        let rows = self.values.len().div_ceil(columns);
        let at = |ends: [f64; 2], k: usize, of: usize| {
            ends[0] + (ends[1] - ends[0]) * k as f64 / of as f64
        };
        let step = |value: f64| match largest > 0.0 {
            true => (value / largest * STEPS).round(),
            false => 0.0,
        };
        for (row, values) in self.values.chunks(columns).enumerate() {
            let mut from = 0;
            while from < values.len() {
                let colour = step(values[from]);
                let same = values[from..]
                    .iter()
                    .take_while(|value| step(**value) == colour);
                let to = from + same.count().max(1);
                let corner = |column: usize, row: usize| {
                    plot.pixel((at(self.x, column, columns), at(self.y, row, rows)))
                };
                if let (Some((left, bottom)), Some((right, top))) =
                    (corner(from, row), corner(to, row + 1))
                    && colour.is_finite()
                    && colour != 0.0
                {
                    let area = Area {
                        left,
                        top,
                        width: right - left,
                        height: bottom - top,
                    };
                    let fill = shade(colour / STEPS);
                    svg.rectangle(&area, fill, fill);
                }
                from = to;
            }
        }
    }
}

/// From paper to the full colour of the sign.
fn shade(strength: f64) -> Rgb {
    let (full, strength) = match strength < 0.0 {
        true => (Colour::Blue.rgb(), -0.75 * strength),
        false => (Colour::Vermillion.rgb(), 0.75 * strength),
    };
    let mix = |paper: u8, full: u8| {
        let mixed = f64::from(paper) + strength * (f64::from(full) - f64::from(paper));
        mixed.round() as u8
    };
    (
        mix(PAPER.0, full.0),
        mix(PAPER.1, full.1),
        mix(PAPER.2, full.2),
    )
}
