//! Generic fall-backs for a group that gives no closed form: transposes by pairing, small solves.

use num_traits::{One, Zero};

use crate::{Scalar, VectorSpace};

/// The $\nu$ with $\langle \nu, e_i \rangle = \langle \mu, A e_i \rangle$ for the basis $e_i$ of the algebra.
pub(crate) fn transpose_by_pairing<A: VectorSpace, D: VectorSpace<Scalar = A::Scalar>>(
    mu: &D,
    shape: &A,
    pair: impl Fn(&D, &A) -> A::Scalar,
    map: impl Fn(&A) -> A,
) -> D {
    let mut nu = mu.zero_like();
    for i in 0..mu.dim() {
        nu.set(i, pair(mu, &map(&basis(shape, i))));
    }
    nu
}

/// The $x$ with $A x = b$, by Gauss–Jordan elimination with row pivoting; not finite where $A$ is singular.
pub(crate) fn solve<A: VectorSpace>(b: &A, map: impl Fn(&A) -> A) -> A {
    let n = b.dim();
    let columns: Vec<_> = (0..n).map(|j| map(&basis(b, j))).collect();
    let mut rows: Vec<Vec<A::Scalar>> = (0..n)
        .map(|i| columns.iter().chain([b]).map(|c| c.get(i)).collect())
        .collect();
    for k in 0..n {
        let size = |row: &Vec<A::Scalar>| row[k].magnitude();
        let pivot = (k..n).max_by(|&i, &j| size(&rows[i]).total_cmp(&size(&rows[j])));
        rows.swap(k, pivot.unwrap_or(k));
        let head: Vec<_> = rows[k].iter().map(|&x| x / rows[k][k]).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = if i == k { A::Scalar::zero() } else { row[k] };
            for (x, &h) in row.iter_mut().zip(&head) {
                *x = if i == k { h } else { *x - factor * h };
            }
        }
    }
    let mut x = b.zero_like();
    for (i, row) in rows.iter().enumerate() {
        x.set(i, row[n]);
    }
    x
}

/// The basis vector $e_i$ of the algebra that `shape` lies in.
pub(crate) fn basis<V: VectorSpace>(shape: &V, i: usize) -> V {
    let mut e = shape.zero_like();
    e.set(i, V::Scalar::one());
    e
}
