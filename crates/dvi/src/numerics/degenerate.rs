//! Directions in which a kinetic energy has no inertia.

/// Roundings that elimination may leave in place of a zero, for each coordinate.
const ROUNDINGS: f64 = 8.0;
/// Inertia is what stays as the step vanishes: a pivot that shrinks by more than this is none.
const STAYS: f64 = 0.1;
/// Passes that bring the rows of a symmetric matrix to the same size.
const PASSES: usize = 4;

/// A square matrix, row by row.
#[derive(Clone)]
pub(crate) struct Square {
    n: usize,
    entries: Vec<f64>,
}

impl Square {
    pub(crate) fn new(n: usize, entries: Vec<f64>) -> Self {
        Self { n, entries }
    }

    fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.n + j]
    }

    /// Multiplies rows and columns so that the largest entry of each is near one, whatever the units.
    fn balance(&self) -> Vec<f64> {
        let mut scales = vec![1.0; self.n];
        for _ in 0..PASSES {
            let largest = |i: usize| {
                let row = (0..self.n).map(|j| (scales[i] * self.at(i, j) * scales[j]).abs());
                row.fold(0.0, f64::max)
            };
            let sizes: Vec<f64> = (0..self.n).map(largest).collect();
            for (scale, size) in scales.iter_mut().zip(sizes) {
                if size > 0.0 {
                    *scale /= size.sqrt();
                }
            }
        }
        scales
    }

    fn scaled(&self, scales: &[f64]) -> Self {
        let mut scaled = self.clone();
        for (k, entry) in scaled.entries.iter_mut().enumerate() {
            *entry *= scales[k / self.n] * scales[k % self.n];
        }
        scaled
    }

    fn swap(&mut self, k: usize, (row, column): (usize, usize)) {
        for j in 0..self.n {
            self.entries.swap(k * self.n + j, row * self.n + j);
        }
        for i in 0..self.n {
            self.entries.swap(i * self.n + k, i * self.n + column);
        }
    }

    fn eliminate(&mut self, k: usize) {
        for i in k + 1..self.n {
            let factor = self.at(i, k) / self.at(k, k);
            for j in k + 1..self.n {
                self.entries[i * self.n + j] -= factor * self.at(k, j);
            }
        }
    }
}

/// A coordinate along which a matrix has no inertia, by elimination with complete pivoting, if there is one.
///
/// `short` and `long` are the same matrix at a short step and at a longer one: what is inertia is the same in both.
pub(crate) fn without_inertia(short: &Square, long: &Square) -> Option<usize> {
    let scales = long.balance();
    let (mut short, mut long) = (short.scaled(&scales), long.scaled(&scales));
    let n = long.n;
    let rounding = ROUNDINGS * f64::EPSILON * n as f64;
    let mut coordinates: Vec<usize> = (0..n).collect();
    for k in 0..n {
        let places = (k..n).flat_map(|i| (k..n).map(move |j| (i, j)));
        let size = |(i, j): (usize, usize)| short.at(i, j).abs();
        let (row, column) = places.reduce(|a, b| if size(b) > size(a) { b } else { a })?;
        coordinates.swap(k, column);
        short.swap(k, (row, column));
        long.swap(k, (row, column));
        let (pivot, longer) = (short.at(k, k).abs(), long.at(k, k).abs());
        if !(pivot > rounding && pivot > STAYS * longer) {
            return Some(coordinates[k]);
        }
        short.eliminate(k);
        long.eliminate(k);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found<const N: usize>(short: [[f64; N]; N], long: [[f64; N]; N]) -> Option<usize> {
        let square = |rows: [[f64; N]; N]| Square::new(N, rows.concat());
        without_inertia(&square(short), &square(long))
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
