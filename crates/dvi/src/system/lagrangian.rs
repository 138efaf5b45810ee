//! The continuous Lagrangian: what a user writes when there is no discrete one yet.

use core::marker::PhantomData;

use lie::{AlgebraOver, Cayley, Jet, LieGroup, Over, RealGroup, Scalar, VectorSpace};

use super::context::{Context, System};
use super::quadrature::Quadrature;
use super::shape::ShapeError;
use super::state::{State, Still};
use super::traced::{Cache, Recording};
use crate::numerics::duals::{add_constant, for_each_chunk, read_partials};

/// A Lagrangian $L(g, \xi)$ on a left-trivialised tangent bundle, $\dot g = g \xi$.
///
/// Only [`value`](Self::value) is required; write it generic over the scalar. From it follow discrete Lagrangians
/// ([`discretise`](Self::discretise)) and Hamilton's equations ([`hamiltonian`](Self::hamiltonian)).
///
/// ```
/// use dvi::{Context, Integrator, Lagrangian, Quadrature, System, Variational};
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
/// let start = HeavyTop.state(0.0, SO3::exp(&Tangent([0.3, 0.0, 0.0])), &Tangent([0.0, 0.0, 10.0]))?;
/// let (mut state, mut integrator) = (start.clone(), Variational::new(HeavyTop.discretise(Quadrature::Midpoint)));
/// for _ in 0..100 {
///     integrator.step(&mut state, 0.01)?;
/// }
/// // The spin about the body's axis and about the vertical are kept.
/// assert!((state.mu[2] - start.mu[2]).abs() < 1e-12);
/// # use lie::LieGroup;
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub trait Lagrangian: System {
    /// $L(t, g, \xi)$, in joules; the context `at` has the time and the parameters.
    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Self::Group, S>,
        xi: &AlgebraOver<Self::Group, S>,
    ) -> S;

    /// The Legendre transform $\mu = \mathbf D_\xi L(t, g, \xi)$, (10); by dual numbers unless given.
    ///
    /// A closed form begins with `self.check_shape(g, xi)?`.
    ///
    /// # Errors
    /// As [`check_shape`](Self::check_shape).
    fn legendre(
        &self,
        t: f64,
        g: &Self::Group,
        xi: &<Self::Group as LieGroup>::Algebra,
    ) -> Result<<Self::Group as LieGroup>::Dual, ShapeError> {
        self.check_shape(g, xi)?;
        type J = <f64 as Scalar>::Jet;
        let parameters: Vec<J> = self.parameters().iter().map(|p| J::constant(*p)).collect();
        let (at, lifted) = (Context::new(J::constant(t), &parameters), g.lift::<J>());
        let (mut moved, mut mu) = (lifted.zero_algebra(), g.zero_dual());
        for_each_chunk(xi.dim(), |first| {
            lie::seed(&mut moved, first);
            add_constant(&mut moved, xi);
            read_partials(&mut mu, first, self.value::<J>(at, &lifted, &moved));
        });
        Ok(mu)
    }

    /// The energy $\langle \mathbf D_\xi L, \xi \rangle - L$, in joules.
    ///
    /// # Errors
    /// As [`check_shape`](Self::check_shape).
    fn energy(
        &self,
        t: f64,
        g: &Self::Group,
        xi: &<Self::Group as LieGroup>::Algebra,
    ) -> Result<f64, ShapeError> {
        let mu = self.legendre(t, g, xi)?;
        Ok(Self::Group::pair(&mu, xi) - self.value(Context::new(t, self.parameters()), g, xi))
    }

    /// The state at the configuration `g` with the velocity `xi`.
    ///
    /// # Errors
    /// As [`check_shape`](Self::check_shape).
    fn state(
        &self,
        t: f64,
        g: Self::Group,
        xi: &<Self::Group as LieGroup>::Algebra,
    ) -> Result<State<Self::Group>, ShapeError> {
        let mu = self.legendre(t, &g, xi)?;
        Ok(State { t, g, mu })
    }

    /// Checks that `g` is a configuration of this system and `xi` a velocity at it; both are, where sizes are known at compile time.
    ///
    /// # Errors
    /// [`ShapeError::Configuration`] where `g` does not [fit](System::fits), [`ShapeError::Velocity`] where `xi` has not the shape of `g`.
    fn check_shape(
        &self,
        g: &Self::Group,
        xi: &<Self::Group as LieGroup>::Algebra,
    ) -> Result<(), ShapeError> {
        let shape = g.zero_algebra();
        if !self.fits(g) {
            return Err(ShapeError::Configuration);
        }
        if !shape.same_shape(xi) {
            let (expected, found) = (shape.dim(), xi.dim());
            return Err(ShapeError::Velocity { expected, found });
        }
        Ok(())
    }

    /// The discrete Lagrangian by a quadrature rule, through the Cayley map: `top.discretise(Quadrature::Midpoint)`.
    fn discretise(self, rule: Quadrature) -> Discretised<Self>
    where
        Self: Sized,
    {
        Discretised::new(self, rule)
    }

    /// Hamilton's equations of this Lagrangian: of a recording of its value, where there is one.
    fn hamiltonian(self) -> HamiltonianSystem<Self>
    where
        Self: Sized,
    {
        HamiltonianSystem {
            lagrangian: self,
            recorded: Cache::default(),
        }
    }
}

/// Whether $L$ has a value at rest at `g`: whether that is in its domain.
pub(crate) fn is_defined<L: Lagrangian>(
    lagrangian: &L,
    t: f64,
    g: &L::Group,
    still: &Still<L::Group>,
) -> bool {
    let at = Context::new(t, lagrangian.parameters());
    lagrangian.value::<f64>(at, g, &still.velocity).is_finite()
}

impl<L: Lagrangian> Lagrangian for &L {
    #[inline(always)]
    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        xi: &AlgebraOver<L::Group, S>,
    ) -> S {
        L::value(self, at, g, xi)
    }
    fn legendre(
        &self,
        t: f64,
        g: &L::Group,
        xi: &<L::Group as LieGroup>::Algebra,
    ) -> Result<<L::Group as LieGroup>::Dual, ShapeError> {
        L::legendre(self, t, g, xi)
    }
    fn energy(
        &self,
        t: f64,
        g: &L::Group,
        xi: &<L::Group as LieGroup>::Algebra,
    ) -> Result<f64, ShapeError> {
        L::energy(self, t, g, xi)
    }
    fn state(
        &self,
        t: f64,
        g: L::Group,
        xi: &<L::Group as LieGroup>::Algebra,
    ) -> Result<State<L::Group>, ShapeError> {
        L::state(self, t, g, xi)
    }
}

/// A continuous Lagrangian or force made discrete by a [`Quadrature`] rule, with one velocity for the whole step by the retraction `R`.
///
/// With $\xi = \tau^{-1}(f)/h$, $L_d(t, g, f) = h \sum_i b_i L(t + c_i h, g f^{c_i}, \xi)$. Where $f$ is outside the
/// retraction's chart, a turn by $\pi$, the value is not a number and the step is refused.
///
/// Made by [`Lagrangian::discretise`]; on groups of run-time size its value allocates, its derivatives do not.
///
/// ```
/// use dvi::{Context, DiscreteLagrangian, Lagrangian, Quadrature, System};
/// use lie::{Exp, LieGroup, Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg on a spring of 4 N/m.
/// struct Spring;
///
/// impl System for Spring {
///     type Group = Rn<1>;
/// }
///
/// impl Lagrangian for Spring {
///     fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         (v[0] * v[0] - x.0[0] * x.0[0] * S::from_f64(4.0)) * S::from_f64(0.5)
///     }
/// }
///
/// let discrete = Spring.discretise(Quadrature::Trapezoid).with_retraction::<Exp>();
/// assert_eq!(discrete.value(Context::new(0.0, &[]), &Rn([1.0]), &Rn([0.5]), 0.5), 0.5 * (0.5 - 2.0 * (1.0 + 2.25) / 2.0));
/// assert_eq!((discrete.order(), discrete.is_symmetric()), (2, true));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Discretised<L, R = Cayley> {
    pub(crate) system: L,
    pub(crate) rule: Quadrature,
    retraction: PhantomData<R>,
}

impl<L> Discretised<L> {
    /// The system by a quadrature rule, through the Cayley map.
    pub fn new(system: L, rule: Quadrature) -> Self {
        Self {
            system,
            rule,
            retraction: PhantomData,
        }
    }
}

impl<L, R> Discretised<L, R> {
    /// The same rule through another retraction: another method of the same order.
    pub fn with_retraction<P>(self) -> Discretised<L, P> {
        let Self { system, rule, .. } = self;
        Discretised {
            system,
            rule,
            retraction: PhantomData,
        }
    }

    /// The continuous system.
    pub fn system(&self) -> &L {
        &self.system
    }
}

/// The Hamiltonian system of a Lagrangian, $\mu = \mathbf D_\xi L$.
///
/// The value is recorded once for each shape of the configuration, and its derivatives run as a program, as in
/// [`TracedSystem`](crate::TracedSystem). A value that branches on a number, or is not quadratic in the
/// velocity, cannot be recorded so. Then it is the system by dual numbers, [`DualSystem`](crate::DualSystem). [`means`](crate::ContinuousSystem::means) tells which of the two, and why; so do the
/// [reports](crate::StepReport::means) of steps.
///
/// ```
/// use dvi::{Context, Lagrangian, State, System};
/// use lie::{Cotangent, Rn, Scalar, Tangent};
///
/// /// A particle of 2 kg in a field of 9.81 N/kg.
/// struct Falling;
///
/// impl System for Falling {
///     type Group = Rn<1>;
/// }
///
/// impl Lagrangian for Falling {
///     fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         v[0] * v[0] - x.0[0] * S::from_f64(2.0 * 9.81)
///     }
/// }
///
/// let state = State { t: 0.0, g: Rn([3.0]), mu: Cotangent([4.0]) };
/// let system = Falling.hamiltonian();
/// assert_eq!(system.velocity(&state), Tangent([2.0]));
/// assert_eq!(system.energy(&state), 4.0 + 3.0 * 2.0 * 9.81);
/// ```
#[derive(Clone)]
pub struct HamiltonianSystem<L: System> {
    pub(super) lagrangian: L,
    pub(super) recorded: Cache<L::Group, (), Recording<L::Group>>,
}
