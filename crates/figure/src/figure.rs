//! Grids of charts.

use std::collections::HashSet;

use crate::axis::Axis;
use crate::ends::{self, Labels};
use crate::grid::Grid;
use crate::line::SAMPLE;
use crate::page::{EDGE, Page};
use crate::panel::{ABOVE, BELOW};
use crate::plot::{Plot, TICK_GAP};
use crate::svg::Area;
use crate::text::TICK;
use crate::{FigureError, Line, Panel, Rendered, font};

/// Of a panel with all its labels.
const WIDTH: f64 = 762.0;
const COLUMN_GAP: f64 = 36.0;
const ROW_GAP: f64 = 24.0;
/// Left of the tick labels, for the label of the axis.
const Y_LABEL: f64 = 32.0;
/// Half a tick label may stand over the right end of a plot.
const RIGHT: f64 = 22.0;

/// A grid of charts, filled row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Printed above everything; may be empty.
    pub title: String,
    /// Number of columns, at least one; no more are drawn than there are panels.
    pub columns: usize,
    /// Where lines are named.
    pub labels: Labels,
    /// Height of the charts inside their axes, in pixels; at most [`Figure::TALLEST`].
    pub plot_height: f64,
    /// The charts, at least one.
    pub panels: Vec<Panel>,
    /// Paragraphs below the charts.
    pub notes: Vec<String>,
}

impl Default for Figure {
    /// One column of low charts below a legend.
    fn default() -> Self {
        Self {
            title: String::new(),
            columns: 1,
            labels: Labels::Legend,
            plot_height: 250.0,
            panels: vec![],
            notes: vec![],
        }
    }
}

impl Figure {
    /// The tallest chart, in pixels.
    pub const TALLEST: f64 = 2000.0;

    /// Draws the figure; two columns are 1600 pixels wide.
    ///
    /// # Errors
    ///
    /// [`FigureError`] if the figure has no panel, no column or too many of them, or if its charts are too low or too tall.
    pub fn render(&self) -> Result<Rendered, FigureError> {
        let grid = Grid::new(self.columns, self.panels.len())?;
        let height = self.plot_height;
        if !(1.0..=Self::TALLEST).contains(&height) {
            return Err(FigureError::PlotHeight { height });
        }
        let pitch = (WIDTH + COLUMN_GAP, ABOVE + height + BELOW + ROW_GAP);
        let width = grid.columns as f64 * pitch.0 - COLUMN_GAP;
        let mut page = Page::new(width + 2.0 * EDGE, &self.title);
        let beyond = self.name_lines(&mut page);
        let axes: Vec<(Axis, Axis)> = self.panels.iter().map(Panel::axes).collect();
        let indents = indents(&axes, grid.columns);
        for (k, (panel, (x, y))) in self.panels.iter().zip(axes).enumerate() {
            let (left, top) = grid.corner(k, (EDGE, page.y), pitch);
            let indent = indents[grid.column(k)];
            let area = Area {
                left: left + indent,
                top: top + ABOVE,
                width: WIDTH - indent - beyond,
                height,
            };
            let plot = Plot { area, x, y };
            panel.draw(&mut page.svg, &plot, self.labels, [left, left + WIDTH]);
        }
        page.y += grid.rows as f64 * pitch.1 - ROW_GAP;
        page.finish(&self.notes)
    }

    /// Draws the legend, if there is to be one; returns what the names need on the right of a plot.
    fn name_lines(&self, page: &mut Page) -> f64 {
        match self.labels {
            Labels::Legend => {
                let lines = self.legend().into_iter();
                let entries = lines.map(|line| (line.label.as_str(), line));
                page.legend(entries, SAMPLE, |svg, line, at| line.draw_sample(svg, at));
                RIGHT
            }
            Labels::Ends => ends::room(self.panels.iter().flat_map(Panel::names)).min(WIDTH / 2.0),
        }
    }

    /// One line of every label, colour and style, in order of appearance.
    fn legend(&self) -> Vec<&Line> {
        let mut seen = HashSet::new();
        let mut is_new = |line: &&Line| seen.insert((line.label.clone(), line.colour, line.style));
        let lines = self.panels.iter().flat_map(|panel| &panel.lines);
        let named = lines.filter(|line| !line.label.is_empty());
        named.filter(|line| is_new(line)).collect()
    }
}

/// Left of the plots of each column: its widest tick label aligns them.
fn indents(axes: &[(Axis, Axis)], columns: usize) -> Vec<f64> {
    let indent = |column: usize| {
        let axes = axes.iter().skip(column).step_by(columns);
        let labels = axes.flat_map(|(_, y)| y.labels());
        Y_LABEL + font::widest(labels, TICK) + TICK_GAP
    };
    (0..columns).map(indent).collect()
}
