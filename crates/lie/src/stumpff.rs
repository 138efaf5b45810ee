//! The Stumpff functions, from which the exponential maps are built.

use crate::Scalar;

/// Below this $x$ the series is used; above, the recursion from trigonometric functions.
const SERIES_BELOW: f64 = 1.0;
/// Terms of the series; the first one left out is below $10^{-20}$ of the value.
const TERMS: u32 = 9;

/// $c_1, \dots, c_6$ at $x = \theta^2 \ge 0$, $c_k(x) = \sum_i \frac{(-x)^i}{(k + 2i)!}$.
///
/// $c_1 = \sin\theta/\theta$, $c_2 = (1 - \cos\theta)/\theta^2$ and $c_k = 1/k! - x c_{k+2}$. They are entire,
/// so their derivatives exist at zero; the textbook quotients lose all digits there.
#[inline(always)]
pub(crate) fn stumpff<S: Scalar>(x: S) -> [S; 6] {
    let small = x.less(S::from_f64(SERIES_BELOW));
    let (near, far) = (series(x), recursion(S::select(small, S::one(), x)));
    core::array::from_fn(|k| S::select(small, near[k], far[k]))
}

/// $c_7$ and $c_8$ at $x$, from $c_5$ and $c_6$ where the series is not used.
#[inline(always)]
pub(crate) fn stumpff_next<S: Scalar>(x: S, [c5, c6]: [S; 2]) -> [S; 2] {
    let small = x.less(S::from_f64(SERIES_BELOW));
    let (near, r) = (
        [sum(x, 7), sum(x, 8)],
        S::one() / S::select(small, S::one(), x),
    );
    let far = [
        (S::from_f64(1.0 / 120.0) - c5) * r,
        (S::from_f64(1.0 / 720.0) - c6) * r,
    ];
    core::array::from_fn(|k| S::select(small, near[k], far[k]))
}

/// $g(x) = \frac{1 - \frac\theta2 \cot\frac\theta2}{\theta^2} = \frac{c_3 - 2 c_4}{2 c_2}$ and $g'(x) = \frac{c_5 - 4 c_6}{4 c_2}$.
///
/// Where $\mathrm{ad}^3 = -x\, \mathrm{ad}$, $\mathrm d\exp^{-1} = 1 + \frac12 \mathrm{ad} + g(x)\, \mathrm{ad}^2$.
#[inline(always)]
pub(crate) fn dexp_inv_factor<S: Scalar>(x: S) -> [S; 2] {
    let [_, c2, c3, c4, c5, c6] = stumpff(x);
    let four = S::from_f64(4.0);
    [(c3 - c4 - c4) / (c2 + c2), (c5 - four * c6) / (four * c2)]
}

/// The first two alone.
#[inline(always)]
pub(crate) fn stumpff2<S: Scalar>(x: S) -> [S; 2] {
    let small = x.less(S::from_f64(SERIES_BELOW));
    let (c3, c4) = (sum(x, 3), sum(x, 4));
    let far = trigonometric(S::select(small, S::one(), x));
    let near = [S::one() - x * c3, S::from_f64(0.5) - x * c4];
    core::array::from_fn(|k| S::select(small, near[k], far[k]))
}

#[inline(always)]
fn series<S: Scalar>(x: S) -> [S; 6] {
    let (c5, c6) = (sum(x, 5), sum(x, 6));
    let (c3, c4) = (
        S::from_f64(1.0 / 6.0) - x * c5,
        S::from_f64(1.0 / 24.0) - x * c6,
    );
    let (c1, c2) = (S::one() - x * c3, S::from_f64(0.5) - x * c4);
    [c1, c2, c3, c4, c5, c6]
}

/// $c_k(x)$ by Horner's rule on $\frac{1}{k!} \left(1 - \frac{x}{(k+1)(k+2)} \left(1 - \cdots \right)\right)$.
#[inline(always)]
fn sum<S: Scalar>(x: S, k: u32) -> S {
    let factor = |i: u32| 1.0 / (f64::from(k + 2 * i - 1) * f64::from(k + 2 * i));
    let tail = (1..=TERMS).rev().fold(S::one(), |tail, i| {
        S::one() - x * tail * S::from_f64(factor(i))
    });
    tail * S::from_f64(1.0 / (1..=k).map(f64::from).product::<f64>())
}

#[inline(always)]
fn recursion<S: Scalar>(x: S) -> [S; 6] {
    let [c1, c2] = trigonometric(x);
    let r = S::one() / x;
    let (c3, c4) = ((S::one() - c1) * r, (S::from_f64(0.5) - c2) * r);
    let (c5, c6) = (
        (S::from_f64(1.0 / 6.0) - c3) * r,
        (S::from_f64(1.0 / 24.0) - c4) * r,
    );
    [c1, c2, c3, c4, c5, c6]
}

/// $\sin\theta/\theta$ and $(1 - \cos\theta)/\theta^2$ by the half angle, which does not cancel.
#[inline(always)]
fn trigonometric<S: Scalar>(x: S) -> [S; 2] {
    let half = x.sqrt() * S::from_f64(0.5);
    let (sin, cos) = half.sin_cos();
    let sinc = sin / half;
    [sinc * cos, sinc * sinc * S::from_f64(0.5)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_definition_on_both_sides_of_the_seam() {
        for theta in [
            0.0_f64, 1e-8, 1e-4, 0.3, 0.999_999, 1.0, 1.000_001, 2.0, 3.0, 6.0,
        ] {
            let x = theta * theta;
            // The sum of the series, and of its terms' magnitudes.
            let series = |k: u32| {
                let mut term = 1.0 / (1..=k).map(f64::from).product::<f64>();
                let (mut total, mut magnitudes) = (0.0, 0.0);
                for i in 1..60 {
                    total += term;
                    magnitudes += term.abs();
                    term *= -x / (f64::from(k + 2 * i - 1) * f64::from(k + 2 * i));
                }
                (total, magnitudes)
            };
            let c = stumpff(x);
            for k in 1..=6 {
                let (expected, magnitudes) = series(k);
                let factorial = (1..=k).map(f64::from).product::<f64>();
                // A step of the recursion takes the rounding of c_{k-2} over to c_k, divided by x >= 1: relative to
                // c_k it grows by c_{k-2} / (x c_k) <= k (k - 1), by k! in all. The reference cancels at large angles.
                let relative = f64::EPSILON * (factorial + magnitudes / expected.abs());
                let error = (c[k as usize - 1] / expected - 1.0).abs();
                assert!(error <= relative, "c_{k}({x}): {error:e} > {relative:e}");
            }
            assert_eq!(stumpff2(x)[0], c[0]);
        }
    }
}
