//! SE(3): rigid displacements of space.

use crate::stumpff::stumpff;
use crate::{Cotangent, LieGroup, NotUnique, OutsideChart, Over, SO3, Scalar, Tangent, Vec3};

/// A rigid displacement $y \mapsto R y + x$, the semidirect product $SO(3) \ltimes \mathbb{R}^3$.
///
/// Coordinates of the algebra: angular, then linear velocity, both in the body's frame, $(\omega, v)$;
/// of the dual: $(\pi, q)$. Then $\mathrm{Ad}\_{(R,x)} (\omega, v) = (R\omega, Rv + x \times R\omega)$ and
/// $\mathrm{Ad}^\ast\_{(R,x)} (\pi, q) = (R^T(\pi + q \times x), R^T q)$.
///
/// ```
/// use lie::{LieGroup, SE3, SO3, Vec3};
///
/// let shift = SE3::new(SO3::identity(), Vec3([1.0, 2.0, 3.0]));
/// assert_eq!(shift.compose(&shift).translation, Vec3([2.0, 4.0, 6.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SE3<S = f64> {
    /// The rotation $R$.
    pub rotation: SO3<S>,
    /// The translation $x$.
    pub translation: Vec3<S>,
}

impl<S: Scalar> Default for SE3<S> {
    fn default() -> Self {
        Self::identity()
    }
}

impl<S: Scalar> SE3<S> {
    /// The identity.
    #[inline(always)]
    pub fn identity() -> Self {
        Self::new(SO3::identity(), Vec3::zero())
    }

    /// The displacement $y \mapsto R y + x$.
    #[inline(always)]
    pub fn new(rotation: SO3<S>, translation: Vec3<S>) -> Self {
        Self {
            rotation,
            translation,
        }
    }

    /// $(1 - \hat\omega/2)^{-1} v = \frac{1}{1 + |\omega|^2/4} \left(1 + \frac12 \hat\omega + \frac14 \omega\omega^T\right) v$.
    #[inline(always)]
    fn cayley_translation(w: Vec3<S>, v: Vec3<S>) -> Vec3<S> {
        let quarter = S::from_f64(0.25);
        let scale = S::one() / (S::one() + w.norm_squared() * quarter);
        (v + w.cross(v) * S::from_f64(0.5) + w * (w.dot(v) * quarter)) * scale
    }

    /// $\eta + \sum_k a_k \mathrm{ad}\_\xi^k \eta$ for $k = 1, \dots, 4$.
    #[inline(always)]
    fn ad_polynomial(xi: &Tangent<6, S>, eta: &Tangent<6, S>, a: [S; 4]) -> Tangent<6, S> {
        let mut power = *eta;
        a.into_iter().fold(*eta, |sum, a| {
            power = Self::bracket(xi, &power);
            sum + power * a
        })
    }
}

impl<S: Scalar> LieGroup for SE3<S> {
    type Scalar = S;
    type Algebra = Tangent<6, S>;
    type Dual = Cotangent<6, S>;
    type WithScalar<T: Scalar> = SE3<T>;

    #[inline(always)]
    fn zero_algebra(&self) -> Tangent<6, S> {
        Tangent::zero()
    }

    #[inline(always)]
    fn zero_dual(&self) -> Cotangent<6, S> {
        Cotangent::zero()
    }

    #[inline(always)]
    fn convert<A: Scalar, B: Scalar>(g: &SE3<A>, f: impl Fn(A) -> B + Copy) -> Over<Self, B> {
        let rotation = <SO3<S> as LieGroup>::convert(&g.rotation, f);
        SE3::new(rotation, Vec3(g.translation.0.map(f)))
    }

    #[inline(always)]
    fn compose(&self, h: &Self) -> Self {
        let translation = self.translation + self.rotation.rotate(h.translation);
        Self::new(self.rotation.compose(&h.rotation), translation)
    }

    #[inline(always)]
    fn inverse(&self) -> Self {
        Self::new(
            self.rotation.inverse(),
            -self.rotation.inverse_rotate(self.translation),
        )
    }

    /// $(\exp\hat\omega, (1 + c_2 \hat\omega + c_3 \hat\omega^2) v)$.
    #[inline(always)]
    fn exp(xi: &Tangent<6, S>) -> Self {
        let (w, v) = xi.split();
        let [_, c2, c3, ..] = stumpff(w.norm_squared());
        let once = w.cross(v);
        Self::new(SO3::exp(&w.into()), v + once * c2 + w.cross(once) * c3)
    }

    #[inline(always)]
    fn log(&self) -> Result<Tangent<6, S>, NotUnique<Tangent<6, S>>> {
        let with_translation = |w: Tangent<3, S>| {
            // The inverse of the right-trivialised differential takes x back to v.
            let v = SO3::dexp_inv(&-w, &self.translation.into());
            Tangent::from((w.vec3(), v.vec3()))
        };
        match self.rotation.log() {
            Ok(w) => Ok(with_translation(w)),
            Err(e) => Err(NotUnique {
                representative: with_translation(e.representative),
            }),
        }
    }

    #[inline(always)]
    fn adjoint(&self, xi: &Tangent<6, S>) -> Tangent<6, S> {
        let (w, v) = xi.split();
        let rotated = self.rotation.rotate(w);
        (
            rotated,
            self.rotation.rotate(v) + self.translation.cross(rotated),
        )
            .into()
    }

    #[inline(always)]
    fn bracket(xi: &Tangent<6, S>, eta: &Tangent<6, S>) -> Tangent<6, S> {
        let ((w, v), (a, b)) = (xi.split(), eta.split());
        (w.cross(a), w.cross(b) + v.cross(a)).into()
    }

    #[inline(always)]
    fn is_finite(&self) -> bool {
        self.rotation.is_finite() && self.translation.is_finite()
    }

    #[inline(always)]
    fn identity_like(&self) -> Self {
        Self::identity()
    }

    #[inline(always)]
    fn coadjoint(&self, mu: &Cotangent<6, S>) -> Cotangent<6, S> {
        let (angular, linear) = mu.split();
        let r = &self.rotation;
        (
            r.inverse_rotate(angular + linear.cross(self.translation)),
            r.inverse_rotate(linear),
        )
            .into()
    }

    #[inline(always)]
    fn coadjoint_bracket(xi: &Tangent<6, S>, mu: &Cotangent<6, S>) -> Cotangent<6, S> {
        let ((w, v), (angular, linear)) = (xi.split(), mu.split());
        (angular.cross(w) + linear.cross(v), linear.cross(w)).into()
    }

    /// A polynomial of degree 4 in $\mathrm{ad}\_\xi$, whose minimal polynomial is $\lambda(\lambda^2 + \theta^2)^2$:
    /// J. M. Selig, *Geometric Fundamentals of Robotics* (2005), ch. 4, rewritten in Stumpff functions.
    #[inline(always)]
    fn dexp(xi: &Tangent<6, S>, eta: &Tangent<6, S>) -> Tangent<6, S> {
        let (w, _) = xi.split();
        let [c1, c2, c3, c4, c5, _] = stumpff(w.norm_squared());
        let (half, c) = (S::from_f64(0.5), S::from_f64);
        let a1 = (c(4.0) * c2 - c1) * half;
        let a2 = (c(5.0) * c3 - c2) * half;
        let a3 = (c3 - c(2.0) * c4) * half;
        let a4 = (c4 - c(3.0) * c5) * half;
        Self::ad_polynomial(xi, eta, [-a1, a2, -a3, a4])
    }

    /// $1 + \frac12 \mathrm{ad} + \frac{3 c_3 - 8 c_4}{4 c_2} \mathrm{ad}^2 + \frac{4 c_6 - c_5}{4 c_2} \mathrm{ad}^4$; source as [`dexp`](LieGroup::dexp).
    #[inline(always)]
    fn dexp_inv(xi: &Tangent<6, S>, eta: &Tangent<6, S>) -> Tangent<6, S> {
        let (w, _) = xi.split();
        let [_, c2, c3, c4, c5, c6] = stumpff(w.norm_squared());
        let c = S::from_f64;
        let scale = S::one() / (c(4.0) * c2);
        let b2 = (c(3.0) * c3 - c(8.0) * c4) * scale;
        let b4 = (c(4.0) * c6 - c5) * scale;
        Self::ad_polynomial(xi, eta, [c(0.5), b2, S::zero(), b4])
    }

    /// The Cayley map of the 4×4 matrices: $(\mathrm{cay}(\omega), (1 - \hat\omega/2)^{-1} v)$.
    #[inline(always)]
    fn cayley(xi: &Tangent<6, S>) -> Self {
        let (w, v) = xi.split();
        Self::new(SO3::cayley(&w.into()), Self::cayley_translation(w, v))
    }

    #[inline(always)]
    fn cayley_inverse(&self) -> Result<Tangent<6, S>, OutsideChart> {
        let w = self.rotation.cayley_inverse()?.vec3();
        let v = self.translation - w.cross(self.translation) * S::from_f64(0.5);
        Ok((w, v).into())
    }

    /// $(\mathrm d\mathrm{cay}_\omega \eta, (1 + \hat\omega/2)^{-1} (u + \frac12 \eta \times x))$ with $x$ the translation of $\mathrm{cay}(\omega, v)$.
    #[inline(always)]
    fn dcay(xi: &Tangent<6, S>, eta: &Tangent<6, S>) -> Tangent<6, S> {
        let ((w, v), (eta, u)) = (xi.split(), eta.split());
        let moved = u + eta.cross(Self::cayley_translation(w, v)) * S::from_f64(0.5);
        (
            SO3::dcay(&w.into(), &eta.into()).vec3(),
            Self::cayley_translation(-w, moved),
        )
            .into()
    }

    #[inline(always)]
    fn dcay_inv(xi: &Tangent<6, S>, eta: &Tangent<6, S>) -> Tangent<6, S> {
        let ((w, v), (omega, u)) = (xi.split(), eta.split());
        let half = S::from_f64(0.5);
        let angular = SO3::dcay_inv(&w.into(), &omega.into()).vec3();
        let x = Self::cayley_translation(w, v);
        (angular, u + w.cross(u) * half - angular.cross(x) * half).into()
    }

    #[inline(always)]
    fn normalize(&mut self) {
        self.rotation.normalize();
    }
}
