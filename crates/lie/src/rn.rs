//! $\mathbb{R}^n$ under addition.

use crate::numeric::add_all_compensated;
use crate::{Cotangent, LieGroup, NotUnique, Over, Retraction, Scalar, Tangent, Vec3};

/// A vector of $\mathbb{R}^n$, the group operation being addition.
///
/// Its coordinates share a unit: for a length and an angle, take `(Rn<1>, SO2)` or `(Rn<1>, Rn<1>)`.
///
/// The group is abelian: $\mathrm{Ad}$ and $\mathrm{Ad}^\ast$ are the identity, $\mathrm{ad}$ and $\mathrm{ad}^\ast$ are zero.
///
/// ```
/// use lie::{LieGroup, Rn};
///
/// assert_eq!(Rn([1.0, 2.0]).compose(&Rn([3.0, 4.0])), Rn([4.0, 6.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rn<const N: usize, S = f64>(pub [S; N]);

/// Space, $\mathbb{R}^3$.
pub type R3<S = f64> = Rn<3, S>;

impl<const N: usize, S: Scalar> Rn<N, S> {
    /// The identity: zero.
    #[inline(always)]
    pub fn identity() -> Self {
        Self([S::zero(); N])
    }
}

impl<const N: usize, S: Scalar> Default for Rn<N, S> {
    fn default() -> Self {
        Self::identity()
    }
}

impl<const N: usize, S> core::ops::Index<usize> for Rn<N, S> {
    type Output = S;
    #[inline(always)]
    fn index(&self, i: usize) -> &S {
        &self.0[i]
    }
}

impl<S: Scalar> R3<S> {
    /// The coordinates as a vector.
    #[inline(always)]
    pub fn vec3(&self) -> Vec3<S> {
        Vec3(self.0)
    }
}

impl<S> From<Vec3<S>> for R3<S> {
    #[inline(always)]
    fn from(x: Vec3<S>) -> Self {
        Rn(x.0)
    }
}

impl<const N: usize, S: Scalar> LieGroup for Rn<N, S> {
    type Scalar = S;
    type Algebra = Tangent<N, S>;
    type Dual = Cotangent<N, S>;
    type WithScalar<T: Scalar> = Rn<N, T>;

    #[inline(always)]
    fn zero_algebra(&self) -> Tangent<N, S> {
        Tangent::zero()
    }

    #[inline(always)]
    fn zero_dual(&self) -> Cotangent<N, S> {
        Cotangent::zero()
    }

    #[inline(always)]
    fn convert<A: Scalar, B: Scalar>(g: &Rn<N, A>, f: impl Fn(A) -> B + Copy) -> Over<Self, B> {
        Rn(g.0.map(f))
    }

    #[inline(always)]
    fn compose(&self, h: &Self) -> Self {
        let mut sum = *self;
        sum.0.iter_mut().zip(h.0).for_each(|(x, y)| *x += y);
        sum
    }

    #[inline(always)]
    fn inverse(&self) -> Self {
        Self(self.0.map(|x| -x))
    }

    #[inline(always)]
    fn exp(xi: &Tangent<N, S>) -> Self {
        Self(xi.0)
    }

    #[inline(always)]
    fn log(&self) -> Result<Tangent<N, S>, NotUnique<Tangent<N, S>>> {
        Ok(Tangent(self.0))
    }

    #[inline(always)]
    fn adjoint(&self, xi: &Tangent<N, S>) -> Tangent<N, S> {
        *xi
    }

    #[inline(always)]
    fn bracket(_: &Tangent<N, S>, _: &Tangent<N, S>) -> Tangent<N, S> {
        Tangent::zero()
    }

    #[inline(always)]
    fn is_finite(&self) -> bool {
        self.0.iter().all(|x| x.magnitude().is_finite())
    }

    #[inline(always)]
    fn zero_carry(&self) -> Self {
        Self::identity()
    }

    #[inline(always)]
    fn advance(&mut self, f: &Self, carry: &mut Self) {
        add_all_compensated(&mut self.0, f.0, &mut carry.0);
    }

    #[inline(always)]
    fn coadjoint(&self, mu: &Cotangent<N, S>) -> Cotangent<N, S> {
        *mu
    }

    #[inline(always)]
    fn coadjoint_bracket(_: &Tangent<N, S>, _: &Cotangent<N, S>) -> Cotangent<N, S> {
        Cotangent::zero()
    }

    #[inline(always)]
    fn d_left<R: Retraction>(_: &Tangent<N, S>, eta: &Tangent<N, S>) -> Tangent<N, S> {
        *eta
    }

    #[inline(always)]
    fn d_left_inv<R: Retraction>(_: &Tangent<N, S>, eta: &Tangent<N, S>) -> Tangent<N, S> {
        *eta
    }

    #[inline(always)]
    fn d_left_dual<R: Retraction>(_: &Tangent<N, S>, mu: &Cotangent<N, S>) -> Cotangent<N, S> {
        *mu
    }

    #[inline(always)]
    fn d_left_inv_dual<R: Retraction>(_: &Tangent<N, S>, mu: &Cotangent<N, S>) -> Cotangent<N, S> {
        *mu
    }

    #[inline(always)]
    fn d_left_inv_gradient<R: Retraction>(
        _: &Tangent<N, S>,
        _: &Cotangent<N, S>,
        _: &Tangent<N, S>,
    ) -> Cotangent<N, S> {
        Cotangent::zero()
    }

    #[inline(always)]
    fn inverse_coadjoint_into(&self, mu: &Cotangent<N, S>, out: &mut Cotangent<N, S>) {
        *out = *mu;
    }

    #[inline(always)]
    fn sqrt(&self) -> Self {
        Self(self.0.map(|x| x * S::from_f64(0.5)))
    }
}
