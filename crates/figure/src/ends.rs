//! Names beside a panel, each led to from the end of its line.

use crate::layout::{Cell, LABEL, TICK};
use crate::thin::Pixel;
use crate::{FigureError, Level, Line, Panel, font};

/// Between the plot and the names: room for the leaders.
const LEADER: f64 = 46.0;
/// Room for a marker before a name.
const MARK: f64 = 18.0;
/// Between the middle lines of two names.
const PITCH: f64 = 1.15 * TICK;

/// A name, and the path that leads to it.
pub(crate) struct End<'a> {
    pub(crate) label: &'a str,
    /// Of a line, not of a level.
    pub(crate) line: Option<&'a Line>,
    /// Where its marker stands before the name.
    pub(crate) mark: Pixel,
    pub(crate) leader: [Pixel; 2],
    pub(crate) at: Pixel,
}

/// What the names take beside the plots of a figure.
pub(crate) fn room<'a>(panels: impl Iterator<Item = &'a Panel>) -> Result<f64, FigureError> {
    let labels = panels.flat_map(|panel| {
        let levels = panel.levels.iter().map(|level| &level.label);
        panel.lines.iter().map(|line| &line.label).chain(levels)
    });
    let mut widest: f64 = 0.0;
    for label in labels {
        widest = widest.max(font::width(label, TICK)?);
    }
    Ok(LEADER + widest)
}

/// The names of a panel's lines and levels, moved apart where they would overlap.
pub(crate) fn ends<'a>(panel: &'a Panel, cell: &Cell) -> Vec<End<'a>> {
    let right = cell.plot.right();
    let line = |line: &'a Line| {
        let end = line.points.iter().rev().find_map(|p| cell.pixel(*p))?;
        Some((line.label.as_str(), Some(line), end))
    };
    let level = |level: &'a Level| {
        let end = (right, cell.height(level.y)?);
        Some((level.label.as_str(), None, end))
    };
    let lines = panel.lines.iter().filter_map(line);
    let levels = panel.levels.iter().filter_map(level);
    let named = lines.chain(levels).filter(|(label, ..)| !label.is_empty());
    let mut ends: Vec<_> = named.collect();
    // Of lines that end at one height, the leader of the left one passes above the end of the right one.
    ends.sort_by(|(_, _, a), (_, _, b)| {
        let row = |y: f64| (y / PITCH).round();
        row(a.1).total_cmp(&row(b.1)).then(a.0.total_cmp(&b.0))
    });
    let bottom = cell.plot.bottom() + LABEL / 2.0;
    let heights = spread(ends.iter().map(|(_, _, end)| end.1).collect(), bottom);
    let label = |((label, line, end), y)| End {
        label,
        line,
        leader: [end, (right + LEADER - MARK, y)],
        mark: (right + LEADER - MARK / 2.0, y),
        at: (right + LEADER, y),
    };
    ends.into_iter().zip(heights).map(label).collect()
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
