//! Adaptive explicit Runge–Kutta, the method that knows no geometry.
//!
//! [`integrate`] runs a Dormand–Prince pair (the steppers of `ode_solvers`)
//! and samples the trajectory on a uniform grid. It serves twice: at everyday
//! tolerances as the competitor a variational integrator is measured against,
//! and at `1e-13` as the reference both are measured by.
//!
//! # How exact the samples are
//!
//! The step sequence does not depend on the sampling grid: the method takes the
//! steps it wants. A sample that falls inside an accepted step `[a, b]` is *not*
//! interpolated; it comes from one more step of the same pair from `a` to the
//! sampling time, which is as exact as the step itself. The reason is a
//! measurement. On the harmonic oscillator (largest error made within one step,
//! over `t ∈ [0, 100]`, relative = absolute tolerance):
//!
//! | pair   | tolerance | accepted step | interpolant of the pair | shorter step |
//! |--------|-----------|---------------|-------------------------|--------------|
//! | 5(4)   | 1e-6      | 8.5e-8        | 3.7e-7                  | 8.3e-8       |
//! | 5(4)   | 1e-9      | 2.0e-11       | 3.3e-10                 | 2.0e-11      |
//! | 8(5,3) | 1e-9      | 7.7e-11       | 3.2e-9                  | 7.7e-11      |
//! | 8(5,3) | 1e-12     | 4.0e-14       | 3.4e-12                 | 3.4e-14      |
//! | 8(5,3) | 1e-13     | 9.5e-15       | 3.5e-13                 | 2.8e-15      |
//!
//! The interpolants have order 4 and 7 and lose up to two digits on a single
//! step; over a long run the accumulated error of the steps hides that. The
//! global errors at `t ≤ 100` of 8(5,3) at `1e-13` are 1.6e-12 both on the
//! oscillator and on a free rigid body with inertia (1, 2, 3).
//!
//! The calls spent on samples are counted apart
//! ([`Samples::sampling_evaluations`]), so that [`Samples::evaluations`] stays
//! the price of the method.

mod error;
mod grid;
mod march;
mod system;

pub use error::BaselineError;

use std::fmt;

/// An embedded Runge–Kutta pair of Dormand and Prince.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Pair {
    /// Order 5 with an error estimate of order 4 (the classical "RK45").
    DormandPrince54,
    /// Order 8 with error estimates of orders 5 and 3, for tight tolerances.
    DormandPrince853,
}

impl fmt::Display for Pair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Pair::DormandPrince54 => "Dormand–Prince 5(4)",
            Pair::DormandPrince853 => "Dormand–Prince 8(5,3)",
        })
    }
}

/// Tolerances of the step size control.
///
/// A step passes when the root mean square over the components of
/// `error / (absolute + relative * |y|)` is at most one. The error of the whole
/// run is larger, typically by the number of steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Error allowed per step relative to the size of each component (no unit);
    /// at least [`Tolerance::SMALLEST_RELATIVE`] and below one.
    pub relative: f64,
    /// Error allowed per step in the unit of the state; positive.
    pub absolute: f64,
}

impl Tolerance {
    /// Below ten units of rounding, step control only measures noise.
    pub const SMALLEST_RELATIVE: f64 = 10.0 * f64::EPSILON;

    /// The same number as relative and as absolute tolerance.
    ///
    /// ```
    /// # use study::baseline::Tolerance;
    /// assert_eq!(Tolerance::uniform(1e-9).absolute, 1e-9);
    /// ```
    #[must_use]
    pub const fn uniform(tolerance: f64) -> Self {
        Self {
            relative: tolerance,
            absolute: tolerance,
        }
    }

    pub(crate) fn check(self) -> Result<(), BaselineError> {
        let relative = self.relative >= Self::SMALLEST_RELATIVE && self.relative < 1.0;
        let absolute = self.absolute > 0.0 && self.absolute.is_finite();
        if relative && absolute {
            return Ok(());
        }
        Err(BaselineError::Tolerance {
            relative: self.relative,
            absolute: self.absolute,
        })
    }
}

/// A sampled trajectory and what it cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    /// Sampling times: `0, every, 2 every, …` and `until`, strictly increasing.
    pub t: Vec<f64>,
    /// States at the sampling times, in the order of `t`; all finite.
    pub y: Vec<Vec<f64>>,
    /// Calls of the right-hand side made by the method, failed steps included.
    pub evaluations: usize,
    /// Further calls made to get states at sampling times between two steps.
    pub sampling_evaluations: usize,
    /// Accepted steps.
    pub accepted: usize,
    /// Rejected steps; failures before the first success are part of finding
    /// the initial step and do not count.
    pub rejected: usize,
}

/// Integrates `dy/dt = rhs(t, y)` from `y(0) = y0` to `t = until`.
///
/// `rhs(t, y, dy)` writes the derivative into `dy`, every entry of it. It is
/// only called with finite states. It may answer with non-finite numbers where
/// it is not defined: the step is then tried again, shorter.
///
/// Samples are taken at `0, every, 2 every, …` (each the rounded product, no
/// accumulated drift) and, exactly once and last, at `until`; a multiple of
/// `every` within rounding of `until` is the sample at `until`. Times are in
/// the unit of the problem, usually seconds.
///
/// The stiffness test of the underlying stepper is off: a stiff problem costs
/// many steps (at most [`MAX_STEPS`]), it is not refused.
///
/// # Errors
///
/// [`BaselineError`] for an input out of range, for a right-hand side that
/// stays non-finite however short the step, and for a run that cannot reach
/// `until`. States in `Ok` are finite.
///
/// # Examples
///
/// ```
/// use study::baseline::{integrate, Pair, Tolerance};
///
/// let oscillator = |_t: f64, y: &[f64], dy: &mut [f64]| {
///     dy[0] = y[1];
///     dy[1] = -y[0];
/// };
/// let tolerance = Tolerance::uniform(1e-12);
/// let run = integrate(Pair::DormandPrince853, oscillator, &[1.0, 0.0], 10.0, 0.3, tolerance)?;
///
/// assert_eq!(run.t.last(), Some(&10.0));
/// for (t, y) in run.t.iter().zip(&run.y) {
///     assert!((y[0] - t.cos()).abs() < 1e-10);
/// }
/// # Ok::<(), study::baseline::BaselineError>(())
/// ```
pub fn integrate(
    pair: Pair,
    mut rhs: impl FnMut(f64, &[f64], &mut [f64]),
    y0: &[f64],
    until: f64,
    every: f64,
    tolerance: Tolerance,
) -> Result<Samples, BaselineError> {
    tolerance.check()?;
    check_state(y0)?;
    let grid = grid::Grid::new(until, every, y0.len())?;
    march::march(pair, tolerance, &grid, &mut rhs, y0)
}

/// Steps, accepted and rejected, after which [`integrate`] gives up.
pub const MAX_STEPS: usize = 10_000_000;

pub(crate) fn check_state(y0: &[f64]) -> Result<(), BaselineError> {
    if y0.is_empty() {
        return Err(BaselineError::EmptyState);
    }
    match y0.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(index) => Err(BaselineError::InitialState {
            index,
            value: y0[index],
        }),
    }
}
