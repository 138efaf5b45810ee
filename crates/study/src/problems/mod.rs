//! Classical test problems: a Lagrangian, a start, the solution, the symmetries.
//!
//! | problem | group | solution |
//! |---|---|---|
//! | [`FreeRigidBody`] | [`SO3`](lie::SO3) | Jacobi elliptic functions, attitude included |
//! | [`HeavyTop`] (Lagrange's) | [`SO3`](lie::SO3) | Jacobi elliptic functions, attitude included |
//! | [`Pendulum`] in space | [`SO3`](lie::SO3) | planar swings by elliptic functions; else [`Reference`] |
//! | [`Kirchhoff`]'s ellipsoid | [`SE3`](lie::SE3) | steady motions, and how fast unstable ones are left |
//!
//! Lengths are in m, masses in kg, times in s. Space has its third axis $e_3$ upwards; velocities are the body's, in the
//! body's frame. Elliptic integrals are Carlson's (crate `ellip`), functions by the arithmetic–geometric mean.
//!
//! ```
//! use dvi::{Integrator, Lagrangian, Quadrature, Variational};
//! use lie::SO3;
//! use study::problems::{FreeRigidBody, Solution};
//!
//! let problem = FreeRigidBody::new([1.0, 2.0, 3.0])?.problem(SO3::identity(), [1.0, 0.1, 1.0])?;
//! let mut state = problem.start.clone();
//! let mut integrator = Variational::new(problem.lagrangian.discretise(Quadrature::Midpoint));
//! for _ in 0..100 {
//!     integrator.step(&mut state, problem.time / 1000.0)?;
//! }
//! let exact = problem.exact.at(state.t)?;
//! assert!((*state.g.matrix() - *exact.g.matrix()).frobenius() < 1e-3);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod error;
mod free_rigid_body;
mod heavy_top;
mod jacobi;
mod kirchhoff;
mod pendulum;
mod reference;
mod steady;

pub use error::ProblemError;
pub use free_rigid_body::{FreeRigidBody, FreeRotation};
pub use heavy_top::{HeavyTop, Nutation};
pub use kirchhoff::Kirchhoff;
pub use pendulum::{Pendulum, Swing};
pub use reference::Reference;
pub use steady::Steady;

use dvi::{Lagrangian, LeftTranslation, RightTranslation, State, Symmetry, momentum_map};
use lie::{LieGroup, Over, RealGroup, Scalar, VectorSpace};

/// A test problem with its solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem<L: Lagrangian, X> {
    /// The name to print.
    pub name: &'static str,
    /// The system.
    pub lagrangian: L,
    /// Where it starts.
    pub start: State<L::Group>,
    /// The motion from there.
    pub exact: X,
    /// A time in s that suits the motion: its period, where it has one.
    pub time: f64,
    /// The symmetries of the Lagrangian.
    pub symmetries: Vec<NamedSymmetry<<L::Group as LieGroup>::Algebra>>,
}

/// A motion known at every time.
pub trait Solution<G: RealGroup> {
    /// The state at time `t`, s.
    ///
    /// # Errors
    /// [`ProblemError`] where `t` is not finite or the state cannot be found; states in `Ok` are finite.
    fn at(&self, t: f64) -> Result<State<G>, ProblemError>;
}

/// A symmetry and the name of its momentum map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedSymmetry<A> {
    /// What is conserved.
    pub name: &'static str,
    /// The transformations.
    pub symmetry: Translation<A>,
}

/// A translation of the group from the left, a motion of space, or from the right, a motion of the body against its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Translation<A> {
    /// $g \mapsto \exp(s\zeta) g$.
    Left(LeftTranslation<A>),
    /// $g \mapsto g \exp(s\zeta)$.
    Right(RightTranslation<A>),
}

impl<G: RealGroup> Symmetry<G> for Translation<G::Algebra> {
    fn act<S: Scalar>(&self, s: S, g: &Over<G, S>) -> Over<G, S> {
        match self {
            Self::Left(translation) => Symmetry::<G>::act(translation, s, g),
            Self::Right(translation) => Symmetry::<G>::act(translation, s, g),
        }
    }
}

impl<L: Lagrangian, X> Problem<L, X> {
    /// The momentum maps of the [symmetries](Self::symmetries), in their order.
    pub fn momenta(&self, state: &State<L::Group>) -> Vec<f64> {
        let maps = self.symmetries.iter();
        maps.map(|named| momentum_map(&named.symmetry, &state.g, &state.mu))
            .collect()
    }

    /// The energy, J.
    pub fn energy(&self, state: &State<L::Group>) -> f64 {
        (&self.lagrangian).hamiltonian().energy(state)
    }
}

fn left<A>(name: &'static str, zeta: A) -> NamedSymmetry<A> {
    let symmetry = Translation::Left(LeftTranslation(zeta));
    NamedSymmetry { name, symmetry }
}

fn right<A>(name: &'static str, zeta: A) -> NamedSymmetry<A> {
    let symmetry = Translation::Right(RightTranslation(zeta));
    NamedSymmetry { name, symmetry }
}

/// `value` if it is positive and finite.
fn positive(what: &'static str, value: f64) -> Result<f64, ProblemError> {
    let good = value > 0.0 && value.is_finite();
    good.then_some(value)
        .ok_or(ProblemError::NotPositive { what, value })
}

fn finite(what: &'static str, values: &[f64]) -> Result<(), ProblemError> {
    let good = values.iter().all(|value| value.is_finite());
    good.then_some(()).ok_or(ProblemError::NotFinite { what })
}

/// The state, if it is finite.
fn checked<G: RealGroup>(state: State<G>) -> Result<State<G>, ProblemError> {
    let good = state.g.is_finite() && state.mu.max_magnitude().is_finite();
    good.then_some(state)
        .ok_or(ProblemError::NotFinite { what: "state" })
}
