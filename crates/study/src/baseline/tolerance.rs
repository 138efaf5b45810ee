//! How large the error of a step may be.

use super::BaselineError;

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

    pub(super) fn check(self) -> Result<(), BaselineError> {
        let Self { relative, absolute } = self;
        let in_range = (Self::SMALLEST_RELATIVE..1.0).contains(&relative)
            && absolute > 0.0
            && absolute.is_finite();
        in_range
            .then_some(())
            .ok_or(BaselineError::Tolerance { relative, absolute })
    }

    /// The error allowed where the state is `y`.
    #[inline(always)]
    pub(super) fn scale(self, y: f64) -> f64 {
        self.absolute + self.relative * y.abs()
    }
}
