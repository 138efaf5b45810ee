//! The bitmap of an SVG document.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use crate::FigureError;
use crate::font::SUBSET;

/// Draws an SVG document, with no font but the bundled one, and encodes it as PNG.
pub(crate) fn rasterise(svg: &str) -> Result<Vec<u8>, FigureError> {
    let mut options = Options::default();
    options.fontdb_mut().load_font_data(SUBSET.to_vec());
    let tree = Tree::from_str(svg, &options).map_err(FigureError::draw)?;
    let size = tree.size().to_int_size();
    let pixels = Pixmap::new(size.width(), size.height());
    let mut pixels = pixels.ok_or_else(|| FigureError::draw("the bitmap is too large"))?;
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
    pixels.encode_png().map_err(FigureError::draw)
}
