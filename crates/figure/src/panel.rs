//! One chart: curves over two axes, and their names.

use crate::axis::{Axis, Scale, range};
use crate::colour::FRAME;
use crate::ends::{self, Labels};
use crate::font;
use crate::heat::Heat;
use crate::line::{DASHES, Level, Line};
use crate::plot::Plot;
use crate::svg::{Pen, Svg};
use crate::text::{LABEL, PANEL_TITLE, TICK, Text};

/// Above the plot, for the title.
pub(crate) const ABOVE: f64 = 36.0;
/// Below the plot, for its ticks and the label of the axis.
pub(crate) const BELOW: f64 = 54.0;

const X_TICKS: usize = 7;
const Y_TICKS: usize = 6;
const Y_MARGIN: f64 = 0.06;

/// One chart of the grid.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Panel {
    /// Printed above the chart.
    pub title: String,
    /// Quantity and unit of the horizontal axis.
    pub x_label: String,
    /// Scale of the horizontal axis.
    pub x_scale: Scale,
    /// Quantity and unit of the vertical axis.
    pub y_label: String,
    /// Scale of the vertical axis.
    pub y_scale: Scale,
    /// A map below all else.
    pub heat: Option<Heat>,
    /// Drawn dashed, below the curves.
    pub levels: Vec<Level>,
    /// Curves, the first one at the bottom.
    pub lines: Vec<Line>,
}

impl Panel {
    /// The names of its lines and levels.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        let levels = self.levels.iter().map(|level| level.label.as_str());
        let lines = self.lines.iter().map(|line| line.label.as_str());
        lines.chain(levels)
    }

    /// Axes over all that can be placed: the horizontal and the vertical one.
    pub(crate) fn axes(&self) -> (Axis, Axis) {
        // A zero on a logarithmic axis is not drawn, but its time counts.
        let points = self.lines.iter().flat_map(|line| &line.points);
        let points = points.filter(|(_, y)| Scale::Linear.coordinate(*y).is_some());
        let points = points.filter_map(|(x, y)| Some((self.x_scale.coordinate(*x)?, *y)));
        let [across, up] = [|heat: &Heat| heat.x, |heat: &Heat| heat.y]
            .map(|ends| self.heat.iter().flat_map(ends).collect::<Vec<_>>());
        let times = points.clone().map(|(x, _)| x).chain(across);
        let levels = self.levels.iter().map(|level| level.y);
        let heights = points.map(|(_, y)| y).chain(levels).chain(up);
        let heights = heights.filter_map(|y| self.y_scale.coordinate(y));
        // A map fills its panel.
        let margin = if self.heat.is_some() { 0.0 } else { Y_MARGIN };
        (
            Axis::new(self.x_scale, range(times), 0.0, X_TICKS),
            Axis::new(self.y_scale, range(heights), margin, Y_TICKS),
        )
    }

    /// Draws the panel, whose left end is `left`, and whose right end is `right`.
    pub(crate) fn draw(&self, svg: &mut Svg, plot: &Plot, labels: Labels, [left, right]: [f64; 2]) {
        if let Some(heat) = &self.heat {
            heat.draw(svg, plot);
        }
        plot.draw_rules(svg);
        let pen = Pen::new(FRAME, 1.0, DASHES);
        for y in self.levels.iter().filter_map(|level| plot.height(level.y)) {
            svg.stroke(&plot.level(y), pen);
        }
        if labels == Labels::Ends {
            ends::draw(svg, (&self.lines, &self.levels), plot, right);
        }
        for line in &self.lines {
            line.draw(svg, plot);
        }
        plot.draw_frame(svg);
        self.draw_names(svg, plot, left);
    }

    fn draw_names(&self, svg: &mut Svg, plot: &Plot, left: f64) {
        let area = &plot.area;
        let (x, y) = area.middle();
        let (above, below) = (area.top - ABOVE / 2.0 + 2.0, area.bottom() + BELOW - 10.0);
        let title = Text::new(&self.title, (x, above), PANEL_TITLE);
        svg.text(&title.within(area.width - 2.0 * beside(&plot.y)));
        let label = Text::new(&self.x_label, (x, below), LABEL);
        svg.text(&label.within(area.width - 2.0 * beside(&plot.x)));
        let label = Text::new(&self.y_label, (left + LABEL / 2.0 + 2.0, y), LABEL);
        svg.text(&label.upright().within(area.height + 40.0));
        if let Some(factor) = &plot.y.factor {
            svg.text(&Text::new(factor, (area.left, above + 4.0), TICK).starting());
        }
        if let Some(factor) = &plot.x.factor {
            svg.text(&Text::new(factor, (area.right(), below), TICK).ending());
        }
        if self.lines.iter().all(|line| line.pixels(plot).is_empty()) {
            svg.text(&Text::new("no data", (x, y), LABEL).within(area.width));
        }
    }
}

/// What the factor of an axis takes at one end of a centred text.
fn beside(axis: &Axis) -> f64 {
    let factor = axis.factor.as_deref();
    factor.map_or(0.0, |factor| font::width(factor, TICK) + 12.0)
}
