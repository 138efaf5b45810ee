//! Hamilton's equations of a Lagrangian that was recorded once.

mod cache;
mod compile;
mod discrete;
mod elements;
mod error;
mod inertia;
mod storage;
mod translation;

use std::sync::Arc;

use lie::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, Scalar, VectorSpace};
use trace::{Program, record};

pub(crate) use self::cache::{Cache, Whose};
pub(crate) use self::compile::Programs;
use self::compile::{Layout, compile};
pub(crate) use self::discrete::{DiscreteCache, DiscreteProgram, DiscreteRecording};
pub(crate) use self::elements::{count as count_numbers, with_numbers};
pub use self::error::TracedError;
pub use self::storage::TracedWorkspace;
use self::translation::Translations;
use super::context::{Adapter, Context};
use super::continuous::{ContinuousSystem, Means};
use super::dual_system::DualSystem;
use super::lagrangian::Lagrangian;

/// The Hamiltonian system of a Lagrangian that is quadratic in the velocity, $\mu = H(t, g)\, \xi + b(t, g)$, recorded once.
///
/// What [`DualSystem`] finds by dual numbers and iteration in each evaluation is here a program without loops: $H$ and its
/// factors, the velocity and the force. It runs in [lanes](ContinuousSystem::INLINE). Where $H$ is not positive definite, the answer is not a number.
///
/// It is for configurations of one shape. With another number of factors the answer is not a number: make another.
///
/// ```
/// use dvi::{Context, Lagrangian, System, TracedSystem};
/// use lie::{SO3, Scalar, Tangent, Vec3};
///
/// /// A heavy top: moments of inertia 1, 1 and 1/2 kg m², weight times lever 1 N m.
/// struct HeavyTop;
///
/// impl System for HeavyTop {
///     type Group = SO3;
/// }
///
/// impl Lagrangian for HeavyTop {
///     fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
///         let [a, b, c] = omega.0;
///         let half = S::from_f64(0.5);
///         (a * a + b * b + c * c * half) * half - r.rotate(Vec3([0.0, 0.0, 1.0]).lift())[2]
///     }
/// }
///
/// let system = TracedSystem::new(HeavyTop, &SO3::identity())?;
/// // The velocity, with two constant moments of one, and the force, of two entries of the rotation.
/// assert!(system.program().instructions() < 10);
/// # Ok::<(), dvi::TracedError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TracedSystem<L> {
    lagrangian: L,
    programs: Arc<Programs>,
}

impl<L: Lagrangian> TracedSystem<L> {
    /// Records the Lagrangian for configurations of the shape of `g`.
    ///
    /// # Errors
    /// [`TracedError::Trace`] where its value branches on a number or calls [`Scalar::smooth`], [`TracedError::NotQuadratic`] where the
    /// velocity is not to be had from the momentum by a linear system.
    pub fn new(lagrangian: L, g: &L::Group) -> Result<Self, TracedError> {
        let programs = Programs::of(&lagrangian, g)?.into();
        Ok(Self {
            lagrangian,
            programs,
        })
    }

    /// What is computed in each evaluation.
    pub fn program(&self) -> &Program {
        &self.programs.rates
    }
}

impl Programs {
    /// Those of a Lagrangian, for configurations of the shape of `g`.
    pub(crate) fn of<L: Lagrangian>(lagrangian: &L, g: &L::Group) -> Result<Self, TracedError> {
        let layout = Layout::of(lagrangian.parameters().len(), g);
        let recorded = record(layout.len(), |x| {
            let g = elements::with_numbers(g, &x[layout.numbers()]);
            let mut xi = g.zero_algebra();
            xi.read(&x[layout.velocity()]);
            let at = Context::new(x[0], &x[layout.parameters()]);
            vec![lagrangian.value(at, &g, &xi)]
        })?;
        compile(recorded, layout, &Translations::new(g)?)
    }

    /// Velocity and force of a state, one after the other.
    pub(crate) fn rates<G: RealGroup>(
        &self,
        at: Context<f64>,
        g: &G,
        mu: &G::Dual,
    ) -> Option<Vec<f64>> {
        storage::once(&self.rates, at, g, mu)
    }

    /// The energy of a state.
    pub(crate) fn energy<G: RealGroup>(
        &self,
        at: Context<f64>,
        g: &G,
        mu: &G::Dual,
    ) -> Option<f64> {
        storage::once(&self.energy, at, g, mu).map(|out| out[0])
    }

    /// The first pivot of the inertia that is not clearly positive, with its coordinate.
    pub(crate) fn pivot<G: RealGroup>(&self, at: Context<f64>, g: &G) -> Option<(usize, Pivot)> {
        /// Roundings that elimination may leave in place of a zero, for each coordinate.
        const ROUNDINGS: f64 = 8.0;
        let out = storage::once(&self.inertia, at, g, &g.zero_dual())?;
        let (pivots, diagonal) = out.split_at(out.len() / 2);
        let rounding = ROUNDINGS * f64::EPSILON * pivots.len() as f64;
        let mut all = pivots.iter().zip(diagonal).enumerate();
        all.find_map(|(k, (pivot, entry))| {
            let size = rounding * entry.abs();
            match *pivot {
                pivot if pivot > size => None,
                pivot if pivot < -size => Some((k, Pivot::Negative)),
                pivot if pivot.is_nan() => Some((k, Pivot::Unknown)),
                _ => Some((k, Pivot::Zero)),
            }
        })
    }
}

/// A pivot of an inertia that is not positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pivot {
    /// There is no inertia.
    Zero,
    /// The inertia is indefinite.
    Negative,
    /// The inertia is not a number.
    Unknown,
}

/// A coordinate without inertia, by what is recorded; by dual numbers where pivots do not tell.
pub(crate) fn without_inertia<L: Lagrangian>(
    lagrangian: &L,
    programs: &Programs,
    (t, g): (f64, &L::Group),
) -> Option<usize> {
    match programs.pivot(Context::new(t, lagrangian.parameters()), g)? {
        (coordinate, Pivot::Zero) => Some(coordinate),
        _ => DualSystem(lagrangian).without_inertia(t, g),
    }
}

impl<L: Lagrangian> Adapter for TracedSystem<L> {
    type Inner = L;

    fn inner(&self) -> &L {
        &self.lagrangian
    }
}

impl<L: Lagrangian> ContinuousSystem for TracedSystem<L> {
    type Workspace<S: Scalar> = TracedWorkspace<L::Group, S>;
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        mu: &DualOver<L::Group, S>,
        work: &mut TracedWorkspace<L::Group, S>,
        xi: &mut AlgebraOver<L::Group, S>,
        tau: &mut DualOver<L::Group, S>,
    ) {
        let found = work.run(|| Some(self.programs.clone()), at, g, mu);
        read_rates(found, xi, tau);
    }

    fn is_defined(&self, t: f64, g: &L::Group) -> bool {
        DualSystem(&self.lagrangian).is_defined(t, g)
    }

    fn without_inertia(&self, t: f64, g: &L::Group) -> Option<usize> {
        without_inertia(&self.lagrangian, &self.programs, (t, g))
    }

    fn means(&self, _: f64, _: &L::Group) -> Means {
        Means::Recorded
    }
}

/// Takes velocity and force from where they are one after the other; no numbers where there are none.
#[inline(always)]
pub(crate) fn read_rates<S: Scalar>(
    found: Option<&[S]>,
    xi: &mut impl VectorSpace<Scalar = S>,
    tau: &mut impl VectorSpace<Scalar = S>,
) {
    match found.and_then(|out| out.split_at_checked(xi.dim())) {
        Some((velocity, force)) if force.len() == tau.dim() => {
            xi.read(velocity);
            tau.read(force);
        }
        _ => {
            (0..xi.dim()).for_each(|i| xi.set(i, S::from_f64(f64::NAN)));
            (0..tau.dim()).for_each(|i| tau.set(i, S::from_f64(f64::NAN)));
        }
    }
}
