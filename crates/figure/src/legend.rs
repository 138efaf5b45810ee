//! Names in centred rows, each behind a sample of what it names.

use crate::font;
use crate::page::{EDGE, Page};
use crate::svg::Svg;
use crate::text::Pixel;
use crate::text::{LABEL, Text};

const AFTER_SAMPLE: f64 = 9.0;
const BETWEEN: f64 = 34.0;
const ROW: f64 = 34.0;

impl Page {
    /// Adds a legend. `draw` draws a sample `wide` pixels wide, from its left end on its middle line.
    pub(crate) fn legend<'a, T>(
        &mut self,
        entries: impl IntoIterator<Item = (&'a str, T)>,
        wide: f64,
        draw: impl Fn(&mut Svg, &T, Pixel),
    ) {
        let indent = wide + AFTER_SAMPLE;
        let room = self.room();
        let named = |(label, kind): (&str, T)| {
            let label = font::cut(label, LABEL, room - indent);
            (indent + font::width(&label, LABEL), label, kind)
        };
        let entries: Vec<_> = entries.into_iter().map(named).collect();
        let mut rest = entries.as_slice();
        while !rest.is_empty() {
            let (count, used) = fitting(rest.iter().map(|(width, ..)| *width), room);
            let (row, later) = rest.split_at(count);
            let (mut x, y) = (EDGE + (room - used) / 2.0, self.y + ROW / 2.0);
            for (width, label, kind) in row {
                draw(&mut self.svg, kind, (x, y));
                let name = Text::new(label, (x + indent, y), LABEL);
                self.svg.text(&name.starting());
                x += width + BETWEEN;
            }
            self.y += ROW;
            rest = later;
        }
    }
}

/// How many entries fit into a row, at least one, and what they take of it.
fn fitting(widths: impl Iterator<Item = f64>, room: f64) -> (usize, f64) {
    let mut fit = (0, -BETWEEN);
    for width in widths {
        let used = fit.1 + BETWEEN + width;
        if fit.0 > 0 && used > room {
            break;
        }
        fit = (fit.0 + 1, used);
    }
    fit
}
