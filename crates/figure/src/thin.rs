//! No more points than pixels can show.

use crate::text::Pixel;

/// Keeps the lowest and the highest of every run of points within one pixel column, and the two ends of the line.
pub(crate) fn thin(points: &[Pixel]) -> Vec<Pixel> {
    let mut kept: Vec<Pixel> = points.first().copied().into_iter().collect();
    for column in points.chunk_by(|a, b| a.0.floor() == b.0.floor()) {
        let by_height = |a: &usize, b: &usize| column[*a].1.total_cmp(&column[*b].1);
        let low = (0..column.len()).min_by(by_height);
        let high = (0..column.len()).max_by(by_height);
        let extremes = low.min(high).into_iter().chain(low.max(high));
        kept.extend(extremes.map(|k| column[k]));
    }
    kept.extend(points.last());
    kept.dedup();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_points_stay() {
        let points = vec![(0.0, 1.0), (0.5, 2.0), (3.0, -1.0), (7.0, 0.0)];
        assert_eq!(thin(&points), points);
        assert_eq!(thin(&[]), []);
        assert_eq!(thin(&[(1.0, 1.0)]), [(1.0, 1.0)]);
    }

    #[test]
    fn extremes_of_every_column_stay_in_order() {
        let wave = |k: u32| {
            let x = f64::from(k) / 1000.0;
            (x, (x * 400.0).sin() * (1.0 + x))
        };
        let all: Vec<Pixel> = (0..100_000).map(wave).collect();
        let kept = thin(&all);
        assert!(kept.len() <= 202, "{}", kept.len());
        assert!(kept.windows(2).all(|w| w[0].0 < w[1].0));
        assert_eq!((kept.first(), kept.last()), (all.first(), all.last()));
        for column in 0..100 {
            let extremes = |points: &[Pixel]| {
                let inside = points.iter().filter(|p| p.0.floor() == f64::from(column));
                let both = inside.map(|p| (p.1, p.1));
                both.reduce(|(low, high), (y, _)| (low.min(y), high.max(y)))
            };
            assert_eq!(extremes(&all), extremes(&kept));
        }
    }
}
