//! Hamilton's equations as a program, apart from what was recorded.

use core::ops::Range;

use lie::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, Scalar, VectorSpace};
use trace::{Binary, Graph, Id, Program, record};

use super::compile::{Layout, Programs, rates};
use super::error::TracedError;
use super::recording::{Recording, Told};
use super::storage::{Shared, TracedWorkspace};
use super::{Pivot, read_rates};
use crate::numerics::elements;
use crate::system::context::{Context, System};
use crate::system::continuous::{ContinuousSystem, Means};
use crate::system::force::Force;
use crate::system::lagrangian::Lagrangian;
use crate::system::shape::ShapeError;

/// The Hamiltonian system of a Lagrangian that is quadratic in the velocity, $\mu = H(t, g)\, \xi + b(t, g)$, recorded once.
///
/// What [`DualSystem`](crate::DualSystem) finds by dual numbers and iteration in each evaluation is here a program without loops: $H$ and its
/// factors, the velocity and the force. It runs in [lanes](ContinuousSystem::INLINE). Where $H$ is not positive definite, the answer is not a number.
///
/// It has nothing of the Lagrangian but what was recorded, and its [parameters](System::parameters), which may be
/// [changed](Self::with_parameters). It is for configurations of one shape: with another number of factors the answer is not a number.
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
/// let system = TracedSystem::new(&HeavyTop, &SO3::identity())?;
/// // The velocity, with two constant moments of one, and the force, of two entries of the rotation.
/// assert!(system.program().instructions() < 10);
/// # Ok::<(), dvi::TracedError>(())
/// ```
#[derive(Clone, Debug)]
pub struct TracedSystem<G: RealGroup>(Recording<G>);

impl<G: RealGroup> From<Recording<G>> for TracedSystem<G> {
    fn from(recording: Recording<G>) -> Self {
        Self(recording)
    }
}

impl<G: RealGroup> TracedSystem<G> {
    /// Records the Lagrangian for configurations of the shape of `g`.
    ///
    /// # Errors
    /// [`TracedError::Trace`] where its value branches on a number or calls [`Scalar::smooth`], [`TracedError::NotQuadratic`] where the
    /// velocity is not to be had from the momentum by a linear system.
    pub fn new<L: Lagrangian<Group = G>>(lagrangian: &L, g: &G) -> Result<Self, TracedError> {
        Ok(Self(Recording {
            programs: Programs::of(lagrangian, g)?.into(),
            at_rest: Shared::default(),
            shape: g.clone(),
            told: Told {
                parameters: lagrangian.parameters().to_vec(),
                cyclic: lagrangian.cyclic(),
                is_driven: lagrangian.is_driven(),
                terms: lagrangian.terms(),
                is_symplectic: lagrangian.is_symplectic(),
            },
        }))
    }

    /// The same with other parameters: nothing is recorded again.
    ///
    /// # Errors
    /// [`ShapeError::Parameters`] where there are more or fewer of them than before.
    pub fn with_parameters(mut self, parameters: &[f64]) -> Result<Self, ShapeError> {
        let (expected, found) = (self.0.told.parameters.len(), parameters.len());
        if expected != found {
            return Err(ShapeError::Parameters { expected, found });
        }
        self.0.told.parameters.copy_from_slice(parameters);
        Ok(self)
    }

    /// The same with a force, which is recorded too: in place of [`Forced`](crate::Forced), which evaluates it anew each time.
    ///
    /// What the force reads from elsewhere stays as it is now: a control that is set from outside belongs in a `Forced`.
    ///
    /// # Errors
    /// [`TracedError::Trace`] where the force branches on a number or calls [`Scalar::smooth`].
    pub fn with_force<F: Force<Group = G>>(&self, force: &F) -> Result<Self, TracedError> {
        let layout = Layout::of(self.0.told.parameters.len(), &self.0.shape);
        let acting = record(layout.len(), |x| {
            let at = Context::new(x[0], &x[layout.parameters()]);
            let g = elements::with_numbers(&self.0.shape, &x[layout.numbers()]);
            let (mut xi, mut out) = (g.zero_algebra(), g.zero_dual());
            xi.read(&x[layout.velocity()]);
            force.force(at, &g, &xi, &mut out);
            out.coordinates()
        })?;
        let flow = add(self.0.programs.flow.clone(), layout, &acting);
        let programs = Programs {
            rates: rates(&flow),
            flow,
            ..(*self.0.programs).clone()
        };
        let mut forced = self.0.clone();
        forced.programs = programs.into();
        forced.told.is_symplectic = false;
        Ok(Self(forced))
    }

    /// What is computed in each evaluation.
    pub fn program(&self) -> &Program {
        &self.0.programs.rates
    }

    pub(crate) fn into_recording(self) -> Recording<G> {
        self.0
    }
}

/// Adds a force, recorded by the velocity, to that of the equations.
fn add(mut flow: Graph, layout: Layout, acting: &Graph) -> Graph {
    let mut out = flow.outputs().to_vec();
    let tau = out.split_off(out.len() / 2);
    let known = &flow.inputs()[..layout.velocity().start];
    let arguments = [known, &out].concat();
    let added = flow.call(acting, &arguments, acting.outputs());
    let sum = |(tau, force): (Id, Id)| flow.binary(Binary::Add, tau, force);
    out.extend(tau.into_iter().zip(added).map(sum));
    flow.set_outputs(&out);
    flow
}

impl<G: RealGroup> System for TracedSystem<G> {
    type Group = G;

    fn parameters(&self) -> &[f64] {
        &self.0.told.parameters
    }
    fn cyclic(&self) -> Range<usize> {
        self.0.told.cyclic.clone()
    }
    fn fits(&self, g: &G) -> bool {
        self.0.shape.same_shape(g)
    }
    fn is_driven(&self) -> bool {
        self.0.told.is_driven
    }
    fn terms(&self) -> usize {
        self.0.told.terms
    }
    fn is_symplectic(&self) -> bool {
        self.0.told.is_symplectic
    }
}

impl<G: RealGroup> ContinuousSystem for TracedSystem<G> {
    type Workspace<S: Scalar> = TracedWorkspace<G, S>;
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<G, S>,
        mu: &DualOver<G, S>,
        work: &mut TracedWorkspace<G, S>,
        xi: &mut AlgebraOver<G, S>,
        tau: &mut DualOver<G, S>,
    ) {
        let found = work.run(|| Some(self.0.programs.clone()), at, g, mu);
        read_rates(found, xi, tau);
    }

    fn is_defined(&self, t: f64, g: &G) -> bool {
        let at = Context::new(t, &self.0.told.parameters);
        let value = self.0.at_rest.run(&self.0.programs.at_rest, at, g);
        value.is_some_and(f64::is_finite)
    }

    fn without_inertia(&self, t: f64, g: &G) -> Option<usize> {
        let at = Context::new(t, &self.0.told.parameters);
        match self.0.programs.pivot(at, g)? {
            (coordinate, Pivot::Zero) => Some(coordinate),
            _ => None,
        }
    }

    fn means(&self, _: f64, _: &G) -> Means {
        Means::Recorded
    }
}
