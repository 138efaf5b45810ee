//! Small dense systems over any scalar.

use lie::Scalar;

use super::degenerate::Square;

/// A square matrix, factorised by Gauss elimination with row pivoting.
///
/// A singular matrix is not an error here: a solution is then not finite.
pub(crate) struct Elimination<S> {
    n: usize,
    /// Row by row: the matrix, then its factors.
    entries: Vec<S>,
    /// The row that elimination took for each column.
    pivots: Vec<usize>,
    /// What rows are relative to.
    units: Vec<f64>,
}

impl<S: Scalar> Elimination<S> {
    pub(crate) fn new(n: usize) -> Self {
        Self {
            n,
            entries: vec![S::zero(); n * n],
            pivots: vec![0; n],
            units: vec![1.0; n],
        }
    }

    /// Sets an entry of the matrix; every one of them before it is factorised again.
    pub(crate) fn set(&mut self, row: usize, column: usize, value: S) {
        self.entries[row * self.n + column] = value;
    }

    /// A row, before the matrix is factorised.
    pub(crate) fn row(&self, i: usize) -> &[S] {
        &self.entries[i * self.n..][..self.n]
    }

    /// Factorises a matrix from a vector space to its dual: its diagonal tells the units of the rows that pivots are chosen from.
    pub(crate) fn factorise(&mut self) {
        let n = self.n;
        for (i, unit) in self.units.iter_mut().enumerate() {
            *unit = match self.entries[i * n + i].magnitude() {
                0.0 => 1.0,
                size => size.sqrt(),
            };
        }
        for k in 0..n {
            let size = |row: &usize| self.entries[row * n + k].magnitude() / self.units[*row];
            let best = (k..n).max_by(|a, b| size(a).total_cmp(&size(b)));
            let best = best.unwrap_or(k);
            self.pivots[k] = best;
            if best != k {
                (0..n).for_each(|j| self.entries.swap(k * n + j, best * n + j));
                self.units.swap(k, best);
            }
            for row in k + 1..n {
                let factor = self.entries[row * n + k] / self.entries[k * n + k];
                self.entries[row * n + k] = factor;
                for j in k + 1..n {
                    let above = self.entries[k * n + j];
                    self.entries[row * n + j] -= factor * above;
                }
            }
        }
    }

    /// Replaces `x` by the solution with it as the right-hand side; of a scalar over which the matrix is constant.
    pub(crate) fn solve<T: Scalar<Real = S>>(&self, x: &mut [T]) {
        let n = self.n;
        let entry = |i: usize, j: usize| T::from_real(self.entries[i * n + j]);
        for k in 0..n {
            x.swap(k, self.pivots[k]);
        }
        for i in 0..n {
            x[i] = (0..i).fold(x[i], |sum, j| sum - entry(i, j) * x[j]);
        }
        for i in (0..n).rev() {
            let known = (i + 1..n).fold(x[i], |sum, j| sum - entry(i, j) * x[j]);
            x[i] = known / entry(i, i);
        }
    }
}

impl Elimination<f64> {
    /// The matrix, before it is factorised.
    pub(crate) fn square(&self) -> Square {
        Square::new(self.n, self.entries.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_needs_pivoting_and_is_not_finite_on_the_singular() {
        let mut system = Elimination::new(3);
        let mut solve = |rows: [[f64; 3]; 3]| {
            for (i, row) in rows.iter().enumerate() {
                (0..3).for_each(|j| system.set(i, j, row[j]));
            }
            let mut x = [7.0_f64, 1.0, 15.0];
            system.factorise();
            system.solve(&mut x);
            x
        };
        let x = solve([[0.0, 2.0, 1.0], [1.0, 0.0, 0.0], [3.0, 0.0, 4.0]]);
        let expected = [1.0, 2.0, 3.0];
        assert!(x.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15));
        let x = solve([[0.0, 2.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 4.0]]);
        assert!(x.iter().any(|x| !x.is_finite()));
    }
}
