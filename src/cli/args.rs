//! Values of options.

use thiserror::Error;

/// Why a value was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ValueError {
    #[error("expected a finite number > 0, in seconds")]
    Seconds,
    #[error("expected a whole number >= 1")]
    Count,
}

/// A duration in seconds: finite and positive.
pub fn seconds(text: &str) -> Result<f64, ValueError> {
    let value = text.parse().map_err(|_| ValueError::Seconds)?;
    let valid = f64::is_finite(value) && value > 0.0;
    valid.then_some(value).ok_or(ValueError::Seconds)
}

/// How many: at least one.
pub fn count(text: &str) -> Result<u64, ValueError> {
    let value = text.parse().map_err(|_| ValueError::Count)?;
    (value > 0).then_some(value).ok_or(ValueError::Count)
}
