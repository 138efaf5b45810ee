//! The solution of an initial value problem at the times that are asked for.

use lie::Batch;

use super::stages::RightHandSide;
use super::stepper::{Stepper, Work};
use super::{BaselineError, Pair, Tolerance};

/// Shorter than this, relative to the time, no step is taken.
const NO_STEP: f64 = 16.0 * f64::EPSILON;

/// The solution of $\dot y = f(t, y)$ from a start, found step by step as it is asked for.
///
/// The steps do not depend on the times that are asked for, and make no allocation. A state within a step comes from a step of
/// its own, see [`baseline`](super). `f` must be a total function: it is called with any numbers, and answers with ones that are
/// not finite where it is not defined. Vectors are combined by the instructions of `S`.
///
/// ```
/// use study::baseline::{Pair, Tolerance, Trajectory};
///
/// let oscillator = |_t: f64, y: &[f64], dy: &mut [f64]| (dy[0], dy[1]) = (y[1], -y[0]);
/// let (start, tolerance) = ((0.0, [1.0, 0.0].as_slice()), Tolerance::uniform(1e-10));
/// let mut motion: Trajectory<_> = Trajectory::new(&Pair::DP54, oscillator, start, 10.0, tolerance)?;
/// for t in [0.0, 0.1, 3.0, 10.0_f64] {
///     assert!((motion.at(t)?[0] - t.cos()).abs() < 1e-8);
/// }
/// # Ok::<(), study::baseline::BaselineError>(())
/// ```
pub struct Trajectory<F, S = f64> {
    rhs: F,
    until: f64,
    main: Stepper<S>,
    /// To a time within the last step.
    within: Stepper<S>,
}

impl<F: RightHandSide, S: Batch<Item = f64>> Trajectory<F, S> {
    /// The solution from the state `y` at `t` to the time `until`.
    ///
    /// # Errors
    /// [`BaselineError`] for an input out of range, and where `rhs` is not finite at the start.
    pub fn new(
        pair: &'static Pair,
        mut rhs: F,
        (t, y): (f64, &[f64]),
        until: f64,
        tolerance: Tolerance,
    ) -> Result<Self, BaselineError> {
        tolerance.check()?;
        if !(t.is_finite() && until.is_finite() && until > t) {
            return Err(BaselineError::Until { until });
        }
        if y.is_empty() {
            return Err(BaselineError::EmptyState);
        }
        if let Some(index) = y.iter().position(|y| !y.is_finite()) {
            let value = y[index];
            return Err(BaselineError::InitialState { index, value });
        }
        let mut main = Stepper::new(pair, tolerance, (t, y));
        main.begin(&mut rhs, until)?;
        Ok(Self {
            rhs,
            until,
            main,
            within: Stepper::new(pair, tolerance, (t, y)),
        })
    }

    /// The state at a time that is not before the start of the last step taken, nor after the end.
    ///
    /// # Errors
    /// [`BaselineError`]; what was [reached](Self::reached) before stays.
    pub fn at(&mut self, t: f64) -> Result<&[f64], BaselineError> {
        let (from, until) = (self.main.before, self.until);
        if !(from..=until).contains(&t) {
            return Err(BaselineError::Time { t, from, until });
        }
        while self.main.t < t {
            self.step()?;
        }
        if self.main.t == t {
            return Ok(&self.main.y);
        }
        let (within, rhs) = (&mut self.within, &mut self.rhs);
        within.rewind(&self.main, t);
        if t - within.t > NO_STEP * t.abs() {
            while within.t < t {
                within.step(rhs, t)?;
            }
        }
        Ok(&within.y)
    }

    /// Takes a step, unless the end is reached.
    ///
    /// # Errors
    /// [`BaselineError`]; what was [reached](Self::reached) before stays.
    pub fn step(&mut self) -> Result<(), BaselineError> {
        if self.main.t < self.until {
            self.main.step(&mut self.rhs, self.until)?;
        }
        Ok(())
    }

    /// The end of the last step taken: its time and state.
    pub fn reached(&self) -> (f64, &[f64]) {
        (self.main.t, &self.main.y)
    }

    /// The cost so far.
    pub fn work(&self) -> Work {
        Work {
            sampling_evaluations: self.within.work.evaluations,
            ..self.main.work
        }
    }
}
