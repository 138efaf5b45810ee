//! Sparse linear systems whose rows need no exchange: those near a symmetric positive matrix.

use std::collections::BTreeSet;

/// The factors $A = L U$ of a matrix with a symmetric pattern, eliminated on the diagonal in an order that keeps them sparse.
///
/// The pattern of the factors is found once. Where a pivot is zero, the solution is not finite.
pub(crate) struct Sparse {
    /// Where each unknown has gone.
    place: Vec<usize>,
    /// Of each row in the new order: the columns before the diagonal, and after it, ascending.
    before: Vec<Vec<usize>>,
    after: Vec<Vec<usize>>,
    /// The entries of the matrix: row, column, both in the new order.
    lower: Vec<Vec<f64>>,
    upper: Vec<Vec<f64>>,
    pivots: Vec<f64>,
    diagonal: Vec<f64>,
    /// A row that is being eliminated; zero between.
    row: Vec<f64>,
}

impl Sparse {
    /// For matrices with these columns in each row, and the transposed pattern; the diagonal counts.
    pub(crate) fn new(rows: &[Vec<usize>]) -> Self {
        let order = Elimination::new(rows).order();
        let n = rows.len();
        let mut place = vec![0; n];
        for (k, (i, _)) in order.iter().enumerate() {
            place[*i] = k;
        }
        let mut before = vec![Vec::new(); n];
        let mut after = Vec::with_capacity(n);
        for (k, (_, left)) in order.iter().enumerate() {
            let mut later: Vec<usize> = left.iter().map(|j| place[*j]).collect();
            later.sort_unstable();
            later.iter().for_each(|j| before[*j].push(k));
            after.push(later);
        }
        let zeros = |rows: &[Vec<usize>]| rows.iter().map(|row| vec![0.0; row.len()]).collect();
        Self {
            lower: zeros(&before),
            upper: zeros(&after),
            pivots: vec![0.0; n],
            diagonal: vec![0.0; n],
            row: vec![0.0; n],
            place,
            before,
            after,
        }
    }

    /// What a factorisation costs, in products.
    pub(crate) fn operations(&self) -> usize {
        self.after.iter().map(|row| (1 + row.len()).pow(2)).sum()
    }

    /// Sets all entries to zero.
    pub(crate) fn clear(&mut self) {
        let parts = [&mut self.lower, &mut self.upper];
        parts.into_iter().flatten().for_each(|row| row.fill(0.0));
        self.diagonal.fill(0.0);
    }

    /// Sets an entry of the pattern.
    pub(crate) fn set(&mut self, i: usize, j: usize, x: f64) {
        let (i, j) = (self.place[i], self.place[j]);
        let (columns, entries) = match i.cmp(&j) {
            core::cmp::Ordering::Equal => return self.diagonal[i] = x,
            core::cmp::Ordering::Greater => (&self.before[i], &mut self.lower[i]),
            core::cmp::Ordering::Less => (&self.after[i], &mut self.upper[i]),
        };
        if let Ok(at) = columns.binary_search(&j) {
            entries[at] = x;
        }
    }

    /// Factorises the matrix, row by row; the entries are replaced.
    pub(crate) fn factorise(&mut self) {
        for i in 0..self.pivots.len() {
            let row = &mut self.row;
            for (j, x) in self.before[i].iter().zip(&self.lower[i]) {
                row[*j] = *x;
            }
            for (j, x) in self.after[i].iter().zip(&self.upper[i]) {
                row[*j] = *x;
            }
            row[i] = self.diagonal[i];
            for k in &self.before[i] {
                let factor = row[*k] / self.pivots[*k];
                row[*k] = factor;
                for (j, x) in self.after[*k].iter().zip(&self.upper[*k]) {
                    row[*j] -= factor * x;
                }
            }
            self.pivots[i] = core::mem::take(&mut row[i]);
            for (j, x) in self.before[i].iter().zip(&mut self.lower[i]) {
                *x = core::mem::take(&mut row[*j]);
            }
            for (j, x) in self.after[i].iter().zip(&mut self.upper[i]) {
                *x = core::mem::take(&mut row[*j]);
            }
        }
    }

    /// How many pivots are negative.
    pub(crate) fn negative_pivots(&self) -> usize {
        self.pivots.iter().filter(|x| **x < 0.0).count()
    }

    /// The pivot of an unknown, and the entry on the diagonal that it has come from.
    pub(crate) fn pivot(&self, i: usize) -> [f64; 2] {
        let i = self.place[i];
        [self.pivots[i], self.diagonal[i]]
    }

    /// Replaces `x` by the solution with it as the right-hand side.
    pub(crate) fn solve(&mut self, x: &mut [f64]) {
        let y = &mut self.row;
        for (x, place) in x.iter().zip(&self.place) {
            y[*place] = *x;
        }
        for (i, (columns, entries)) in self.before.iter().zip(&self.lower).enumerate() {
            let known = columns.iter().zip(entries).map(|(j, entry)| entry * y[*j]);
            y[i] -= known.sum::<f64>();
        }
        let rows = self.after.iter().zip(&self.upper).enumerate();
        for (i, (columns, entries)) in rows.rev() {
            let known = columns.iter().zip(entries).map(|(j, entry)| entry * y[*j]);
            y[i] = (y[i] - known.sum::<f64>()) / self.pivots[i];
        }
        for (x, place) in x.iter_mut().zip(&self.place) {
            *x = core::mem::take(&mut y[*place]);
        }
    }
}

/// Elimination on a graph: an unknown that goes leaves its neighbours joined.
struct Elimination {
    neighbours: Vec<BTreeSet<usize>>,
    /// The unknowns that are left, by how many neighbours they have.
    left: BTreeSet<(usize, usize)>,
}

impl Elimination {
    fn new(rows: &[Vec<usize>]) -> Self {
        let mut neighbours = vec![BTreeSet::new(); rows.len()];
        for (i, row) in rows.iter().enumerate() {
            for j in row.iter().filter(|j| **j != i) {
                neighbours[i].insert(*j);
                neighbours[*j].insert(i);
            }
        }
        let degrees = neighbours.iter().enumerate().map(|(i, of)| (of.len(), i));
        Self {
            left: degrees.collect(),
            neighbours,
        }
    }

    /// The unknowns in the order in which each has the fewest neighbours left, with these (W. F. Tinney, J. W. Walker, 1967).
    fn order(mut self) -> Vec<(usize, Vec<usize>)> {
        let mut order = Vec::with_capacity(self.neighbours.len());
        while let Some((_, k)) = self.left.pop_first() {
            let of_k = core::mem::take(&mut self.neighbours[k]);
            for i in &of_k {
                self.left.remove(&(self.neighbours[*i].len(), *i));
                self.neighbours[*i].remove(&k);
                let others = of_k.iter().filter(|j| *j != i);
                self.neighbours[*i].extend(others);
                self.left.insert((self.neighbours[*i].len(), *i));
            }
            order.push((k, of_k.into_iter().collect()));
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring of `n` unknowns, each tied to two others and to a common one.
    fn ring(n: usize) -> (Vec<Vec<usize>>, impl Fn(usize, usize) -> f64) {
        let mut rows: Vec<Vec<usize>> = (0..n).map(|i| vec![i, (i + 1) % n, n]).collect();
        rows.push(vec![n]);
        let entry = move |i: usize, j: usize| {
            if i == j {
                4.0 + n as f64 * f64::from(u8::from(i == n))
            } else {
                0.3 * (3.0 * i as f64 - 2.0 * j as f64).sin() - 0.5
            }
        };
        (rows, entry)
    }

    #[test]
    fn it_solves() {
        let (rows, entry) = ring(40);
        let mut matrix = Sparse::new(&rows);
        matrix.clear();
        let exact: Vec<f64> = (0..41).map(|i| f64::from(i).cos()).collect();
        let mut x = vec![0.0; 41];
        let mut put = |i: usize, j: usize| {
            matrix.set(i, j, entry(i, j));
            x[i] += entry(i, j) * exact[j];
        };
        for (i, row) in rows.iter().enumerate() {
            for j in row {
                put(i, *j);
                if *j != i {
                    put(*j, i);
                }
            }
        }
        matrix.factorise();
        assert_eq!(matrix.negative_pivots(), 0);
        matrix.solve(&mut x);
        let off = x.iter().zip(&exact).map(|(x, y)| (x - y).abs());
        assert!(off.fold(0.0, f64::max) < 1e-14);
    }

    #[test]
    fn pivots_have_the_signs_of_the_inertia() {
        let mut matrix = Sparse::new(&[vec![0, 1], vec![1, 2], vec![2]]);
        for (i, x) in [2.0, -3.0, 1.0].into_iter().enumerate() {
            matrix.set(i, i, x);
        }
        matrix.set(0, 1, 0.5);
        matrix.set(1, 0, 0.5);
        matrix.factorise();
        assert_eq!(matrix.negative_pivots(), 1);
    }

    /// Rings and trees are eliminated in proportion to their size.
    #[test]
    fn what_is_nearly_a_tree_stays_sparse() {
        let cost = |rows: &[Vec<usize>]| Sparse::new(rows).operations();
        let tree = |n: usize| -> Vec<Vec<usize>> { (0..n).map(|i| vec![i, i / 2]).collect() };
        let circle =
            |n: usize| -> Vec<Vec<usize>> { (0..n).map(|i| vec![i, (i + 1) % n]).collect() };
        assert!(cost(&tree(1000)) <= 4 * 1000);
        assert!(cost(&circle(1000)) <= 9 * 1000);
    }
}
