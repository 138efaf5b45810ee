//! Symmetric matrices: positive definite, semidefinite, and inertias of rigid bodies.

use lie::Mat3;

use super::entry::Value;
use super::error::SceneError;
use super::note::{Correction, PUBLISHED, ROUNDING};
use super::values::{finite, has_elements};

/// Rows.
pub(super) type Matrix = [[f64; 3]; 3];

/// Below this multiple of the diagonal element a pivot is rounding.
const DEFINITE: f64 = 8.0 * f64::EPSILON;

/// How far below zero an eigenvalue may be, relative to the matrix.
const SEMIDEFINITE: f64 = 1e-12;

impl Value<'_> {
    /// A symmetric positive definite matrix, given as such or by its diagonal.
    pub fn definite(&self) -> Result<Matrix, SceneError> {
        let matrix = self.symmetric(|x| x > 0.0)?;
        positive_definite(matrix).map_err(|what| self.wrong(&what))
    }

    /// A symmetric positive semidefinite matrix, given as such or by its diagonal.
    pub fn semidefinite(&self) -> Result<Matrix, SceneError> {
        let matrix = self.symmetric(|x| x >= 0.0)?;
        match is_semidefinite(matrix) {
            true => Ok(matrix),
            false => Err(self.wrong("not positive semidefinite")),
        }
    }

    /// A matrix that is symmetric up to the digits of published numbers, made exactly so; the scene notes by how much it was not.
    fn symmetric(&self, on_diagonal: fn(f64) -> bool) -> Result<Matrix, SceneError> {
        let elements = self.elements()?;
        let elements: Result<Vec<_>, _> = elements.iter().map(element).collect();
        let elements = elements.map_err(|_| self.wrong("wrong type"))?;
        let (matrix, off) = matrix(&elements, on_diagonal)
            .and_then(symmetric_part)
            .map_err(|what| self.wrong(&what))?;
        if off > ROUNDING {
            self.note(Correction::Symmetrised, off);
        }
        Ok(matrix)
    }
}

/// An element of a diagonal, or a row of a matrix.
enum Element {
    Number(f64),
    Row(Vec<f64>),
}

fn element(value: &Value) -> Result<Element, SceneError> {
    match value.is_array() {
        true => value.numbers().map(Element::Row),
        false => value.number().map(Element::Number),
    }
}

/// The sum, if it is finite and positive definite.
pub(super) fn sum(a: Matrix, b: Matrix) -> Option<Matrix> {
    let sum = [0, 1, 2].map(|i| [0, 1, 2].map(|j| a[i][j] + b[i][j]));
    positive_definite(sum).ok()
}

/// Whether no principal moment of this inertia exceeds the sum of the two others beyond rounding.
pub(super) fn is_of_a_rigid_body(inertia: Matrix) -> bool {
    let inertia = inertia.map(|row| row.map(|x| 0.25 * x));
    let half_trace = 0.5 * (inertia[0][0] + inertia[1][1] + inertia[2][2]);
    let at = |i: usize, j: usize| f64::from(i == j) * half_trace - inertia[i][j];
    is_semidefinite([0, 1, 2].map(|i| [0, 1, 2].map(|j| at(i, j))))
}

fn matrix(elements: &[Element], on_diagonal: fn(f64) -> bool) -> Result<Matrix, String> {
    match elements {
        [Element::Number(x), Element::Number(y), Element::Number(z)] => {
            let values = finite(&[*x, *y, *z])?;
            match values.iter().position(|value| !on_diagonal(*value)) {
                Some(index) => Err(format!("element {} is {:?}", index + 1, values[index])),
                None => Ok(Mat3::diagonal(values).0),
            }
        }
        [Element::Row(x), Element::Row(y), Element::Row(z)] => {
            let row = |index: usize, row: &[f64]| {
                finite(row).map_err(|what| format!("row {index} {what}"))
            };
            Ok([row(1, x)?, row(2, y)?, row(3, z)?])
        }
        [_, _, _] => Err("mixes numbers and rows".to_owned()),
        _ => Err(has_elements(elements.len())),
    }
}

/// The symmetric part, and how far from it the matrix is relative to its largest element.
fn symmetric_part(matrix: Matrix) -> Result<(Matrix, f64), String> {
    let largest = largest(&matrix);
    let (mut result, mut off) = (matrix, 0.0_f64);
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        let (upper, lower) = (matrix[i][j], matrix[j][i]);
        let difference = (upper - lower).abs();
        if difference > PUBLISHED * largest {
            let (i, j) = (i + 1, j + 1);
            return Err(format!(
                "not symmetric: row {i} has {upper:?} in column {j}, row {j} has {lower:?} in column {i}"
            ));
        }
        // Halved before the sum, which could overflow.
        let mean = 0.5 * upper + 0.5 * lower;
        (result[i][j], result[j][i]) = (mean, mean);
        // Two equal entries may both be zero, and the largest one too.
        if difference > 0.0 {
            off = off.max(difference / largest);
        }
    }
    Ok((result, off))
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

/// By the pivots of the matrix shifted by what is allowed below zero: those of a singular one are rounding.
fn is_semidefinite(matrix: Matrix) -> bool {
    let largest = largest(&matrix);
    let at = |i: usize, j: usize| matrix[i][j] / largest + f64::from(i == j) * SEMIDEFINITE;
    let shifted = [0, 1, 2].map(|i| [0, 1, 2].map(|j| at(i, j)));
    largest == 0.0 || positive_definite(shifted).is_ok()
}

fn largest(matrix: &Matrix) -> f64 {
    matrix.iter().flatten().fold(0.0, |m, x| m.max(x.abs()))
}
