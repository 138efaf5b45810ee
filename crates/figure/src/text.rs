//! One line of text.

use std::borrow::Cow;

use crate::colour::{INK, Rgb};
use crate::font;

/// A point of the drawing, in pixels; `y` grows downwards.
pub(crate) type Pixel = (f64, f64);

/// Sizes of the em, in pixels.
pub(crate) const TITLE: f64 = 23.0;
pub(crate) const PANEL_TITLE: f64 = 18.0;
pub(crate) const LABEL: f64 = 16.5;
pub(crate) const TICK: f64 = 15.0;
pub(crate) const NOTE: f64 = 13.5;

/// A text, centred on its point in ink unless told otherwise.
pub(crate) struct Text<'a> {
    pub(crate) text: Cow<'a, str>,
    /// On the middle line of its capitals.
    pub(crate) at: Pixel,
    pub(crate) size: f64,
    /// SVG's `text-anchor`.
    pub(crate) anchor: &'static str,
    pub(crate) colour: Rgb,
    /// Read from bottom to top.
    pub(crate) upright: bool,
}

impl<'a> Text<'a> {
    pub(crate) fn new(text: &'a str, at: Pixel, size: f64) -> Self {
        Self {
            text: text.into(),
            at,
            size,
            anchor: "middle",
            colour: INK,
            upright: false,
        }
    }

    pub(crate) fn starting(mut self) -> Self {
        self.anchor = "start";
        self
    }

    pub(crate) fn ending(mut self) -> Self {
        self.anchor = "end";
        self
    }

    pub(crate) fn upright(mut self) -> Self {
        self.upright = true;
        self
    }

    pub(crate) fn coloured(mut self, colour: Rgb) -> Self {
        self.colour = colour;
        self
    }

    /// Smaller or cut where it is longer than `room`.
    pub(crate) fn within(mut self, room: f64) -> Self {
        let (text, size) = font::fit(&self.text, self.size, room);
        (self.text, self.size) = (text.into(), size);
        self
    }
}
