//! Dense linear systems of hundreds of unknowns, by `faer`: the small elimination takes five times as long at 300.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{MatMut, MatRef, Par, Spec};

use super::numbers::{exponent, power_of_two};

/// A large square matrix and its factors; as [`lie::Lu`], for doubles alone.
pub(crate) struct Large {
    n: usize,
    entries: Vec<f64>,
    /// Powers of two that rows are multiplied by.
    scales: Vec<f64>,
    /// Where the rows have gone, and back.
    rows: [Vec<usize>; 2],
    exchanges: usize,
    memory: MemBuffer,
}

impl Large {
    pub(crate) fn new(n: usize) -> Self {
        let factor = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Spec::default());
        let solve = solve::solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq);
        Self {
            n,
            entries: vec![0.0; n * n],
            scales: vec![1.0; n],
            rows: [vec![0; n], vec![0; n]],
            exchanges: 0,
            memory: MemBuffer::new(factor.or(solve)),
        }
    }

    /// The columns from `first` on.
    pub(crate) fn columns_mut(&mut self, first: usize) -> impl Iterator<Item = &mut [f64]> {
        self.entries[first * self.n..].chunks_exact_mut(self.n.max(1))
    }

    /// Factorises the matrix, with the largest pivots relative to the unit of each row.
    pub(crate) fn factorise(&mut self, unit: impl Fn(usize) -> f64) {
        for (i, scale) in self.scales.iter_mut().enumerate() {
            *scale = power_of_two(-exponent(unit(i)).unwrap_or(0));
        }
        for column in self.entries.chunks_exact_mut(self.n.max(1)) {
            multiply(column, &self.scales);
        }
        let [forward, inverse] = &mut self.rows;
        let (info, _) = factor::lu_in_place(
            MatMut::from_column_major_slice_mut(&mut self.entries, self.n, self.n),
            forward,
            inverse,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::default(),
        );
        self.exchanges = info.transposition_count;
    }

    /// Whether the determinant is negative.
    pub(crate) fn turns_over(&self) -> bool {
        let pivots = self.entries.iter().step_by(self.n + 1);
        (pivots.filter(|pivot| **pivot < 0.0).count() + self.exchanges) % 2 == 1
    }

    /// Replaces `x` by the solution with it as the right-hand side.
    pub(crate) fn solve(&mut self, x: &mut [f64]) {
        multiply(x, &self.scales);
        let [forward, inverse] = &self.rows;
        let factors = MatRef::from_column_major_slice(&self.entries, self.n, self.n);
        solve::solve_in_place(
            factors,
            factors,
            PermRef::new_checked(forward, inverse, self.n),
            MatMut::from_column_major_slice_mut(x, self.n, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }
}

fn multiply(x: &mut [f64], scales: &[f64]) {
    x.iter_mut().zip(scales).for_each(|(x, scale)| *x *= scale);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_needs_pivoting_and_does_not_panic_on_the_singular() {
        let columns = [[0.0, 1.0, 3.0], [2.0, 0.0, 0.0], [1.0, 0.0, 4.0]];
        let factorised = |columns: [[f64; 3]; 3]| {
            let mut matrix = Large::new(3);
            for (to, from) in matrix.columns_mut(0).zip(columns) {
                to.copy_from_slice(&from);
            }
            matrix.factorise(|i| [1.0, 8.0, 0.0][i]);
            matrix
        };
        let (mut matrix, mut x) = (factorised(columns), [7.0, 1.0, 15.0]);
        matrix.solve(&mut x);
        assert_eq!(x, [1.0, 2.0, 3.0]);
        // The determinant is -8.
        assert!(matrix.turns_over());
        matrix = factorised([[0.0; 3], columns[1], columns[2]]);
        matrix.solve(&mut x);
        assert!(x.iter().any(|x| !x.is_finite()));
    }
}
