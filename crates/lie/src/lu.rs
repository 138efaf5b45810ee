//! Dense linear systems over any scalar.

use crate::Scalar;

/// A square matrix of run-time size, and its factors $P A = L U$ by Gauss elimination with row exchanges.
///
/// Nothing allocates but [`new`](Self::new) and `clone`. A singular matrix is no error here: a solution is then not finite.
///
/// ```
/// use lie::Lu;
///
/// let mut matrix = Lu::new(2);
/// matrix.column_mut(0).copy_from_slice(&[0.0, 2.0]);
/// matrix.column_mut(1).copy_from_slice(&[1.0, 3.0]);
/// matrix.factorise(|_, _| 1.0);
/// let mut x = [1.0, 5.0];
/// matrix.solve(&mut x, |entry: f64| entry);
/// assert_eq!(x, [1.0, 1.0]);
/// ```
#[derive(Clone, Debug)]
pub struct Lu<S> {
    n: usize,
    /// Column by column: the matrix, then $L$ below the diagonal and $U$ above.
    entries: Vec<S>,
    /// The row that each was exchanged with.
    exchanges: Vec<usize>,
    /// What the rows are relative to.
    units: Vec<f64>,
}

impl<S: Scalar> Lu<S> {
    /// The zero matrix of `n` rows.
    pub fn new(n: usize) -> Self {
        Self {
            n,
            entries: vec![S::zero(); n * n],
            exchanges: vec![0; n],
            units: vec![1.0; n],
        }
    }

    /// The number of rows.
    pub fn dim(&self) -> usize {
        self.n
    }

    /// An entry of the matrix, or of its factors.
    #[inline(always)]
    pub fn at(&self, row: usize, column: usize) -> S {
        self.entries[column * self.n + row]
    }

    /// A column of the matrix; to be set, all of them, before it is factorised again.
    #[inline(always)]
    pub fn column_mut(&mut self, j: usize) -> &mut [S] {
        &mut self.entries[j * self.n..][..self.n]
    }

    /// The columns from `first` on.
    pub fn columns_mut(&mut self, first: usize) -> impl Iterator<Item = &mut [S]> {
        self.entries[first * self.n..].chunks_exact_mut(self.n.max(1))
    }

    /// Factorises the matrix, with the largest pivots relative to the unit of each row.
    ///
    /// `unit` is called with a row's index and its entry on the diagonal; zero counts as one. Rows of different units are exchanged as
    /// if they were of the same.
    pub fn factorise(&mut self, unit: impl Fn(usize, S) -> f64) {
        for i in 0..self.n {
            let unit = unit(i, self.at(i, i));
            self.units[i] = if unit == 0.0 { 1.0 } else { unit };
        }
        self.factorise_by(|this, k| {
            let size = |row: &usize| this.at(*row, k).magnitude() / this.units[*row];
            let best = (k..this.n).max_by(|a, b| size(a).total_cmp(&size(b)));
            best.unwrap_or(k)
        });
    }

    /// The same for a matrix from a vector space to its dual: the roots of its diagonal are the units.
    pub fn factorise_form(&mut self) {
        self.factorise(|_, diagonal| diagonal.magnitude().sqrt());
    }

    /// Factorises the matrix, where `choose` says which row, not above it, is exchanged with row `k` of what is left.
    pub fn factorise_by(&mut self, choose: impl Fn(&Self, usize) -> usize) {
        let n = self.n;
        for k in 0..n {
            let pivot = choose(self, k);
            self.exchanges[k] = pivot;
            if pivot != k {
                (0..n).for_each(|j| self.entries.swap(j * n + k, j * n + pivot));
                self.units.swap(k, pivot);
            }
            let (done, rest) = self.entries.split_at_mut((k + 1) * n);
            let column = &mut done[k * n + k..];
            let (diagonal, below) = (column[0], &mut column[1..]);
            below.iter_mut().for_each(|x| *x /= diagonal);
            for right in rest.chunks_exact_mut(n) {
                let (above, right) = (right[k], &mut right[k + 1..]);
                for (x, factor) in right.iter_mut().zip(&*below) {
                    *x -= *factor * above;
                }
            }
        }
    }

    /// The row that each was exchanged with.
    pub fn exchanges(&self) -> &[usize] {
        &self.exchanges
    }

    /// Replaces `x` by the solution with it as the right-hand side; `lift` takes an entry to the scalar of `x`.
    pub fn solve<T: Scalar>(&self, x: &mut [T], lift: impl Fn(S) -> T) {
        let n = self.n.max(1);
        for (k, row) in self.exchanges.iter().enumerate() {
            x.swap(k, *row);
        }
        for (k, column) in self.entries.chunks_exact(n).enumerate() {
            let known = x[k];
            for (x, entry) in x[k + 1..].iter_mut().zip(&column[k + 1..]) {
                *x -= lift(*entry) * known;
            }
        }
        for (k, column) in self.entries.chunks_exact(n).enumerate().rev() {
            let known = x[k] / lift(column[k]);
            x[k] = known;
            for (x, entry) in x[..k].iter_mut().zip(column) {
                *x -= lift(*entry) * known;
            }
        }
    }
}

impl Lu<f64> {
    /// How many pivots are negative; without exchanges, as many as eigenvalues where the matrix is symmetric (J. J. Sylvester).
    pub fn negative_pivots(&self) -> usize {
        (0..self.n).filter(|k| self.at(*k, *k) < 0.0).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(rows: [[f64; 3]; 3]) -> Lu<f64> {
        let mut matrix = Lu::new(3);
        for j in 0..3 {
            matrix
                .column_mut(j)
                .copy_from_slice(&rows.map(|row| row[j]));
        }
        matrix
    }

    #[test]
    fn solves_what_needs_pivoting_and_is_not_finite_on_the_singular() {
        let solve = |rows| {
            let (mut system, mut x) = (matrix(rows), [7.0, 1.0, 15.0]);
            system.factorise_form();
            system.solve(&mut x, |entry: f64| entry);
            x
        };
        let x = solve([[0.0, 2.0, 1.0], [1.0, 0.0, 0.0], [3.0, 0.0, 4.0]]);
        assert_eq!(x, [1.0, 2.0, 3.0]);
        for singular in [
            [[0.0, 2.0, 1.0], [0.0, 0.0, 0.0], [3.0, 0.0, 4.0]],
            [[0.0, 2.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 4.0]],
        ] {
            assert!(solve(singular).iter().any(|x| !x.is_finite()));
        }
    }

    #[test]
    fn the_units_of_the_coordinates_do_not_change_a_bit() {
        let rows = [[2.0, -3.0, 0.1], [0.7, 1e-3, 5.0], [-1.3, 0.2, 0.3]];
        let (far, rhs) = (2.0_f64.powi(40), [1.0, 2.0, -0.3]);
        let solve = |units: [f64; 3]| {
            let form = [0, 1, 2].map(|i| [0, 1, 2].map(|j| rows[i][j] * units[i] * units[j]));
            let (mut system, mut x) = (matrix(form), [0, 1, 2].map(|i| rhs[i] * units[i]));
            system.factorise_form();
            system.solve(&mut x, |entry: f64| entry);
            [0, 1, 2].map(|i| x[i] * units[i])
        };
        let expected = solve([1.0; 3]);
        for units in [[1.0, 1.0, 1024.0], [0.125, 4.0, 1.0], [far, 0.5, 1.0]] {
            assert_eq!(solve(units), expected, "{units:?}");
        }
    }

    #[test]
    fn signs_are_those_of_the_eigenvalues() {
        // Of this one, about -1.0, 1.4 and 3.7.
        let mut form = matrix([[1.0, 2.0, 0.5], [2.0, 1.0, 1.0], [0.5, 1.0, 2.0]]);
        form.factorise_by(|_, k| k);
        assert_eq!(form.negative_pivots(), 1);
    }
}
