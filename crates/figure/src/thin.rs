//! No more points than pixels can show.

/// A point of the drawing, in pixels.
pub(crate) type Pixel = (f64, f64);

/// Keeps, of every run of points within one pixel column, the lowest and the
/// highest, and the two ends of the line.
pub(crate) fn thin(points: impl IntoIterator<Item = Pixel>) -> Vec<Pixel> {
    let mut kept = Vec::new();
    let mut column: Option<Column> = None;
    for point in points {
        match &mut column {
            Some(c) if c.index == point.0.floor() => c.add(point),
            _ => {
                if let Some(done) = column.replace(Column::new(point)) {
                    done.flush(&mut kept);
                }
            }
        }
    }
    if let Some(done) = column {
        let last = done.last;
        done.flush(&mut kept);
        push(&mut kept, last);
    }
    kept
}

struct Column {
    index: f64,
    count: usize,
    low: (usize, Pixel),
    high: (usize, Pixel),
    last: Pixel,
}

impl Column {
    fn new(point: Pixel) -> Self {
        Self {
            index: point.0.floor(),
            count: 1,
            low: (0, point),
            high: (0, point),
            last: point,
        }
    }

    fn add(&mut self, point: Pixel) {
        if point.1 < self.low.1.1 {
            self.low = (self.count, point);
        }
        if point.1 > self.high.1.1 {
            self.high = (self.count, point);
        }
        self.count += 1;
        self.last = point;
    }

    fn flush(self, kept: &mut Vec<Pixel>) {
        let (a, b) = if self.low.0 <= self.high.0 {
            (self.low, self.high)
        } else {
            (self.high, self.low)
        };
        push(kept, a.1);
        push(kept, b.1);
    }
}

fn push(kept: &mut Vec<Pixel>, point: Pixel) {
    if kept.last() != Some(&point) {
        kept.push(point);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_points_stay() {
        let points = vec![(0.0, 1.0), (0.5, 2.0), (3.0, -1.0), (7.0, 0.0)];
        assert_eq!(thin(points.clone()), points);
        assert_eq!(thin([]), []);
        assert_eq!(thin([(1.0, 1.0)]), [(1.0, 1.0)]);
    }

    #[test]
    fn extremes_of_every_column_stay_in_order() {
        let wave = |k: u32| {
            let x = f64::from(k) / 1000.0;
            (x, (x * 400.0).sin() * (1.0 + x))
        };
        let all: Vec<Pixel> = (0..100_000).map(wave).collect();
        let kept = thin(all.clone());
        assert!(kept.len() <= 201, "{}", kept.len());
        assert!(kept.windows(2).all(|w| w[0].0 < w[1].0));
        assert_eq!(kept.last(), all.last());
        for column in 0..100 {
            let peak = |points: &[Pixel]| {
                let inside = points.iter().filter(|p| p.0.floor() == f64::from(column));
                inside.map(|p| p.1).fold(f64::NEG_INFINITY, f64::max)
            };
            assert_eq!(peak(&all), peak(&kept));
        }
    }
}
