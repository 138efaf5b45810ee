//! SO(2): rotations of the plane.

use crate::numeric::add_compensated;
use crate::{
    Chart, Cotangent, LieGroup, NotUnique, OutsideChart, Over, Retraction, Scalar, Tangent, Units,
};

/// A rotation of the plane, held as $(\cos\theta, \sin\theta)$.
///
/// Algebra and dual are $\mathbb{R}$, by the angular velocity. The group is abelian: $\mathrm{Ad}$ and
/// $\mathrm{Ad}^\ast$ are the identity, $\mathrm{ad}$ and $\mathrm{ad}^\ast$ are zero.
///
/// ```
/// use lie::{LieGroup, SO2};
///
/// let eighth = SO2::from_angle(core::f64::consts::FRAC_PI_4);
/// let [x, y] = eighth.compose(&eighth).rotate([1.0, 0.0]);
/// assert!(x.abs() < 1e-15 && (y - 1.0).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SO2<S = f64> {
    cos: S,
    sin: S,
}

impl<S: Scalar> Default for SO2<S> {
    fn default() -> Self {
        Self::identity()
    }
}

impl<S> SO2<S> {
    #[inline(always)]
    pub(crate) fn parts(&self) -> [&S; 2] {
        [&self.cos, &self.sin]
    }
}

impl<S: Scalar> SO2<S> {
    /// The identity.
    #[inline(always)]
    pub fn identity() -> Self {
        Self::from_cos_sin_unchecked(S::one(), S::zero())
    }

    /// The rotation by this angle, counterclockwise.
    #[inline(always)]
    pub fn from_angle(angle: S) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self::from_cos_sin_unchecked(cos, sin)
    }

    /// The rotation with this cosine and sine, taken on trust.
    #[inline(always)]
    pub fn from_cos_sin_unchecked(cos: S, sin: S) -> Self {
        Self { cos, sin }
    }

    /// The angle, in $(-\pi, \pi]$.
    #[inline(always)]
    pub fn angle(&self) -> S {
        self.sin.atan2(self.cos)
    }

    /// $\cos\theta$.
    #[inline(always)]
    pub fn cos(&self) -> S {
        self.cos
    }

    /// $\sin\theta$.
    #[inline(always)]
    pub fn sin(&self) -> S {
        self.sin
    }

    /// $\cos\theta - 1$, with small relative error also where the rotation is close to the identity.
    ///
    /// ```
    /// use lie::SO2;
    ///
    /// let tiny = SO2::from_angle(1e-9);
    /// assert_eq!((tiny.cos() - 1.0, tiny.cos_minus_one()), (0.0, -0.5e-18));
    /// ```
    #[inline(always)]
    pub fn cos_minus_one(&self) -> S {
        let obtuse = self.is_obtuse();
        let denominator = S::one() + S::select(obtuse, S::one(), self.cos);
        let near = -(self.sin * self.sin / denominator);
        S::select(obtuse, self.cos - S::one(), near)
    }

    /// $R x$.
    #[inline(always)]
    pub fn rotate(&self, [x, y]: [S; 2]) -> [S; 2] {
        let (c, s) = (self.cos, self.sin);
        [c * x - s * y, s * x + c * y]
    }

    /// $R^T x$.
    #[inline(always)]
    pub fn inverse_rotate(&self, x: [S; 2]) -> [S; 2] {
        self.inverse().rotate(x)
    }

    /// The $\xi$ with $\mathrm{cay}(\xi)^2 = R$: $2 \tan\frac\theta4 = 2 \sin\frac\theta2 / (1 + \cos\frac\theta2)$.
    #[inline(always)]
    pub(crate) fn cayley_of_root(&self) -> S {
        let root = self.sqrt();
        (root.sin + root.sin) / (S::one() + root.cos)
    }

    #[inline(always)]
    fn is_obtuse(&self) -> S::Mask {
        self.cos.less(S::zero())
    }

    /// A number that is not of half turns: none where the angle is $\pi$ within its rounding.
    #[inline(always)]
    fn unless_half_turn(&self, x: S) -> Option<S> {
        let by = S::select(self.is_obtuse(), self.sin, S::one());
        x.guarded(by, 4.0 * S::EPSILON)
    }

    /// $1 + \xi^2/4$, the Cayley map's divisor.
    #[inline(always)]
    fn cayley_divisor(xi: S) -> S {
        S::one() + xi * xi * S::from_f64(0.25)
    }

    /// $\mathrm d\tau_\xi$, a number: $1$, or $1 / (1 + \xi^2/4)$.
    #[inline(always)]
    fn d_tau<R: Retraction>(xi: S, x: S) -> S {
        match R::CHART {
            Chart::Exp => x,
            Chart::Cayley => x / Self::cayley_divisor(xi),
        }
    }

    /// $\mathrm d\tau_\xi^{-1}$.
    #[inline(always)]
    fn d_tau_inv<R: Retraction>(xi: S, x: S) -> S {
        match R::CHART {
            Chart::Exp => x,
            Chart::Cayley => x * Self::cayley_divisor(xi),
        }
    }
}

impl<S: Scalar> LieGroup for SO2<S> {
    type Scalar = S;
    type Algebra = Tangent<1, S>;
    type Dual = Cotangent<1, S>;
    type WithScalar<T: Scalar> = SO2<T>;

    #[inline(always)]
    fn zero_algebra(&self) -> Tangent<1, S> {
        Tangent::zero()
    }

    #[inline(always)]
    fn zero_dual(&self) -> Cotangent<1, S> {
        Cotangent::zero()
    }

    #[inline(always)]
    fn convert<A: Scalar, B: Scalar>(g: &SO2<A>, f: impl Fn(A) -> B + Copy) -> Over<Self, B> {
        SO2::from_cos_sin_unchecked(f(g.cos), f(g.sin))
    }

    #[inline(always)]
    fn compose(&self, h: &Self) -> Self {
        let [cos, sin] = self.rotate([h.cos, h.sin]);
        Self::from_cos_sin_unchecked(cos, sin)
    }

    #[inline(always)]
    fn inverse(&self) -> Self {
        Self::from_cos_sin_unchecked(self.cos, -self.sin)
    }

    #[inline(always)]
    fn exp(xi: &Tangent<1, S>) -> Self {
        Self::from_angle(xi[0])
    }

    #[inline(always)]
    fn log(&self) -> Result<Tangent<1, S>, NotUnique<Tangent<1, S>>> {
        let angle = self.angle();
        match self.unless_half_turn(angle) {
            Some(angle) => Ok(Tangent([angle])),
            None => Err(NotUnique {
                representative: Tangent([angle]),
            }),
        }
    }

    #[inline(always)]
    fn adjoint(&self, xi: &Tangent<1, S>) -> Tangent<1, S> {
        *xi
    }

    #[inline(always)]
    fn bracket(_: &Tangent<1, S>, _: &Tangent<1, S>) -> Tangent<1, S> {
        Tangent::zero()
    }

    fn units(&self, units: &mut Units) {
        units.angles(1);
    }

    #[inline(always)]
    fn is_finite(&self) -> bool {
        (self.cos.magnitude() + self.sin.magnitude()).is_finite()
    }

    #[inline(always)]
    fn coadjoint(&self, mu: &Cotangent<1, S>) -> Cotangent<1, S> {
        *mu
    }

    #[inline(always)]
    fn coadjoint_bracket(_: &Tangent<1, S>, _: &Cotangent<1, S>) -> Cotangent<1, S> {
        Cotangent::zero()
    }

    /// $(1 - \xi^2/4, \xi) / (1 + \xi^2/4)$: the rotation by $2 \arctan(\xi/2)$.
    #[inline(always)]
    fn cayley(xi: &Tangent<1, S>) -> Self {
        let scale = S::one() / Self::cayley_divisor(xi[0]);
        let cos = (S::one() - xi[0] * xi[0] * S::from_f64(0.25)) * scale;
        Self::from_cos_sin_unchecked(cos, xi[0] * scale)
    }

    /// $2 \tan\frac\theta2$, as $2 \sin\theta / (1 + \cos\theta)$ or $2 (1 - \cos\theta) / \sin\theta$, which do not cancel.
    #[inline(always)]
    fn cayley_inverse(&self) -> Result<Tangent<1, S>, OutsideChart> {
        let (one, obtuse) = (S::one(), self.is_obtuse());
        let numerator = S::select(obtuse, one - self.cos, self.sin);
        let denominator = S::select(obtuse, self.sin, one + self.cos);
        let tangent = self.unless_half_turn((numerator + numerator) / denominator);
        Ok(Tangent([tangent.ok_or(OutsideChart)?]))
    }

    #[inline(always)]
    fn d_left<R: Retraction>(xi: &Tangent<1, S>, eta: &Tangent<1, S>) -> Tangent<1, S> {
        Tangent([Self::d_tau::<R>(xi[0], eta[0])])
    }

    #[inline(always)]
    fn d_left_inv<R: Retraction>(xi: &Tangent<1, S>, eta: &Tangent<1, S>) -> Tangent<1, S> {
        Tangent([Self::d_tau_inv::<R>(xi[0], eta[0])])
    }

    #[inline(always)]
    fn d_left_dual<R: Retraction>(xi: &Tangent<1, S>, mu: &Cotangent<1, S>) -> Cotangent<1, S> {
        Cotangent([Self::d_tau::<R>(xi[0], mu[0])])
    }

    #[inline(always)]
    fn d_left_inv_dual<R: Retraction>(xi: &Tangent<1, S>, mu: &Cotangent<1, S>) -> Cotangent<1, S> {
        Cotangent([Self::d_tau_inv::<R>(xi[0], mu[0])])
    }

    /// Zero, or $\frac12 \mu \xi \eta$.
    #[inline(always)]
    fn d_left_inv_gradient<R: Retraction>(
        xi: &Tangent<1, S>,
        mu: &Cotangent<1, S>,
        eta: &Tangent<1, S>,
    ) -> Cotangent<1, S> {
        match R::CHART {
            Chart::Exp => Cotangent::zero(),
            Chart::Cayley => Cotangent([mu[0] * xi[0] * eta[0] * S::from_f64(0.5)]),
        }
    }

    /// The half angle's larger part from $\frac12 (1 + |\cos\theta|)$, the smaller one from $\sin\theta$.
    #[inline(always)]
    fn sqrt(&self) -> Self {
        let (half, obtuse) = (S::from_f64(0.5), self.is_obtuse());
        let size = S::select(obtuse, -self.cos, self.cos);
        let large = ((S::one() + size) * half).sqrt();
        let small = self.sin * half / large;
        let clockwise = self.sin.less(S::zero());
        let (far_cos, far_sin) = (
            S::select(clockwise, -small, small),
            S::select(clockwise, -large, large),
        );
        Self::from_cos_sin_unchecked(
            S::select(obtuse, far_cos, large),
            S::select(obtuse, far_sin, small),
        )
    }

    #[inline(always)]
    fn zero_carry(&self) -> Self {
        Self::from_cos_sin_unchecked(S::zero(), S::zero())
    }

    #[inline(always)]
    fn advance(&mut self, f: &Self, carry: &mut Self) {
        let (c, s, less) = (self.cos, self.sin, f.cos_minus_one());
        add_compensated(&mut self.cos, c * less - s * f.sin, &mut carry.cos);
        add_compensated(&mut self.sin, s * less + c * f.sin, &mut carry.sin);
    }

    /// One Newton step for the unit length, $z \leftarrow \frac12 z (3 - |z|^2)$.
    #[inline(always)]
    fn normalize(&mut self) {
        let defect = S::one() - (self.cos * self.cos + self.sin * self.sin);
        let correction = defect * S::from_f64(0.5);
        self.cos += self.cos * correction;
        self.sin += self.sin * correction;
    }
}
