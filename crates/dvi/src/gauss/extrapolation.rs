//! Continuing what was seen at the stages of the last steps.

use std::sync::OnceLock;

use super::tableau::Tableau;

/// Steps that are looked back on, at most.
pub(super) const STEPS: usize = 3;
/// Stages of a step, at most.
const STAGES: usize = 8;
const VALUES: usize = STEPS * STAGES;

/// A row for each stage of the next step, a column for each stage of the last ones.
pub(super) type Rows = [[f64; VALUES]; STAGES];

/// That of [`extrapolation`] for a step as long as the last ones, made once: it costs as much as a step.
pub(super) fn continuation(tableau: &Tableau, steps: usize) -> &'static Rows {
    static MADE: [[OnceLock<Rows>; STEPS]; STAGES] =
        [const { [const { OnceLock::new() }; STEPS] }; STAGES];
    let made = &MADE[tableau.nodes.len() - 1][steps - 1];
    made.get_or_init(|| extrapolation(tableau, steps, 1.0))
}

/// The degree of the polynomial through so many steps: higher ones follow the past closer and extrapolate worse.
fn degree(stages: usize, steps: usize) -> usize {
    match stages {
        0..=5 => stages + 1,
        _ => [5, 9, 12][steps - 1],
    }
}

/// The matrix that takes values at the stages of the last `steps` steps, the oldest first, to those at the stages of the
/// next, `ratio` times as long.
///
/// It continues the polynomial of a [`degree`] that is nearest to the values in the $b$-weighted mean square.
/// Through all the values it would go at the highest degree, which extrapolates badly. By polynomials orthogonal on the
/// stages, from their three-term recurrence (G. E. Forsythe, *J. SIAM* 5, 1957).
pub(super) fn extrapolation(tableau: &Tableau, steps: usize, ratio: f64) -> Rows {
    let stages = tableau.nodes.len();
    let values = steps * stages;
    let node = |j: usize| tableau.nodes[j % stages] + (j / stages) as f64;
    let weight = |j: usize| tableau.weights[j % stages].high;
    let target = |i: usize| steps as f64 + ratio * tableau.nodes[i];
    let sum = |term: &dyn Fn(usize) -> f64| (0..values).map(|j| weight(j) * term(j)).sum::<f64>();
    let mut rows = [[0.0; VALUES]; STAGES];
    // A polynomial and the one before it, at the stages of the past and of the next step.
    let (mut p, mut q) = ([1.0; VALUES], [1.0; STAGES]);
    let (mut p_last, mut q_last) = ([0.0; VALUES], [0.0; STAGES]);
    let mut last = f64::INFINITY;
    for _ in 0..=degree(stages, steps).min(values - 1) {
        let square = sum(&|j| p[j] * p[j]);
        for (i, row) in rows.iter_mut().enumerate().take(stages) {
            for (j, entry) in row.iter_mut().enumerate().take(values) {
                *entry += weight(j) * p[j] * q[i] / square;
            }
        }
        let (a, b) = (sum(&|j| node(j) * p[j] * p[j]) / square, square / last);
        last = square;
        for j in 0..values {
            (p_last[j], p[j]) = (p[j], (node(j) - a) * p[j] - b * p_last[j]);
        }
        for i in 0..stages {
            (q_last[i], q[i]) = (q[i], (target(i) - a) * q[i] - b * q_last[i]);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From one step and from three, of the same size and of others, backwards too.
    #[test]
    fn a_polynomial_is_extrapolated_exactly() {
        let tableau = Tableau::gauss(6);
        let cubic = |x: f64| 1.0 - 2.0 * x + 0.5 * x.powi(3);
        for (steps, ratio) in [(1, 1.0), (1, 0.5), (1, -1.0), (3, 1.0), (3, 0.5)] {
            let matrix = extrapolation(tableau, steps, ratio);
            let past = |j: usize| tableau.nodes[j % 6] + (j / 6) as f64;
            for (row, c) in matrix.iter().zip(&tableau.nodes) {
                let terms = || (0..6 * steps).map(|j| row[j] * cubic(past(j)));
                let exact = cubic(steps as f64 + ratio * c);
                // Rounding of the entries, the largest of which is of the degree 12 over three steps.
                let bound = 100.0 * f64::EPSILON * terms().map(f64::abs).sum::<f64>();
                let off = (terms().sum::<f64>() - exact).abs();
                assert!(off < bound, "{steps} {ratio}: {off:e} {bound:e}");
            }
        }
    }
}
