//! SE(2): rigid displacements of the plane.

use crate::numeric::add_all_compensated;
use crate::plane::{add, cross, scale, turn};
use crate::series::{polynomial, polynomial_gradient};
use crate::stumpff::{dexp_inv_factor, stumpff, stumpff2};
use crate::{
    Cayley, Chart, Cotangent, LieGroup, NotUnique, OutsideChart, Over, Retraction, SO2, Scalar,
    Tangent, Units,
};

/// A rigid displacement $y \mapsto R y + x$ of the plane, the semidirect product $SO(2) \ltimes \mathbb{R}^2$.
///
/// Coordinates of the algebra: angular, then linear velocity, both in the body's frame, $(\omega, v_x, v_y)$;
/// of the dual: $(\pi, q_x, q_y)$. With the quarter turn $J$ and $x \times y = x_1 y_2 - x_2 y_1$,
/// $\mathrm{Ad}\_{(R,x)} (\omega, v) = (\omega, Rv - \omega J x)$,
/// $\mathrm{Ad}^\ast\_{(R,x)} (\pi, q) = (\pi + q \times x, R^T q)$,
/// $\mathrm{ad}\_{(\omega,v)} (\alpha, u) = (0, \omega J u - \alpha J v)$ and
/// $\mathrm{ad}^\ast\_{(\omega,v)} (\pi, q) = (q \times v, -\omega J q)$.
///
/// ```
/// use lie::{LieGroup, SE2, SO2};
///
/// let corner = SE2::new(SO2::from_angle(core::f64::consts::FRAC_PI_2), [1.0, 0.0]);
/// let [x, y] = corner.compose(&corner).translation;
/// assert!((x - 1.0).abs() < 1e-15 && (y - 1.0).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SE2<S = f64> {
    /// The rotation $R$.
    pub rotation: SO2<S>,
    /// The translation $x$.
    pub translation: [S; 2],
}

impl<S: Scalar> Default for SE2<S> {
    fn default() -> Self {
        Self::identity()
    }
}

impl<S: Scalar> SE2<S> {
    /// The identity.
    #[inline(always)]
    pub fn identity() -> Self {
        Self::new(SO2::identity(), [S::zero(); 2])
    }

    /// The displacement $y \mapsto R y + x$.
    #[inline(always)]
    pub fn new(rotation: SO2<S>, translation: [S; 2]) -> Self {
        Self {
            rotation,
            translation,
        }
    }

    /// $R y + x$: where the point `y` of the body is.
    #[inline(always)]
    pub fn act(&self, y: [S; 2]) -> [S; 2] {
        add(self.rotation.rotate(y), self.translation)
    }

    /// $(1 - \omega J/2)^{-1} v = \frac{1}{1 + \omega^2/4} (1 + \omega J/2) v$.
    #[inline(always)]
    fn cayley_translation(w: S, v: [S; 2]) -> [S; 2] {
        let half = w * S::from_f64(0.5);
        scale(S::one() / (S::one() + half * half), half_turned(w, v))
    }

    /// $\mathrm d\exp_\xi = 1 - c_2\, \mathrm{ad}\_\xi + c_3\, \mathrm{ad}\_\xi^2$: the minimal polynomial of
    /// $\mathrm{ad}\_\xi$ is $\lambda (\lambda^2 + \omega^2)$.
    #[inline(always)]
    fn dexp_coefficients(xi: &Tangent<3, S>) -> [S; 2] {
        let [_, c2, c3, ..] = stumpff(xi[0] * xi[0]);
        [-c2, c3]
    }

    /// $\mathrm d\exp_\xi^{-1} = 1 + \frac12 \mathrm{ad}\_\xi + g(\omega^2)\, \mathrm{ad}\_\xi^2$ with $g$ of [`dexp_inv_factor`].
    #[inline(always)]
    fn dexp_inv_coefficients(xi: &Tangent<3, S>) -> [S; 2] {
        let [factor, _] = dexp_inv_factor(xi[0] * xi[0]);
        [S::from_f64(0.5), factor]
    }

    /// The polynomial's, and that of $g(\omega^2)$.
    #[inline(always)]
    fn dexp_inv_gradient(
        xi: &Tangent<3, S>,
        mu: &Cotangent<3, S>,
        eta: &Tangent<3, S>,
    ) -> Cotangent<3, S> {
        let ([factor, slope], half) = (dexp_inv_factor(xi[0] * xi[0]), S::from_f64(0.5));
        let (mut gradient, in_a) = polynomial_gradient(
            (xi, mu, eta),
            &[half, factor],
            (Self::bracket, Self::coadjoint_bracket, Self::pair),
        );
        gradient[0] += (slope + slope) * xi[0] * in_a[1];
        gradient
    }
}

/// $(1 + \omega J/2) v$.
#[inline(always)]
fn half_turned<S: Scalar>(w: S, v: [S; 2]) -> [S; 2] {
    add(v, turn(w * S::from_f64(0.5), v))
}

#[inline(always)]
fn split<S: Scalar>([w, x, y]: [S; 3]) -> (S, [S; 2]) {
    (w, [x, y])
}

#[inline(always)]
fn join<S: Scalar>(w: S, [x, y]: [S; 2]) -> [S; 3] {
    [w, x, y]
}

impl<S: Scalar> LieGroup for SE2<S> {
    type Scalar = S;
    type Algebra = Tangent<3, S>;
    type Dual = Cotangent<3, S>;
    type WithScalar<T: Scalar> = SE2<T>;

    #[inline(always)]
    fn zero_algebra(&self) -> Tangent<3, S> {
        Tangent::zero()
    }

    #[inline(always)]
    fn zero_dual(&self) -> Cotangent<3, S> {
        Cotangent::zero()
    }

    #[inline(always)]
    fn convert<A: Scalar, B: Scalar>(g: &SE2<A>, f: impl Fn(A) -> B + Copy) -> Over<Self, B> {
        let rotation = <SO2<S> as LieGroup>::convert(&g.rotation, f);
        SE2::new(rotation, g.translation.map(f))
    }

    #[inline(always)]
    fn compose(&self, h: &Self) -> Self {
        let translation = add(self.translation, self.rotation.rotate(h.translation));
        Self::new(self.rotation.compose(&h.rotation), translation)
    }

    #[inline(always)]
    fn inverse(&self) -> Self {
        let [x, y] = self.rotation.inverse_rotate(self.translation);
        Self::new(self.rotation.inverse(), [-x, -y])
    }

    /// $(\exp\omega, (c_1 + c_2 \omega J) v)$ with the Stumpff functions of $\omega^2$.
    #[inline(always)]
    fn exp(xi: &Tangent<3, S>) -> Self {
        let (w, v) = split(xi.0);
        let [c1, c2] = stumpff2(w * w);
        let translation = add(scale(c1, v), turn(c2 * w, v));
        Self::new(SO2::from_angle(w), translation)
    }

    /// $v = \left(\frac\omega2 \cot\frac\omega2 - \frac\omega2 J\right) x$, the first factor as $c_1/(2 c_2)$.
    #[inline(always)]
    fn log(&self) -> Result<Tangent<3, S>, NotUnique<Tangent<3, S>>> {
        let with_translation = |w: Tangent<1, S>| {
            let [c1, c2] = stumpff2(w[0] * w[0]);
            let (x, half) = (self.translation, w[0] * S::from_f64(0.5));
            let v = add(scale(c1 / (c2 + c2), x), turn(-half, x));
            Tangent(join(w[0], v))
        };
        match self.rotation.log() {
            Ok(w) => Ok(with_translation(w)),
            Err(e) => Err(NotUnique {
                representative: with_translation(e.representative),
            }),
        }
    }

    #[inline(always)]
    fn adjoint(&self, xi: &Tangent<3, S>) -> Tangent<3, S> {
        let (w, v) = split(xi.0);
        let moved = add(self.rotation.rotate(v), turn(-w, self.translation));
        Tangent(join(w, moved))
    }

    #[inline(always)]
    fn bracket(xi: &Tangent<3, S>, eta: &Tangent<3, S>) -> Tangent<3, S> {
        let ((w, v), (a, u)) = (split(xi.0), split(eta.0));
        Tangent(join(S::zero(), add(turn(w, u), turn(-a, v))))
    }

    fn units(&self, units: &mut Units) {
        units.angles(1);
        units.vector(2);
    }

    #[inline(always)]
    fn is_finite(&self) -> bool {
        let [x, y] = self.translation.map(Scalar::magnitude);
        self.rotation.is_finite() && (x + y).is_finite()
    }

    #[inline(always)]
    fn coadjoint(&self, mu: &Cotangent<3, S>) -> Cotangent<3, S> {
        let (angular, linear) = split(mu.0);
        Cotangent(join(
            angular + cross(linear, self.translation),
            self.rotation.inverse_rotate(linear),
        ))
    }

    #[inline(always)]
    fn coadjoint_bracket(xi: &Tangent<3, S>, mu: &Cotangent<3, S>) -> Cotangent<3, S> {
        let ((w, v), (_, linear)) = (split(xi.0), split(mu.0));
        Cotangent(join(cross(linear, v), turn(-w, linear)))
    }

    /// The Cayley map of the 3×3 matrices: $(\mathrm{cay}(\omega), (1 - \omega J/2)^{-1} v)$.
    #[inline(always)]
    fn cayley(xi: &Tangent<3, S>) -> Self {
        let (w, v) = split(xi.0);
        Self::new(SO2::cayley(&Tangent([w])), Self::cayley_translation(w, v))
    }

    #[inline(always)]
    fn cayley_inverse(&self) -> Result<Tangent<3, S>, OutsideChart> {
        let Tangent([w]) = self.rotation.cayley_inverse()?;
        Ok(Tangent(join(w, half_turned(-w, self.translation))))
    }

    /// Cayley's: $(\alpha / (1 + \omega^2/4), (1 + \omega J/2)^{-1} (u + \frac12 \alpha J x))$ with $x$ the translation of
    /// $\mathrm{cay}(\omega, v)$.
    #[inline(always)]
    fn d_left<R: Retraction>(xi: &Tangent<3, S>, eta: &Tangent<3, S>) -> Tangent<3, S> {
        if R::CHART == Chart::Exp {
            return polynomial(eta, &Self::dexp_coefficients(xi), |x| Self::bracket(xi, x));
        }
        let ((w, v), (a, u)) = (split(xi.0), split(eta.0));
        let Tangent([angular]) = SO2::d_left::<Cayley>(&Tangent([w]), &Tangent([a]));
        let x = Self::cayley_translation(w, v);
        let moved = add(u, turn(a * S::from_f64(0.5), x));
        Tangent(join(angular, Self::cayley_translation(-w, moved)))
    }

    /// Cayley's: $((1 + \omega^2/4) \alpha, (1 + \omega J/2) (u - \frac12 \alpha J v))$.
    #[inline(always)]
    fn d_left_inv<R: Retraction>(xi: &Tangent<3, S>, eta: &Tangent<3, S>) -> Tangent<3, S> {
        if R::CHART == Chart::Exp {
            return polynomial(eta, &Self::dexp_inv_coefficients(xi), |x| {
                Self::bracket(xi, x)
            });
        }
        let ((w, v), (a, u)) = (split(xi.0), split(eta.0));
        let Tangent([angular]) = SO2::d_left_inv::<Cayley>(&Tangent([w]), &Tangent([a]));
        let moved = add(u, turn(-(a * S::from_f64(0.5)), v));
        Tangent(join(angular, half_turned(w, moved)))
    }

    /// Cayley's: $(\pi / (1 + \omega^2/4) + \frac12 x \times p, p)$ with $p = (1 - \omega J/2)^{-1} q$ and $x$ the
    /// translation of $\mathrm{cay}(\omega, v)$.
    #[inline(always)]
    fn d_left_dual<R: Retraction>(xi: &Tangent<3, S>, mu: &Cotangent<3, S>) -> Cotangent<3, S> {
        if R::CHART == Chart::Exp {
            return polynomial(mu, &Self::dexp_coefficients(xi), |x| {
                Self::coadjoint_bracket(xi, x)
            });
        }
        let ((w, v), (angular, q)) = (split(xi.0), split(mu.0));
        let (p, x) = (
            Self::cayley_translation(w, q),
            Self::cayley_translation(w, v),
        );
        let Cotangent([angular]) = SO2::d_left_dual::<Cayley>(&Tangent([w]), &Cotangent([angular]));
        Cotangent(join(angular + S::from_f64(0.5) * cross(x, p), p))
    }

    /// Cayley's: $((1 + \omega^2/4) \pi + \frac12 p \times v, p)$ with $p = (1 - \omega J/2) q$.
    #[inline(always)]
    fn d_left_inv_dual<R: Retraction>(xi: &Tangent<3, S>, mu: &Cotangent<3, S>) -> Cotangent<3, S> {
        if R::CHART == Chart::Exp {
            return polynomial(mu, &Self::dexp_inv_coefficients(xi), |x| {
                Self::coadjoint_bracket(xi, x)
            });
        }
        let ((w, v), (angular, q)) = (split(xi.0), split(mu.0));
        let p = half_turned(-w, q);
        let angular = SO2::d_left_inv_dual::<Cayley>(&Tangent([w]), &Cotangent([angular]));
        Cotangent(join(angular[0] + S::from_f64(0.5) * cross(p, v), p))
    }

    /// Cayley's: $\frac12 (\omega \pi \alpha + (u - \frac12 \alpha J v) \times q, \alpha J p)$ with $p = (1 - \omega J/2) q$.
    #[inline(always)]
    fn d_left_inv_gradient<R: Retraction>(
        xi: &Tangent<3, S>,
        mu: &Cotangent<3, S>,
        eta: &Tangent<3, S>,
    ) -> Cotangent<3, S> {
        if R::CHART == Chart::Exp {
            return Self::dexp_inv_gradient(xi, mu, eta);
        }
        let ((w, v), (angular, q), (a, u)) = (split(xi.0), split(mu.0), split(eta.0));
        let half = S::from_f64(0.5);
        let moved = add(u, turn(-(a * half), v));
        Cotangent(join(
            half * (w * angular * a + cross(moved, q)),
            turn(half * a, half_turned(-w, q)),
        ))
    }

    /// $(R^{1/2}, (1 + R^{1/2})^{-1} x)$, the inverse as $\frac12 (1 - \omega J/2)$ for $R^{1/2} = \mathrm{cay}(\omega)$.
    #[inline(always)]
    fn sqrt(&self) -> Self {
        let w = self.rotation.cayley_of_root();
        let translation = scale(S::from_f64(0.5), half_turned(-w, self.translation));
        Self::new(self.rotation.sqrt(), translation)
    }

    #[inline(always)]
    fn zero_carry(&self) -> Self {
        Self::new(self.rotation.zero_carry(), [S::zero(); 2])
    }

    #[inline(always)]
    fn advance(&mut self, f: &Self, carry: &mut Self) {
        let increment = self.rotation.rotate(f.translation);
        add_all_compensated(&mut self.translation, increment, &mut carry.translation);
        self.rotation.advance(&f.rotation, &mut carry.rotation);
    }

    #[inline(always)]
    fn normalize(&mut self) {
        self.rotation.normalize();
    }
}
