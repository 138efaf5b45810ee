//! A drawing as SVG text.

use crate::colour::{PAPER, Rgb};
use crate::font::{FAMILY, HALF_CAPITAL};
use crate::text::{Pixel, Text};

/// An upright rectangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Area {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Area {
    pub(crate) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    pub(crate) fn middle(&self) -> Pixel {
        (self.left + self.width / 2.0, self.top + self.height / 2.0)
    }
}

/// How a path is stroked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pen {
    colour: Rgb,
    /// In pixels.
    width: f64,
    /// Lengths of dashes and gaps, in pixels; empty for a continuous stroke.
    dashes: &'static str,
}

impl Pen {
    pub(crate) fn new(colour: Rgb, width: f64, dashes: &'static str) -> Self {
        Self {
            colour,
            width,
            dashes,
        }
    }
}

/// The elements drawn so far, the first one at the bottom.
#[derive(Default)]
pub(crate) struct Svg(String);

impl Svg {
    /// Strokes a path.
    pub(crate) fn stroke(&mut self, path: &[Pixel], pen: Pen) {
        if path.len() < 2 {
            return;
        }
        let dashes = match pen.dashes {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        self.0 += &format!(
            "<path stroke=\"{}\" stroke-width=\"{}\"{dashes} d=\"{}\"/>\n",
            hex(pen.colour),
            pen.width,
            outline(path)
        );
    }

    /// Horizontal and vertical lines one pixel wide, on whole pixels.
    pub(crate) fn rules(&mut self, rules: impl IntoIterator<Item = [Pixel; 2]>, colour: Rgb) {
        let lines: String = rules.into_iter().map(|rule| outline(&rule)).collect();
        self.0 += &format!(
            "<path stroke=\"{}\" shape-rendering=\"crispEdges\" d=\"{lines}\"/>\n",
            hex(colour)
        );
    }

    /// The same outline at many points, which it is relative to.
    pub(crate) fn marks(&mut self, points: &[Pixel], mark: &str, colour: Rgb) {
        if points.is_empty() {
            return;
        }
        let marks = points.iter().map(|at| outline(&[*at]) + mark);
        let colour = hex(colour);
        self.0 += &format!(
            "<path fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"2\" d=\"{}\"/>\n",
            marks.collect::<String>()
        );
    }

    /// A filled rectangle with an edge.
    pub(crate) fn rectangle(&mut self, area: &Area, fill: Rgb, edge: Rgb) {
        self.0 += &format!(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"{}\" shape-rendering=\"crispEdges\"/>\n",
            rounded(area.left),
            rounded(area.top),
            rounded(area.width),
            rounded(area.height),
            hex(fill),
            hex(edge)
        );
    }

    pub(crate) fn text(&mut self, text: &Text) {
        if text.text.is_empty() {
            return;
        }
        let (x, y) = (rounded(text.at.0), rounded(text.at.1));
        let turn = match text.upright {
            true => format!(" transform=\"rotate(-90 {x} {y})\""),
            false => String::new(),
        };
        self.0 += &format!(
            "<text x=\"{x}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\"{turn}>{}</text>\n",
            rounded(text.at.1 + HALF_CAPITAL * text.size),
            rounded(text.size),
            text.anchor,
            hex(text.colour),
            escaped(&text.text)
        );
    }

    /// The whole document, on paper of a size in pixels.
    pub(crate) fn document(&self, (width, height): (u32, u32)) -> String {
        format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             xmlns=\"http://www.w3.org/2000/svg\" font-family=\"{FAMILY}\" fill=\"none\" stroke-linejoin=\"round\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n{}</svg>\n",
            hex(PAPER),
            self.0
        )
    }
}

/// The commands that move along points.
fn outline(points: &[Pixel]) -> String {
    let pairs = points
        .iter()
        .map(|(x, y)| format!("{} {}", rounded(*x), rounded(*y)));
    format!("M{}", pairs.collect::<Vec<_>>().join(" "))
}

/// To hundredths of a pixel, without a negative zero.
fn rounded(length: f64) -> f64 {
    (length * 100.0).round() / 100.0 + 0.0
}

fn hex((r, g, b): Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Text as XML has it; what XML cannot have is replaced.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '\t' | '\n' | '\r' => escaped.push(' '),
            '\0'..' ' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            _ => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_short_and_finite_texts_are_escaped() {
        assert_eq!(outline(&[(1.0, -0.001), (2.345, 1e3)]), "M1 0 2.35 1000");
        assert_eq!(hex((0, 114, 255)), "#0072ff");
        assert_eq!(escaped("a<b & c>\u{1}\td"), "a&lt;b &amp; c&gt;\u{fffd} d");
    }
}
