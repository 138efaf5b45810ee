//! The frame of a chart: where its values are, and what its axes say.

use crate::axis::Axis;
use crate::colour::{FRAME, RULE};
use crate::svg::{Area, Svg};
use crate::text::Pixel;
use crate::text::{TICK, Text};

/// Between a tick and its label.
pub(crate) const TICK_GAP: f64 = 9.0;
const TICK_LENGTH: f64 = 5.0;
const MINOR_LENGTH: f64 = 3.0;

/// Where a panel is drawn, and what its axes show.
pub(crate) struct Plot {
    /// Inside the axes.
    pub(crate) area: Area,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
}

impl Plot {
    fn across(&self, fraction: f64) -> f64 {
        self.area.left + fraction * self.area.width
    }

    fn up(&self, fraction: f64) -> f64 {
        self.area.bottom() - fraction * self.area.height
    }

    /// The vertical pixel of a value, if it can be placed.
    pub(crate) fn height(&self, y: f64) -> Option<f64> {
        self.y.place(y).map(|y| self.up(y))
    }

    /// The pixel of a point, if it can be placed.
    pub(crate) fn pixel(&self, (x, y): (f64, f64)) -> Option<Pixel> {
        Some((self.across(self.x.place(x)?), self.height(y)?))
    }

    /// From the left to the right end.
    pub(crate) fn level(&self, y: f64) -> [Pixel; 2] {
        [(self.area.left, y), (self.area.right(), y)]
    }

    fn upright(&self, x: f64) -> [Pixel; 2] {
        [(x, self.area.top), (x, self.area.bottom())]
    }

    /// Draws the lines across at the labelled ticks.
    pub(crate) fn draw_rules(&self, svg: &mut Svg) {
        let upright = self.x.major.iter().map(|t| self.upright(self.across(t.at)));
        let levels = self.y.major.iter().map(|t| self.level(self.up(t.at)));
        svg.rules(upright.chain(levels), RULE);
    }

    /// Draws the frame, its ticks and their labels.
    pub(crate) fn draw_frame(&self, svg: &mut Svg) {
        let Area { left, top, .. } = self.area;
        let (right, bottom) = (self.area.right(), self.area.bottom());
        let sides = [self.upright(left), self.upright(right)].into_iter();
        let sides = sides.chain([self.level(top), self.level(bottom)]);
        let below = ticks(&self.x).map(|(at, length)| {
            let x = self.across(at);
            [(x, bottom), (x, bottom + length)]
        });
        let beside = ticks(&self.y).map(|(at, length)| {
            let y = self.up(at);
            [(left - length, y), (left, y)]
        });
        svg.rules(sides.chain(below).chain(beside), FRAME);
        for tick in &self.x.major {
            let at = (self.across(tick.at), bottom + TICK_GAP + TICK / 2.0);
            svg.text(&Text::new(&tick.label, at, TICK));
        }
        for tick in &self.y.major {
            let at = (left - TICK_GAP, self.up(tick.at));
            svg.text(&Text::new(&tick.label, at, TICK).ending());
        }
    }
}

/// Positions and lengths of all ticks.
fn ticks(axis: &Axis) -> impl Iterator<Item = (f64, f64)> {
    let major = axis.major.iter().map(|tick| (tick.at, TICK_LENGTH));
    let minor = axis.minor.iter().map(|at| (*at, MINOR_LENGTH));
    major.chain(minor)
}
