//! The coefficients of Gauss collocation, in double-double precision.

use std::sync::OnceLock;

use qd::Quad;

use crate::step::Rule;

/// The Gauss–Legendre collocation method with `S` stages, of order `2 S`.
///
/// From the shifted Legendre polynomials $P_k$ on $[0, 1]$: $c_i$ are the zeros of $P_s$,
/// $b_i = \left(c_i (1 - c_i) P_s'(c_i)^2\right)^{-1}$, and
/// $a_{ij} = b_j \left(c_i + \frac12 \sum_{k=1}^{s-1} P_k(c_j) \left(P_{k+1}(c_i) - P_{k-1}(c_i)\right)\right)$
/// (E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, II.1.3).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tableau {
    /// $c_i$.
    pub(super) nodes: Vec<f64>,
    /// $b_i$.
    pub(super) weights: Vec<Split>,
    /// $a_{ij}$, row by row.
    pub(super) forward: Vec<Vec<Split>>,
    /// $b_j - a_{ij}$, which for Gauss is $b_j a_{ji} / b_i$: the adjoint coefficients of the momenta.
    pub(super) backward: Vec<Vec<Split>>,
    /// Sums over the ends and the stages of a step.
    pub(super) rule: Rule,
}

/// A coefficient with the part that a float of it leaves out.
///
/// A rounded coefficient is a slightly different method, whose energy drifts by rounding in one direction; see
/// E. Hairer, R. I. McLachlan, A. Razakarivony, *Achieving Brouwer's law with implicit Runge–Kutta methods*, BIT 48 (2008).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Split {
    pub(super) high: f64,
    pub(super) low: f64,
}

impl From<Quad> for Split {
    fn from(x: Quad) -> Self {
        Self {
            high: x.0,
            low: x.1,
        }
    }
}

impl Tableau {
    /// The tableau of 1 to 8 stages, made once: the zeros in double-double cost as much as many steps.
    pub(super) fn gauss(stages: usize) -> &'static Self {
        static MADE: [OnceLock<Tableau>; 8] = [const { OnceLock::new() }; 8];
        MADE[stages - 1].get_or_init(|| Self::new(stages))
    }

    fn new(stages: usize) -> Self {
        let nodes: Vec<_> = (0..stages).map(|i| node(stages, i)).collect();
        let weight = |c: &Quad| {
            let slope = legendre(stages, *c).slope;
            ONE / (*c * (ONE - *c) * slope * slope)
        };
        let weights: Vec<_> = nodes.iter().map(weight).collect();
        let entry = |i: usize, j: usize| {
            let terms = (1..stages).map(|k| {
                let difference = legendre(k + 1, nodes[i]).value - legendre(k - 1, nodes[i]).value;
                legendre(k, nodes[j]).value * difference * Quad::from(0.5)
            });
            weights[j] * terms.fold(nodes[i], |sum, term| sum + term)
        };
        let matrix = |entry: &dyn Fn(usize, usize) -> Quad| -> Vec<Vec<Split>> {
            let row = |i| (0..stages).map(|j| entry(i, j).into()).collect();
            (0..stages).map(row).collect()
        };
        let places: Vec<f64> = nodes.iter().map(|c| c.0).collect();
        Self {
            forward: matrix(&entry),
            backward: matrix(&|i, j| weights[j] - entry(i, j)),
            rule: Rule::inside(&places, weights.iter().map(|b| b.0)),
            nodes: places,
            weights: weights.iter().copied().map(Split::from).collect(),
        }
    }
}

const ONE: Quad = Quad(1.0, 0.0);

/// A Legendre polynomial on $[0, 1]$ and its derivative.
struct Legendre {
    value: Quad,
    slope: Quad,
}

/// $P_k(x)$ by $(k+1) P_{k+1} = (2k+1)(2x - 1) P_k - k P_{k-1}$.
fn legendre(degree: usize, x: Quad) -> Legendre {
    let (zero, two) = (Quad::from(0.0), Quad::from(2.0));
    let y = x * two - ONE;
    let (mut last, mut value) = (zero, ONE);
    let (mut last_slope, mut slope) = (zero, zero);
    for k in 0..degree {
        let [a, b, n] = [2 * k + 1, k, k + 1].map(|k| Quad::from(k as f64));
        let next = (y * value * a - last * b) / n;
        let next_slope = ((value * two + y * slope) * a - last_slope * b) / n;
        (last, value) = (value, next);
        (last_slope, slope) = (slope, next_slope);
    }
    Legendre { value, slope }
}

/// The zero number `i` of $P_s$, by Newton's method from Chebyshev's approximation.
fn node(stages: usize, i: usize) -> Quad {
    /// Doubling the digits each time, from two to thirty-two, and one more.
    const ITERATIONS: u32 = 6;
    let angle = core::f64::consts::PI * (i as f64 + 0.75) / (stages as f64 + 0.5);
    let mut x = Quad::from(0.5 - 0.5 * angle.cos());
    for _ in 0..ITERATIONS {
        let Legendre { value, slope } = legendre(stages, x);
        x -= value / slope;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn full(x: Split) -> Quad {
        Quad(x.high, x.low)
    }

    /// What double-double leaves of sums of eight terms.
    const DOUBLE_DOUBLE: f64 = 1e-29;

    /// The order conditions $B(2s)$, $C(s)$, $D(s)$ give order $2s$ (J. C. Butcher); the last, symplecticity.
    fn conditions(stages: usize) {
        let tableau = Tableau::gauss(stages);
        let exact: Vec<_> = (0..stages).map(|i| node(stages, i)).collect();
        let power = |x: Quad, n: usize| (0..n).fold(ONE, |y, _| y * x);
        let near = |a: Quad, b: Quad| {
            let off = (a - b).0.abs();
            assert!(off < DOUBLE_DOUBLE, "{stages} stages: {off:e}");
        };
        let sum = |terms: &dyn Fn(usize) -> Quad| {
            (0..stages).fold(Quad::from(0.0), |sum, i| sum + terms(i))
        };
        let b = |i: usize| full(tableau.weights[i]);
        let a = |i: usize, j: usize| full(tableau.forward[i][j]);
        for k in 1..=2 * stages {
            let b_k = sum(&|i| b(i) * power(exact[i], k - 1));
            near(b_k, ONE / Quad::from(k as f64));
        }
        for k in 1..=stages {
            for (i, c) in exact.iter().enumerate() {
                let c_k = sum(&|j| a(i, j) * power(exact[j], k - 1));
                near(c_k, power(*c, k) / Quad::from(k as f64));
                let d_k = sum(&|j| b(j) * power(exact[j], k - 1) * a(j, i));
                near(d_k, b(i) * (ONE - power(*c, k)) / Quad::from(k as f64));
            }
        }
        for (i, j) in (0..stages).flat_map(|i| (0..stages).map(move |j| (i, j))) {
            near(b(i) * a(i, j) + b(j) * a(j, i), b(i) * b(j));
            near(full(tableau.backward[i][j]), b(j) * a(j, i) / b(i));
        }
    }

    #[test]
    fn order_conditions() {
        (1..=8).for_each(conditions);
    }
}
