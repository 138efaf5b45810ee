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
//! use dvi::{DiscreteLagrangian, Lagrangian, LeftTranslation, Midpoint, Variational, laws};
//! use lie::{LieGroup, Mat3, SO3, Scalar, Tangent, Vec3};
//!
//! /// A rigid body with the moments of inertia 1, 2 and 3 kg m².
//! struct Body;
//!
//! impl Lagrangian for Body {
//!     type Group = SO3;
//!     fn value<S: Scalar>(&self, _: &SO3<S>, omega: &Tangent<3, S>) -> S {
//!         let j = Mat3::diagonal([1.0, 2.0, 3.0]).lift::<S>();
//!         omega.vec3().dot(j * omega.vec3()) * S::from_f64(0.5)
//!     }
//! }
//!
//! let start = Body.state(0.0, SO3::exp(&Tangent([0.3, -0.5, 1.0])), &Tangent([0.2, 1.0, 0.1]))?;
//! let (states, discrete) = ([start.clone()], Body.discretise::<Midpoint>());
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

use core::ops::Range;

use thiserror::Error;

use crate::newton::degenerate;
use crate::{DiscreteLagrangian, State, StepError, Variational};
use compare::Checker;

pub use derivatives::check_consistency;
pub use order::{Order, check_order, distance, observed_order};
pub use steps::{check_reversibility, check_step, check_symplecticity, symplectic_defect};
pub use symmetry::check_symmetry;

/// What a check did.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Numbers compared.
    pub comparisons: usize,
    /// The largest ratio of a difference to its tolerance; below one.
    pub worst: f64,
}

/// Why a check did not pass.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LawError {
    /// There was nothing to try the laws on.
    #[error("no state to check on: give at least one, laws cannot pass on nothing")]
    NoExamples,
    /// The errors of the runs are those of rounding, or there is one run only: they show no order.
    #[error(
        "fewer than two runs have errors above rounding (step sizes and errors: {errors:?}): give more runs, of longer steps"
    )]
    TooFewRuns {
        /// Step sizes, s, and errors of all runs.
        errors: Vec<(f64, f64)>,
    },
    /// A law does not hold.
    #[error(
        "the law {formula} fails: component {component} is {left:.17e} on the left and {right:.17e} on the right (tolerance {tolerance:.1e}), for {case}"
    )]
    Violated {
        /// The law.
        formula: &'static str,
        /// The example it fails on.
        case: String,
        /// The coordinate.
        component: usize,
        /// The left-hand side there.
        left: f64,
        /// The right-hand side there.
        right: f64,
        /// The largest difference that rounding and the solver's tolerance explain.
        tolerance: f64,
    },
    /// The kinetic energy has no inertia in some direction of the velocity.
    #[error(
        "the Lagrangian is degenerate: its kinetic energy has no inertia in some direction of the velocity, so a momentum there has no velocity; give it a small one, as a point mass on a rod needs about the rod (for {case})"
    )]
    Degenerate {
        /// The state it was tried at.
        case: String,
    },
    /// The coordinates that are declared cyclic are not all there.
    #[error(
        "cyclic() names the coordinates {} to {}, but the group has {dimension}, counted from 0; name those of a factor R^m that g does not enter by", cyclic.start, cyclic.end - 1
    )]
    Cyclic {
        /// What [`cyclic`](DiscreteLagrangian::cyclic) returns.
        cyclic: Range<usize>,
        /// The dimension of the group.
        dimension: usize,
    },
    /// The observed order is not the declared one.
    #[error(
        "the observed order is {observed:.3}, the declared one {declared}; step sizes and errors: {errors:?}; a higher one is that of steps too long for the motion"
    )]
    Order {
        /// What the integrator declares.
        declared: u32,
        /// The slope of the log–log fit.
        observed: f64,
        /// Step sizes, s, and errors of the fit.
        errors: Vec<(f64, f64)>,
    },
    /// A step that a law speaks of was refused.
    #[error("a step was refused: {0}")]
    Step(#[from] StepError),
}

type Outcome = Result<(), LawError>;

/// Checks a discrete Lagrangian on examples, with steps of size `h`.
///
/// - the derivatives $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d$ and $\mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d$
///   against dual numbers and central differences of the value;
/// - where coordinates are declared [cyclic](DiscreteLagrangian::cyclic), that $L_d$ does not depend on them;
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
    let mut checker = Checker::default();
    for state in states {
        cyclic::exist(lagrangian, &state.g)?;
        derivatives::check(&mut checker, lagrangian, state, h)?;
        if degenerate(lagrangian, state, h).is_some() {
            let case = format!("{state:?}");
            return Err(LawError::Degenerate { case });
        }
    }
    let mut integrator = Variational::new(lagrangian);
    for state in states {
        steps::legendre(&mut checker, &mut integrator, lagrangian, state, h)?;
        if lagrangian.is_symplectic() {
            steps::symplecticity(&mut checker, &mut integrator, state, h)?;
        }
        if lagrangian.is_symmetric() {
            steps::reversibility(&mut checker, &mut integrator, state, h)?;
        }
    }
    Ok(checker.report())
}

fn examples<T>(states: &[T]) -> Outcome {
    match states {
        [] => Err(LawError::NoExamples),
        _ => Ok(()),
    }
}
