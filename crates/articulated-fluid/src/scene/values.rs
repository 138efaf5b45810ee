//! Values of keys: numbers, vectors and rotations.

use std::ops::Range;

use toml::Spanned;

use super::description::StartVelocity;
use super::error::SceneError;
use super::note::{Correction, PUBLISHED, ROUNDING};
use super::raw::{Field, RawAxisAngle, RawRotation, WordOr};
use super::source::Source;

/// A number that is finite and > 0.
pub(super) fn positive(field: &Spanned<f64>, source: &Source) -> Result<f64, SceneError> {
    number(field, |value| value > 0.0, source)
}

/// A number that is finite and >= 0.
pub(super) fn not_negative(field: &Spanned<f64>, source: &Source) -> Result<f64, SceneError> {
    number(field, |value| value >= 0.0, source)
}

/// A number that is finite and >= 0, zero if the key is missing.
pub(super) fn not_negative_or_zero(
    field: Option<&Spanned<f64>>,
    source: &Source,
) -> Result<f64, SceneError> {
    field.map_or(Ok(0.0), |field| not_negative(field, source))
}

/// An array of `N` finite numbers.
pub(super) fn array<const N: usize>(
    field: &Spanned<Vec<f64>>,
    source: &Source,
) -> Result<[f64; N], SceneError> {
    finite(field.get_ref()).map_err(|what| source.wrong(field.span(), &what))
}

/// An array of 3 finite numbers, zero if the key is missing.
pub(super) fn triple_or_zero(
    field: Option<&Spanned<Vec<f64>>>,
    source: &Source,
) -> Result<[f64; 3], SceneError> {
    field.map_or(Ok([0.0; 3]), |field| array(field, source))
}

/// The velocity of the first body, zero if the key is missing.
pub(super) fn start_velocity(
    field: &Field<WordOr<Vec<f64>>>,
    source: &Source,
) -> Result<StartVelocity, SceneError> {
    let Some(field) = field else {
        return Ok(StartVelocity::Given([0.0; 3]));
    };
    match field.get_ref() {
        WordOr::Word(word) if word == "zero-momentum" => Ok(StartVelocity::ZeroMomentum),
        WordOr::Word(word) => Err(unknown_word(word, field.span(), source)),
        WordOr::Value(values) => finite(values)
            .map(StartVelocity::Given)
            .map_err(|what| source.wrong(field.span(), &what)),
    }
}

/// A rotation as a quaternion of length 1, the identity if the key is missing.
pub(super) fn attitude(
    field: &Field<WordOr<RawRotation>>,
    source: &Source,
) -> Result<[f64; 4], SceneError> {
    const ALIGNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
    let Some(field) = field else {
        return Ok(ALIGNED);
    };
    match field.get_ref() {
        WordOr::Word(word) if word == "aligned" => Ok(ALIGNED),
        WordOr::Word(word) => Err(unknown_word(word, field.span(), source)),
        WordOr::Value(RawRotation::Quaternion(values)) => unit(values, field.span(), source),
        WordOr::Value(RawRotation::AxisAngle(raw)) => axis_angle(raw, field.span(), source),
    }
}

fn unknown_word(word: &str, span: Range<usize>, source: &Source) -> SceneError {
    source.wrong(span, &format!("is {:?}", super::source::quote(word)))
}

/// A quaternion of length 1 up to the digits of published numbers, made exactly so; the scene notes by how much it was not.
fn unit(values: &[f64], span: Range<usize>, source: &Source) -> Result<[f64; 4], SceneError> {
    let quaternion: [f64; 4] = finite(values).map_err(|what| source.wrong(span.clone(), &what))?;
    let length = length(&quaternion);
    let off = (length - 1.0).abs();
    if off > PUBLISHED {
        return Err(source.wrong(span, &format!("has length {length:?}")));
    }
    if off > ROUNDING {
        source.note(span, Correction::Normalised, off);
    }
    Ok(quaternion.map(|x| x / length))
}

/// The quaternion of the rotation about an axis of any length.
fn axis_angle(
    raw: &RawAxisAngle,
    table: Range<usize>,
    source: &Source,
) -> Result<[f64; 4], SceneError> {
    let missing = |key| source.missing(table.clone(), key);
    let axis_field = raw.axis.as_ref().ok_or_else(|| missing("axis"))?;
    let angle_field = raw.angle.as_ref().ok_or_else(|| missing("angle"))?;
    let axis: [f64; 3] = array(axis_field, source)?;
    // Brought to size one first: squares overflow and underflow.
    let largest = axis.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest == 0.0 {
        return Err(source.wrong(axis_field.span(), "has length 0"));
    }
    let axis = axis.map(|x| x / largest);
    let (sin, cos) = (0.5 * number(angle_field, f64::is_finite, source)?).sin_cos();
    let [x, y, z] = axis.map(|x| x / length(&axis) * sin);
    Ok([cos, x, y, z])
}

fn length(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn number(
    field: &Spanned<f64>,
    allowed: fn(f64) -> bool,
    source: &Source,
) -> Result<f64, SceneError> {
    let value = *field.get_ref();
    match value.is_finite() && allowed(value) {
        true => Ok(value),
        false => Err(source.wrong(field.span(), &format!("is {value:?}"))),
    }
}

/// `N` finite numbers, or how the values are not that.
pub(super) fn finite<const N: usize>(values: &[f64]) -> Result<[f64; N], String> {
    let array = <[f64; N]>::try_from(values).map_err(|_| elements(values.len()))?;
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(format!("element {} is {:?}", index + 1, values[index])),
        None => Ok(array),
    }
}

/// The wrong number of elements in words.
pub(super) fn elements(count: usize) -> String {
    match count {
        1 => "has 1 element".to_owned(),
        _ => format!("has {count} elements"),
    }
}
