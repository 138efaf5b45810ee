//! The solution with a symmetric matrix, written on a graph.

use std::collections::BTreeMap;

use trace::{Binary, Graph, Id, Pattern};

/// The lower triangle of a sparse symmetric matrix, by rows and columns.
type Triangle = BTreeMap<(usize, usize), Id>;

/// The solution of $H x = b$ by $H = L D L^T$ without exchanges of rows.
///
/// Where a pivot is not positive, so that $H$ is no inertia, the solution is not a number.
pub(super) fn solve(graph: &mut Graph, (pattern, entries): (&Pattern, &[Id]), b: &[Id]) -> Vec<Id> {
    let (n, mut h) = (b.len(), lower(pattern, entries));
    let mut x = b.to_vec();
    let pivots: Vec<Id> = (0..n)
        .map(|k| eliminate(graph, &mut h, &mut x, k))
        .collect();
    for k in (0..n).rev() {
        x[k] = graph.binary(Binary::Div, x[k], pivots[k]);
        for i in k + 1..n {
            if let Some(factor) = h.get(&(i, k)) {
                x[k] = graph.neg_mul_add([*factor, x[i], x[k]]);
            }
        }
    }
    x
}

fn lower(pattern: &Pattern, entries: &[Id]) -> Triangle {
    let row = |i: usize| pattern.row(i).iter().map(move |j| (i, *j));
    let places = (0..pattern.rows()).flat_map(row).zip(entries);
    places
        .filter(|((i, j), _)| j <= i)
        .map(|(at, id)| (at, *id))
        .collect()
}

/// Leaves the factors of column `k` in its place, and gives its pivot.
fn eliminate(graph: &mut Graph, h: &mut Triangle, x: &mut [Id], k: usize) -> Id {
    let (zero, none) = (graph.constant(0.0), graph.constant(f64::NAN));
    let pivot = h.get(&(k, k)).copied().unwrap_or(none);
    let pivot = graph.select([zero, pivot], pivot, none);
    let column: Vec<(usize, Id)> = (k + 1..x.len())
        .filter_map(|i| Some((i, *h.get(&(i, k))?)))
        .collect();
    for (i, entry) in &column {
        let factor = graph.binary(Binary::Div, *entry, pivot);
        x[*i] = graph.neg_mul_add([factor, x[k], x[*i]]);
        for (j, above) in column.iter().filter(|(j, _)| j <= i) {
            let old = h.get(&(*i, *j)).copied();
            let old = old.unwrap_or_else(|| graph.constant(0.0));
            h.insert((*i, *j), graph.neg_mul_add([factor, *above, old]));
        }
        h.insert((*i, k), factor);
    }
    pivot
}
