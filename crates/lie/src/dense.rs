//! Generic fall-backs for a group that gives no closed form: transposes by pairing, series, small solves.

use num_traits::{One, Zero};

use crate::{LieGroup, Scalar, VectorSpace};

/// Terms of the series of $\mathrm d\exp$: $(2\pi)^{40}/41! < 10^{-17}$.
const DEXP_TERMS: u32 = 40;

/// The $\nu$ with $\langle \nu, e_i \rangle = \langle \mu, A e_i \rangle$ for the basis $e_i$ of the algebra.
pub(crate) fn transpose_by_pairing<G: LieGroup>(
    mu: &G::Dual,
    shape: &G::Algebra,
    map: impl Fn(&G::Algebra) -> G::Algebra,
) -> G::Dual {
    let mut nu = mu.zero_like();
    for i in 0..mu.dim() {
        nu.set(i, G::pair(mu, &map(&basis(shape, i))));
    }
    nu
}

/// $\sum_k \frac{(-1)^k}{(k+1)!} \mathrm{ad}_\xi^k \eta$.
pub(crate) fn dexp_series<G: LieGroup>(xi: &G::Algebra, eta: &G::Algebra) -> G::Algebra {
    let (mut sum, mut term) = (eta.clone(), eta.clone());
    for k in 1..DEXP_TERMS {
        let next = G::bracket(xi, &term);
        term.set_zero();
        term.add_scaled(G::Scalar::from_f64(-1.0 / f64::from(k + 1)), &next);
        sum.add_scaled(G::Scalar::one(), &term);
    }
    sum
}

/// The $x$ with $A x = b$, by Gauss–Jordan elimination with row pivoting; not finite where $A$ is singular.
pub(crate) fn solve<G: LieGroup>(
    b: &G::Algebra,
    map: impl Fn(&G::Algebra) -> G::Algebra,
) -> G::Algebra {
    let n = b.dim();
    let columns: Vec<_> = (0..n).map(|j| map(&basis(b, j))).collect();
    let mut rows: Vec<Vec<G::Scalar>> = (0..n)
        .map(|i| columns.iter().chain([b]).map(|c| c.get(i)).collect())
        .collect();
    for k in 0..n {
        let size = |row: &Vec<G::Scalar>| row[k].magnitude();
        let pivot = (k..n).max_by(|&i, &j| size(&rows[i]).total_cmp(&size(&rows[j])));
        rows.swap(k, pivot.unwrap_or(k));
        let head: Vec<_> = rows[k].iter().map(|&x| x / rows[k][k]).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = if i == k { G::Scalar::zero() } else { row[k] };
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
