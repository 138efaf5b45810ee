//! Values of keys: vectors, quaternions and symmetric positive definite matrices.

use toml::Spanned;

use super::error::SceneError;
use super::raw::{Entry, Field};
use super::source::Source;

/// Rows.
type Matrix = [[f64; 3]; 3];

/// How far from 1 the length of an attitude may be before it is normalised.
const UNIT: f64 = 1e-6;

/// How far from symmetric a matrix may be, relative to its largest element.
const SYMMETRIC: f64 = 1e-12;

/// Below this multiple of the diagonal element a pivot is rounding.
const DEFINITE: f64 = 8.0 * f64::EPSILON;

/// A number that is finite and > 0.
pub(super) fn positive(field: &Spanned<f64>, source: &Source) -> Result<f64, SceneError> {
    let value = *field.get_ref();
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(source.wrong(field.span(), &format!("is {value:?}")))
    }
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

/// A quaternion of length 1, the identity if the key is missing.
pub(super) fn attitude(field: &Field<Vec<f64>>, source: &Source) -> Result<[f64; 4], SceneError> {
    let Some(field) = field else {
        return Ok([1.0, 0.0, 0.0, 0.0]);
    };
    let quaternion: [f64; 4] = array(field, source)?;
    let length = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (length - 1.0).abs() <= UNIT {
        Ok(quaternion.map(|x| x / length))
    } else {
        Err(source.wrong(field.span(), &format!("has length {length:?}")))
    }
}

/// A symmetric positive definite matrix, given as such or by its diagonal.
pub(super) fn definite(field: &Spanned<Vec<Entry>>, source: &Source) -> Result<Matrix, SceneError> {
    matrix(field.get_ref())
        .and_then(symmetric)
        .and_then(positive_definite)
        .map_err(|what| source.wrong(field.span(), &what))
}

/// The matrix with this diagonal.
pub(super) fn diagonal([x, y, z]: [f64; 3]) -> Matrix {
    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]
}

fn finite<const N: usize>(values: &[f64]) -> Result<[f64; N], String> {
    let array = <[f64; N]>::try_from(values).map_err(|_| elements(values.len()))?;
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(format!("element {} is {:?}", index + 1, values[index])),
        None => Ok(array),
    }
}

fn elements(count: usize) -> String {
    match count {
        1 => "has 1 element".to_owned(),
        _ => format!("has {count} elements"),
    }
}

fn matrix(entries: &[Entry]) -> Result<Matrix, String> {
    match entries {
        [Entry::Number(x), Entry::Number(y), Entry::Number(z)] => {
            let values = finite(&[*x, *y, *z])?;
            match values.iter().position(|value| *value <= 0.0) {
                Some(index) => Err(format!("element {} is {:?}", index + 1, values[index])),
                None => Ok(diagonal(values)),
            }
        }
        [Entry::Row(x), Entry::Row(y), Entry::Row(z)] => {
            let row = |index: usize, row: &[f64]| {
                finite(row).map_err(|what| format!("row {index} {what}"))
            };
            Ok([row(1, x)?, row(2, y)?, row(3, z)?])
        }
        [_, _, _] => Err("mixes numbers and rows".to_owned()),
        _ => Err(elements(entries.len())),
    }
}

/// The symmetric part of a matrix that is symmetric but for rounding.
fn symmetric(matrix: Matrix) -> Result<Matrix, String> {
    let largest = matrix.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut result = matrix;
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        let (upper, lower) = (matrix[i][j], matrix[j][i]);
        if (upper - lower).abs() > SYMMETRIC * largest {
            let (i, j) = (i + 1, j + 1);
            return Err(format!(
                "not symmetric: row {i} has {upper:?} in column {j}, row {j} has {lower:?} in column {i}"
            ));
        }
        // Halved before the sum, which could overflow.
        let mean = 0.5 * upper + 0.5 * lower;
        (result[i][j], result[j][i]) = (mean, mean);
    }
    Ok(result)
}

/// Checks that the pivots of the factorisation $L D L^T$ are > 0 beyond rounding.
fn positive_definite(matrix: Matrix) -> Result<Matrix, String> {
    let [[a, b, c], [_, d, e], [_, _, f]] = matrix;
    let second = d - b / a * b;
    let mixed = e - b / a * c;
    let third = f - c / a * c - mixed / second * mixed;
    let pivots = [(a, a), (second, d), (third, f)];
    let too_small = |&(pivot, scale): &(f64, f64)| !(pivot.is_normal() && pivot > DEFINITE * scale);
    match pivots.iter().position(too_small) {
        Some(index) => Err(format!(
            "not positive definite: pivot {} is {:?}",
            index + 1,
            pivots[index].0
        )),
        None => Ok(matrix),
    }
}
