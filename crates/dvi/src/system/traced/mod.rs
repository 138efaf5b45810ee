//! Hamilton's equations of a Lagrangian that was recorded once.

mod compile;
mod elements;
mod error;
mod inertia;
mod storage;
mod translation;

use lie::{AlgebraOver, DualOver, LieGroup, Over, Scalar, VectorSpace};
use trace::{Program, record};

use self::compile::{Layout, compile};
pub use self::error::TracedError;
pub use self::storage::TracedWorkspace;
use self::translation::Translations;
use super::context::{Adapter, Context};
use super::continuous::ContinuousSystem;
use super::lagrangian::{HamiltonianSystem, Lagrangian};

/// The Hamiltonian system of a Lagrangian that is quadratic in the velocity, $\mu = H(t, g)\, \xi + b(t, g)$, recorded once.
///
/// What [`HamiltonianSystem`] finds by dual numbers and iteration in each evaluation is here a program without loops: $H$ and its
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
    program: Program,
}

impl<L: Lagrangian> TracedSystem<L> {
    /// Records the Lagrangian for configurations of the shape of `g`.
    ///
    /// # Errors
    /// [`TracedError::Trace`] where its value branches on a number or calls [`Scalar::smooth`], [`TracedError::NotQuadratic`] where the
    /// velocity is not to be had from the momentum by a linear system.
    pub fn new(lagrangian: L, g: &L::Group) -> Result<Self, TracedError> {
        let layout = Layout::of(&lagrangian, g);
        let recorded = record(layout.len(), |x| {
            let g = elements::with_numbers(g, &x[layout.numbers()]);
            let mut xi = g.zero_algebra();
            xi.read(&x[layout.velocity()]);
            let at = Context::new(x[0], &x[layout.parameters()]);
            vec![lagrangian.value(at, &g, &xi)]
        })?;
        let program = compile(recorded, layout, &Translations::new(g)?)?;
        Ok(Self {
            lagrangian,
            program,
        })
    }

    /// What is computed in each evaluation.
    pub fn program(&self) -> &Program {
        &self.program
    }
}

impl<L: Lagrangian> Adapter for TracedSystem<L> {
    type Inner = L;

    fn inner(&self) -> &L {
        &self.lagrangian
    }
}

impl<L: Lagrangian> ContinuousSystem for TracedSystem<L> {
    type Workspace<S: Scalar> = TracedWorkspace<L, S>;
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        mu: &DualOver<L::Group, S>,
        work: &mut TracedWorkspace<L, S>,
        xi: &mut AlgebraOver<L::Group, S>,
        tau: &mut DualOver<L::Group, S>,
    ) {
        let storage = work.of_shape(&self.program, g);
        if let Some(out) = storage.run(&self.program, at, g, mu) {
            xi.read(out);
            tau.read(&out[mu.dim()..]);
        } else {
            (0..xi.dim()).for_each(|i| xi.set(i, S::from_f64(f64::NAN)));
            (0..tau.dim()).for_each(|i| tau.set(i, S::from_f64(f64::NAN)));
        }
    }

    fn is_defined(&self, t: f64, g: &L::Group) -> bool {
        HamiltonianSystem(&self.lagrangian).is_defined(t, g)
    }

    fn without_inertia(&self, t: f64, g: &L::Group) -> Option<usize> {
        HamiltonianSystem(&self.lagrangian).without_inertia(t, g)
    }
}
