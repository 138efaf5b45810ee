//! The solution with a symmetric matrix, written on a graph.

use std::collections::BTreeMap;

use trace::{Binary, Graph, Id, Pattern};

/// A column of the lower triangle of a sparse symmetric matrix, by rows.
type Column = BTreeMap<usize, Id>;

/// The solution of $H x = b$, and the pivots that it divides by.
pub(super) struct Solution {
    pub(super) x: Vec<Id>,
    /// The pivots before their signs are looked at.
    pub(super) pivots: Vec<Id>,
    /// The entries of $H$ on the diagonal.
    pub(super) diagonal: Vec<Id>,
}

/// The solution of $H x = b$ by $H = L D L^T$ without exchanges of rows; none where that takes more operations than `limit`.
///
/// Where a pivot is not positive, so that $H$ is no inertia, the solution is not a number.
pub(super) fn solve(
    graph: &mut Graph,
    (pattern, entries): (&Pattern, &[Id]),
    b: &[Id],
    limit: usize,
) -> Option<Solution> {
    let mut columns = lower(pattern, entries);
    let zero = graph.constant(0.0);
    let on_diagonal = |(k, column): (usize, &Column)| column.get(&k).copied().unwrap_or(zero);
    let diagonal: Vec<Id> = columns.iter().enumerate().map(on_diagonal).collect();
    let (mut x, mut operations) = (b.to_vec(), 0);
    let (mut pivots, mut divisors) = (Vec::new(), Vec::new());
    for k in 0..x.len() {
        let below = columns[k].len();
        operations += below * below / 2;
        if operations > limit {
            return None;
        }
        let (pivot, divisor) = eliminate(graph, &mut columns, &mut x, k);
        pivots.push(pivot);
        divisors.push(divisor);
    }
    for k in (0..x.len()).rev() {
        x[k] = graph.binary(Binary::Div, x[k], divisors[k]);
        for (i, factor) in columns[k].range(k + 1..) {
            x[k] = graph.neg_mul_add([*factor, x[*i], x[k]]);
        }
    }
    Some(Solution {
        x,
        pivots,
        diagonal,
    })
}

fn lower(pattern: &Pattern, entries: &[Id]) -> Vec<Column> {
    let mut columns = vec![Column::new(); pattern.rows()];
    let row = |i: usize| pattern.row(i).iter().map(move |j| (i, *j));
    let places = (0..pattern.rows()).flat_map(row).zip(entries);
    for ((i, j), id) in places.filter(|((i, j), _)| j <= i) {
        columns[j].insert(i, *id);
    }
    columns
}

/// Leaves the factors of column `k` in its place, and gives its pivot; as it is, and as what is divided by.
fn eliminate(graph: &mut Graph, columns: &mut [Column], x: &mut [Id], k: usize) -> (Id, Id) {
    let (zero, none) = (graph.constant(0.0), graph.constant(f64::NAN));
    let pivot = columns[k].get(&k).copied().unwrap_or(zero);
    let divisor = graph.select([zero, pivot], pivot, none);
    let column: Vec<(usize, Id)> = columns[k].range(k + 1..).map(|(i, x)| (*i, *x)).collect();
    for (i, entry) in &column {
        let factor = graph.binary(Binary::Div, *entry, divisor);
        x[*i] = graph.neg_mul_add([factor, x[k], x[*i]]);
        for (j, above) in column.iter().filter(|(j, _)| j <= i) {
            let old = columns[*j].get(i).copied().unwrap_or(zero);
            columns[*j].insert(*i, graph.neg_mul_add([factor, *above, old]));
        }
        columns[k].insert(*i, factor);
    }
    (pivot, divisor)
}
