//! Small dense systems over any scalar.

use lie::Scalar;

/// A square matrix with a right-hand side, solved by Gauss elimination with row pivoting.
///
/// A singular matrix is not an error here: the solution is then not finite.
pub(crate) struct Elimination<S> {
    n: usize,
    /// Row by row; lost in a solve.
    entries: Vec<S>,
    rhs: Vec<S>,
}

impl<S: Scalar> Elimination<S> {
    pub(crate) fn new(n: usize) -> Self {
        Self {
            n,
            entries: vec![S::zero(); n * n],
            rhs: vec![S::zero(); n],
        }
    }

    pub(crate) fn set(&mut self, row: usize, column: usize, value: S) {
        self.entries[row * self.n + column] = value;
    }

    pub(crate) fn right_hand_side(&mut self) -> &mut [S] {
        &mut self.rhs
    }

    /// Replaces the right-hand side by the solution.
    pub(crate) fn solve(&mut self) -> &[S] {
        for k in 0..self.n {
            self.pivot(k);
            for row in k + 1..self.n {
                self.eliminate(row, k);
            }
        }
        for k in (0..self.n).rev() {
            let known = (k + 1..self.n).fold(self.rhs[k], |sum, j| {
                sum - self.entries[k * self.n + j] * self.rhs[j]
            });
            self.rhs[k] = known / self.entries[k * self.n + k];
        }
        &self.rhs
    }

    /// Brings the row with the largest entry of column `k` to the diagonal.
    fn pivot(&mut self, k: usize) {
        let n = self.n;
        let size = |row: &usize| self.entries[row * n + k].magnitude();
        let best = (k..n).max_by(|a, b| size(a).total_cmp(&size(b)));
        let best = best.unwrap_or(k);
        if best != k {
            (0..n).for_each(|j| self.entries.swap(k * n + j, best * n + j));
            self.rhs.swap(k, best);
        }
    }

    fn eliminate(&mut self, row: usize, k: usize) {
        let n = self.n;
        let factor = self.entries[row * n + k] / self.entries[k * n + k];
        for j in k + 1..n {
            let above = self.entries[k * n + j];
            self.entries[row * n + j] -= factor * above;
        }
        let above = self.rhs[k];
        self.rhs[row] -= factor * above;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_needs_pivoting_and_is_not_finite_on_the_singular() {
        let mut system = Elimination::new(3);
        let fill = |system: &mut Elimination<f64>, rows: [[f64; 3]; 3]| {
            for (i, row) in rows.iter().enumerate() {
                (0..3).for_each(|j| system.set(i, j, row[j]));
            }
            system.right_hand_side().copy_from_slice(&[7.0, 1.0, 15.0]);
        };
        fill(
            &mut system,
            [[0.0, 2.0, 1.0], [1.0, 0.0, 0.0], [3.0, 0.0, 4.0]],
        );
        assert_eq!(system.solve(), [1.0, 2.0, 3.0]);
        fill(
            &mut system,
            [[0.0, 2.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 4.0]],
        );
        assert!(system.solve().iter().any(|x| !x.is_finite()));
    }
}
