//! What a Lie group is.

use core::fmt::Debug;

use num_traits::{One, Zero};

use crate::series::{exponential, polynomial, polynomial_gradient};
use crate::{
    Chart, Exp, Jet, NotUnique, OutsideChart, Retraction, Scalar, Units, VectorSpace, dense,
};

/// The group `G` with its numbers replaced by `S`.
pub type Over<G, S> = <G as LieGroup>::WithScalar<S>;

/// The algebra of `G` over the scalar `S`.
pub type AlgebraOver<G, S> = <Over<G, S> as LieGroup>::Algebra;

/// The dual of the algebra of `G` over the scalar `S`.
pub type DualOver<G, S> = <Over<G, S> as LieGroup>::Dual;

/// A Lie group: elements, algebra, dual, and the maps between them.
///
/// Conventions (see the [crate's notation](crate#notation)): left trivialisation, $\dot g = g \xi$;
/// $\mathrm{Ad}\_g \xi = g \xi g^{-1}$; $\mathrm{ad}\_\xi \eta = [\xi, \eta]$;
/// $\langle \mathrm{Ad}^\ast\_g \mu, \xi\rangle = \langle \mu, \mathrm{Ad}\_g \xi\rangle$ and
/// $\langle \mathrm{ad}^\ast\_\xi \mu, \eta\rangle = \langle \mu, \mathrm{ad}\_\xi \eta\rangle$;
/// differentials are left-trivialised, $\mathrm d\tau_\xi \eta = \tau(\xi)^{-1} \frac{d}{ds}\vert_{s=0} \tau(\xi + s\eta)$,
/// of the [retraction](Retraction) $\tau$ that the type parameter `R` chooses.
///
/// A type is a *family* over scalars: [`WithScalar`](Self::WithScalar) names its relatives, so one formula
/// runs on floats, dual numbers and SIMD lanes.
///
/// # Required
/// Four types and nine methods make a group: the zeros of [algebra](Self::zero_algebra) and [dual](Self::zero_dual),
/// [`convert`](Self::convert), [`compose`](Self::compose), [`inverse`](Self::inverse), [`exp`](Self::exp),
/// [`log`](Self::log), [`adjoint`](Self::adjoint) and [`bracket`](Self::bracket). Where its numbers are redundant, as a
/// matrix's are, [`normalize`](Self::normalize) too. Call [`laws::check`](crate::laws::check) on a few elements: it tests
/// them.
///
/// # Provided
/// All else has a default. Replace it by a closed form where speed counts; the laws test that too.
/// - Transposes: [`coadjoint`](Self::coadjoint), [`coadjoint_bracket`](Self::coadjoint_bracket); by the pairing.
/// - The [Cayley map](Self::cayley) and [its inverse](Self::cayley_inverse), [`sqrt`](Self::sqrt); by `exp` and `log`.
/// - Differentials of both retractions: [`d_left`](Self::d_left), its inverse, their transposes, a gradient; by
///   [series](crate::dexp) and small linear systems. A closed form matches on [`R::CHART`](Retraction::CHART).
/// - Shape: [`same_shape`](Self::same_shape), [`units`](Self::units), [`identity_like`](Self::identity_like).
/// - Steps of integrators: the `*_into` methods write into an existing element of the same shape,
///   [`advance`](Self::advance) compensates rounding. Run-time-sized groups override them so as not to allocate.
pub trait LieGroup: Clone + Debug + PartialEq + Send + Sync + 'static {
    // Required.

    /// The numbers.
    type Scalar: Scalar;
    /// The Lie algebra $\mathfrak g$.
    type Algebra: VectorSpace<Scalar = Self::Scalar>;
    /// The dual $\mathfrak g^\ast$, paired by coordinates.
    type Dual: VectorSpace<Scalar = Self::Scalar>;
    /// The same group over another scalar.
    type WithScalar<S: Scalar>: LieGroup<Scalar = S>;

    /// The zero of the algebra, of this element's shape.
    fn zero_algebra(&self) -> Self::Algebra;

    /// The zero of the dual, of this element's shape.
    fn zero_dual(&self) -> Self::Dual;

    /// Applies `f` to every number of an element.
    fn convert<S: Scalar, T: Scalar>(g: &Over<Self, S>, f: impl Fn(S) -> T + Copy)
    -> Over<Self, T>;

    /// $g h$.
    fn compose(&self, h: &Self) -> Self;

    /// $g^{-1}$.
    fn inverse(&self) -> Self;

    /// $\exp \xi$.
    fn exp(xi: &Self::Algebra) -> Self;

    /// The shortest $\xi$ with $\exp \xi = g$.
    ///
    /// # Errors
    /// [`NotUnique`], with one of the answers, where there are several.
    fn log(&self) -> Result<Self::Algebra, NotUnique<Self::Algebra>>;

    /// $\mathrm{Ad}\_g \xi = g \xi g^{-1}$.
    fn adjoint(&self, xi: &Self::Algebra) -> Self::Algebra;

    /// $\mathrm{ad}\_\xi \eta = [\xi, \eta]$.
    fn bracket(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra;

    // Provided: the shape, and the way back to the group.

    /// Whether the two have the same number of factors, so that their product exists; for groups of run-time size.
    #[inline(always)]
    fn same_shape(&self, _other: &Self) -> bool {
        true
    }

    /// Appends the units of the algebra's coordinates; by default all share one that is their own.
    ///
    /// Integrators compare sizes within a unit only, so that their steps do not depend on what is called a metre.
    fn units(&self, units: &mut Units) {
        units.vector(self.zero_dual().dim());
    }

    /// The identity, of this element's shape.
    fn identity_like(&self) -> Self {
        Self::exp(&self.zero_algebra())
    }

    /// Whether every number of the element is finite; by the logarithm unless given.
    fn is_finite(&self) -> bool {
        let log = self.log().unwrap_or_else(|e| e.representative);
        log.max_magnitude().is_finite()
    }

    /// Pulls an element that rounding has moved off the group back to it; needed where the numbers are redundant, as a matrix's are.
    #[inline(always)]
    fn normalize(&mut self) {}

    // Provided: the transposes.

    /// The pairing $\langle \mu, \xi \rangle$, by coordinates.
    #[inline(always)]
    fn pair(mu: &Self::Dual, xi: &Self::Algebra) -> Self::Scalar {
        (0..mu.dim()).fold(Self::Scalar::zero(), |sum, i| sum + mu.get(i) * xi.get(i))
    }

    /// $\mathrm{Ad}^\ast\_g \mu$, with $\langle \mathrm{Ad}^\ast\_g \mu, \xi\rangle = \langle \mu, \mathrm{Ad}\_g \xi\rangle$.
    fn coadjoint(&self, mu: &Self::Dual) -> Self::Dual {
        dense::transpose_by_pairing(mu, &self.zero_algebra(), Self::pair, |e| self.adjoint(e))
    }

    /// $\mathrm{ad}^\ast\_\xi \mu$, with $\langle \mathrm{ad}^\ast\_\xi \mu, \eta\rangle = \langle \mu, \mathrm{ad}\_\xi \eta\rangle$.
    fn coadjoint_bracket(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
        dense::transpose_by_pairing(mu, xi, Self::pair, |e| Self::bracket(xi, e))
    }

    // Provided: the retractions.

    /// The Cayley map $\mathrm{cay}(\xi) = (1 - \xi/2)^{-1} (1 + \xi/2)$ of a matrix group whose defining
    /// form is quadratic; by default the exponential.
    ///
    /// It is a rational map that agrees with $\exp$ to second order.
    #[inline(always)]
    fn cayley(xi: &Self::Algebra) -> Self {
        Self::exp(xi)
    }

    /// The $\xi$ with $\mathrm{cay}(\xi) = g$.
    ///
    /// # Errors
    /// [`OutsideChart`] where there is none.
    fn cayley_inverse(&self) -> Result<Self::Algebra, OutsideChart> {
        self.log().map_err(|_| OutsideChart)
    }

    /// $\tau(\xi)$.
    ///
    /// ```
    /// use lie::{Cayley, Exp, LieGroup, SO3, Tangent};
    ///
    /// let xi = Tangent([1e-3, 2e-3, -1e-3]);
    /// let (a, b) = (SO3::retract::<Exp>(&xi), SO3::retract::<Cayley>(&xi));
    /// assert!((*a.matrix() - *b.matrix()).frobenius() < 1e-8);
    /// ```
    #[inline(always)]
    fn retract<R: Retraction>(xi: &Self::Algebra) -> Self {
        match R::CHART {
            Chart::Exp => Self::exp(xi),
            Chart::Cayley => Self::cayley(xi),
        }
    }

    /// $\tau^{-1}(g)$.
    ///
    /// # Errors
    /// [`OutsideChart`] where the inverse does not exist or is not unique.
    #[inline(always)]
    fn retract_inverse<R: Retraction>(&self) -> Result<Self::Algebra, OutsideChart> {
        match R::CHART {
            Chart::Exp => self.log().map_err(|_| OutsideChart),
            Chart::Cayley => self.cayley_inverse(),
        }
    }

    /// The square root nearest the identity: the $h$ with $h h = g$, halfway from $e$ to $g$ on the one-parameter
    /// subgroup; where there are several, one of them.
    ///
    /// ```
    /// use lie::{LieGroup, SO3, Tangent};
    ///
    /// let xi = Tangent([0.2, -0.4, 1.0]);
    /// let (whole, half): (SO3, SO3) = (SO3::exp(&xi), SO3::exp(&(xi * 0.5)));
    /// assert!((*whole.sqrt().matrix() - *half.matrix()).frobenius() < 1e-15);
    /// ```
    fn sqrt(&self) -> Self {
        let mut half = self.zero_algebra();
        let log = self.log().unwrap_or_else(|e| e.representative);
        half.add_scaled(Self::Scalar::from_f64(0.5), &log);
        Self::exp(&half)
    }

    // Provided: the differentials of the retractions.

    /// The left-trivialised differential $\mathrm d\tau_\xi \eta = \tau(\xi)^{-1} \frac{d}{ds}\vert_{s=0} \tau(\xi + s \eta)$.
    ///
    /// The default is the exponential's [series](crate::dexp), for both retractions, as the Cayley map is the
    /// exponential by default. A group that has a Cayley map of its own gives this method and
    /// [the gradient](Self::d_left_inv_gradient) too.
    fn d_left<R: Retraction>(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
        dexp::<Self>(xi, eta)
    }

    /// $\mathrm d\tau_\xi^{-1} \eta$; the default solves a linear system of size `dim`.
    fn d_left_inv<R: Retraction>(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
        dense::solve(eta, |e| Self::d_left::<R>(xi, e))
    }

    /// $(\mathrm d\tau_\xi)^\ast \mu$, the $\nu$ with
    /// $\langle \nu, \eta\rangle = \langle \mu, \mathrm d\tau_\xi \eta\rangle$.
    fn d_left_dual<R: Retraction>(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
        dense::transpose_by_pairing(mu, xi, Self::pair, |e| Self::d_left::<R>(xi, e))
    }

    /// $(\mathrm d\tau_\xi^{-1})^\ast \mu$, the $\nu$ with
    /// $\langle \nu, \eta\rangle = \langle \mu, \mathrm d\tau_\xi^{-1} \eta\rangle$.
    fn d_left_inv_dual<R: Retraction>(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
        dense::transpose_by_pairing(mu, xi, Self::pair, |e| Self::d_left_inv::<R>(xi, e))
    }

    /// The gradient in $\xi$ of $\langle \mu, \mathrm d\tau_\xi^{-1} \eta\rangle$, with $\mu$ and $\eta$ fixed; the default
    /// is the exponential's [series](crate::dexp_inv_gradient).
    ///
    /// ```
    /// use lie::{Cayley, Cotangent, LieGroup, SO3, Tangent};
    ///
    /// // At zero, the map is 1 + ad/2 to first order.
    /// let (xi, mu, eta) = (Tangent([0.0; 3]), Cotangent([1.0, 0.0, 0.0]), Tangent([0.0, 1.0, 0.0]));
    /// let gradient = SO3::d_left_inv_gradient::<Cayley>(&xi, &mu, &eta);
    /// assert_eq!(gradient, Cotangent([0.0, 0.0, -0.5]));
    /// ```
    fn d_left_inv_gradient<R: Retraction>(
        xi: &Self::Algebra,
        mu: &Self::Dual,
        eta: &Self::Algebra,
    ) -> Self::Dual {
        dexp_inv_gradient::<Self>(xi, mu, eta)
    }

    /// The right-trivialised differential: $\frac{d}{ds}\vert_{s=0} \tau(\xi + s \eta) \tau(\xi)^{-1}$, which is
    /// the left-trivialised one at $-\xi$.
    fn d_right<R: Retraction>(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
        Self::d_left::<R>(&negated(xi), eta)
    }

    /// The inverse of [`d_right`](Self::d_right) in `eta`.
    fn d_right_inv<R: Retraction>(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
        Self::d_left_inv::<R>(&negated(xi), eta)
    }

    // Provided: in place.

    /// [`convert`](Self::convert) into `out`.
    #[inline(always)]
    fn convert_into<S: Scalar, T: Scalar>(
        g: &Over<Self, S>,
        f: impl Fn(S) -> T + Copy,
        out: &mut Over<Self, T>,
    ) {
        *out = Self::convert(g, f);
    }

    /// [`compose`](Self::compose) into `out`.
    #[inline(always)]
    fn compose_into(&self, h: &Self, out: &mut Self) {
        *out = self.compose(h);
    }

    /// [`inverse`](Self::inverse) into `out`.
    #[inline(always)]
    fn inverse_into(&self, out: &mut Self) {
        *out = self.inverse();
    }

    /// [`retract`](Self::retract) into `out`.
    #[inline(always)]
    fn retract_into<R: Retraction>(xi: &Self::Algebra, out: &mut Self) {
        *out = Self::retract::<R>(xi);
    }

    /// [`retract_inverse`](Self::retract_inverse) into `out`; where there is none, `out` is not to be used.
    ///
    /// # Errors
    /// As [`retract_inverse`](Self::retract_inverse).
    #[inline(always)]
    fn retract_inverse_into<R: Retraction>(
        &self,
        out: &mut Self::Algebra,
    ) -> Result<(), OutsideChart> {
        *out = self.retract_inverse::<R>()?;
        Ok(())
    }

    /// [`sqrt`](Self::sqrt) into `out`.
    #[inline(always)]
    fn sqrt_into(&self, out: &mut Self) {
        *out = self.sqrt();
    }

    /// [`coadjoint`](Self::coadjoint) into `out`.
    #[inline(always)]
    fn coadjoint_into(&self, mu: &Self::Dual, out: &mut Self::Dual) {
        *out = self.coadjoint(mu);
    }

    /// $\mathrm{Ad}^\ast\_{g^{-1}} \mu$ into `out`: from the frame of $g$ to the frame of the identity.
    #[inline(always)]
    fn inverse_coadjoint_into(&self, mu: &Self::Dual, out: &mut Self::Dual) {
        *out = self.inverse().coadjoint(mu);
    }

    /// The zero of the numbers that [`advance`](Self::advance) carries, of this element's shape.
    fn zero_carry(&self) -> Self {
        self.clone()
    }

    /// $g \leftarrow g f$ for an $f$ near the identity, with the rounding error carried over to the next time.
    ///
    /// Where the product is a sum of $g$ and a small increment, `carry` holds what the last sum has lost (W. Kahan); it
    /// starts as [`zero_carry`](Self::zero_carry). The default does not compensate.
    #[inline(always)]
    fn advance(&mut self, f: &Self, _carry: &mut Self) {
        *self = self.compose(f);
    }

    // Provided: canonical coordinates (c, pi) of the chart about the identity.

    /// From canonical coordinates $(c, \pi)$: $f = \tau(c)$ and the momentum $\mu = (\mathrm d\tau_c^{-1})^\ast \pi$.
    #[inline(always)]
    fn chart_enter_into<R: Retraction>(
        c: &Self::Algebra,
        pi: &Self::Dual,
        (f, mu): (&mut Self, &mut Self::Dual),
    ) {
        Self::retract_into::<R>(c, f);
        *mu = Self::d_left_inv_dual::<R>(c, pi);
    }

    /// To canonical coordinates at the end of a displacement: with $P$ the momentum in the frame of its start, $f = \tau(c)$,
    /// $\mu = \mathrm{Ad}^\ast\_f P$ and $\pi = (\mathrm d\tau_c)^\ast \mu$.
    #[inline(always)]
    fn chart_leave_into<R: Retraction>(
        c: &Self::Algebra,
        momentum: &Self::Dual,
        (f, mu, pi): (&mut Self, &mut Self::Dual, &mut Self::Dual),
    ) {
        Self::retract_into::<R>(c, f);
        f.coadjoint_into(momentum, mu);
        *pi = Self::d_left_dual::<R>(c, mu);
    }

    /// Hamilton's equations in the chart, with the velocity $\xi$ and the force $\tau$:
    /// $\dot c = \mathrm d\tau_c^{-1} \xi$,
    /// $\dot\pi = (\mathrm d\tau_c)^\ast \tau - \partial_c \langle \pi, \mathrm d\tau_c^{-1} \xi\rangle$.
    #[inline(always)]
    fn chart_rates_into<R: Retraction>(
        (c, pi): (&Self::Algebra, &Self::Dual),
        (xi, tau): (&Self::Algebra, &Self::Dual),
        (c_dot, pi_dot): (&mut Self::Algebra, &mut Self::Dual),
    ) {
        *c_dot = Self::d_left_inv::<R>(c, xi);
        *pi_dot = Self::d_left_dual::<R>(c, tau);
        let gradient = Self::d_left_inv_gradient::<R>(c, pi, xi);
        pi_dot.add_scaled(-Self::Scalar::one(), &gradient);
    }

    /// The first of [these](Self::chart_rates_into) alone: $\dot c = \mathrm d\tau_c^{-1} \xi$.
    #[inline(always)]
    fn chart_velocity_into<R: Retraction>(
        c: &Self::Algebra,
        xi: &Self::Algebra,
        c_dot: &mut Self::Algebra,
    ) {
        *c_dot = Self::d_left_inv::<R>(c, xi);
    }
}

fn negated<V: VectorSpace>(xi: &V) -> V {
    let mut minus = xi.clone();
    minus.scale(-V::Scalar::one());
    minus
}

/// A group over `f64`, the base of its family: what an integrator's state is made of.
pub trait RealGroup: LieGroup<Scalar = f64, WithScalar<f64> = Self> {
    /// This element over another scalar, a constant under differentiation.
    ///
    /// ```
    /// use lie::{RealGroup, SO3};
    ///
    /// let single: SO3<f32> = SO3::identity().lift();
    /// assert_eq!(single, SO3::identity());
    /// ```
    fn lift<S: Scalar>(&self) -> Over<Self, S> {
        Self::convert(self, S::from_f64)
    }

    /// Sets this element to another of the same shape, in place.
    #[inline(always)]
    fn copy_from(&mut self, g: &Self) {
        Self::convert_into::<f64, f64>(g, |x| x, self);
    }
}

impl<G: LieGroup<Scalar = f64, WithScalar<f64> = G>> RealGroup for G {}

/// Sets the coordinates of `zeta` to the dual variables of the directions from `first` on, at zero.
///
/// After evaluating a function of, say, $g \exp \zeta$, direction `d` of the result holds the derivative
/// along the basis vector `first + d`: the left-trivialised derivative.
#[inline(always)]
pub fn seed<V: VectorSpace<Scalar: Jet>>(zeta: &mut V, first: usize) {
    for i in 0..zeta.dim() {
        let zero = <V::Scalar as Jet>::Value::zero();
        let x = match i.checked_sub(first) {
            Some(d) if d < crate::JET_DIRECTIONS => V::Scalar::variable(zero, d),
            _ => V::Scalar::constant(zero),
        };
        zeta.set(i, x);
    }
}

/// $\mathrm d\exp_\xi \eta = \sum_k \frac{(-1)^k}{(k+1)!} \mathrm{ad}_\xi^k \eta$, to rounding for $\lVert \mathrm{ad}_\xi \rVert \le 2\pi$.
///
/// The default of [`LieGroup::d_left`]; a group that has closed forms for its Cayley map alone calls it for the exponential.
pub fn dexp<G: LieGroup>(xi: &G::Algebra, eta: &G::Algebra) -> G::Algebra {
    polynomial(eta, &exponential(), |x| G::bracket(xi, x))
}

/// The gradient in $\xi$ of $\langle \mu, \mathrm d\exp_\xi^{-1} \eta\rangle$: that of
/// $-\langle \nu, \mathrm d\exp_\xi \zeta\rangle$ with $\nu = (\mathrm d\exp_\xi^{-1})^\ast \mu$ and
/// $\zeta = \mathrm d\exp_\xi^{-1} \eta$ fixed.
///
/// The default of [`LieGroup::d_left_inv_gradient`].
pub fn dexp_inv_gradient<G: LieGroup>(xi: &G::Algebra, mu: &G::Dual, eta: &G::Algebra) -> G::Dual {
    let nu = G::d_left_inv_dual::<Exp>(xi, mu);
    let zeta = G::d_left_inv::<Exp>(xi, eta);
    let maps = (G::bracket, G::coadjoint_bracket, G::pair);
    let (mut gradient, _) = polynomial_gradient((xi, &nu, &zeta), &exponential(), maps);
    gradient.scale(-G::Scalar::one());
    gradient
}

impl Units {
    /// The units of a group's coordinates.
    pub fn of<G: LieGroup>(g: &G) -> Self {
        let mut units = Self::default();
        g.units(&mut units);
        units
    }
}
