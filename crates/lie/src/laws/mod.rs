//! The laws of a Lie group, for any group: call [`check`] in a test of your own.
//!
//! ```
//! use lie::{LieGroup, SO3, Tangent, laws};
//!
//! let velocities = [Tangent([0.3, -0.2, 0.5]), Tangent([1e-8, 0.0, 0.0]), Tangent([0.0, 3.1, 0.0])];
//! let elements = velocities.map(|xi| SO3::<f64>::exp(&xi));
//! let report = laws::check(&elements, &velocities)?;
//! assert!(report.comparisons > 100);
//! # Ok::<(), laws::LawError>(())
//! ```

mod algebra;
mod differentials;

use thiserror::Error;

use crate::{LieGroup, Scalar, VectorSpace};

/// Roundings that a law may gather, in units of $\varepsilon$ and of the operands' sizes.
const ROUNDINGS: f64 = 300.0;

/// What [`check`] did.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Numbers compared.
    pub comparisons: usize,
    /// The largest ratio of a difference to its tolerance; below one.
    pub worst: f64,
}

/// Why a group did not pass.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LawError {
    /// There was nothing to prove the laws on.
    #[error("no {what} among the examples: give at least one, laws cannot pass on nothing")]
    NoExamples {
        /// What was missing.
        what: &'static str,
    },
    /// A law does not hold.
    #[error(
        "the law {formula} fails for {case}: component {component} is {left:.17e} on the left and {right:.17e} on the right (tolerance {tolerance:.1e})"
    )]
    Violated {
        /// The law.
        formula: &'static str,
        /// The example it fails on.
        case: String,
        /// The coordinate that differs most.
        component: usize,
        /// The left-hand side there.
        left: f64,
        /// The right-hand side there.
        right: f64,
        /// The largest difference that rounding explains.
        tolerance: f64,
    },
}

/// Proves the laws of a group on examples.
///
/// Elements and velocities are combined in all pairs (and triples, where a law needs them), so a handful is enough:
/// take the identity's neighbourhood (0, 1e-8), generic ones, and rotations close to $\pi$, none past it by much.
/// The momenta are made from the velocities.
///
/// Checked: the group axioms; $\exp$, $\log$ and the Cayley map with their inverses; $\mathrm{Ad}$ a homomorphism,
/// $\mathrm{ad}$ its derivative, antisymmetry and the Jacobi identity; the pairings that define $\mathrm{Ad}^\ast$ and
/// $\mathrm{ad}^\ast$; left- and right-trivialised differentials of both retractions and their inverses, against dual
/// numbers and against central differences; the `*_into` forms against the plain ones.
///
/// Tolerances: `300 eps` times the sizes of the operands, and `eps^(2/3)` in place of `eps` for central differences.
///
/// # Errors
/// [`LawError::NoExamples`] without an element other than the identity and a velocity other than zero;
/// [`LawError::Violated`] with the first law that fails.
pub fn check<G>(elements: &[G], velocities: &[G::Algebra]) -> Result<Report, LawError>
where
    G: LieGroup<WithScalar<<G as LieGroup>::Scalar> = G>,
{
    if !velocities.iter().any(|xi| xi.max_magnitude() > 0.0) {
        return Err(LawError::NoExamples {
            what: "velocity other than zero",
        });
    }
    if !elements.iter().any(|g| size(g) > 1.0) {
        return Err(LawError::NoExamples {
            what: "element other than the identity",
        });
    }
    let mut checker = Checker {
        comparisons: 0,
        worst: 0.0,
    };
    algebra::check(&mut checker, elements, velocities)?;
    differentials::check(&mut checker, elements, velocities)?;
    Ok(Report {
        comparisons: checker.comparisons,
        worst: checker.worst,
    })
}

type Outcome = Result<(), LawError>;

struct Checker {
    comparisons: usize,
    worst: f64,
}

impl Checker {
    /// Compares two vectors coordinate by coordinate.
    fn vectors<V: VectorSpace>(
        &mut self,
        formula: &'static str,
        case: impl Fn() -> String,
        left: &V,
        right: &V,
        scale: f64,
    ) -> Outcome {
        let tolerance = ROUNDINGS * V::Scalar::EPSILON * scale;
        self.within(formula, case, left, right, tolerance)
    }

    fn within<V: VectorSpace>(
        &mut self,
        formula: &'static str,
        case: impl Fn() -> String,
        left: &V,
        right: &V,
        tolerance: f64,
    ) -> Outcome {
        for component in 0..left.dim() {
            let (a, b) = (left.get(component), right.get(component));
            self.comparisons += 1;
            let ratio = (a - b).magnitude() / tolerance;
            self.worst = self.worst.max(ratio);
            // Written so that NaN fails.
            if ratio.is_nan() || ratio > 1.0 {
                let (left, right) = (signed(a), signed(b));
                return Err(LawError::Violated {
                    formula,
                    case: case(),
                    component,
                    left,
                    right,
                    tolerance,
                });
            }
        }
        Ok(())
    }

    /// Compares two elements by the logarithm of $a^{-1} b$.
    fn elements<G: LieGroup>(
        &mut self,
        formula: &'static str,
        case: impl Fn() -> String,
        a: &G,
        b: &G,
        scale: f64,
    ) -> Outcome {
        let difference = log_of(&a.inverse().compose(b));
        self.vectors(formula, case, &difference, &difference.zero_like(), scale)
    }
}

/// The logarithm, or one of them.
fn log_of<G: LieGroup>(g: &G) -> G::Algebra {
    g.log().unwrap_or_else(|e| e.representative)
}

/// One plus the length of the logarithm, by the largest coordinate.
fn size<G: LieGroup>(g: &G) -> f64 {
    1.0 + log_of(g).max_magnitude()
}

fn vector_size<V: VectorSpace>(x: &V) -> f64 {
    1.0 + x.max_magnitude()
}

fn signed<S: Scalar>(x: S) -> f64 {
    let size = x.magnitude();
    if (x + S::from_f64(size)).magnitude() > size {
        size
    } else {
        -size
    }
}

/// A momentum for each velocity: its coordinates in reverse.
fn momentum<G: LieGroup>(g: &G, xi: &G::Algebra) -> G::Dual {
    let (mut mu, n) = (g.zero_dual(), xi.dim());
    (0..n).for_each(|i| mu.set(i, xi.get(n - 1 - i)));
    mu
}

fn scaled<V: VectorSpace>(x: &V, a: f64) -> V {
    let mut y = x.zero_like();
    y.add_scaled(V::Scalar::from_f64(a), x);
    y
}

fn sum<V: VectorSpace>(x: &V, y: &V) -> V {
    let mut z = x.clone();
    z.add_scaled(V::Scalar::from_f64(1.0), y);
    z
}
