//! The two backends behind one set of strokes and texts.
//!
//! Backends count in whole pixels. The SVG is therefore drawn on a finer grid
//! than its nominal size, and the bitmap is drawn larger and averaged, which
//! also smooths its edges.

use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontTransform, IntoFont, RGBColor, ShapeStyle, TextStyle};

use crate::thin::Pixel;
use crate::{FigureError, Rendered, font, write};

/// Grid cells per pixel.
const SVG_SCALE: u32 = 4;
const PNG_SCALE: u32 = 3;

/// A backend with its scale and its ways with text.
pub(crate) struct Surface<B> {
    backend: B,
    scale: f64,
    /// Font size of the backend per em.
    size_per_em: f64,
    /// From the middle of a capital to the backend's idea of it, in ems.
    drop: f64,
    /// Whether a path is stroked as a whole.
    joins: bool,
    /// Grid cells by which strokes come out wider than asked for.
    swell: f64,
}

/// A text to draw, its capitals centred on the vertical position.
pub(crate) struct Text<'a> {
    pub(crate) text: &'a str,
    pub(crate) at: Pixel,
    /// Size of the em in pixels.
    pub(crate) size: f64,
    pub(crate) align: HPos,
    /// Read from bottom to top.
    pub(crate) upright: bool,
    pub(crate) colour: RGBColor,
}

/// What can be drawn on any backend.
pub(crate) trait Drawing {
    /// Width and height in pixels.
    fn size(&self) -> Pixel;

    /// Draws everything.
    fn draw<B: DrawingBackend>(&self, on: &mut Surface<B>) -> Result<(), FigureError>;
}

/// Both pictures of a drawing.
pub(crate) fn render(drawing: &impl Drawing) -> Result<Rendered, FigureError> {
    Ok(Rendered {
        svg: svg(drawing)?,
        png: png(drawing)?,
    })
}

/// An SVG document.
fn svg(drawing: &impl Drawing) -> Result<String, FigureError> {
    let (width, height) = size(drawing, 1);
    let (wide, high) = size(drawing, SVG_SCALE);
    let mut document = String::new();
    let mut surface = Surface {
        backend: SVGBackend::with_string(&mut document, (wide, high)),
        scale: f64::from(SVG_SCALE),
        size_per_em: 1.24,
        drop: 0.09,
        joins: true,
        swell: 0.0,
    };
    drawing.draw(&mut surface)?;
    surface.backend.present().map_err(FigureError::draw)?;
    drop(surface);
    Ok(document.replacen(
        &format!("width=\"{wide}\" height=\"{high}\""),
        &format!("width=\"{width}\" height=\"{height}\""),
        1,
    ))
}

/// An encoded PNG.
fn png(drawing: &impl Drawing) -> Result<Vec<u8>, FigureError> {
    let (wide, high) = size(drawing, PNG_SCALE);
    let mut pixels = vec![255; wide as usize * high as usize * 3];
    let mut surface = Surface {
        backend: BitMapBackend::with_buffer(&mut pixels, (wide, high)),
        scale: f64::from(PNG_SCALE),
        size_per_em: font::LINE_PER_EM,
        drop: 0.252,
        joins: false,
        swell: 1.0,
    };
    drawing.draw(&mut surface)?;
    surface.backend.present().map_err(FigureError::draw)?;
    drop(surface);
    let averaged = average(&pixels, wide as usize, PNG_SCALE as usize);
    write::encode_png(&averaged, size(drawing, 1))
}

fn size(drawing: &impl Drawing, scale: u32) -> (u32, u32) {
    let (width, height) = drawing.size();
    (width.ceil() as u32 * scale, height.ceil() as u32 * scale)
}

/// Replaces each square of `n` by `n` pixels by its mean colour.
fn average(pixels: &[u8], width: usize, n: usize) -> Vec<u8> {
    let out = width / n;
    let mut averaged = Vec::with_capacity(pixels.len() / (n * n));
    for block in pixels.chunks_exact(3 * width * n) {
        let mut sums = vec![0_u32; 3 * out];
        for row in block.chunks_exact(3 * width) {
            for (k, value) in row.iter().enumerate() {
                sums[k / 3 / n * 3 + k % 3] += u32::from(*value);
            }
        }
        let count = (n * n) as u32;
        averaged.extend(sums.iter().map(|s| ((s + count / 2) / count) as u8));
    }
    averaged
}

impl<B: DrawingBackend> Surface<B> {
    fn grid(&self, (x, y): Pixel) -> (i32, i32) {
        (
            (x * self.scale).round() as i32,
            (y * self.scale).round() as i32,
        )
    }

    /// Fills the rectangle between two corners.
    pub(crate) fn fill(&mut self, a: Pixel, b: Pixel, colour: RGBColor) -> Result<(), FigureError> {
        let (a, b) = (self.grid(a), self.grid(b));
        self.backend
            .draw_rect(a, b, &colour.filled(), true)
            .map_err(FigureError::draw)
    }

    /// Strokes a path of a width in pixels.
    pub(crate) fn stroke(
        &mut self,
        path: &[Pixel],
        colour: RGBColor,
        width: f64,
    ) -> Result<(), FigureError> {
        let stroke = (width * self.scale - self.swell).round().max(1.0);
        let style = ShapeStyle::from(&colour).stroke_width(stroke as u32);
        if self.joins {
            let path: Vec<_> = path.iter().map(|p| self.grid(*p)).collect();
            let drawn = self.backend.draw_path(path, &style);
            return drawn.map_err(FigureError::draw);
        }
        for k in 1..path.len() {
            let (a, b) = (path[k - 1], path[k]);
            // Overlapping ends close the notches between two segments.
            let before = if k > 1 { width / 2.0 } else { 0.0 };
            let after = if k + 1 < path.len() { width / 2.0 } else { 0.0 };
            let (a, b) = (beyond(b, a, before), beyond(a, b, after));
            self.backend
                .draw_line(self.grid(a), self.grid(b), &style)
                .map_err(FigureError::draw)?;
        }
        Ok(())
    }

    /// Fills a polygon.
    pub(crate) fn polygon(
        &mut self,
        corners: &[Pixel],
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        let corners: Vec<_> = corners.iter().map(|p| self.grid(*p)).collect();
        self.backend
            .fill_polygon(corners, &colour)
            .map_err(FigureError::draw)
    }

    /// Draws a text.
    pub(crate) fn text(&mut self, text: &Text) -> Result<(), FigureError> {
        let font = (font::FAMILY, text.size * self.size_per_em * self.scale).into_font();
        let drop = self.drop * text.size;
        let (x, y) = text.at;
        let (font, at) = if text.upright {
            (font.transform(FontTransform::Rotate270), (x + drop, y))
        } else {
            (font, (x, y + drop))
        };
        let style = TextStyle::from(font)
            .color(&text.colour)
            .pos(Pos::new(text.align, VPos::Center));
        self.backend
            .draw_text(text.text, &style, self.grid(at))
            .map_err(FigureError::draw)
    }
}

/// The point a length behind `to` on the ray from `from`.
fn beyond(from: Pixel, to: Pixel, length: f64) -> Pixel {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let distance = dx.hypot(dy);
    if distance == 0.0 {
        return to;
    }
    let f = length / distance;
    (to.0 + f * dx, to.1 + f * dy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averaging_mixes_squares() {
        let (w, b) = ([255_u8; 3], [0_u8; 3]);
        let rows = [[w, b, b, b], [b, w, b, b]];
        let pixels: Vec<u8> = rows.as_flattened().as_flattened().to_vec();
        assert_eq!(average(&pixels, 4, 2), [128, 128, 128, 0, 0, 0]);
    }
}
