//! Values of options.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use study::contender::{Contender, Control, UnknownContender};
use study::methods::{Method, UnknownMethod};
use study::stability::{Parameter, UnknownParameter};
use thiserror::Error;

/// Why a value was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ValueError {
    #[error("expected a finite number > 0, in seconds")]
    Seconds,
    #[error("expected a finite number > 0, such as 1e-9")]
    Accuracy,
    #[error("expected a whole number >= 1")]
    Count,
    #[error("expected a finite number > 0")]
    Multiple,
}

/// A duration in seconds: finite and positive.
pub fn seconds(text: &str) -> Result<f64, ValueError> {
    let value = text.parse().map_err(|_| ValueError::Seconds)?;
    let valid = f64::is_finite(value) && value > 0.0;
    valid.then_some(value).ok_or(ValueError::Seconds)
}

/// An error to stay below: finite and positive.
pub fn accuracy(text: &str) -> Result<f64, ValueError> {
    seconds(text).map_err(|_| ValueError::Accuracy)
}

/// So many times: finite and positive.
pub fn multiple(text: &str) -> Result<f64, ValueError> {
    seconds(text).map_err(|_| ValueError::Multiple)
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

/// A method or a baseline by its name; help and errors tell them all.
pub fn contender() -> impl TypedValueParser<Value = Contender> {
    contenders(Contender::all())
}

/// The same of those that take steps of one size.
pub fn stepper() -> impl TypedValueParser<Value = Contender> {
    contenders(Contender::all().filter(|contender| contender.control() == Control::Step))
}

fn contenders(all: impl Iterator<Item = Contender>) -> impl TypedValueParser<Value = Contender> {
    let value = |contender: Contender| {
        let help = format!("order {}: {}", contender.order(), contender.description());
        PossibleValue::new(contender.name()).help(help)
    };
    PossibleValuesParser::new(all.map(value))
        .try_map(|name| name.parse::<Contender>() as Result<_, UnknownContender>)
}

/// What of a scene is varied, by its name; help and errors tell all there is.
pub fn parameter() -> impl TypedValueParser<Value = Parameter> {
    let value =
        |parameter: Parameter| PossibleValue::new(parameter.name()).help(parameter.description());
    PossibleValuesParser::new(Parameter::all().map(value))
        .try_map(|name| name.parse::<Parameter>() as Result<_, UnknownParameter>)
}
