//! The continuous Lagrangian: what a user writes when there is no discrete one yet.

use core::ops::Range;

use lie::{AlgebraOver, Jet, LieGroup, Over, RealGroup, Scalar, VectorSpace};

use crate::jets::{add_constant, for_each_chunk, read_partials};
use crate::{Discretised, HamiltonianSystem, Quadrature, ShapeError, State};

/// A Lagrangian $L(g, \xi)$ on a left-trivialised tangent bundle, $\dot g = g \xi$.
///
/// Only [`value`](Self::value) is required; write it generic over the scalar. From it follow discrete Lagrangians
/// ([`discretise`](Self::discretise)) and Hamilton's equations ([`hamiltonian`](Self::hamiltonian)).
///
/// ```
/// use dvi::{Integrator, Lagrangian, Midpoint, Variational};
/// use lie::{SO3, Scalar, Tangent, Vec3};
///
/// /// A heavy top: moments of inertia 1, 1 and 1/2 kg m², weight times lever 1 N m.
/// struct HeavyTop;
///
/// impl Lagrangian for HeavyTop {
///     type Group = SO3;
///     fn value<S: Scalar>(&self, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
///         let [a, b, c] = omega.0;
///         let half = S::from_f64(0.5);
///         (a * a + b * b + c * c * half) * half - r.rotate(Vec3([0.0, 0.0, 1.0]).lift())[2]
///     }
/// }
///
/// let start = HeavyTop.state(0.0, SO3::exp(&Tangent([0.3, 0.0, 0.0])), &Tangent([0.0, 0.0, 10.0]))?;
/// let (mut state, mut integrator) = (start.clone(), Variational::new(HeavyTop.discretise::<Midpoint>()));
/// for _ in 0..100 {
///     integrator.step(&mut state, 0.01)?;
/// }
/// // The spin about the body's axis and about the vertical are kept.
/// assert!((state.mu[2] - start.mu[2]).abs() < 1e-12);
/// # use lie::LieGroup;
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub trait Lagrangian {
    /// The configuration group.
    type Group: RealGroup;

    /// $L(g, \xi)$, in joules.
    fn value<S: Scalar>(&self, g: &Over<Self::Group, S>, xi: &AlgebraOver<Self::Group, S>) -> S;

    /// $L(t, g, \xi)$, the only value that the framework asks for.
    ///
    /// A Lagrangian that depends on time gives this one, and as [`value`](Self::value) the one at $t = 0$.
    #[inline(always)]
    fn value_at<S: Scalar>(
        &self,
        _t: S,
        g: &Over<Self::Group, S>,
        xi: &AlgebraOver<Self::Group, S>,
    ) -> S {
        self.value(g, xi)
    }

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
        let (t, lifted) = (J::constant(t), g.lift::<J>());
        let (mut moved, mut mu) = (lifted.zero_algebra(), g.zero_dual());
        for_each_chunk(xi.dim(), |first| {
            lie::seed(&mut moved, first);
            add_constant(&mut moved, xi);
            read_partials(&mut mu, first, self.value_at::<J>(t, &lifted, &moved));
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
        Ok(Self::Group::pair(&mu, xi) - self.value_at(t, g, xi))
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

    /// The coordinates of a factor $\mathbb{R}^m$ of a direct product that `g` does not enter $L$ by; see [`DiscreteLagrangian::cyclic`](crate::DiscreteLagrangian::cyclic).
    fn cyclic(&self) -> Range<usize> {
        0..0
    }

    /// Whether `g` is a configuration of this system; for systems whose size is known at run time.
    fn fits(&self, _g: &Self::Group) -> bool {
        true
    }

    /// Checks that `g` is a configuration of this system and `xi` a velocity at it; both are, where sizes are known at compile time.
    ///
    /// # Errors
    /// [`ShapeError::Configuration`] where `g` does not [fit](Self::fits), [`ShapeError::Velocity`] where `xi` has not the shape of `g`.
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

    /// The discrete Lagrangian by a quadrature rule, through the Cayley map: `top.discretise::<Midpoint>()`.
    fn discretise<Q: Quadrature>(self) -> Discretised<Self, Q>
    where
        Self: Sized,
    {
        Discretised::new(self)
    }

    /// Hamilton's equations of this Lagrangian.
    fn hamiltonian(self) -> HamiltonianSystem<Self>
    where
        Self: Sized,
    {
        HamiltonianSystem(self)
    }
}

/// Whether $L$ has a value at rest at `g`: whether that is in its domain.
pub(crate) fn is_defined<L: Lagrangian>(lagrangian: &L, t: f64, g: &L::Group) -> bool {
    let still = g.zero_algebra();
    lagrangian.value_at::<f64>(t, g, &still).is_finite()
}

impl<L: Lagrangian> Lagrangian for &L {
    type Group = L::Group;

    #[inline(always)]
    fn value<S: Scalar>(&self, g: &Over<L::Group, S>, xi: &AlgebraOver<L::Group, S>) -> S {
        L::value(self, g, xi)
    }
    #[inline(always)]
    fn value_at<S: Scalar>(&self, t: S, g: &Over<L::Group, S>, xi: &AlgebraOver<L::Group, S>) -> S {
        L::value_at(self, t, g, xi)
    }
    fn legendre(
        &self,
        t: f64,
        g: &L::Group,
        xi: &<L::Group as LieGroup>::Algebra,
    ) -> Result<<L::Group as LieGroup>::Dual, ShapeError> {
        L::legendre(self, t, g, xi)
    }
    fn cyclic(&self) -> Range<usize> {
        L::cyclic(self)
    }
    fn fits(&self, g: &L::Group) -> bool {
        L::fits(self, g)
    }
}
