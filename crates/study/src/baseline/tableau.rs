//! Coefficients of explicit Runge–Kutta methods.

mod dop853;

use core::fmt;

/// Coefficients that are not zero, each with the stage whose rate it weighs.
pub type Row = &'static [(usize, f64)];

/// An explicit Runge–Kutta method,
/// $$ k_i = f\Bigl(t + c_i h,\ y + h \sum_{j < i} a_{ij} k_j\Bigr), \qquad y' = y + h \sum_i b_i k_i, \qquad c_i = \sum_j a_{ij}. $$
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tableau {
    /// The error at a fixed time falls as $h^{\text{order}}$.
    pub order: u32,
    /// The $a_{ij}$ of each stage but the first, which is at the start of the step.
    pub rows: &'static [Row],
    /// The $b_i$.
    pub weights: Row,
}

impl Tableau {
    /// The classical method of order 4.
    pub const CLASSICAL: Self = Self {
        order: 4,
        rows: &[&[(0, 0.5)], &[(1, 0.5)], &[(2, 1.0)]],
        weights: &[
            (0, 1.0 / 6.0),
            (1, 1.0 / 3.0),
            (2, 1.0 / 3.0),
            (3, 1.0 / 6.0),
        ],
    };

    /// How many stages a step has.
    #[must_use]
    pub const fn stages(&self) -> usize {
        self.rows.len() + 1
    }
}

/// The sum of a row: the node $c_i$ of a stage.
#[must_use]
pub fn sum(row: Row) -> f64 {
    row.iter().map(|(_, a)| a).sum()
}

/// A Runge–Kutta method with an error estimate from the same stages.
///
/// With $e = \sum_i e_i k_i$, $e' = \sum_i e'_i k_i$ and the norm of the [tolerance](super::Tolerance), the error of a step is
/// $$ h \frac{\lVert e \rVert^2}{\sqrt{\lVert e \rVert^2 + 0.01 \lVert e' \rVert^2}}, $$
/// which is $h \lVert e \rVert$ where there is no second estimate.
///
/// Sources: J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980); E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary
/// Differential Equations I*, II.4, II.5 and II.10, and their codes DOPRI5 and DOP853.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// What it is called.
    pub name: &'static str,
    /// The method that steps.
    pub tableau: Tableau,
    /// The $e_i$; one index past the stages stands for the rate at the end of the step.
    pub estimate: Row,
    /// The $e'_i$ of a second estimate of lower order; empty where there is none.
    pub second: Row,
    /// The exponent of the previous error in the step size, which damps the size's oscillations.
    pub damping: f64,
    /// A step is at least and at most so many times as long as the one before.
    pub factors: [f64; 2],
}

impl Pair {
    /// Order 5 with an error estimate of order 4 (the classical "RK45"), as DOPRI5 controls it.
    #[rustfmt::skip]
    pub const DP54: Self = Self {
        name: "Dormand–Prince 5(4)",
        tableau: Tableau {
            order: 5,
            rows: &[
                &[(0, 1.0 / 5.0)],
                &[(0, 3.0 / 40.0), (1, 9.0 / 40.0)],
                &[(0, 44.0 / 45.0), (1, -56.0 / 15.0), (2, 32.0 / 9.0)],
                &[(0, 19372.0 / 6561.0), (1, -25360.0 / 2187.0), (2, 64448.0 / 6561.0), (3, -212.0 / 729.0)],
                &[(0, 9017.0 / 3168.0), (1, -355.0 / 33.0), (2, 46732.0 / 5247.0), (3, 49.0 / 176.0),
                  (4, -5103.0 / 18656.0)],
            ],
            weights: &[(0, 35.0 / 384.0), (2, 500.0 / 1113.0), (3, 125.0 / 192.0), (4, -2187.0 / 6784.0),
                       (5, 11.0 / 84.0)],
        },
        estimate: &[(0, 71.0 / 57600.0), (2, -71.0 / 16695.0), (3, 71.0 / 1920.0), (4, -17253.0 / 339_200.0),
                    (5, 22.0 / 525.0), (6, -1.0 / 40.0)],
        second: &[],
        damping: 0.04,
        factors: [0.2, 10.0],
    };

    /// Order 8 with error estimates of orders 5 and 3, for tight tolerances, as DOP853 controls it.
    pub const DP853: Self = Self {
        name: "Dormand–Prince 8(5,3)",
        tableau: Tableau {
            order: 8,
            rows: &dop853::ROWS,
            weights: dop853::WEIGHTS,
        },
        estimate: dop853::ERROR_5,
        second: dop853::ERROR_3,
        damping: 0.0,
        factors: [0.333, 6.0],
    };

    /// Whether the estimate takes the rate at the end of the step, which is the next one's first stage.
    #[must_use]
    pub fn looks_at_end(&self) -> bool {
        let end = self.tableau.stages();
        self.estimate.iter().any(|(stage, _)| *stage == end)
    }
}

impl fmt::Display for Pair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name)
    }
}
