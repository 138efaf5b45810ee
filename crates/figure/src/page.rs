//! A sheet that is filled from the top: title, then whatever, then notes.

use crate::font::wrap;
use crate::svg::Svg;
use crate::text::{NOTE, TITLE, Text};
use crate::{FigureError, Rendered, png};

/// Free on all sides.
pub(crate) const EDGE: f64 = 20.0;
const TITLE_BAND: f64 = 40.0;
const NOTE_PITCH: f64 = 18.0;

pub(crate) struct Page {
    pub(crate) svg: Svg,
    pub(crate) width: f64,
    /// Down to where it is filled.
    pub(crate) y: f64,
}

impl Page {
    /// A page of a width in pixels with a title, which may be empty.
    pub(crate) fn new(width: f64, title: &str) -> Self {
        let mut page = Self {
            svg: Svg::default(),
            width,
            y: EDGE,
        };
        if !title.is_empty() {
            let at = (width / 2.0, EDGE + TITLE_BAND / 2.0 - 4.0);
            page.svg
                .text(&Text::new(title, at, TITLE).within(page.room()));
            page.y += TITLE_BAND;
        }
        page
    }

    /// The width between the edges.
    pub(crate) fn room(&self) -> f64 {
        self.width - 2.0 * EDGE
    }

    /// Ends the page with paragraphs.
    pub(crate) fn finish(mut self, notes: &[String]) -> Result<Rendered, FigureError> {
        let room = self.room();
        for line in notes.iter().flat_map(|note| wrap(note, NOTE, room)) {
            self.y += NOTE_PITCH;
            self.svg
                .text(&Text::new(&line, (EDGE, self.y), NOTE).starting());
        }
        let size = (self.width.ceil() as u32, (self.y + EDGE).ceil() as u32);
        let svg = self.svg.document(size);
        let png = png::rasterise(&svg)?;
        Ok(Rendered { svg, png })
    }
}
