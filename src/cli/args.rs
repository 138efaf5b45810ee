//! Values of options.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use sim::{LARGEST_ACCURACY, Method, UnknownMethod};
use thiserror::Error;

/// Why a value was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ValueError {
    #[error("expected a finite number > 0, in seconds")]
    Seconds,
    #[error("expected a finite number > 0, in rad or rad/s")]
    Angle,
    #[error("expected a finite number >= 0, in kg/m^3: 1000 of water, 0 of a vacuum")]
    Density,
    #[error(
        "expected a number > 0 and <= {LARGEST_ACCURACY}, such as 1e-9; an attitude is never more than pi off"
    )]
    Accuracy,
    #[error("expected a whole number >= 1")]
    Count,
    #[cfg(feature = "chart")]
    #[error("expected a finite number > 0; of the stiffness, 0 as well")]
    Multiple,
}

/// A duration in seconds: finite and positive.
pub fn seconds(text: &str) -> Result<f64, ValueError> {
    let value = text.parse().map_err(|_| ValueError::Seconds)?;
    let valid = f64::is_finite(value) && value > 0.0;
    valid.then_some(value).ok_or(ValueError::Seconds)
}

/// An angle in rad, or a rate in rad/s: finite and positive.
pub fn angle(text: &str) -> Result<f64, ValueError> {
    seconds(text).map_err(|_| ValueError::Angle)
}

/// An error to stay below: positive, and one that can be exceeded.
pub fn accuracy(text: &str) -> Result<f64, ValueError> {
    let value = seconds(text)
        .ok()
        .filter(|value| *value <= LARGEST_ACCURACY);
    value.ok_or(ValueError::Accuracy)
}

/// A density in kg/m³: finite, and not negative.
pub fn density(text: &str) -> Result<f64, ValueError> {
    let value = text.parse().map_err(|_| ValueError::Density)?;
    let valid = f64::is_finite(value) && value >= 0.0;
    valid.then_some(value).ok_or(ValueError::Density)
}

/// How many: at least one.
pub fn count(text: &str) -> Result<u64, ValueError> {
    let value = text.parse().map_err(|_| ValueError::Count)?;
    (value > 0).then_some(value).ok_or(ValueError::Count)
}

/// A method by its name; help and errors tell them all.
pub fn method() -> impl TypedValueParser<Value = Method> {
    let value = |method: Method| {
        let help = format!("order {}: {}", method.order(), method.description());
        PossibleValue::new(method.name()).help(help)
    };
    PossibleValuesParser::new(Method::all().map(value))
        .try_map(|name| name.parse::<Method>() as Result<_, UnknownMethod>)
}
