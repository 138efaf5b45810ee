//! Grids of small maps, each of coloured tiles with a sign.

use crate::colour::{FRAME, INK, PAPER, Rgb};
use crate::page::{EDGE, LABEL, PANEL_TITLE, Page, TICK};
use crate::svg::{Area, Svg, Text};
use crate::{Colour, FigureError, Rendered, font, grid};

const WIDTH: f64 = 1600.0;
/// Above and below a map, and between two.
const ABOVE: f64 = 32.0;
const BELOW: f64 = 30.0;
const GAP: f64 = 22.0;
const TILE_HEIGHT: f64 = 26.0;
/// Of a map: the label of its axis has room beside it.
const LOWEST: f64 = 130.0;
/// In the legend.
const SAMPLE: f64 = 26.0;
/// Between a tile and its label.
const BESIDE: f64 = 8.0;
/// Tiles darker than this, 0 to 255, have white signs.
const DARK: f64 = 140.0;
/// Of a sign's em in its tile.
const SIGN: f64 = 0.62;

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
    /// Draws the maps, 1600 pixels wide.
    ///
    /// # Errors
    ///
    /// [`FigureError`] if there is no map, no column, or too many of them.
    pub fn render(&self) -> Result<Rendered, FigureError> {
        let columns = grid::columns(self.columns, self.maps.len())?;
        let mut page = Page::new(WIDTH, &self.title);
        let entries = self.kinds.iter().map(|kind| (kind.label.as_str(), kind));
        page.legend(entries, SAMPLE, |svg, kind, (left, y)| {
            let (top, size) = (y - SAMPLE / 2.0, SAMPLE);
            kind.draw(
                svg,
                &Area {
                    left,
                    top,
                    width: size,
                    height: size,
                },
            );
        });
        let left = EDGE + LABEL + BESIDE;
        let pitch = (WIDTH - EDGE - left + GAP) / columns as f64;
        let indent = font::widest(self.y.iter().map(String::as_str), TICK) + BESIDE;
        let indent = indent.min(pitch / 2.0);
        let height = LOWEST.max(TILE_HEIGHT * self.y.len() as f64);
        let top = page.y;
        for (k, map) in self.maps.iter().enumerate() {
            let (row, column) = ((k / columns) as f64, (k % columns) as f64);
            let area = Area {
                left: left + column * pitch + indent,
                top: top + row * (ABOVE + height + BELOW) + ABOVE,
                width: pitch - GAP - indent,
                height,
            };
            self.draw(&mut page.svg, map, &area, indent - BESIDE);
        }
        let rows = self.maps.len().div_ceil(columns) as f64;
        page.y += rows * (ABOVE + height + BELOW);
        let middle = (
            EDGE + LABEL / 2.0 - 4.0,
            (top + ABOVE + page.y - BELOW) / 2.0,
        );
        let label = Text::new(&self.y_label, middle, LABEL).upright();
        page.svg.text(&label.within(page.y - top));
        let label = Text::new(&self.x_label, (WIDTH / 2.0, page.y + LABEL / 2.0), LABEL);
        page.svg.text(&label.within(page.room()));
        page.y += LABEL;
        page.finish(&self.notes)
    }

    /// Draws a map, with `beside` for the names of its rows.
    fn draw(&self, svg: &mut Svg, map: &Tiles, area: &Area, beside: f64) {
        let title = Text::new(
            &map.title,
            (area.middle().0, area.top - ABOVE / 2.0),
            PANEL_TITLE,
        );
        svg.text(&title.within(area.width));
        let (columns, rows) = (self.x.len().max(1), self.y.len().max(1));
        let (width, height) = (area.width / columns as f64, area.height / rows as f64);
        let tile = |column: usize, row: usize| Area {
            left: area.left + column as f64 * width,
            top: area.bottom() - (row + 1) as f64 * height,
            width,
            height,
        };
        for (k, kind) in map.kinds.iter().take(columns * rows).enumerate() {
            if let Some(kind) = self.kinds.get(*kind) {
                kind.draw(svg, &tile(k % columns, k / columns));
            }
        }
        for (row, label) in self.y.iter().enumerate() {
            let at = (area.left - BESIDE, tile(0, row).middle().1);
            svg.text(&Text::new(label, at, TICK).ending().within(beside));
        }
        let widest = font::widest(self.x.iter().map(String::as_str), TICK);
        let stride = ((widest + BESIDE) / width).ceil() as usize;
        for (column, label) in self.x.iter().enumerate().step_by(stride.max(1)) {
            let at = (
                tile(column, 0).middle().0,
                area.bottom() + BESIDE + TICK / 2.0,
            );
            svg.text(&Text::new(label, at, TICK));
        }
    }
}

impl Kind {
    /// Draws a tile.
    fn draw(&self, svg: &mut Svg, area: &Area) {
        let fill = self.colour.map_or(PAPER, Colour::rgb);
        svg.rectangle(area, fill, if fill == PAPER { FRAME } else { PAPER });
        let size = SIGN * area.width.min(area.height);
        svg.text(&Text::new(&self.sign, area.middle(), size).coloured(ink_on(fill)));
    }
}

/// Of a sign.
fn ink_on((r, g, b): Rgb) -> Rgb {
    let lightness = 0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b);
    if lightness < DARK { PAPER } else { INK }
}
