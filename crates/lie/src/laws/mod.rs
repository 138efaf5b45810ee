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

mod adjoint;
mod chart;
mod checker;
mod differentials;
mod dual_differentials;
mod examples;
mod group;
mod linear;
mod maps;
mod vectors;
mod verdict;

use crate::LieGroup;
use checker::size;
use examples::Examples;
use linear::length;

pub use checker::{Case, Report};
pub use verdict::LawError;

/// Tests the laws of a group on examples.
///
/// It finds mistakes, it proves nothing: a group may be right on the examples and wrong elsewhere. Elements and
/// velocities are combined in all pairs (and triples, where a law needs them), so a handful is enough. Take the
/// identity's neighbourhood (0, 1e-8), generic ones, and rotations close to $\pi$, none past it by much. Zero and the
/// basis of the algebra are added to the velocities; the momenta are the dual basis and the velocities, reversed.
///
/// Tested:
/// - the vector spaces: every method of algebra and dual against `get` and `set`;
/// - the group axioms, and that an element whose numbers are off by $\delta$ is back on the group to $O(\delta^2)$
///   once normalised. A group with redundant numbers, a matrix say, must not leave `normalize` empty;
/// - $\exp$, $\log$ and the Cayley map: one-parameter subgroups, the inverses, $\log$ the shortest,
///   $\mathrm{cay}\,\xi = \exp\xi + O(\xi^3)$, the square root and that it lies halfway;
/// - $\mathrm{Ad}$ a homomorphism and the derivative of conjugation, $\mathrm{ad}$ its derivative, antisymmetry, the
///   Jacobi identity, and the pairings that define $\mathrm{Ad}^\ast$ and $\mathrm{ad}^\ast$;
/// - left- and right-trivialised differentials of both retractions and their inverses, the identity at zero, against
///   dual numbers and against central differences;
/// - the transposes of these differentials by the pairings that define them, and the gradients of
///   $\langle\mu, \mathrm d\tau_\xi^{-1} \eta\rangle$ against dual numbers and against central differences;
/// - canonical coordinates of both charts, and compensated products;
/// - the `*_into` forms against the plain ones, into an element or vector that differs.
///
/// Elements are equal where $\log(a^{-1} b) = 0$ and $\mathrm{Ad}\_a = \mathrm{Ad}\_b$ on the basis. Tolerances are a few
/// `eps` of the scalar (`eps^(2/3)` against central differences) times the sizes of the operands, which assumes
/// coordinates in which the structure constants are of order one.
///
/// # Errors
/// [`LawError::NoExamples`] without an element other than the identity and a velocity other than zero. A group of
/// dimension zero (an empty [`Power`](crate::Power)) never has them: there is nothing to test.
/// [`LawError::Violated`] or [`LawError::Undefined`] with the first law that fails.
pub fn check<G>(elements: &[G], velocities: &[G::Algebra]) -> Result<Report, LawError>
where
    G: LieGroup<WithScalar<<G as LieGroup>::Scalar> = G>,
{
    if !velocities.iter().any(|xi| length(xi) > 0.0) {
        return Err(LawError::NoExamples {
            what: "velocity other than zero",
        });
    }
    if !elements.iter().any(|g| size(g) > 1.0) {
        return Err(LawError::NoExamples {
            what: "element other than the identity",
        });
    }
    let (examples, mut report) = (Examples::new(elements, velocities), Report::default());
    vectors::check(&mut report, &elements[0].zero_algebra())?;
    vectors::check(&mut report, &elements[0].zero_dual())?;
    group::check(&mut report, &examples)?;
    maps::check(&mut report, &examples)?;
    adjoint::check(&mut report, &examples)?;
    differentials::check(&mut report, &examples)?;
    dual_differentials::check(&mut report, &examples)?;
    chart::check(&mut report, &examples)?;
    Ok(report)
}
