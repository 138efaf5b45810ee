//! Values of options of the experiments.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use study::contender::{Contender, Control, UnknownContender};
use study::stability::{Parameter, UnknownParameter};

use super::args::ValueError;

/// So many times, or so much more: finite and not negative. What of them may be zero depends on the parameter.
pub fn multiple(text: &str) -> Result<f64, ValueError> {
    let value = text.parse().map_err(|_| ValueError::Multiple)?;
    let valid = f64::is_finite(value) && value >= 0.0;
    valid.then_some(value.abs()).ok_or(ValueError::Multiple)
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
