//! Cutting a line into dashes.

use crate::Style;
use crate::thin::Pixel;

/// A path this many times longer than what it spans fills its panel: dashes
/// along it would be a haze, so they follow the horizontal axis instead.
const WINDING: f64 = 2.5;

/// Lengths of dash and gap, in pixels.
fn pattern(style: Style) -> Option<(f64, f64)> {
    match style {
        Style::Solid | Style::Broad | Style::Invisible => None,
        Style::Dashed => Some((9.0, 5.5)),
        Style::Dotted => Some((2.2, 4.0)),
    }
}

/// The strokes that show a path in a style.
pub(crate) fn dash(path: Vec<Pixel>, style: Style) -> Vec<Vec<Pixel>> {
    if style == Style::Invisible {
        return vec![];
    }
    let Some((on, off)) = pattern(style) else {
        return vec![path];
    };
    let span = length(&path, advance) + height(&path);
    let along = length(&path, distance) <= WINDING * span;
    let measure = if along { distance } else { advance };
    let mut cutter = Cutter {
        lengths: [on, off],
        left: on,
        down: true,
        strokes: Vec::new(),
    };
    if let Some(first) = path.first() {
        cutter.strokes.push(vec![*first]);
    }
    for pair in path.windows(2) {
        cutter.follow(pair[0], pair[1], measure(pair[0], pair[1]));
    }
    cutter.strokes.retain(|s| s.len() > 1);
    cutter.strokes
}

fn distance(a: Pixel, b: Pixel) -> f64 {
    (b.0 - a.0).hypot(b.1 - a.1)
}

fn advance(a: Pixel, b: Pixel) -> f64 {
    (b.0 - a.0).abs()
}

/// From the highest to the lowest point.
fn height(path: &[Pixel]) -> f64 {
    let span = |(low, high): (f64, f64), p: &Pixel| (low.min(p.1), high.max(p.1));
    let (low, high) = path.iter().fold((f64::MAX, f64::MIN), span);
    (high - low).max(0.0)
}

fn length(path: &[Pixel], measure: fn(Pixel, Pixel) -> f64) -> f64 {
    path.windows(2).map(|w| measure(w[0], w[1])).sum()
}

struct Cutter {
    lengths: [f64; 2],
    left: f64,
    down: bool,
    strokes: Vec<Vec<Pixel>>,
}

impl Cutter {
    fn follow(&mut self, from: Pixel, to: Pixel, length: f64) {
        let mut done = 0.0;
        while length - done > self.left {
            done += self.left;
            let f = done / length;
            self.turn((from.0 + f * (to.0 - from.0), from.1 + f * (to.1 - from.1)));
        }
        self.left -= length - done;
        if self.down {
            self.extend(to);
        }
    }

    fn turn(&mut self, at: Pixel) {
        if self.down {
            self.extend(at);
        } else {
            self.strokes.push(vec![at]);
        }
        self.down = !self.down;
        self.left = self.lengths[usize::from(!self.down)];
    }

    fn extend(&mut self, point: Pixel) {
        if let Some(stroke) = self.strokes.last_mut() {
            stroke.push(point);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solid_is_one_stroke() {
        let path = vec![(0.0, 0.0), (5.0, 5.0)];
        assert_eq!(dash(path.clone(), Style::Solid), vec![path]);
    }

    #[test]
    fn dashes_have_their_length_across_corners() {
        let path = vec![(0.0, 0.0), (20.0, 0.0), (100.0, 20.0), (180.0, 0.0)];
        let strokes = dash(path, Style::Dashed);
        assert!(strokes.len() > 10);
        for stroke in &strokes[..strokes.len() - 1] {
            assert!((length(stroke, distance) - 9.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_line_that_fills_the_panel_is_dashed_across() {
        let path: Vec<Pixel> = (0..700)
            .map(|k| (f64::from(k), if k % 2 == 0 { 0.0 } else { 250.0 }))
            .collect();
        let strokes = dash(path, Style::Dashed);
        assert_eq!(strokes.len(), (699.0_f64 / 14.5).ceil() as usize);
    }

    #[test]
    fn a_steep_line_is_dashed_along() {
        let strokes = dash(vec![(0.0, 0.0), (1.0, 140.0)], Style::Dashed);
        assert_eq!(strokes.len(), 10);
    }

    #[test]
    fn nothing_gives_nothing() {
        assert!(dash(vec![], Style::Dotted).is_empty());
        assert!(dash(vec![(1.0, 1.0)], Style::Dotted).is_empty());
        assert!(dash(vec![(1.0, 1.0); 3], Style::Dashed).len() <= 1);
    }
}
