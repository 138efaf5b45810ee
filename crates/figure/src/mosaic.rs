//! Grids of small maps, each of coloured tiles with a sign.

use plotters::backend::DrawingBackend;
use plotters::style::RGBColor;
use plotters::style::text_anchor::HPos;

use crate::draw::{FRAME, INK, PAPER, colour, small, title};
use crate::layout::{Area, EDGE, LABEL, MAX_COLUMNS, MAX_ROWS, NOTE, PANEL_TITLE, TICK, TITLE};
use crate::surface::{Drawing, Surface, Text, render};
use crate::thin::Pixel;
use crate::{Colour, FigureError, Rendered, font};

const WIDTH: f64 = 1600.0;
const TITLE_BAND: f64 = 40.0;
const LEGEND_ROW: f64 = 34.0;
const MAP_TITLE: f64 = 32.0;
const TICKS: f64 = 30.0;
const GAP: f64 = 22.0;
const TILE_HEIGHT: f64 = 26.0;
/// Of a map: the label of its axis has room beside it.
const LOWEST: f64 = 130.0;
/// In a legend, and between its entries.
const SWATCH: f64 = 26.0;
const BETWEEN: f64 = 26.0;
/// Between a swatch or a tick and its label.
const BESIDE: f64 = 8.0;
const NOTE_PITCH: f64 = 18.0;
/// Tiles darker than this, 0 to 255, have white signs.
const DARK: f64 = 140.0;
/// Of a sign's em in its tile.
const SIGN: f64 = 0.62;

type Done = Result<(), FigureError>;

/// What a tile can be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Kind {
    /// In the legend.
    pub label: String,
    /// Of the tile; none for the paper's.
    pub colour: Option<Colour>,
    /// In the tile, so that it is told without its colour.
    pub sign: String,
}

/// A map of the grid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tiles {
    /// Printed above it.
    pub title: String,
    /// Indices of [kinds](Mosaic::kinds), row by row from the lowest; those that do not fit are not drawn.
    pub kinds: Vec<usize>,
}

/// A grid of maps over the same two axes, filled row by row.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mosaic {
    /// Printed above everything; may be empty.
    pub title: String,
    /// Number of columns, at least one.
    pub columns: usize,
    /// What the columns and the rows of tiles are.
    pub x_label: String,
    /// See `x_label`.
    pub y_label: String,
    /// Names of the columns of tiles; as many are printed as have room.
    pub x: Vec<String>,
    /// Names of the rows of tiles, the lowest first.
    pub y: Vec<String>,
    /// The legend.
    pub kinds: Vec<Kind>,
    /// The maps, at least one.
    pub maps: Vec<Tiles>,
    /// Paragraphs below the maps.
    pub notes: Vec<String>,
}

impl Mosaic {
    /// Draws the maps.
    ///
    /// # Errors
    /// [`FigureError`] if there is no map, no column, or too many of them.
    pub fn render(&self) -> Result<Rendered, FigureError> {
        self.check()?;
        font::register()?;
        render(&Sheet::new(self)?)
    }

    fn check(&self) -> Result<(), FigureError> {
        if self.maps.is_empty() {
            return Err(FigureError::NoPanel);
        }
        if self.columns == 0 {
            return Err(FigureError::NoColumn);
        }
        let columns = self.columns.min(self.maps.len());
        let rows = self.maps.len().div_ceil(columns);
        if columns > MAX_COLUMNS || rows > MAX_ROWS {
            return Err(FigureError::TooLarge {
                columns,
                rows,
                max_columns: MAX_COLUMNS,
                max_rows: MAX_ROWS,
            });
        }
        Ok(())
    }
}

/// A mosaic and where its parts are, in pixels.
struct Sheet<'a> {
    mosaic: &'a Mosaic,
    height: f64,
    title_y: f64,
    /// The left end and the middle line of each kind.
    legend: Vec<Pixel>,
    maps: Vec<Area>,
    x_label_y: f64,
    notes: Vec<(f64, String)>,
}

impl<'a> Sheet<'a> {
    fn new(mosaic: &'a Mosaic) -> Result<Self, FigureError> {
        let band = if mosaic.title.is_empty() {
            0.0
        } else {
            TITLE_BAND
        };
        let top = EDGE + band;
        let (legend, legend_rows) = legend(&mosaic.kinds, top)?;
        let maps = maps(mosaic, top + legend_rows as f64 * LEGEND_ROW)?;
        let bottom = maps.iter().map(Area::bottom).fold(top, f64::max) + TICKS;
        let x_label_y = bottom + LABEL / 2.0;
        let (notes, end) = notes(&mosaic.notes, x_label_y + LABEL / 2.0)?;
        Ok(Self {
            mosaic,
            height: end + EDGE,
            title_y: EDGE + band / 2.0 - 4.0,
            legend,
            maps,
            x_label_y,
            notes,
        })
    }
}

/// Entries in centred rows, and how many rows.
fn legend(kinds: &[Kind], top: f64) -> Result<(Vec<Pixel>, usize), FigureError> {
    let width = |kind: &Kind| Ok(SWATCH + BESIDE + font::width(&kind.label, LABEL)?);
    let widths: Vec<f64> = kinds
        .iter()
        .map(width)
        .collect::<Result<_, FigureError>>()?;
    let mut rows: Vec<Vec<f64>> = vec![];
    for width in widths {
        let used: f64 = rows.last().into_iter().flatten().map(|w| w + BETWEEN).sum();
        match rows.last_mut() {
            Some(row) if used + width <= WIDTH - 2.0 * EDGE => row.push(width),
            _ => rows.push(vec![width]),
        }
    }
    let mut places = vec![];
    for (k, row) in rows.iter().enumerate() {
        let used = row.iter().map(|w| w + BETWEEN).sum::<f64>() - BETWEEN;
        let mut x = (WIDTH - used) / 2.0;
        for width in row {
            places.push((x, top + (k as f64 + 0.5) * LEGEND_ROW));
            x += width + BETWEEN;
        }
    }
    Ok((places, rows.len()))
}

fn maps(mosaic: &Mosaic, top: f64) -> Result<Vec<Area>, FigureError> {
    let columns = mosaic.columns.min(mosaic.maps.len());
    let mut indent: f64 = 0.0;
    for label in &mosaic.y {
        indent = indent.max(font::width(label, TICK)?);
    }
    // The label of the axis, and those of its ticks.
    let left = EDGE + LABEL + BESIDE;
    let indent = indent + BESIDE;
    let room = WIDTH - EDGE - left - (columns - 1) as f64 * GAP;
    let width = room / columns as f64 - indent;
    let height = LOWEST.max(TILE_HEIGHT * mosaic.y.len() as f64);
    let place = |k: usize| Area {
        left: left + (k % columns) as f64 * (indent + width + GAP) + indent,
        top: top + (k / columns) as f64 * (MAP_TITLE + height + TICKS) + MAP_TITLE,
        width,
        height,
    };
    Ok((0..mosaic.maps.len()).map(place).collect())
}

/// Lines of text with their middle lines, and where they end.
fn notes(notes: &[String], above: f64) -> Result<(Vec<(f64, String)>, f64), FigureError> {
    let mut lines = vec![];
    let mut y = above;
    for note in notes {
        for line in font::wrap(note, NOTE, WIDTH - 2.0 * EDGE)? {
            y += NOTE_PITCH;
            lines.push((y, line));
        }
    }
    Ok((lines, y))
}

impl Drawing for Sheet<'_> {
    fn size(&self) -> Pixel {
        (WIDTH, self.height)
    }

    fn draw<B: DrawingBackend>(&self, on: &mut Surface<B>) -> Done {
        let (mosaic, room) = (self.mosaic, WIDTH - 2.0 * EDGE);
        on.fill((0.0, 0.0), self.size(), PAPER)?;
        title(on, &mosaic.title, (WIDTH / 2.0, self.title_y), TITLE, room)?;
        for (kind, (x, y)) in mosaic.kinds.iter().zip(&self.legend) {
            let corner = (*x, y - SWATCH / 2.0);
            tile(on, kind, corner, (SWATCH, SWATCH))?;
            let at = (x + SWATCH + BESIDE, *y);
            text(on, &kind.label, at, (LABEL, HPos::Left), INK)?;
        }
        for (map, area) in mosaic.maps.iter().zip(&self.maps) {
            self.map(on, map, area)?;
        }
        title(
            on,
            &mosaic.x_label,
            (WIDTH / 2.0, self.x_label_y),
            LABEL,
            room,
        )?;
        self.upright_label(on)?;
        for (y, note) in &self.notes {
            text(on, note, (EDGE, *y), (NOTE, HPos::Left), INK)?;
        }
        Ok(())
    }
}

impl Sheet<'_> {
    fn map<B: DrawingBackend>(&self, on: &mut Surface<B>, map: &Tiles, area: &Area) -> Done {
        let Mosaic { x, y, kinds, .. } = self.mosaic;
        let above = (area.middle().0, area.top - MAP_TITLE / 2.0);
        title(on, &map.title, above, PANEL_TITLE, area.width)?;
        let (columns, rows) = (x.len().max(1), y.len().max(1));
        let size = (area.width / columns as f64, area.height / rows as f64);
        for (k, kind) in map.kinds.iter().take(columns * rows).enumerate() {
            let (column, row) = ((k % columns) as f64, (k / columns) as f64);
            let corner = (
                area.left + column * size.0,
                area.bottom() - (row + 1.0) * size.1,
            );
            if let Some(kind) = kinds.get(*kind) {
                tile(on, kind, corner, size)?;
            }
        }
        for (row, label) in y.iter().enumerate() {
            let middle = area.bottom() - (row as f64 + 0.5) * size.1;
            small(on, label, (area.left - BESIDE, middle), HPos::Right)?;
        }
        let stride = stride(x, size.0)?;
        for (column, label) in x.iter().enumerate().step_by(stride) {
            let middle = area.left + (column as f64 + 0.5) * size.0;
            small(
                on,
                label,
                (middle, area.bottom() + BESIDE + TICK / 2.0),
                HPos::Center,
            )?;
        }
        Ok(())
    }

    fn upright_label<B: DrawingBackend>(&self, on: &mut Surface<B>) -> Done {
        let top = self.maps.iter().map(|map| map.top).fold(f64::MAX, f64::min);
        let bottom = self.maps.iter().map(Area::bottom).fold(0.0, f64::max);
        let (label, size) = font::fit(&self.mosaic.y_label, LABEL, bottom - top + 40.0)?;
        on.text(&Text {
            text: &label,
            at: (EDGE + LABEL / 2.0 - 4.0, (top + bottom) / 2.0),
            size,
            align: HPos::Center,
            upright: true,
            colour: INK,
        })
    }
}

/// Every so many labels have room beside each other.
fn stride(labels: &[String], width: f64) -> Result<usize, FigureError> {
    let mut widest: f64 = 0.0;
    for label in labels {
        widest = widest.max(font::width(label, TICK)?);
    }
    Ok((((widest + BESIDE) / width).ceil() as usize).max(1))
}

fn tile<B: DrawingBackend>(
    on: &mut Surface<B>,
    kind: &Kind,
    (left, top): Pixel,
    (width, height): Pixel,
) -> Done {
    let fill = kind.colour.map_or(PAPER, colour);
    let corner = (left + width, top + height);
    on.fill((left, top), corner, fill)?;
    let outline = [
        (left, top),
        (left + width, top),
        corner,
        (left, top + height),
        (left, top),
    ];
    on.stroke(&outline, if fill == PAPER { FRAME } else { PAPER }, 1.0)?;
    let at = (left + width / 2.0, top + height / 2.0);
    let size = SIGN * width.min(height);
    text(on, &kind.sign, at, (size, HPos::Center), ink_on(fill))
}

fn ink_on(RGBColor(r, g, b): RGBColor) -> RGBColor {
    let lightness = 0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b);
    if lightness < DARK { PAPER } else { INK }
}

fn text<B: DrawingBackend>(
    on: &mut Surface<B>,
    text: &str,
    at: Pixel,
    (size, align): (f64, HPos),
    colour: RGBColor,
) -> Done {
    on.text(&Text {
        text,
        at,
        size,
        align,
        upright: false,
        colour,
    })
}
