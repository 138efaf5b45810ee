//! Names beside a panel, each led to from the end of its line.

use crate::colour::{INK, LEADER};
use crate::font;
use crate::line::{Level, Line};
use crate::plot::Plot;
use crate::svg::{Pen, Svg};
use crate::text::Pixel;
use crate::text::{LABEL, TICK, Text};

/// Between the plot and the names: room for the leaders.
const LEAD: f64 = 46.0;
/// Room for a marker before a name.
const MARK: f64 = 18.0;
/// Between the middle lines of two names.
const PITCH: f64 = 1.15 * TICK;

/// Where lines are named.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Labels {
    /// In one legend on top.
    #[default]
    Legend,
    /// At their ends, on the right of each panel.
    Ends,
}

/// What the names take beside the plots of a figure.
pub(crate) fn room<'a>(names: impl Iterator<Item = &'a str>) -> f64 {
    LEAD + font::widest(names, TICK)
}

/// What is named, by which line if not by a level, and where it ends.
type End<'a> = (&'a str, Option<&'a Line>, Pixel);

/// Draws the names of lines and levels up to `right`, moved apart where they would overlap.
pub(crate) fn draw(svg: &mut Svg, named: (&[Line], &[Level]), plot: &Plot, right: f64) {
    let ends = ends(named, plot);
    let bottom = plot.area.bottom() + LABEL / 2.0;
    let heights = spread(ends.iter().map(|(_, _, end)| end.1).collect(), bottom);
    let left = plot.area.right() + LEAD;
    let pen = Pen::new(LEADER, 1.0, "");
    for ((label, line, end), y) in ends.into_iter().zip(heights) {
        svg.stroke(&[end, (left - MARK, y)], pen);
        let colour = line.map_or(INK, |line| line.colour.rgb());
        let name = Text::new(label, (left, y), TICK).within(right - left);
        svg.text(&name.starting().coloured(colour));
        if let Some(line) = line {
            line.draw_marks(svg, &[(left - MARK / 2.0, y)]);
        }
    }
}

/// Downwards.
fn ends<'a>((lines, levels): (&'a [Line], &'a [Level]), plot: &Plot) -> Vec<End<'a>> {
    let lines = lines.iter().filter_map(|line| {
        let end = *line.pixels(plot).last()?;
        Some((line.label.as_str(), Some(line), end))
    });
    let levels = levels.iter().filter_map(|level| {
        let end = (plot.area.right(), plot.height(level.y)?);
        Some((level.label.as_str(), None, end))
    });
    let named = lines.chain(levels).filter(|(label, ..)| !label.is_empty());
    let mut ends: Vec<End> = named.collect();
    // Of lines that end at one height, the leader of the left one passes above the end of the right one.
    ends.sort_by(|(_, _, a), (_, _, b)| {
        let row = |y: f64| (y / PITCH).round();
        row(a.1).total_cmp(&row(b.1)).then(a.0.total_cmp(&b.0))
    });
    ends
}

/// Heights at least a pitch apart and none below the bottom, in the same order.
fn spread(mut heights: Vec<f64>, bottom: f64) -> Vec<f64> {
    for k in 1..heights.len() {
        heights[k] = heights[k].max(heights[k - 1] + PITCH);
    }
    let mut limit = bottom;
    for height in heights.iter_mut().rev() {
        *height = height.min(limit);
        limit = *height - PITCH;
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_their_order_and_their_distance() {
        let heights = spread(vec![10.0, 11.0, 200.0, 299.0, 300.0], 300.0);
        assert_eq!((heights[0], heights[2], heights[4]), (10.0, 200.0, 300.0));
        assert!(heights.windows(2).all(|w| w[1] - w[0] >= PITCH - 1e-9));
        assert_eq!(spread(vec![], 300.0), [0.0; 0]);
    }
}
