//! Values of keys: numbers, vectors and rotations.

use super::entry::{Table, Value};
use super::error::SceneError;
use super::note::{Correction, PUBLISHED, ROUNDING};
use super::source::quote;

impl Value<'_> {
    /// A number that is finite.
    pub fn finite(&self) -> Result<f64, SceneError> {
        self.number_that(|_| true)
    }

    /// A number that is finite and > 0.
    pub fn positive(&self) -> Result<f64, SceneError> {
        self.number_that(|value| value > 0.0)
    }

    /// A number that is finite and >= 0.
    pub fn not_negative(&self) -> Result<f64, SceneError> {
        self.number_that(|value| value >= 0.0)
    }

    /// An array of `N` finite numbers.
    pub fn array<const N: usize>(&self) -> Result<[f64; N], SceneError> {
        finite(&self.numbers()?).map_err(|what| self.wrong(&what))
    }

    /// An array of 3 finite numbers >= 0.
    pub fn not_negative_array(&self) -> Result<[f64; 3], SceneError> {
        let numbers: [f64; 3] = self.array()?;
        match numbers.iter().find(|x| **x < 0.0) {
            None => Ok(numbers),
            Some(x) => Err(self.wrong(&format!("has {x:?}"))),
        }
    }

    /// The error that a `word` is none of those expected.
    pub fn unknown_word(&self, word: &str) -> SceneError {
        self.wrong(&format!("is {:?}", quote(word)))
    }

    /// A rotation as a quaternion of length 1.
    pub fn attitude(&self) -> Result<[f64; 4], SceneError> {
        match self.word() {
            Some("aligned") => Ok([1.0, 0.0, 0.0, 0.0]),
            Some(word) => Err(self.unknown_word(word)),
            None if self.is_table() => axis_angle(&self.table()?),
            None => self.unit(),
        }
    }

    /// A quaternion of length 1 up to the digits of published numbers, made exactly so; the scene notes by how much it was not.
    fn unit(&self) -> Result<[f64; 4], SceneError> {
        let quaternion: [f64; 4] = self.array()?;
        let length = length(&quaternion);
        let off = (length - 1.0).abs();
        if off > PUBLISHED {
            return Err(self.wrong(&format!("has length {length:?}")));
        }
        if off > ROUNDING {
            self.note(Correction::Normalised, off);
        }
        Ok(quaternion.map(|x| x / length))
    }

    fn number_that(&self, allowed: fn(f64) -> bool) -> Result<f64, SceneError> {
        let value = self.number()?;
        match value.is_finite() && allowed(value) {
            true => Ok(value),
            false => Err(self.wrong(&format!("is {value:?}"))),
        }
    }
}

/// The quaternion of the rotation about an axis of any length.
fn axis_angle(table: &Table) -> Result<[f64; 4], SceneError> {
    let (axis_value, angle) = (table.require("axis")?, table.require("angle")?);
    let axis: [f64; 3] = axis_value.array()?;
    // Brought to size one first: squares overflow and underflow.
    let largest = axis.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest == 0.0 {
        return Err(axis_value.wrong("has length 0"));
    }
    let axis = axis.map(|x| x / largest);
    let (sin, cos) = (0.5 * angle.number_that(f64::is_finite)?).sin_cos();
    let [x, y, z] = axis.map(|x| x / length(&axis) * sin);
    Ok([cos, x, y, z])
}

fn length(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// `N` finite numbers, or how the values are not that.
pub(super) fn finite<const N: usize>(values: &[f64]) -> Result<[f64; N], String> {
    let array = <[f64; N]>::try_from(values).map_err(|_| has_elements(values.len()))?;
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(format!("element {} is {:?}", index + 1, values[index])),
        None => Ok(array),
    }
}

/// The wrong number of elements in words.
pub(super) fn has_elements(count: usize) -> String {
    match count {
        1 => "has 1 element".to_owned(),
        _ => format!("has {count} elements"),
    }
}
