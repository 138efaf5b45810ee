//! Power series in $\mathrm{ad}_\xi$, cut off or summed: the differentials of the exponential.
//!
//! [`dexp`] and [`dexp_inv_gradient`] are the defaults of [`LieGroup::d_left`] and [`LieGroup::d_left_inv_gradient`]. A
//! group that has closed forms for its Cayley map alone calls them for the exponential.

use core::array::from_fn;

use num_traits::One;

use crate::{Exp, LieGroup, Scalar, VectorSpace};

/// Terms of the series of $\mathrm d\exp$: $(2\pi)^{40}/41! < 10^{-17}$.
const TERMS: usize = 39;

/// $\mathrm d\exp_\xi \eta = \sum_k \frac{(-1)^k}{(k+1)!} \mathrm{ad}_\xi^k \eta$, to rounding for $\lVert \mathrm{ad}_\xi \rVert \le 2\pi$.
pub fn dexp<G: LieGroup>(xi: &G::Algebra, eta: &G::Algebra) -> G::Algebra {
    polynomial::<G>(xi, eta, &coefficients())
}

/// The gradient in $\xi$ of $\langle \mu, \mathrm d\exp_\xi^{-1} \eta\rangle$: that of
/// $-\langle \nu, \mathrm d\exp_\xi \zeta\rangle$ with $\nu = (\mathrm d\exp_\xi^{-1})^\ast \mu$ and
/// $\zeta = \mathrm d\exp_\xi^{-1} \eta$ fixed.
pub fn dexp_inv_gradient<G: LieGroup>(xi: &G::Algebra, mu: &G::Dual, eta: &G::Algebra) -> G::Dual {
    let nu = G::d_left_inv_dual::<Exp>(xi, mu);
    let zeta = G::d_left_inv::<Exp>(xi, eta);
    let (mut gradient, _) = polynomial_gradient::<G, TERMS>(xi, &nu, &zeta, &coefficients());
    gradient.scale(-G::Scalar::one());
    gradient
}

fn coefficients<S: Scalar>() -> [S; TERMS] {
    let mut a = 1.0;
    from_fn(|k| {
        a /= -(k as f64 + 2.0);
        S::from_f64(a)
    })
}

/// $\eta + \sum_{k \ge 1} a_k \mathrm{ad}_\xi^k \eta$.
#[inline(always)]
pub(crate) fn polynomial<G: LieGroup>(
    xi: &G::Algebra,
    eta: &G::Algebra,
    a: &[G::Scalar],
) -> G::Algebra {
    let (mut sum, mut term) = (eta.clone(), eta.clone());
    for a in a {
        term = G::bracket(xi, &term);
        sum.add_scaled(*a, &term);
    }
    sum
}

/// The transpose of [the polynomial](polynomial): the same one in $\mathrm{ad}_\xi^\ast$.
#[inline(always)]
pub(crate) fn polynomial_dual<G: LieGroup>(
    xi: &G::Algebra,
    mu: &G::Dual,
    a: &[G::Scalar],
) -> G::Dual {
    let (mut sum, mut term) = (mu.clone(), mu.clone());
    for a in a {
        term = G::coadjoint_bracket(xi, &term);
        sum.add_scaled(*a, &term);
    }
    sum
}

/// The gradients of $\langle \mu, \eta + \sum_k a_k \mathrm{ad}_\xi^k \eta\rangle$: in $\xi$ with the $a_k$ fixed, and in
/// the $a_k$.
///
/// Backwards through the terms $t_k = \mathrm{ad}_\xi t_{k-1}$: the sum is $\langle \lambda_k, t_k\rangle$ plus terms before
/// $t_k$, with $\lambda_k = a_k \mu + \mathrm{ad}^\ast_\xi \lambda_{k+1}$. Each $t_k$ adds
/// $-\mathrm{ad}^\ast_{t_{k-1}} \lambda_k$ to the gradient.
#[inline(always)]
pub(crate) fn polynomial_gradient<G: LieGroup, const K: usize>(
    xi: &G::Algebra,
    mu: &G::Dual,
    eta: &G::Algebra,
    a: &[G::Scalar; K],
) -> (G::Dual, [G::Scalar; K]) {
    let (mut term, mut in_a) = (eta.clone(), [G::Scalar::from_f64(0.0); K]);
    let before: [_; K] = from_fn(|k| {
        let next = G::bracket(xi, &term);
        in_a[k] = G::pair(mu, &next);
        core::mem::replace(&mut term, next)
    });
    let (mut in_xi, mut lambda) = (mu.zero_like(), mu.zero_like());
    for (a, before) in a.iter().zip(&before).rev() {
        lambda = G::coadjoint_bracket(xi, &lambda);
        lambda.add_scaled(*a, mu);
        in_xi.add_scaled(-G::Scalar::one(), &G::coadjoint_bracket(before, &lambda));
    }
    (in_xi, in_a)
}
