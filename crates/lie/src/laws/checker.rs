//! Comparing the two sides of a law.

use core::fmt::Debug;

use super::linear::{basis, filled, vector_size, zero};
use super::verdict::{LawError, Outcome};
use crate::{LieGroup, Scalar, VectorSpace};

/// Roundings that a law may gather, in units of $\varepsilon$ and of the operands' sizes.
///
/// The groups here, in `f64` and `f32`, reach 0.02 to 0.24 of what the two constants allow.
const ROUNDINGS: f64 = 10.0;

/// The same for central differences, in units of $\varepsilon^{2/3}$.
const DIFFERENCE_ROUNDINGS: f64 = 5.0;

/// The largest difference that rounding explains.
pub(super) fn tolerance<S: Scalar>(scale: f64) -> f64 {
    ROUNDINGS * S::EPSILON * scale
}

/// The same where one side is a central difference.
pub(super) fn difference_tolerance<S: Scalar>(scale: f64) -> f64 {
    DIFFERENCE_ROUNDINGS * S::EPSILON.powf(2.0 / 3.0) * scale
}

/// The example at hand, for the message of a failure. Its type is forgotten, so that comparing is compiled once for each type that
/// is compared.
pub type Case<'a> = &'a dyn Fn() -> String;

/// What a check did: it counts the comparisons and keeps the worst.
///
/// [`check`](super::check) returns one; laws of your own start from the default and compare with it.
///
/// ```
/// use lie::laws::Report;
///
/// let mut report = Report::default();
/// let case = || "x = 2".to_string();
/// report.number("x + x = 2 x", &case, 0, (2.0 + 2.0, 2.0 * 2.0), 1e-15)?;
/// assert_eq!((report.comparisons, report.worst), (1, 0.0));
/// # Ok::<(), lie::laws::LawError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Numbers compared.
    pub comparisons: usize,
    /// The largest ratio of a difference to its tolerance; below one.
    pub worst: f64,
}

impl Report {
    /// Compares two numbers, the component of this index of the two sides of a law.
    ///
    /// # Errors
    /// [`LawError::Violated`] where they differ by more than the tolerance, or where one is not a number.
    pub fn number<S: Scalar>(
        &mut self,
        formula: &'static str,
        case: Case<'_>,
        component: usize,
        (left, right): (S, S),
        tolerance: f64,
    ) -> Result<(), LawError> {
        self.comparisons += 1;
        let difference = (left - right).magnitude();
        if difference > 0.0 {
            self.worst = self.worst.max(difference / tolerance);
        }
        // Written so that NaN fails; an infinite tolerance would pass anything.
        if difference <= tolerance && tolerance.is_finite() {
            return Ok(());
        }
        Err(LawError::Violated {
            formula,
            case: case(),
            component,
            left: signed(left),
            right: signed(right),
            tolerance,
        })
    }

    /// Compares two vectors coordinate by coordinate.
    ///
    /// # Errors
    /// As [`number`](Self::number).
    pub fn within<V: VectorSpace>(
        &mut self,
        formula: &'static str,
        case: Case<'_>,
        (left, right): (&V, &V),
        tolerance: f64,
    ) -> Result<(), LawError> {
        let (left, right) = (coordinates(left), coordinates(right));
        self.numbers(formula, case, (&left, &right), tolerance)
    }

    /// Compares numbers one by one.
    pub(super) fn numbers<S: Scalar>(
        &mut self,
        formula: &'static str,
        case: Case<'_>,
        (left, right): (&[S], &[S]),
        tolerance: f64,
    ) -> Outcome {
        let sides = left.iter().zip(right).enumerate();
        for (component, (a, b)) in sides {
            self.number(formula, case, component, (*a, *b), tolerance)?;
        }
        Ok(())
    }

    /// Compares two vectors coordinate by coordinate, up to rounding.
    pub(super) fn vectors<V: VectorSpace>(
        &mut self,
        formula: &'static str,
        case: Case<'_>,
        (left, right): (&V, &V),
        scale: f64,
    ) -> Outcome {
        let tolerance = tolerance::<V::Scalar>(scale);
        self.within(formula, case, (left, right), tolerance)
    }

    /// Compares two elements by the logarithm of $a^{-1} b$, and by $\mathrm{Ad}$ on the basis.
    ///
    /// The second needs no logarithm, the first sees the centre of the group too.
    pub(super) fn elements<G: LieGroup>(
        &mut self,
        formula: &'static str,
        case: Case<'_>,
        (a, b): (&G, &G),
        scale: f64,
    ) -> Outcome {
        let difference = log_of(&a.inverse().compose(b));
        let none = zero(&difference);
        self.vectors(formula, case, (&difference, &none), scale)?;
        basis(&none).iter().try_for_each(|e| {
            let (left, right) = (a.adjoint(e), b.adjoint(e));
            self.vectors(formula, case, (&left, &right), scale * size(b))
        })
    }

    /// The value, which a law says to exist.
    pub(super) fn exists<V, E: Debug>(
        &mut self,
        formula: &'static str,
        case: Case<'_>,
        value: Result<V, E>,
    ) -> Result<V, LawError> {
        value.map_err(|error| LawError::Undefined {
            formula,
            case: case(),
            answer: format!("{error:?}"),
        })
    }
}

/// The logarithm, or one of them.
// Inlined, it would be compiled into every law of every group.
#[inline(never)]
pub(super) fn log_of<G: LieGroup>(g: &G) -> G::Algebra {
    g.log().unwrap_or_else(|e| e.representative)
}

/// One plus the length of the logarithm, by the largest coordinate.
pub(super) fn size<G: LieGroup>(g: &G) -> f64 {
    vector_size(&log_of(g))
}

/// The dual vector whose pairing with $e_i$ is that of $\mu$ with `images[i]`.
pub(super) fn by_pairing<G: LieGroup>(mu: &G::Dual, images: &[G::Algebra]) -> G::Dual {
    filled(mu, &|i| G::pair(mu, &images[i]))
}

pub(super) fn coordinates<V: VectorSpace>(x: &V) -> Vec<V::Scalar> {
    (0..x.dim()).map(|i| x.get(i)).collect()
}

fn signed<S: Scalar>(x: S) -> f64 {
    let size = x.magnitude();
    if (x + S::from_f64(size)).magnitude() > size {
        size
    } else {
        -size
    }
}
