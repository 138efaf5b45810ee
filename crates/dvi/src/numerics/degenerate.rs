//! Directions in which a kinetic energy has no inertia.

use lie::Lu;

/// Roundings that elimination may leave in place of a zero, for each coordinate.
const ROUNDINGS: f64 = 8.0;
/// Inertia is what stays as the step vanishes: a pivot that shrinks by more than this is none.
const STAYS: f64 = 0.1;
/// Passes that bring the rows of a symmetric matrix to the same size.
const PASSES: usize = 4;

/// A coordinate along which a matrix has no inertia, if there is one: where its columns depend on those before.
///
/// `short` and `long` are the same matrix at a short step and at a longer one: what is inertia is the same in both.
pub(crate) fn without_inertia(short: &Lu<f64>, long: &Lu<f64>) -> Option<usize> {
    let scales = balance(long);
    let [mut short, mut long] = [short, long].map(|matrix| scaled(matrix, &scales));
    short.factorise(|_, _| 1.0);
    long.factorise_by(|_, k| short.exchanges()[k]);
    let rounding = ROUNDINGS * f64::EPSILON * scales.len() as f64;
    (0..scales.len()).find(|&k| {
        let [pivot, longer] = [&short, &long].map(|matrix| matrix.at(k, k).abs());
        !(pivot > rounding && pivot > STAYS * longer)
    })
}

/// What rows and columns are multiplied by, so that the largest entry of each is near one, whatever the units.
fn balance(matrix: &Lu<f64>) -> Vec<f64> {
    let n = matrix.dim();
    let mut scales = vec![1.0; n];
    for _ in 0..PASSES {
        let largest = |i: usize| {
            let row = (0..n).map(|j| (scales[i] * matrix.at(i, j) * scales[j]).abs());
            row.fold(0.0, f64::max)
        };
        let sizes: Vec<f64> = (0..n).map(largest).collect();
        for (scale, size) in scales.iter_mut().zip(sizes) {
            if size > 0.0 {
                *scale /= size.sqrt();
            }
        }
    }
    scales
}

fn scaled(matrix: &Lu<f64>, scales: &[f64]) -> Lu<f64> {
    let mut scaled = matrix.clone();
    for (j, of_column) in scales.iter().enumerate() {
        for (entry, of_row) in scaled.column_mut(j).iter_mut().zip(scales) {
            *entry *= of_row * of_column;
        }
    }
    scaled
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found<const N: usize>(short: [[f64; N]; N], long: [[f64; N]; N]) -> Option<usize> {
        let [short, long] = [short, long].map(|rows| {
            let mut matrix = Lu::new(N);
            (0..N).for_each(|j| {
                matrix
                    .column_mut(j)
                    .copy_from_slice(&rows.map(|row| row[j]))
            });
            matrix
        });
        without_inertia(&short, &long)
    }

    #[test]
    fn what_has_inertia_is_told_from_what_has_not() {
        let regular = [[1e3, 1e-3], [1e-3, 2e-9]];
        assert_eq!(found(regular, regular), None);
        // Null coordinates, L = v w.
        let null = [[0.0, 1.0], [1.0, 0.0]];
        assert_eq!(found(null, null), None);
        assert_eq!(
            found([[1.0, 0.0], [0.0, 0.0]], [[1.0, 0.0], [0.0, 0.0]]),
            Some(1)
        );
        assert!(found([[1.0, 1.0], [1.0, 1.0]], [[1.0, 1.0], [1.0, 1.0]]).is_some());
        // A first-order Lagrangian by the midpoint rule: the entries go as the step.
        assert!(found([[0.0, 1e-8], [-1e-8, 0.0]], [[0.0, 1e-6], [-1e-6, 0.0]]).is_some());
    }
}
