//! Dense linear systems of run-time size, solved in place by `faer`.

use core::ops::Range;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{Mat, MatMut, Par, Spec};

use super::degenerate::Square;
use super::numbers::{exponent, power_of_two};

/// A square matrix, its LU factorisation with partial pivoting, and a right-hand side.
///
/// A singular matrix is not an error here: the solution is then not finite, and the iteration sees that.
pub(crate) struct Factorisation {
    matrix: Mat<f64>,
    factors: Mat<f64>,
    forward: Vec<usize>,
    inverse: Vec<usize>,
    swaps: usize,
    /// Powers of two that rows and columns are multiplied by.
    scales: [Vec<f64>; 2],
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
            scales: [vec![1.0; n], vec![1.0; n]],
            rhs: vec![0.0; n],
            memory: MemBuffer::new(factor.or(solve)),
        }
    }

    pub(crate) fn set(&mut self, row: usize, column: usize, value: f64) {
        self.matrix[(row, column)] = value;
    }

    /// The matrix, row by row.
    pub(crate) fn square(&self) -> Square {
        let n = self.rhs.len();
        let entries = (0..n * n).map(|k| self.matrix[(k / n, k % n)]);
        Square::new(n, entries.collect())
    }

    /// Takes over the block of `whole` in these rows and columns.
    pub(crate) fn copy_block(&mut self, whole: &Self, block: Range<usize>) {
        for (j, column) in block.clone().enumerate() {
            for (i, row) in block.clone().enumerate() {
                self.matrix[(i, j)] = whole.matrix[(row, column)];
            }
        }
    }

    /// Factorises a matrix from a vector space to its dual: its diagonal tells the units of the coordinates.
    ///
    /// The pivots are chosen among numbers that do not depend on the units, so neither does the solution, by powers of two not even its bits.
    pub(crate) fn factorise(&mut self) {
        let n = self.rhs.len();
        let first = (0..n).find_map(|i| exponent(self.matrix[(i, i)]));
        let first = first.unwrap_or(0);
        for i in 0..n {
            // The difference is twice that of the units: halved exactly.
            let of_row = exponent(self.matrix[(i, i)]).unwrap_or(first);
            let scale = power_of_two(-(of_row - first).div_euclid(2));
            self.scales.iter_mut().for_each(|s| s[i] = scale);
        }
        self.factorise_scaled();
    }

    /// Factorises a matrix from a space of vectors of these sizes to itself.
    pub(crate) fn factorise_map(&mut self, sizes: impl Iterator<Item = f64>) {
        for (i, size) in sizes.enumerate() {
            let exponent = exponent(size).unwrap_or(0);
            self.scales[0][i] = power_of_two(-exponent);
            self.scales[1][i] = power_of_two(exponent);
        }
        self.factorise_scaled();
    }

    fn factorise_scaled(&mut self) {
        let [rows, columns] = &self.scales;
        for (j, column) in columns.iter().enumerate() {
            let (to, from) = (
                self.factors.col_as_slice_mut(j),
                self.matrix.col_as_slice(j),
            );
            for ((to, from), row) in to.iter_mut().zip(from).zip(rows) {
                *to = from * row * column;
            }
        }
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
        let [rows, columns] = &self.scales;
        let scale = |x: &mut [f64], scales: &[f64]| {
            x.iter_mut().zip(scales).for_each(|(x, scale)| *x *= scale);
        };
        scale(&mut self.rhs, rows);
        let permutation = PermRef::new_checked(&self.forward, &self.inverse, n);
        solve::solve_in_place(
            self.factors.as_ref(),
            self.factors.as_ref(),
            permutation,
            MatMut::from_column_major_slice_mut(&mut self.rhs, n, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
        scale(&mut self.rhs, columns);
        &self.rhs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_units_of_the_coordinates_do_not_change_a_bit() {
        let matrix = [[2.0, -3.0, 0.1], [0.7, 1e-3, 5.0], [-1.3, 0.2, 0.3]];
        let solve = |units: [f64; 3]| {
            let mut system = Factorisation::new(3);
            for (i, row) in matrix.iter().enumerate() {
                (0..3).for_each(|j| system.set(i, j, row[j] * units[i] * units[j]));
            }
            system.factorise();
            let rhs = [1.0, 2.0, -0.3];
            (0..3).for_each(|i| system.right_hand_side()[i] = rhs[i] * units[i]);
            let x = system.solve();
            [0, 1, 2].map(|i| x[i] * units[i])
        };
        let expected = solve([1.0; 3]);
        for units in [
            [1.0, 1.0, 1024.0],
            [0.125, 4.0, 1.0],
            [2.0_f64.powi(40), 0.5, 1.0],
        ] {
            assert_eq!(solve(units), expected, "{units:?}");
        }
    }

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
