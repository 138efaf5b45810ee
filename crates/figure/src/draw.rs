//! The strokes and texts of a figure, in order.

use plotters::backend::DrawingBackend;
use plotters::style::RGBColor;
use plotters::style::text_anchor::HPos;

use crate::dash::dash;
use crate::ends::ends;
use crate::layout::{Cell, EDGE, LABEL, Layout, NOTE, PANEL_TITLE, TICK, TICK_GAP, TITLE};
use crate::legend::{Entry, SAMPLE};
use crate::mark::{Shape, shape};
use crate::surface::{Drawing, Surface, Text};
use crate::thin::{Pixel, thin};
use crate::{Colour, Figure, FigureError, Labels, Level, Line, Marker, Panel, Style, font};

pub(crate) const PAPER: RGBColor = RGBColor(255, 255, 255);
pub(crate) const INK: RGBColor = RGBColor(26, 26, 26);
pub(crate) const FRAME: RGBColor = RGBColor(90, 90, 90);
const LEADER: RGBColor = RGBColor(170, 170, 170);
const RULE: RGBColor = RGBColor(229, 229, 229);

/// Widths of strokes.
const CURVE: f64 = 2.0;
const BROAD: f64 = 12.0;
const THIN: f64 = 1.0;

const TICK_LENGTH: f64 = 5.0;
const MINOR_LENGTH: f64 = 3.0;

type Done = Result<(), FigureError>;

impl Drawing for (&Figure, &Layout) {
    fn size(&self) -> Pixel {
        (self.1.width, self.1.height)
    }

    fn draw<B: DrawingBackend>(&self, on: &mut Surface<B>) -> Done {
        draw(self.0, self.1, on)
    }
}

/// Draws everything.
fn draw<B: DrawingBackend>(figure: &Figure, layout: &Layout, on: &mut Surface<B>) -> Done {
    on.fill((0.0, 0.0), (layout.width, layout.height), PAPER)?;
    let room = layout.width - 2.0 * EDGE;
    let at = (layout.width / 2.0, layout.title_y);
    title(on, &figure.title, at, TITLE, room)?;
    for entry in &layout.legend.entries {
        legend_entry(on, entry)?;
    }
    for (panel, cell) in figure.panels.iter().zip(&layout.cells) {
        rules(on, cell)?;
        for level in &panel.levels {
            level_line(on, cell, level)?;
        }
        if figure.labels == Labels::Ends {
            end_labels(on, panel, cell)?;
        }
        for line in &panel.lines {
            curve(on, cell, line)?;
        }
        frame(on, cell)?;
        tick_labels(on, cell)?;
        names(on, panel, cell)?;
    }
    for (y, note) in &layout.notes {
        on.text(&Text {
            text: note,
            at: (EDGE, *y),
            size: NOTE,
            align: HPos::Left,
            upright: false,
            colour: INK,
        })?;
    }
    Ok(())
}

pub(crate) fn colour(colour: Colour) -> RGBColor {
    let (r, g, b) = colour.rgb();
    RGBColor(r, g, b)
}

fn legend_entry<B: DrawingBackend>(on: &mut Surface<B>, entry: &Entry) -> Done {
    let path = vec![(entry.left, entry.y), (entry.left + SAMPLE, entry.y)];
    for stroke in dash(path, entry.style) {
        on.stroke(&stroke, colour(entry.colour), 1.4 * CURVE)?;
    }
    on.text(&Text {
        text: &entry.label,
        at: (entry.label_left(), entry.y),
        size: LABEL,
        align: HPos::Left,
        upright: false,
        colour: INK,
    })
}

fn rules<B: DrawingBackend>(on: &mut Surface<B>, cell: &Cell) -> Done {
    let plot = &cell.plot;
    for tick in &cell.x.major {
        let x = plot.left + tick.at * plot.width;
        on.stroke(&[(x, plot.top), (x, plot.bottom())], RULE, THIN)?;
    }
    for tick in &cell.y.major {
        let y = plot.bottom() - tick.at * plot.height;
        on.stroke(&[(plot.left, y), (plot.right(), y)], RULE, THIN)?;
    }
    Ok(())
}

fn curve<B: DrawingBackend>(on: &mut Surface<B>, cell: &Cell, line: &Line) -> Done {
    let points = line.points.iter().filter_map(|p| cell.pixel(*p));
    let width = match line.style {
        Style::Broad => BROAD,
        _ => CURVE,
    };
    for stroke in dash(thin(points), line.style) {
        on.stroke(&stroke, colour(line.colour), width)?;
    }
    match line.marker {
        Some(marker) => marks(on, cell, line, marker),
        None => Ok(()),
    }
}

fn marks<B: DrawingBackend>(on: &mut Surface<B>, cell: &Cell, line: &Line, marker: Marker) -> Done {
    let mut points = line.points.iter().filter_map(|p| cell.pixel(*p));
    points.try_for_each(|at| mark(on, at, line, marker))
}

fn mark<B: DrawingBackend>(on: &mut Surface<B>, at: Pixel, line: &Line, marker: Marker) -> Done {
    let colour = colour(line.colour);
    match shape(marker, at) {
        Shape::Filled(corners) => on.polygon(&corners, colour),
        Shape::Strokes(strokes) => strokes
            .iter()
            .try_for_each(|stroke| on.stroke(stroke, colour, CURVE)),
    }
}

fn level_line<B: DrawingBackend>(on: &mut Surface<B>, cell: &Cell, level: &Level) -> Done {
    let Some(y) = cell.height(level.y) else {
        return Ok(());
    };
    let path = vec![(cell.plot.left, y), (cell.plot.right(), y)];
    for stroke in dash(path, Style::Dashed) {
        on.stroke(&stroke, FRAME, THIN)?;
    }
    Ok(())
}

/// Below the curves, so that a leader hides nothing.
fn end_labels<B: DrawingBackend>(on: &mut Surface<B>, panel: &Panel, cell: &Cell) -> Done {
    for end in ends(panel, cell) {
        on.stroke(&end.leader, LEADER, THIN)?;
        on.text(&Text {
            text: end.label,
            at: end.at,
            size: TICK,
            align: HPos::Left,
            upright: false,
            colour: end.line.map_or(INK, |line| colour(line.colour)),
        })?;
        if let Some((line, marker)) = end.line.and_then(|line| Some((line, line.marker?))) {
            mark(on, end.mark, line, marker)?;
        }
    }
    Ok(())
}

fn frame<B: DrawingBackend>(on: &mut Surface<B>, cell: &Cell) -> Done {
    let plot = &cell.plot;
    let (left, right, top, bottom) = (plot.left, plot.right(), plot.top, plot.bottom());
    let corners = [
        (left, top),
        (right, top),
        (right, bottom),
        (left, bottom),
        (left, top),
    ];
    on.stroke(&corners, FRAME, THIN)?;
    for tick in &cell.x.major {
        let x = left + tick.at * plot.width;
        on.stroke(&[(x, bottom), (x, bottom + TICK_LENGTH)], FRAME, THIN)?;
    }
    for at in &cell.x.minor {
        let x = left + at * plot.width;
        on.stroke(&[(x, bottom), (x, bottom + MINOR_LENGTH)], FRAME, THIN)?;
    }
    let majors = cell.y.major.iter().map(|t| (t.at, TICK_LENGTH));
    let minors = cell.y.minor.iter().map(|at| (*at, MINOR_LENGTH));
    for (at, length) in majors.chain(minors) {
        let y = bottom - at * plot.height;
        on.stroke(&[(left - length, y), (left, y)], FRAME, THIN)?;
    }
    Ok(())
}

fn tick_labels<B: DrawingBackend>(on: &mut Surface<B>, cell: &Cell) -> Done {
    let plot = &cell.plot;
    for tick in &cell.x.major {
        let at = (plot.left + tick.at * plot.width, cell.tick_label_y);
        small(on, &tick.label, at, HPos::Center)?;
    }
    for tick in &cell.y.major {
        let at = (plot.left - TICK_GAP, plot.bottom() - tick.at * plot.height);
        small(on, &tick.label, at, HPos::Right)?;
    }
    if let Some(factor) = &cell.y.factor {
        small(on, factor, (plot.left, cell.title_y + 4.0), HPos::Left)?;
    }
    if let Some(factor) = &cell.x.factor {
        small(on, factor, (plot.right(), cell.x_label_y), HPos::Right)?;
    }
    Ok(())
}

fn names<B: DrawingBackend>(on: &mut Surface<B>, panel: &Panel, cell: &Cell) -> Done {
    let plot = &cell.plot;
    let (x, y) = plot.middle();
    let room = plot.width - 2.0 * beside(cell.y.factor.as_deref())?;
    title(on, &panel.title, (x, cell.title_y), PANEL_TITLE, room)?;
    let room = plot.width - 2.0 * beside(cell.x.factor.as_deref())?;
    title(on, &panel.x_label, (x, cell.x_label_y), LABEL, room)?;
    let (text, size) = font::fit(&panel.y_label, LABEL, plot.height + 40.0)?;
    on.text(&Text {
        text: &text,
        at: (cell.y_label_x, y),
        size,
        align: HPos::Center,
        upright: true,
        colour: INK,
    })?;
    if cell.empty {
        return title(on, "no data", (x, y), LABEL, plot.width);
    }
    Ok(())
}

/// Room a factor takes at one end of a centred text.
fn beside(factor: Option<&str>) -> Result<f64, FigureError> {
    match factor {
        None => Ok(0.0),
        Some(factor) => Ok(font::width(factor, TICK)? + 12.0),
    }
}

pub(crate) fn small<B: DrawingBackend>(
    on: &mut Surface<B>,
    text: &str,
    at: Pixel,
    align: HPos,
) -> Done {
    on.text(&Text {
        text,
        at,
        size: TICK,
        align,
        upright: false,
        colour: INK,
    })
}

pub(crate) fn title<B: DrawingBackend>(
    on: &mut Surface<B>,
    text: &str,
    at: Pixel,
    size: f64,
    room: f64,
) -> Done {
    let (text, size) = font::fit(text, size, room)?;
    on.text(&Text {
        text: &text,
        at,
        size,
        align: HPos::Center,
        upright: false,
        colour: INK,
    })
}
