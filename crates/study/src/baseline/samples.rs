//! A trajectory on a uniform grid of times.

use super::{BaselineError, Pair, RightHandSide, Tolerance, Trajectory, Work};

/// Words kept at most over all samples (2 GiB).
const MAX_WORDS: usize = 1 << 28;

/// Words a sample takes beside its numbers: time, vector and allocation.
const OVERHEAD: usize = 6;

/// A multiple of the interval this close to the end is the end.
const SAME: f64 = 16.0 * f64::EPSILON;

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
/// accumulated drift) and, exactly once and last, at `until`. A multiple of
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
    let mut guarded = |t: f64, y: &[f64], dy: &mut [f64]| {
        // An entry that is not written must not pass.
        dy.fill(f64::NAN);
        if y.iter().all(|y| y.is_finite()) {
            rhs(t, y, dy);
        }
    };
    // Its type forgotten, the method is compiled once, and not for every system again.
    let rhs: &mut dyn RightHandSide = &mut guarded;
    let mut trajectory: Trajectory<_> = Trajectory::new(pair, rhs, (0.0, y0), until, tolerance)?;
    let t = times(until, every, MAX_WORDS / (y0.len() + OVERHEAD))?;
    let y = t.iter().map(|t| Ok(trajectory.at(*t)?.to_vec()));
    let y = y.collect::<Result<_, _>>()?;
    let work = trajectory.work();
    Ok(Samples { t, y, work })
}

/// The sampling times, at most about `limit`.
fn times(until: f64, every: f64, limit: usize) -> Result<Vec<f64>, BaselineError> {
    if !(every > 0.0 && every.is_finite()) {
        return Err(BaselineError::Every { every });
    }
    let samples = until / every;
    if samples > limit as f64 {
        return Err(BaselineError::TooManySamples { samples, limit });
    }
    let multiples = (0..).map(|k: u32| every * f64::from(k));
    let before_end = multiples.take_while(|t| *t < until * (1.0 - SAME));
    Ok(before_end.chain([until]).collect())
}
