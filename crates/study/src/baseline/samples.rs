//! A trajectory on a uniform grid of times.

use super::grid::Grid;
use super::{BaselineError, Pair, Tolerance, Trajectory, Work};

/// A sampled trajectory and what it cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    /// Sampling times: `0, every, 2 every, …` and `until`, strictly increasing.
    pub t: Vec<f64>,
    /// States at the sampling times, in the order of `t`; all finite.
    pub y: Vec<Vec<f64>>,
    /// What it cost.
    pub work: Work,
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
/// There is no test for stiffness: a stiff problem costs many steps (at most
/// [`MAX_STEPS`](super::MAX_STEPS)), it is not refused.
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
/// let run = integrate(&Pair::DP853, oscillator, &[1.0, 0.0], 10.0, 0.3, tolerance)?;
///
/// assert_eq!(run.t.last(), Some(&10.0));
/// for (t, y) in run.t.iter().zip(&run.y) {
///     assert!((y[0] - t.cos()).abs() < 1e-10);
/// }
/// # Ok::<(), study::baseline::BaselineError>(())
/// ```
pub fn integrate(
    pair: &'static Pair,
    mut rhs: impl FnMut(f64, &[f64], &mut [f64]),
    y0: &[f64],
    until: f64,
    every: f64,
    tolerance: Tolerance,
) -> Result<Samples, BaselineError> {
    tolerance.check()?;
    let grid = Grid::new(until, every, y0.len())?;
    let mut guarded = |t: f64, y: &[f64], dy: &mut [f64]| {
        // An entry that is not written must not pass.
        dy.fill(f64::NAN);
        if y.iter().all(|y| y.is_finite()) {
            rhs(t, y, dy);
        }
    };
    sample(pair, &mut guarded, y0, &grid, tolerance)
}

/// With the type of the right-hand side forgotten: compiled once, and not for every system again.
fn sample(
    pair: &'static Pair,
    rhs: &mut dyn FnMut(f64, &[f64], &mut [f64]),
    y0: &[f64],
    grid: &Grid,
    tolerance: Tolerance,
) -> Result<Samples, BaselineError> {
    let until = grid.until();
    let mut trajectory: Trajectory<_> =
        Trajectory::new(pair, rhs, (0.0, y0), until, tolerance)?;
    let t: Vec<_> = grid.times().collect();
    let mut y = Vec::with_capacity(t.len());
    for t in &t {
        y.push(trajectory.at(*t)?.to_vec());
    }
    let work = trajectory.work();
    Ok(Samples { t, y, work })
}
