//! What was corrected in a scene file, within the rounding of published numbers.

use std::fmt;

use serde::Serialize;

/// How far from exact a value may be and still be corrected: published numbers have four digits.
pub(super) const PUBLISHED: f64 = 1e-3;

/// A correction no larger than this is the rounding of doubles, and not worth a note.
pub(super) const ROUNDING: f64 = 1e-12;

/// A value of a scene file that was corrected; displayed as one line.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Note {
    /// The name of the body.
    pub body: String,
    /// The key as a dotted path such as `body.total_inertia`.
    pub key: String,
    /// Line of the key, from 1.
    pub line: usize,
    /// What was done.
    pub correction: Correction,
    /// How far off the value was, relative; at most $10^{-3}$. See [`Correction`].
    pub off: f64,
}

/// How a value was made exact.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Correction {
    /// A matrix $A$ was replaced by $\frac12 (A + A^T)$. It was off by $\max |A_{ij} - A_{ji}| / \max |A_{ij}|$.
    Symmetrised,
    /// A quaternion $q$ was replaced by $q / |q|$. It was off by $\bigl| |q| - 1 \bigr|$.
    Normalised,
}

impl fmt::Display for Note {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            body,
            key,
            line,
            correction,
            off,
        } = self;
        write!(formatter, "line {line}: {key} of {body:?} was ")?;
        match correction {
            Correction::Symmetrised => write!(
                formatter,
                "symmetrised: mirrored entries differed by up to {off:.1e} of the largest entry"
            ),
            Correction::Normalised => write!(
                formatter,
                "normalised: its length differed from 1 by {off:.1e}"
            ),
        }
    }
}
