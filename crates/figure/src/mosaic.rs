//! Grids of small maps, each of coloured tiles with a sign.

use crate::colour::{FRAME, INK, PAPER, Rgb};
use crate::grid::Grid;
use crate::page::{EDGE, Page};
use crate::svg::{Area, Svg};
use crate::text::{LABEL, PANEL_TITLE, TICK, Text};
use crate::{Colour, FigureError, Rendered, font};

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
        let grid = Grid::new(self.columns, self.maps.len())?;
        let mut page = Page::new(WIDTH, &self.title);
        self.draw_legend(&mut page);
        let (left, top) = (EDGE + LABEL + BESIDE, page.y);
        let wide = (WIDTH - EDGE - left + GAP) / grid.columns as f64;
        let height = LOWEST.max(TILE_HEIGHT * self.y.len() as f64);
        let pitch = (wide, ABOVE + height + BELOW);
        let indent = (widest(&self.y) + BESIDE).min(wide / 2.0);
        for (k, map) in self.maps.iter().enumerate() {
            let (left, top) = grid.corner(k, (left, top), pitch);
            let area = Area {
                left: left + indent,
                top: top + ABOVE,
                width: wide - GAP - indent,
                height,
            };
            map.draw(&mut page.svg, self, &area);
            self.draw_names(&mut page.svg, &area, indent - BESIDE);
        }
        page.y += grid.rows as f64 * pitch.1;
        let middle = (top + ABOVE + page.y - BELOW) / 2.0;
        let label = Text::new(&self.y_label, (EDGE + LABEL / 2.0 - 4.0, middle), LABEL);
        page.svg.text(&label.upright().within(page.y - top));
        let label = Text::new(&self.x_label, (WIDTH / 2.0, page.y + LABEL / 2.0), LABEL);
        page.svg.text(&label.within(page.room()));
        page.y += LABEL;
        page.finish(&self.notes)
    }

    fn draw_legend(&self, page: &mut Page) {
        let entries = self.kinds.iter().map(|kind| (kind.label.as_str(), kind));
        page.legend(entries, SAMPLE, |svg, kind, (left, y)| {
            let area = Area {
                left,
                top: y - SAMPLE / 2.0,
                width: SAMPLE,
                height: SAMPLE,
            };
            kind.draw(svg, &area);
        });
    }

    /// The tile in a column and a row of a map.
    fn tile(&self, area: &Area, column: usize, row: usize) -> Area {
        let width = area.width / self.x.len().max(1) as f64;
        let height = area.height / self.y.len().max(1) as f64;
        Area {
            left: area.left + column as f64 * width,
            top: area.bottom() - (row + 1) as f64 * height,
            width,
            height,
        }
    }

    /// Draws the names of columns and rows around a map; those of rows have `room`.
    fn draw_names(&self, svg: &mut Svg, area: &Area, room: f64) {
        for (row, name) in self.y.iter().enumerate() {
            let (_, y) = self.tile(area, 0, row).middle();
            let name = Text::new(name, (area.left - BESIDE, y), TICK);
            svg.text(&name.ending().within(room));
        }
        let y = area.bottom() + BESIDE + TICK / 2.0;
        let stride = (widest(&self.x) + BESIDE) / self.tile(area, 0, 0).width;
        let stride = (stride.ceil() as usize).max(1);
        for (column, name) in self.x.iter().enumerate().step_by(stride) {
            let (x, _) = self.tile(area, column, 0).middle();
            svg.text(&Text::new(name, (x, y), TICK));
        }
    }
}

impl Tiles {
    fn draw(&self, svg: &mut Svg, mosaic: &Mosaic, area: &Area) {
        let above = (area.middle().0, area.top - ABOVE / 2.0);
        svg.text(&Text::new(&self.title, above, PANEL_TITLE).within(area.width));
        let (columns, rows) = (mosaic.x.len().max(1), mosaic.y.len().max(1));
        for (k, kind) in self.kinds.iter().take(columns * rows).enumerate() {
            if let Some(kind) = mosaic.kinds.get(*kind) {
                kind.draw(svg, &mosaic.tile(area, k % columns, k / columns));
            }
        }
    }
}

/// Width of the widest tick label.
fn widest(names: &[String]) -> f64 {
    font::widest(names.iter().map(String::as_str), TICK)
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

/// The colour of a sign on a tile.
fn ink_on((r, g, b): Rgb) -> Rgb {
    let lightness = 0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b);
    if lightness < DARK { PAPER } else { INK }
}
