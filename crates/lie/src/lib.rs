//! Lie groups for mechanics: elements, algebras, duals and the maps between them, over any scalar.
//!
//! ```
//! use lie::{LieGroup, SE3, SO3, Tangent, Vec3, VectorSpace};
//!
//! // A pose, moved along a twist (angular, then linear velocity, in the body's frame) for a second.
//! let pose = SE3::new(SO3::identity(), Vec3([1.0, 0.0, 0.0]));
//! let twist = Tangent([0.0, 0.0, 0.5, 2.0, 0.0, 0.0]);
//! let moved = pose.compose(&SE3::exp(&twist));
//!
//! // The way back.
//! let back = pose.inverse().compose(&moved).log()?;
//! assert!((back - twist).max_magnitude() < 1e-15);
//! # Ok::<(), lie::NotUnique<Tangent<6, f64>>>(())
//! ```
//!
//! # What is here
//! | group | type | algebra, dual |
//! |---|---|---|
//! | rotations $SO(3)$ | [`SO3`] | [`Tangent<3>`](Tangent), [`Cotangent<3>`](Cotangent) |
//! | displacements $SE(3)$ | [`SE3`] | [`Tangent<6>`](Tangent), [`Cotangent<6>`](Cotangent): rotation first |
//! | rotations of the plane $SO(2)$ | [`SO2`] | [`Tangent<1>`](Tangent), [`Cotangent<1>`](Cotangent) |
//! | displacements of the plane $SE(2)$ | [`SE2`] | [`Tangent<3>`](Tangent), [`Cotangent<3>`](Cotangent): rotation first |
//! | $\mathbb{R}^n$ | [`Rn<N>`](Rn), [`R3`] | [`Tangent<N>`](Tangent), [`Cotangent<N>`](Cotangent) |
//! | direct products | tuples of 2 to 4 groups | tuples |
//! | powers $G^N$ | `[G; N]` | arrays |
//! | powers of run-time size | [`Power<G>`](Power) | [`Power`] of the factor's |
//!
//! [`laws::check`] proves the laws of any of them, and of a group of your own.
//!
//! # Notation
//! | operation | mathematics | code |
//! |---|---|---|
//! | product, inverse | $g h$, $g^{-1}$ | [`g.compose(&h)`](LieGroup::compose), [`g.inverse()`](LieGroup::inverse) |
//! | exponential, logarithm | $\exp \xi$, $\log g$ | [`G::exp(&xi)`](LieGroup::exp), [`g.log()`](LieGroup::log) |
//! | square root | $h h = g$, $h$ nearest $e$ | [`g.sqrt()`](LieGroup::sqrt) |
//! | Cayley map | $(1 - \xi/2)^{-1} (1 + \xi/2)$ | [`G::cayley(&xi)`](LieGroup::cayley), [`g.cayley_inverse()`](LieGroup::cayley_inverse) |
//! | adjoint action | $\mathrm{Ad}_g \xi = g \xi g^{-1}$ | [`g.adjoint(&xi)`](LieGroup::adjoint) |
//! | bracket | $\mathrm{ad}_\xi \eta = [\xi, \eta]$ | [`G::bracket(&xi, &eta)`](LieGroup::bracket) |
//! | pairing | $\langle \mu, \xi \rangle$ | [`G::pair(&mu, &xi)`](LieGroup::pair) |
//! | coadjoint action | $\langle \mathrm{Ad}^\ast_g \mu, \xi \rangle = \langle \mu, \mathrm{Ad}_g \xi \rangle$ | [`g.coadjoint(&mu)`](LieGroup::coadjoint) |
//! | its derivative | $\langle \mathrm{ad}^\ast_\xi \mu, \eta \rangle = \langle \mu, \mathrm{ad}_\xi \eta \rangle$ | [`G::coadjoint_bracket(&xi, &mu)`](LieGroup::coadjoint_bracket) |
//! | retraction $\tau$, by the type `R`: [`Exp`] or [`Cayley`] | $\tau(\xi)$, $\tau^{-1}(g)$ | [`G::retract::<R>(&xi)`](LieGroup::retract), [`g.retract_inverse::<R>()`](LieGroup::retract_inverse) |
//! | left-trivialised differential | $\mathrm d\tau_\xi \eta = \tau(\xi)^{-1} \frac{d}{ds} \tau(\xi + s \eta)$ at $s = 0$ | [`G::d_left::<R>(&xi, &eta)`](LieGroup::d_left) |
//! | right-trivialised differential | $\frac{d}{ds} \tau(\xi + s \eta) \tau(\xi)^{-1}$ at $s = 0$ | [`G::d_right::<R>(&xi, &eta)`](LieGroup::d_right) |
//! | transpose of the left one | $\langle (\mathrm d\tau_\xi)^\ast \mu, \eta \rangle = \langle \mu, \mathrm d\tau_\xi \eta \rangle$ | [`G::d_left_dual::<R>(&xi, &mu)`](LieGroup::d_left_dual) |
//! | gradient of the inverse | $\nabla_\xi \langle \mu, \mathrm d\tau_\xi^{-1} \eta \rangle$ | [`G::d_left_inv_gradient::<R>(&xi, &mu, &eta)`](LieGroup::d_left_inv_gradient) |
//! | hat, vee | $\hat x y = x \times y$ | [`Vec3::hat`], [`Mat3::vee`] |
//!
//! Trivialisation is on the left everywhere: $\dot g = g \xi$, and velocities of rigid bodies are in the body's frame.
//! With this convention $\mathrm{Ad}^\ast$ is a right action: on $SO(3)$, $\mathrm{Ad}^\ast_R \mu = R^T \mu$.
//!
//! # One formula, every scalar
//! All types take a [`Scalar`], `f64` unless said: `f32`, and [dual numbers](DualNumber) to any depth. A group is a
//! family: [`Over<G, S>`](Over) is `G` over `S`. [`Scalar::Jet`] is the dual number that carries [`JET_DIRECTIONS`]
//! derivatives, and [`seed`] makes of it the left-trivialised derivative of any function of a group element:
//!
//! ```
//! use lie::{Jet, LieGroup, Mat3, RealGroup, SO3, Scalar, Tangent, Vec3};
//!
//! /// The height of the point `e_x` of a body.
//! fn height<S: Scalar>(r: &SO3<S>) -> S {
//!     r.rotate(Vec3([1.0, 0.0, 0.0]).lift())[2]
//! }
//! let mut zeta = SO3::identity().lift::<<f64 as Scalar>::Jet>().zero_algebra();
//! lie::seed(&mut zeta, 0);
//! let slope = height(&SO3::exp(&zeta));
//! // Turning about -y lifts it.
//! assert_eq!([0, 1, 2].map(|i| slope.partial(i)), [0.0, -1.0, 0.0]);
//! ```
//!
//! # Features
//! * `nalgebra`: conversions to and from its vectors, rotations and isometries.

mod approximate;
mod batch;
#[cfg(feature = "nalgebra")]
mod convert_nalgebra;
mod dense;
mod dual_number;
mod error;
mod floats;
mod group;
pub mod lanes;
pub mod laws;
mod lu;
mod matrix;
mod numeric;
mod operators;
mod plane;
mod power;
mod product;
mod retraction;
mod rn;
mod scalar;
mod se2;
mod se3;
mod series;
mod so2;
mod so3;
mod stumpff;
mod symmetric;
mod units;
mod vector;
mod vector_space;

pub use batch::Batch;
pub use dual_number::DualNumber;
pub use error::{NotARotation, NotUnique, OutsideChart};
pub use group::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, dexp, dexp_inv_gradient, seed};
pub use lu::Lu;
pub use matrix::Mat3;
pub use power::Power;
pub use retraction::{Cayley, Chart, Exp, Retraction};
pub use rn::{R3, Rn};
pub use scalar::{JET_DIRECTIONS, Jet, Scalar};
pub use se2::SE2;
pub use se3::SE3;
pub use so2::SO2;
pub use so3::{Displacement, SO3};
pub use symmetric::{Ldl3, Sym3};
pub use units::Units;
pub use vector::Vec3;
pub use vector_space::{Cotangent, Tangent, VectorSpace};

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
