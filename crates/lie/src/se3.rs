//! SE(3): rigid displacements of space.

use crate::numeric::add_all_compensated;
use crate::series::{polynomial, polynomial_gradient};
use crate::stumpff::{stumpff, stumpff_next};
use crate::{
    Cayley, Chart, Cotangent, Exp, LieGroup, NotUnique, OutsideChart, Over, Retraction, SO3,
    Scalar, Tangent, Units, Vec3,
};

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

    /// $R y + x$: where the point `y` of the body is.
    #[inline(always)]
    pub fn act(&self, y: Vec3<S>) -> Vec3<S> {
        self.rotation.rotate(y) + self.translation
    }

    /// $(1 - \hat\omega/2)^{-1} v = \frac{1}{1 + |\omega|^2/4} \left(1 + \frac12 \hat\omega + \frac14 \omega\omega^T\right) v$.
    #[inline(always)]
    fn cayley_translation(w: Vec3<S>, v: Vec3<S>) -> Vec3<S> {
        let quarter = S::from_f64(0.25);
        let scale = S::one() / (S::one() + w.norm_squared() * quarter);
        (v + w.cross(v) * S::from_f64(0.5) + w * (w.dot(v) * quarter)) * scale
    }

    /// A polynomial of degree 4 in $\mathrm{ad}\_\xi$, whose minimal polynomial is $\lambda(\lambda^2 + \theta^2)^2$:
    /// J. M. Selig, *Geometric Fundamentals of Robotics* (2005), ch. 4, rewritten in Stumpff functions.
    #[inline(always)]
    fn dexp_coefficients(xi: &Tangent<6, S>) -> [S; 4] {
        let (w, _) = xi.split();
        let [c1, c2, c3, c4, c5, _] = stumpff(w.norm_squared());
        let (half, c) = (S::from_f64(0.5), S::from_f64);
        let a1 = (c(4.0) * c2 - c1) * half;
        let a2 = (c(5.0) * c3 - c2) * half;
        let a3 = (c3 - c(2.0) * c4) * half;
        let a4 = (c4 - c(3.0) * c5) * half;
        [-a1, a2, -a3, a4]
    }

    /// $1 + \frac12 \mathrm{ad} + \frac{3 c_3 - 8 c_4}{4 c_2} \mathrm{ad}^2 + \frac{4 c_6 - c_5}{4 c_2} \mathrm{ad}^4$; source as above.
    #[inline(always)]
    fn dexp_inv_coefficients(xi: &Tangent<6, S>) -> [S; 4] {
        let (w, _) = xi.split();
        let [_, c2, c3, c4, c5, c6] = stumpff(w.norm_squared());
        let c = S::from_f64;
        let scale = S::one() / (c(4.0) * c2);
        let b2 = (c(3.0) * c3 - c(8.0) * c4) * scale;
        let b4 = (c(4.0) * c6 - c5) * scale;
        [c(0.5), b2, S::zero(), b4]
    }

    /// The derivative of [`dexp_inv_coefficients`](Self::dexp_inv_coefficients)' last one in $x = |\omega|^2$; that of
    /// the second is $x$ times as much.
    ///
    /// $c_k' = \frac12 (k c_{k+2} - c_{k+1})$ makes it $\frac{c_6 - 9 c_7 + 24 c_8}{8 c_2} + \frac{c_3 - 2 c_4}{2 c_2} b_4$.
    #[inline(always)]
    fn dexp_inv_slope(x: S, b4: S) -> S {
        let [_, c2, c3, c4, c5, c6] = stumpff(x);
        let ([c7, c8], c) = (stumpff_next(x, [c5, c6]), S::from_f64);
        let numerator = c6 - c(9.0) * c7 + c(24.0) * c8 + c(4.0) * (c3 - c4 - c4) * b4;
        numerator / (c(8.0) * c2)
    }

    /// The polynomial's, and those of its coefficients in $|\omega|^2$.
    #[inline(always)]
    fn dexp_inv_gradient(
        xi: &Tangent<6, S>,
        mu: &Cotangent<6, S>,
        eta: &Tangent<6, S>,
    ) -> Cotangent<6, S> {
        let ((w, _), b) = (xi.split(), Self::dexp_inv_coefficients(xi));
        let (gradient, in_b) = polynomial_gradient(
            (xi, mu, eta),
            &b,
            (Self::bracket, Self::coadjoint_bracket, Self::pair),
        );
        let x = w.norm_squared();
        let along = Self::dexp_inv_slope(x, b[3]) * (x * in_b[1] + in_b[3]);
        gradient + (w * (along + along), Vec3::zero()).into()
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
            let v = SO3::d_right_inv::<Exp>(&w, &self.translation.into());
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

    fn units(&self, units: &mut Units) {
        units.angles(3);
        units.vector(3);
    }

    #[inline(always)]
    fn is_finite(&self) -> bool {
        self.rotation.is_finite() && self.translation.is_finite()
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

    /// Cayley's: $(\mathrm d\mathrm{cay}_\omega \eta, (1 + \hat\omega/2)^{-1} (u + \frac12 \eta \times x))$ with $x$ the
    /// translation of $\mathrm{cay}(\omega, v)$.
    #[inline(always)]
    fn d_left<R: Retraction>(xi: &Tangent<6, S>, eta: &Tangent<6, S>) -> Tangent<6, S> {
        if R::CHART == Chart::Exp {
            return polynomial(eta, &Self::dexp_coefficients(xi), |x| Self::bracket(xi, x));
        }
        let ((w, v), (eta, u)) = (xi.split(), eta.split());
        let moved = u + eta.cross(Self::cayley_translation(w, v)) * S::from_f64(0.5);
        let angular = SO3::d_left::<Cayley>(&w.into(), &eta.into()).vec3();
        (angular, Self::cayley_translation(-w, moved)).into()
    }

    #[inline(always)]
    fn d_left_inv<R: Retraction>(xi: &Tangent<6, S>, eta: &Tangent<6, S>) -> Tangent<6, S> {
        if R::CHART == Chart::Exp {
            return polynomial(eta, &Self::dexp_inv_coefficients(xi), |x| {
                Self::bracket(xi, x)
            });
        }
        let ((w, v), (omega, u)) = (xi.split(), eta.split());
        let half = S::from_f64(0.5);
        let angular = SO3::d_left_inv::<Cayley>(&w.into(), &omega.into()).vec3();
        let x = Self::cayley_translation(w, v);
        (angular, u + w.cross(u) * half - angular.cross(x) * half).into()
    }

    /// Cayley's: $((\mathrm d\mathrm{cay}_\omega)^\ast \pi + \frac12 x \times p, p)$ with $p = (1 - \hat\omega/2)^{-1} q$ and
    /// $x$ the translation of $\mathrm{cay}(\omega, v)$.
    #[inline(always)]
    fn d_left_dual<R: Retraction>(xi: &Tangent<6, S>, mu: &Cotangent<6, S>) -> Cotangent<6, S> {
        if R::CHART == Chart::Exp {
            return polynomial(mu, &Self::dexp_coefficients(xi), |x| {
                Self::coadjoint_bracket(xi, x)
            });
        }
        let ((w, v), (angular, q)) = (xi.split(), mu.split());
        let (p, x) = (
            Self::cayley_translation(w, q),
            Self::cayley_translation(w, v),
        );
        let angular = SO3::d_left_dual::<Cayley>(&w.into(), &angular.into()).vec3();
        (angular + x.cross(p) * S::from_f64(0.5), p).into()
    }

    /// Cayley's: $((\mathrm d\mathrm{cay}_\omega^{-1})^\ast \pi + \frac12 p \times v, p)$ with $p = (1 - \hat\omega/2) q$.
    #[inline(always)]
    fn d_left_inv_dual<R: Retraction>(xi: &Tangent<6, S>, mu: &Cotangent<6, S>) -> Cotangent<6, S> {
        if R::CHART == Chart::Exp {
            return polynomial(mu, &Self::dexp_inv_coefficients(xi), |x| {
                Self::coadjoint_bracket(xi, x)
            });
        }
        let ((w, v), (angular, q)) = (xi.split(), mu.split());
        let half = S::from_f64(0.5);
        let p = q - w.cross(q) * half;
        let angular = SO3::d_left_inv_dual::<Cayley>(&w.into(), &angular.into()).vec3();
        (angular + p.cross(v) * half, p).into()
    }

    /// Cayley's: SO(3)'s in $(\omega, \pi, \alpha)$ and that of $p \cdot u'$ with $p = (1 - \hat\omega/2) q$,
    /// $u' = u - \frac12 \alpha \times v$: $\frac12 (u' \times q, \alpha \times p)$.
    #[inline(always)]
    fn d_left_inv_gradient<R: Retraction>(
        xi: &Tangent<6, S>,
        mu: &Cotangent<6, S>,
        eta: &Tangent<6, S>,
    ) -> Cotangent<6, S> {
        if R::CHART == Chart::Exp {
            return Self::dexp_inv_gradient(xi, mu, eta);
        }
        let ((w, v), (angular, q), (a, u)) = (xi.split(), mu.split(), eta.split());
        let half = S::from_f64(0.5);
        let (p, moved) = (q - w.cross(q) * half, u - a.cross(v) * half);
        let rotation = SO3::d_left_inv_gradient::<Cayley>(&w.into(), &angular.into(), &a.into());
        (rotation.vec3() + moved.cross(q) * half, a.cross(p) * half).into()
    }

    /// $(R^{1/2}, (1 + R^{1/2})^{-1} x)$, the inverse as $\frac12 (1 - \hat\omega/2)$ for $R^{1/2} = \mathrm{cay}(\omega)$.
    #[inline(always)]
    fn sqrt(&self) -> Self {
        let (w, half) = (self.rotation.cayley_of_root(), S::from_f64(0.5));
        let translation = self.translation - w.cross(self.translation) * half;
        Self::new(SO3::cayley(&w.into()), translation * half)
    }

    #[inline(always)]
    fn zero_carry(&self) -> Self {
        Self::new(self.rotation.zero_carry(), Vec3::zero())
    }

    #[inline(always)]
    fn advance(&mut self, f: &Self, carry: &mut Self) {
        let (x, carried) = (&mut self.translation.0, &mut carry.translation.0);
        add_all_compensated(x, self.rotation.rotate(f.translation).0, carried);
        self.rotation.advance(&f.rotation, &mut carry.rotation);
    }

    #[inline(always)]
    fn normalize(&mut self) {
        self.rotation.normalize();
    }
}
