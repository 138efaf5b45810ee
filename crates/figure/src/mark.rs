//! Marks at the points of a line.

use core::f64::consts::TAU;

use crate::Marker;
use crate::thin::Pixel;

/// From the middle to the rim, in pixels.
const RADIUS: f64 = 5.0;

/// The outline of a marker that is filled, or the strokes of one that is not.
pub(crate) enum Shape {
    Filled(Vec<Pixel>),
    Strokes([[Pixel; 2]; 2]),
}

/// The marker at a point.
pub(crate) fn shape(marker: Marker, (x, y): Pixel) -> Shape {
    let polygon = |corners: u32, turn: f64, radius: f64| {
        let corner = |k: u32| {
            let angle = TAU * (f64::from(k) / f64::from(corners) + turn);
            (x + radius * angle.sin(), y - radius * angle.cos())
        };
        Shape::Filled((0..corners).map(corner).collect())
    };
    let strokes = |a: f64, b: f64| {
        let ends = |a: f64, b: f64| [(x - a, y - b), (x + a, y + b)];
        Shape::Strokes([ends(a, b), ends(-b, a)])
    };
    match marker {
        Marker::Circle => polygon(24, 0.0, 0.9 * RADIUS),
        Marker::Square => polygon(4, 0.125, 1.15 * RADIUS),
        Marker::Diamond => polygon(4, 0.0, 1.2 * RADIUS),
        Marker::Triangle => polygon(3, 0.0, 1.2 * RADIUS),
        Marker::TriangleDown => polygon(3, 0.5, 1.2 * RADIUS),
        Marker::Plus => strokes(RADIUS, 0.0),
        Marker::Cross => strokes(0.8 * RADIUS, 0.8 * RADIUS),
    }
}
