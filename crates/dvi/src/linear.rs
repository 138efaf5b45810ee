//! Dense linear systems of run-time size, solved in place by `faer`.

use core::ops::Range;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{Mat, MatMut, Par, Spec};

/// A square matrix, its LU factorisation with partial pivoting, and a right-hand side.
///
/// A singular matrix is not an error here: the solution is then not finite, and the iteration sees that.
pub(crate) struct Factorisation {
    matrix: Mat<f64>,
    factors: Mat<f64>,
    forward: Vec<usize>,
    inverse: Vec<usize>,
    swaps: usize,
    rhs: Vec<f64>,
    memory: MemBuffer,
}

impl Factorisation {
    pub(crate) fn new(n: usize) -> Self {
        let factor = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Spec::default());
        let solve = solve::solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq);
        Self {
            matrix: Mat::zeros(n, n),
            factors: Mat::zeros(n, n),
            forward: vec![0; n],
            inverse: vec![0; n],
            swaps: 0,
            rhs: vec![0.0; n],
            memory: MemBuffer::new(factor.or(solve)),
        }
    }

    pub(crate) fn set(&mut self, row: usize, column: usize, value: f64) {
        self.matrix[(row, column)] = value;
    }

    /// Takes over the block of `whole` in these rows and columns.
    pub(crate) fn copy_block(&mut self, whole: &Self, block: Range<usize>) {
        for (j, column) in block.clone().enumerate() {
            for (i, row) in block.clone().enumerate() {
                self.matrix[(i, j)] = whole.matrix[(row, column)];
            }
        }
    }

    pub(crate) fn factorise(&mut self) {
        self.factors.copy_from(&self.matrix);
        let (info, _) = factor::lu_in_place(
            self.factors.as_mut(),
            &mut self.forward,
            &mut self.inverse,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::default(),
        );
        self.swaps = info.transposition_count;
    }

    /// Whether a pivot is rounding beside its row, or not a number.
    pub(crate) fn is_singular(&self) -> bool {
        /// Roundings that elimination may leave in place of a zero.
        const ROUNDING: f64 = 100.0 * f64::EPSILON;
        let n = self.rhs.len();
        let largest = |row: usize| {
            let sizes = (0..n).map(|column| self.matrix[(self.forward[row], column)].abs());
            sizes.fold(0.0, f64::max)
        };
        (0..n).any(|i| {
            self.factors[(i, i)].abs().is_nan()
                || self.factors[(i, i)].abs() <= ROUNDING * largest(i)
        })
    }

    /// Whether the determinant is negative.
    pub(crate) fn turns_over(&self) -> bool {
        let n = self.rhs.len();
        let negative = (0..n).filter(|i| self.factors[(*i, *i)] < 0.0).count();
        (negative + self.swaps) % 2 == 1
    }

    /// How many pivots are negative as the matrix whose columns `map` makes of this one's is eliminated without exchanges: as many as
    /// eigenvalues where it is symmetric (J. J. Sylvester). The factors are lost.
    pub(crate) fn index(&mut self, mut map: impl FnMut(&[f64], &mut [f64])) -> usize {
        let (n, a) = (self.rhs.len(), &mut self.factors);
        (0..n).for_each(|j| map(self.matrix.col_as_slice(j), a.col_as_slice_mut(j)));
        for k in 0..n {
            for j in k + 1..n {
                let factor = a[(k, j)] / a[(k, k)];
                for i in k + 1..n {
                    a[(i, j)] -= factor * a[(i, k)];
                }
            }
        }
        (0..n).filter(|i| a[(*i, *i)] < 0.0).count()
    }

    pub(crate) fn right_hand_side(&mut self) -> &mut [f64] {
        &mut self.rhs
    }

    /// Replaces the right-hand side by the solution.
    pub(crate) fn solve(&mut self) -> &[f64] {
        let n = self.rhs.len();
        let permutation = PermRef::new_checked(&self.forward, &self.inverse, n);
        solve::solve_in_place(
            self.factors.as_ref(),
            self.factors.as_ref(),
            permutation,
            MatMut::from_column_major_slice_mut(&mut self.rhs, n, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
        &self.rhs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_needs_pivoting_and_does_not_panic_on_the_singular() {
        let mut system = Factorisation::new(3);
        let rows = [[0.0, 2.0, 1.0], [1.0, 0.0, 0.0], [3.0, 0.0, 4.0]];
        for (i, row) in rows.iter().enumerate() {
            row.iter()
                .enumerate()
                .for_each(|(j, x)| system.set(i, j, *x));
        }
        system.factorise();
        system.right_hand_side().copy_from_slice(&[7.0, 1.0, 15.0]);
        assert_eq!(system.solve(), [1.0, 2.0, 3.0]);
        // The determinant is -8.
        assert!(system.turns_over());
        system.set(1, 0, 0.0);
        system.set(2, 0, 0.0);
        system.factorise();
        system.right_hand_side().copy_from_slice(&[7.0, 1.0, 15.0]);
        assert!(system.solve().iter().any(|x| !x.is_finite()));
    }
}
