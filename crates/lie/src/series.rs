//! Power series in $\mathrm{ad}_\xi$, cut off or summed.

use core::array::from_fn;

use num_traits::One;

use crate::{Scalar, VectorSpace};

/// Terms of the series of $\mathrm d\exp$: $(2\pi)^{40}/41! < 10^{-17}$.
const TERMS: usize = 39;

/// The coefficients $\frac{(-1)^k}{(k+1)!}$ of $\mathrm d\exp$, from $k = 1$.
pub(crate) fn exponential<S: Scalar>() -> [S; TERMS] {
    let mut a = 1.0;
    from_fn(|k| {
        a /= -(k as f64 + 2.0);
        S::from_f64(a)
    })
}

/// $\eta + \sum_{k \ge 1} a_k \mathrm{ad}_\xi^k \eta$ of the map $\mathrm{ad}_\xi$; with $\mathrm{ad}_\xi^\ast$, the transpose of that.
#[inline(always)]
pub(crate) fn polynomial<V: VectorSpace>(eta: &V, a: &[V::Scalar], ad: impl Fn(&V) -> V) -> V {
    let (mut sum, mut term) = (eta.clone(), eta.clone());
    for a in a {
        term = ad(&term);
        sum.add_scaled(*a, &term);
    }
    sum
}

/// The gradients of $\langle \mu, \eta + \sum_k a_k \mathrm{ad}_\xi^k \eta\rangle$: in $\xi$ with the $a_k$ fixed, and in
/// the $a_k$.
///
/// Backwards through the terms $t_k = \mathrm{ad}_\xi t_{k-1}$: the sum is $\langle \lambda_k, t_k\rangle$ plus terms before
/// $t_k$, with $\lambda_k = a_k \mu + \mathrm{ad}^\ast_\xi \lambda_{k+1}$. Each $t_k$ adds
/// $-\mathrm{ad}^\ast_{t_{k-1}} \lambda_k$ to the gradient. The maps are the bracket, its dual and the pairing.
#[inline(always)]
pub(crate) fn polynomial_gradient<
    A: VectorSpace,
    D: VectorSpace<Scalar = A::Scalar>,
    const K: usize,
>(
    (xi, mu, eta): (&A, &D, &A),
    a: &[A::Scalar; K],
    (ad, coad, pair): (
        impl Fn(&A, &A) -> A,
        impl Fn(&A, &D) -> D,
        impl Fn(&D, &A) -> A::Scalar,
    ),
) -> (D, [A::Scalar; K]) {
    let (mut term, mut in_a) = (eta.clone(), [A::Scalar::from_f64(0.0); K]);
    let before: [_; K] = from_fn(|k| {
        let next = ad(xi, &term);
        in_a[k] = pair(mu, &next);
        core::mem::replace(&mut term, next)
    });
    let (mut in_xi, mut lambda) = (mu.zero_like(), mu.zero_like());
    for (a, before) in a.iter().zip(&before).rev() {
        lambda = coad(xi, &lambda);
        lambda.add_scaled(*a, mu);
        in_xi.add_scaled(-A::Scalar::one(), &coad(before, &lambda));
    }
    (in_xi, in_a)
}
