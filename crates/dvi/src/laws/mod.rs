//! The laws of a discrete Lagrangian and of its integrator, for a test of your own.
//!
//! | question | call |
//! |---|---|
//! | Are the hand-written derivatives those of the value? Is a step solved, symplectic, reversible? | [`check`] |
//! | Is $L_d$ the discrete form of this $L$, to the order at all? | [`check_consistency`] |
//! | Is this a symmetry, and its momentum map kept? | [`check_symmetry`] |
//! | Is the method of the order that it declares? | [`check_order`] |
//! | The same for an integrator that was not made here | [`check_step`], [`check_symplecticity`], [`check_reversibility`] |
//!
//! Every failure names the formula, the component and both numbers.
//!
//! ```
//! use dvi::{Context, Lagrangian, LeftTranslation, Quadrature, System, Variational, laws};
//! use lie::{LieGroup, Mat3, SO3, Scalar, Tangent, Vec3};
//!
//! /// A rigid body with the moments of inertia 1, 2 and 3 kg m².
//! struct Body;
//!
//! impl System for Body {
//!     type Group = SO3;
//! }
//!
//! impl Lagrangian for Body {
//!     fn value<S: Scalar>(&self, _: Context<S>, _: &SO3<S>, omega: &Tangent<3, S>) -> S {
//!         let j = Mat3::diagonal([1.0, 2.0, 3.0]).lift::<S>();
//!         omega.vec3().dot(j * omega.vec3()) * S::from_f64(0.5)
//!     }
//! }
//!
//! let start = Body.state(0.0, SO3::exp(&Tangent([0.3, -0.5, 1.0])), &Tangent([0.2, 1.0, 0.1]))?;
//! let (states, discrete) = ([start.clone()], Body.discretise(Quadrature::Midpoint));
//! laws::check(&discrete, &states, 0.1)?;
//! laws::check_consistency(&discrete, &Body, &states)?;
//! laws::check_symmetry(&discrete, &LeftTranslation(Tangent([0.0, 0.0, 1.0])), &states, 0.1)?;
//! let order = laws::check_order(|| Variational::new(&discrete), &start, 1.0, &[8, 16, 32, 64])?;
//! assert!((order.slope - 2.0).abs() < 0.05);
//!
//! // The spin about a body axis is no symmetry of this body, and the answer says so.
//! let axis = dvi::RightTranslation(Tangent([0.0, 0.0, 1.0]));
//! let error = laws::check_symmetry(&discrete, &axis, &states, 0.1).unwrap_err();
//! assert!(error.to_string().contains("L_d(a g, (a g)^-1 a (g f)) = L_d(g, f)"));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod compare;
mod cyclic;
mod derivatives;
mod displacements;
mod order;
mod steps;
mod symmetry;
mod verdict;

use crate::variational::degenerate;
use crate::{DiscreteLagrangian, State, Variational};
use verdict::examples;

pub use derivatives::check_consistency;
pub use lie::laws::Report;
pub use order::{Order, check_order, distance, observed_order};
pub use steps::{check_reversibility, check_step, check_symplecticity, symplectic_defect};
pub use symmetry::check_symmetry;
pub use verdict::LawError;

/// Checks a discrete Lagrangian on examples, with steps of size `h`.
///
/// - the derivatives $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d$ and $\mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d$
///   against dual numbers and central differences of the value;
/// - where coordinates are declared [cyclic](crate::System::cyclic), that $L_d$ does not depend on them;
/// - an inertia in every direction of the velocity;
/// - where declared symmetric, $L_d(t, g, f, h) = -L_d(t + h, g f, f^{-1}, -h)$;
/// - of the step: both discrete Legendre transforms against the momenta ([`check_step`]), symplecticity
///   ([`check_symplecticity`]) and, where declared symmetric, reversibility ([`check_reversibility`]).
///
/// Formulas are tried on parts of the displacement by which the state moves in the step, so $L_d$ need be defined there only.
///
/// With a [force](crate::Forced), check the Lagrangian without it here, and the whole by [`check_step`] and [`check_order`].
///
/// # Errors
/// [`LawError`] with the first law that fails.
pub fn check<L: DiscreteLagrangian>(
    lagrangian: &L,
    states: &[State<L::Group>],
    h: f64,
) -> Result<Report, LawError> {
    examples(states)?;
    let mut report = Report::default();
    for state in states {
        cyclic::exist(lagrangian, &state.g)?;
        derivatives::check(&mut report, lagrangian, state, h)?;
        if degenerate(lagrangian, state, h, &Default::default()).is_some() {
            let case = format!("{state:?}");
            return Err(LawError::Degenerate { case });
        }
    }
    let mut integrator = Variational::new(lagrangian);
    for state in states {
        steps::legendre(&mut report, &mut integrator, lagrangian, state, h)?;
        if lagrangian.is_symplectic() {
            steps::symplecticity(&mut report, &mut integrator, state, h)?;
        }
        if lagrangian.is_symmetric() {
            steps::reversibility(&mut report, &mut integrator, state, h)?;
        }
    }
    Ok(report)
}
