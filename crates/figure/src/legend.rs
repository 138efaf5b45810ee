//! The one legend on top of the figure.

use std::collections::HashSet;

use crate::layout::LABEL;
use crate::{Colour, Figure, FigureError, Labels, Line, Style, font};

/// Length of the stroke shown before a name.
pub(crate) const SAMPLE: f64 = 48.0;
const AFTER_SAMPLE: f64 = 10.0;
const BETWEEN: f64 = 42.0;
const ROW: f64 = 30.0;
const BELOW: f64 = 8.0;

/// A name, its stroke and where they start.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub(crate) label: String,
    pub(crate) colour: Colour,
    pub(crate) style: Style,
    pub(crate) left: f64,
    /// Middle line.
    pub(crate) y: f64,
    width: f64,
}

impl Entry {
    fn new(line: &Line, room: f64) -> Result<Self, FigureError> {
        let indent = SAMPLE + AFTER_SAMPLE;
        let label = font::cut(&line.label, LABEL, room - indent)?;
        Ok(Self {
            width: indent + font::width(&label, LABEL)?,
            label,
            colour: line.colour,
            style: line.style,
            left: 0.0,
            y: 0.0,
        })
    }

    /// Where the name starts.
    pub(crate) fn label_left(&self) -> f64 {
        self.left + SAMPLE + AFTER_SAMPLE
    }
}

/// Entries in centred rows.
pub(crate) struct Legend {
    pub(crate) entries: Vec<Entry>,
    rows: usize,
}

impl Legend {
    /// The legend of all panels, from `left` over `room`, its first row below
    /// `top`.
    pub(crate) fn new(
        figure: &Figure,
        (left, room): (f64, f64),
        top: f64,
    ) -> Result<Self, FigureError> {
        let kinds = kinds(figure);
        let entries: Result<Vec<Entry>, _> = kinds.iter().map(|l| Entry::new(l, room)).collect();
        let mut entries = entries?;
        let mut rows = 0;
        let mut start = 0;
        while start < entries.len() {
            let end = start + fitting(&entries[start..], room);
            let y = top + (rows as f64 + 0.5) * ROW;
            centre(&mut entries[start..end], left, room, y);
            rows += 1;
            start = end;
        }
        Ok(Self { entries, rows })
    }

    pub(crate) fn height(&self) -> f64 {
        match self.rows {
            0 => 0.0,
            rows => rows as f64 * ROW + BELOW,
        }
    }
}

/// One line of every label, colour and style, in order of appearance.
fn kinds(figure: &Figure) -> Vec<&Line> {
    if figure.labels != Labels::Legend {
        return vec![];
    }
    let kind = |l: &Line| (l.label.clone(), l.colour, l.style);
    let mut seen = HashSet::new();
    let lines = figure.panels.iter().flat_map(|p| &p.lines);
    lines
        .filter(|l| !l.label.is_empty() && seen.insert(kind(l)))
        .collect()
}

/// How many entries fit into a row, at least one.
fn fitting(entries: &[Entry], room: f64) -> usize {
    let mut used = -BETWEEN;
    let fit = entries.iter().take_while(|e| {
        used += BETWEEN + e.width;
        used <= room
    });
    fit.count().max(1)
}

fn centre(row: &mut [Entry], left: f64, room: f64, y: f64) {
    let gaps = BETWEEN * row.len().saturating_sub(1) as f64;
    let used: f64 = gaps + row.iter().map(|e| e.width).sum::<f64>();
    let mut x = left + (room - used) / 2.0;
    for entry in row {
        (entry.left, entry.y) = (x, y);
        x += entry.width + BETWEEN;
    }
}
