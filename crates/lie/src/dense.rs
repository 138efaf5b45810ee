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
        term = next_term::<G>(xi, k, &term);
        sum.add_scaled(G::Scalar::one(), &term);
    }
    sum
}

/// The gradient in $\xi$ of $\langle \mu, \mathrm d\exp_\xi^{-1} \eta\rangle$: that of
/// $-\langle \nu, \mathrm d\exp_\xi \zeta\rangle$ with $\nu = (\mathrm d\exp_\xi^{-1})^\ast \mu$ and
/// $\zeta = \mathrm d\exp_\xi^{-1} \eta$ fixed.
///
/// Backwards through the terms $t_k = -\frac{1}{k+1} [\xi, t_{k-1}]$ of the series: the sum is
/// $\langle \lambda_k, t_k\rangle$ plus terms before $t_k$, so that $\lambda_{k-1} = \nu - \frac{1}{k+1}
/// \mathrm{ad}^\ast_\xi \lambda_k$, and $t_k$ adds $\frac{1}{k+1} \mathrm{ad}^\ast_{t_{k-1}} \lambda_k$.
pub(crate) fn dexp_inv_gradient<G: LieGroup>(
    xi: &G::Algebra,
    mu: &G::Dual,
    eta: &G::Algebra,
) -> G::Dual {
    let (nu, zeta) = (G::dexp_inv_dual(xi, mu), G::dexp_inv(xi, eta));
    let mut terms = vec![zeta];
    for k in 1..DEXP_TERMS {
        terms.extend(terms.last().map(|term| next_term::<G>(xi, k, term)));
    }
    let (mut gradient, mut lambda) = (mu.zero_like(), nu.clone());
    for (k, before) in (1..DEXP_TERMS).zip(&terms).rev() {
        let factor = term_factor(k);
        gradient.add_scaled(factor, &G::coadjoint_bracket(before, &lambda));
        lambda.set_sum(&nu, factor, &G::coadjoint_bracket(xi, &lambda));
    }
    gradient
}

/// $t_k = -\frac{1}{k+1} [\xi, t_{k-1}]$.
fn next_term<G: LieGroup>(xi: &G::Algebra, k: u32, before: &G::Algebra) -> G::Algebra {
    let mut term = before.zero_like();
    term.add_scaled(term_factor(k), &G::bracket(xi, before));
    term
}

fn term_factor<S: Scalar>(k: u32) -> S {
    S::from_f64(-1.0 / f64::from(k + 1))
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
