//! Where everything goes, in pixels of the finished bitmap.

use crate::axis::{Axis, coordinate};
use crate::legend::Legend;
use crate::{Figure, FigureError, Labels, Panel, Scale, ends, font};

pub(crate) const MAX_COLUMNS: usize = 6;
pub(crate) const MAX_ROWS: usize = 24;

/// Text sizes (ems).
pub(crate) const TITLE: f64 = 23.0;
pub(crate) const PANEL_TITLE: f64 = 18.0;
pub(crate) const LABEL: f64 = 16.5;
pub(crate) const TICK: f64 = 15.0;

pub(crate) const NOTE: f64 = 13.5;

/// Between a tick and its label.
pub(crate) const TICK_GAP: f64 = 9.0;

/// Free on all sides.
pub(crate) const EDGE: f64 = 20.0;
const CELL_WIDTH: f64 = 762.0;
const CELL_GAP: f64 = 36.0;
const TITLE_BAND: f64 = 36.0;
const X_BAND: f64 = 62.0;
const ROW_GAP: f64 = 16.0;
const Y_LABEL_BAND: f64 = 32.0;
/// Half a tick label may stand over the right end of a plot.
const RIGHT: f64 = 22.0;
/// Between the middle lines of notes.
const NOTE_PITCH: f64 = 18.0;
const X_TICKS: usize = 7;
const Y_TICKS: usize = 6;
const Y_MARGIN: f64 = 0.06;

/// An upright rectangle; `y` grows downwards.
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

    pub(crate) fn middle(&self) -> (f64, f64) {
        (self.left + self.width / 2.0, self.top + self.height / 2.0)
    }
}

/// One panel: where it is drawn and what its axes show.
pub(crate) struct Cell {
    /// The rectangle inside the axes.
    pub(crate) plot: Area,
    /// Middle line of the title above and of the label below the plot.
    pub(crate) title_y: f64,
    pub(crate) x_label_y: f64,
    pub(crate) tick_label_y: f64,
    /// Middle line of the rotated label on the left.
    pub(crate) y_label_x: f64,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) empty: bool,
}

/// The whole figure.
pub(crate) struct Layout {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) title_y: f64,
    pub(crate) legend: Legend,
    pub(crate) cells: Vec<Cell>,
    /// Lines of text with their middle lines.
    pub(crate) notes: Vec<(f64, String)>,
}

impl Layout {
    pub(crate) fn new(figure: &Figure) -> Result<Self, FigureError> {
        let columns = figure.columns.min(figure.panels.len());
        let width = 2.0 * EDGE + columns as f64 * (CELL_WIDTH + CELL_GAP) - CELL_GAP;
        let title_height = if figure.title.is_empty() { 0.0 } else { 40.0 };
        let legend = Legend::new(figure, (EDGE, width - 2.0 * EDGE), EDGE + title_height)?;
        let top = EDGE + title_height + legend.height();
        let axes: Vec<Axes> = figure.panels.iter().map(Axes::new).collect();
        let right = match figure.labels {
            Labels::Legend => RIGHT,
            Labels::Ends => ends::room(figure.panels.iter())?.min(CELL_WIDTH / 2.0),
        };
        let cells = place(axes, columns, (top, figure.plot_height, right))?;
        let bottom = cells.iter().map(|c| c.x_label_y).fold(0.0, f64::max);
        let notes = notes(figure, bottom, width - 2.0 * EDGE)?;
        let end = notes.last().map_or(bottom, |(y, _)| *y);
        Ok(Self {
            width,
            height: end + EDGE,
            notes,
            title_y: EDGE + title_height / 2.0 - 4.0,
            legend,
            cells,
        })
    }
}

struct Axes {
    x: Axis,
    y: Axis,
    empty: bool,
}

impl Axes {
    fn new(panel: &Panel) -> Self {
        let (mut xs, mut ys) = (None, None);
        for (x, y) in panel.lines.iter().flat_map(|l| &l.points) {
            let x = coordinate(panel.x_scale, *x);
            // A zero on a logarithmic axis is not drawn, but its time counts.
            if let (Some(x), Some(_)) = (x, coordinate(Scale::Linear, *y)) {
                cover(&mut xs, x);
                if let Some(y) = coordinate(panel.y_scale, *y) {
                    cover(&mut ys, y);
                }
            }
        }
        let empty = ys.is_none();
        let levels = panel.levels.iter();
        for y in levels.filter_map(|level| coordinate(panel.y_scale, level.y)) {
            cover(&mut ys, y);
        }
        Self {
            x: Axis::new(panel.x_scale, xs, 0.0, X_TICKS),
            y: Axis::new(panel.y_scale, ys, Y_MARGIN, Y_TICKS),
            empty,
        }
    }

    fn label_width(&self) -> Result<f64, FigureError> {
        let mut widest: f64 = 0.0;
        for tick in &self.y.major {
            widest = widest.max(font::width(&tick.label, TICK)?);
        }
        Ok(widest)
    }
}

fn notes(figure: &Figure, above: f64, room: f64) -> Result<Vec<(f64, String)>, FigureError> {
    let mut notes = vec![];
    let mut y = above + TICK;
    for note in &figure.notes {
        for line in font::wrap(note, NOTE, room)? {
            y += NOTE_PITCH;
            notes.push((y, line));
        }
    }
    Ok(notes)
}

fn cover(range: &mut Option<(f64, f64)>, value: f64) {
    let (low, high) = range.get_or_insert((value, value));
    *low = low.min(value);
    *high = high.max(value);
}

fn place(
    axes: Vec<Axes>,
    columns: usize,
    (top, plot_height, right): (f64, f64, f64),
) -> Result<Vec<Cell>, FigureError> {
    // The widest tick label of a column sets the left end of all its plots.
    let mut labels = vec![0.0_f64; columns];
    for (k, a) in axes.iter().enumerate() {
        labels[k % columns] = labels[k % columns].max(a.label_width()?);
    }
    let row_height = TITLE_BAND + plot_height + X_BAND + ROW_GAP;
    let cells = axes.into_iter().enumerate().map(|(k, axes)| {
        let left = EDGE + (k % columns) as f64 * (CELL_WIDTH + CELL_GAP);
        let indent = Y_LABEL_BAND + labels[k % columns] + TICK_GAP;
        let plot = Area {
            left: left + indent,
            top: top + (k / columns) as f64 * row_height + TITLE_BAND,
            width: CELL_WIDTH - indent - right,
            height: plot_height,
        };
        Cell::new(plot, left, axes)
    });
    Ok(cells.collect())
}

impl Cell {
    fn new(plot: Area, left: f64, axes: Axes) -> Self {
        Self {
            plot,
            title_y: plot.top - TITLE_BAND / 2.0 + 2.0,
            tick_label_y: plot.bottom() + TICK_GAP + TICK / 2.0,
            x_label_y: plot.bottom() + X_BAND - 18.0,
            y_label_x: left + LABEL / 2.0 + 2.0,
            x: axes.x,
            y: axes.y,
            empty: axes.empty,
        }
    }

    /// The vertical pixel of a value, if it can be placed.
    pub(crate) fn height(&self, y: f64) -> Option<f64> {
        Some(self.plot.bottom() - self.y.place(y)? * self.plot.height)
    }

    /// The pixel of a point, if it can be placed.
    pub(crate) fn pixel(&self, (x, y): (f64, f64)) -> Option<(f64, f64)> {
        let (x, y) = (self.x.place(x)?, self.height(y)?);
        Some((self.plot.left + x * self.plot.width, y))
    }
}
