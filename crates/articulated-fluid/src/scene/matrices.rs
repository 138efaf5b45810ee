//! Symmetric matrices: positive definite, semidefinite, and inertias of rigid bodies.

use lie::Mat3;

use super::entry::Value;
use super::error::SceneError;
use super::note::{Correction, PUBLISHED, ROUNDING};
use super::values::{finite, has_elements};

/// Rows.
pub(super) type Matrix<const N: usize = 3> = [[f64; N]; N];

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

    /// A symmetric positive semidefinite matrix of 6 rows.
    pub fn semidefinite_of_six(&self) -> Result<Matrix<6>, SceneError> {
        let matrix = self.noted(symmetric_part(
            rows(&self.parts()?).map_err(|what| self.wrong(&what))?,
        ))?;
        match is_semidefinite(matrix) {
            true => Ok(matrix),
            false => Err(self.wrong("not positive semidefinite")),
        }
    }

    fn symmetric(&self, on_diagonal: fn(f64) -> bool) -> Result<Matrix, SceneError> {
        let elements = self.parts()?;
        self.noted(matrix(&elements, on_diagonal).and_then(symmetric_part))
    }

    fn parts(&self) -> Result<Vec<Element>, SceneError> {
        let elements = self.elements()?;
        let elements: Result<Vec<_>, _> = elements.iter().map(element).collect();
        elements.map_err(|_| self.wrong("wrong type"))
    }

    /// A matrix that is symmetric up to the digits of published numbers, made exactly so; the scene notes by how much it was not.
    fn noted<const N: usize>(
        &self,
        found: Result<(Matrix<N>, f64), String>,
    ) -> Result<Matrix<N>, SceneError> {
        let (matrix, off) = found.map_err(|what| self.wrong(&what))?;
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
        elements => rows(elements),
    }
}

fn rows<const N: usize>(elements: &[Element]) -> Result<Matrix<N>, String> {
    let elements: &[Element; N] = elements
        .try_into()
        .map_err(|_| has_elements(elements.len()))?;
    let mut matrix = [[0.0; N]; N];
    for (i, (element, row)) in elements.iter().zip(&mut matrix).enumerate() {
        *row = match element {
            Element::Row(row) => finite(row).map_err(|what| format!("row {} {what}", i + 1))?,
            Element::Number(_) => return Err("mixes numbers and rows".to_owned()),
        };
    }
    Ok(matrix)
}

/// The symmetric part, and how far from it the matrix is relative to the largest element of its unit.
fn symmetric_part<const N: usize>(matrix: Matrix<N>) -> Result<(Matrix<N>, f64), String> {
    let (mut result, mut off) = (matrix, 0.0_f64);
    for (i, j) in (0..N).flat_map(|i| (i + 1..N).map(move |j| (i, j))) {
        let largest = block(&matrix, i, j).max(block(&matrix, j, i));
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
fn positive_definite<const N: usize>(matrix: Matrix<N>) -> Result<Matrix<N>, String> {
    let mut rest = matrix;
    for k in 0..N {
        let pivot = rest[k][k];
        if !(pivot.is_normal() && pivot > DEFINITE * matrix[k][k]) {
            let k = k + 1;
            return Err(format!("not positive definite: pivot {k} is {pivot:?}"));
        }
        let row = rest[k];
        for (i, left) in rest.iter_mut().enumerate().skip(k + 1) {
            let factor = row[i] / pivot;
            (k + 1..N).for_each(|j| left[j] -= factor * row[j]);
        }
    }
    Ok(matrix)
}

/// By the pivots of the matrix shifted by what is allowed below zero: those of a singular one are rounding.
fn is_semidefinite<const N: usize>(matrix: Matrix<N>) -> bool {
    // Each unit on its own: a block of zeros must be zero all along.
    let size = |i: usize| match block(&matrix, i, i) {
        0.0 => 1.0,
        largest => largest.sqrt(),
    };
    let mut shifted = matrix;
    for (i, row) in shifted.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = *entry / size(i) / size(j) + f64::from(i == j) * SEMIDEFINITE;
        }
    }
    positive_definite(shifted).is_ok()
}

/// The largest element of those with the same unit.
fn block<const N: usize>(matrix: &Matrix<N>, i: usize, j: usize) -> f64 {
    let part = |i: usize| 3 * (i / 3)..3 * (i / 3) + 3;
    let entries = matrix[part(i)].iter().flat_map(|row| &row[part(j)]);
    entries.fold(0.0, |m, x| m.max(x.abs()))
}
