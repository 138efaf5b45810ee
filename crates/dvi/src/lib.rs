//! Variational integrators on Lie groups: from a Lagrangian to a stepping map, and the laws that it obeys.
//!
//! Write one value, the Lagrangian $L(g, \xi)$ or a discrete one $L_d(g_k, f_k)$, the action of a step from $g_k$ to
//! $g_{k+1} = g_k f_k$. An integrator steps it: the group, the symplectic form and the momentum maps are kept, because the map
//! is the extremum of a discrete action.
//!
//! | what | mathematics | code |
//! |---|---|---|
//! | Lagrangian, Legendre transform | $L(g, \xi)$, $\mu = \mathbf D_\xi L$ | [`Lagrangian`] |
//! | discrete Lagrangian | $L_d(g, f)$ | [`DiscreteLagrangian::value`], or [`Lagrangian::discretise`] by a [`Quadrature`] rule |
//! | its derivatives | $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d$, $\mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d$ | [`DiscreteLagrangian::derivatives`], of the recorded value unless given |
//! | Hamilton's equations | $\dot g = g \xi$, $\dot \mu = \mathrm{ad}^\ast_\xi \mu + \tau$ | [`ContinuousSystem`], or [`Lagrangian::hamiltonian`] |
//! | forces | $f_d^-$, $f_d^+$; $F$ | [`DiscreteForce`], [`Force`], [`Forced`] |
//!
//! | integrator | order | symmetric | from |
//! |---|---|---|---|
//! | [`Variational`] | that of $L_d$ | where $L_d$ is | a discrete Lagrangian |
//! | [`Composition`] | 2, 4, 6, 8 | yes | a discrete Lagrangian and its [`Adjoint`] |
//! | [`Gauss`] | 2, 4, …, 16 | no | a continuous system |
//!
//! | of an integrator | mathematics | code |
//! |---|---|---|
//! | Hamiltonian form | $(g_k, \mu_k) \mapsto (g_{k+1}, \mu_{k+1})$ | [`Integrator::step`]; between steps, [`Integrator::peek`] |
//! | Lagrangian form | $(g_k, f_k) \mapsto (g_{k+1}, f_{k+1})$, (25)–(26) | [`Variational::step_pair`] |
//! | discrete Legendre transforms | $\mathbb F^- L_d$, $\mathbb F^+ L_d$ | [`legendre_minus`], [`legendre_plus`], [`Variational::displacement`] |
//! | derivative of the flow | $\partial (g_T, \mu_T) / \partial (g_0, \mu_0, F)$ | [`FirstVariation::step_varied`] |
//! | momentum map of a symmetry | $\langle \mu, g^{-1} \frac{d}{ds} \Phi_s(g) \rangle$ | [`Symmetry`], [`momentum_map`] |
//! | laws | derivatives, order, symplecticity, reversibility, invariance | [`laws`] |
//!
//! Equation numbers are those of T. Lee, M. Leok, N. H. McClamroch, *Dynamics of connected rigid bodies in a perfect
//! fluid* (2009). The print of (25) has $\mathrm{Ad}^\ast_{f_{k+1}}$ where $\mathrm{Ad}^\ast_{f_{k+1}^{-1}}$ is meant.
//!
//! # When a step is solved
//! Sizes are compared within one unit only: angles with angles, and the vectors of each factor $\mathbb{R}^n$ among themselves
//! ([`lie::Units`]). A light body is judged by its own momentum. So a step depends neither on what is called a metre, nor on the ratio of masses.
//!
//! Rounding is measured, not guessed: where an iteration no longer gains, the arguments are moved in their last places, and what that
//! changes is what rounding may leave. The state after a step is in the domain of the Lagrangian, or the step is refused with
//! [`Cause::NotFinite`]. Where the kinetic energy has no inertia in some direction, every integrator says
//! [`Cause::Degenerate`] and names it; Lagrangians that are linear in a velocity are not supported.
//!
//! # How a step is solved
//! For [`Gauss`] see there. Of a discrete Lagrangian, the unknown is $c$ with $f_k = \tau(c)$, $\tau$ the Cayley map. The balance of momenta is brought below
//! a tolerance, starting from an extrapolation of the steps before. The matrix of the iteration is the inertia of a model that
//! [solves it fast](DiscreteLagrangian::HAS_INERTIA); else Newton's, from dual numbers, is kept until convergence slows. It is sparse where the
//! balance is: a chain, a tree or a ring of many bodies whose neighbours are tied steps in proportion to their number.
//!
//! # How derivatives come about
//! A value that is all a user has written is recorded at the first step, by [`trace`], and differentiated in reverse: a gradient costs a few
//! values. It is recorded again where the configuration has another shape; a [parameter](System::parameters) that changes needs no new recording.
//! What a value reads from elsewhere, and may change, must be such a parameter. A value that looks at a number, to branch on it say, cannot be
//! recorded: its derivatives come from dual numbers, which cost much more. [`StepReport::means`] tells which of the two it is, and why;
//! [`TracedSystem::new`] asks for the recording and gives the reason as an error.
//!
//! The balance of a long step has many roots, and the motion's is the one that grows from no displacement at $h = 0$. There the balance's
//! matrix is the inertia; where the motion's root ends it meets another and the matrix is singular, so that beyond, a pivot has another sign. A root with
//! such a pivot is not taken, nor one that Newton's method has found by a residual that does not fall. The solution is then followed from shorter
//! steps. Where it ends before the step's size, the step is refused. This is evidence and no proof. Where a force changes much within a step,
//! several roots may have the inertia's signs. The one that the steps before lead to is then taken.
//!
//! The new momentum is the coadjoint transport of the old one, not a difference quotient. So momentum maps hold to rounding
//! even at a loose tolerance. They do not tell whether the step was solved: the [`StepReport`]'s residual does.

mod composition;
mod gauss;
pub mod laws;
mod numerics;
mod pilot;
mod step;
mod system;
mod variation;
mod variational;

pub use composition::Composition;
pub use gauss::{Ensemble, Gauss};
pub use pilot::{Pilot, PilotError};
pub use step::{Cause, Hint, Integrator, Path, StepError, StepReport, check_momentum, check_step};
pub use system::{
    Adjoint, AdjointWorkspace, Context, ContinuousSystem, Derivatives, DiscreteForce,
    DiscreteLagrangian, Discretised, DiscretisedWorkspace, DualSystem, Force, Forced,
    ForcedWorkspace, HamiltonianSystem, HamiltonianWorkspace, Lagrangian, LeftTranslation,
    LegendreWorkspace, Means, Pair, Quadrature, Recording, RightTranslation, ShapeError, State,
    Still, Symmetry, System, TracedError, TracedSystem, TracedWorkspace, legendre_minus,
    legendre_plus, momentum_map,
};
pub use variation::{FirstVariation, Variation, symplectic_form};
pub use variational::Variational;

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
