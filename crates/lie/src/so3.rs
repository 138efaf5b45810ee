//! SO(3): rotations of space.

use crate::numeric::add_all_compensated;
use crate::stumpff::{dexp_inv_factor, stumpff, stumpff2};
use crate::{
    Chart, Cotangent, LieGroup, Mat3, NotARotation, NotUnique, OutsideChart, Over, Retraction,
    Scalar, Tangent, Units, Vec3,
};

/// A rotation, held as its matrix $R$.
///
/// Algebra and dual are $\mathbb{R}^3$ by the hat map: $\mathrm{Ad}\_R \Omega = R \Omega$,
/// $\mathrm{ad}\_\Omega \eta = \Omega \times \eta$, $\mathrm{Ad}^\ast\_R \mu = R^T \mu$, $\mathrm{ad}^\ast\_\Omega \mu = \mu \times \Omega$.
///
/// ```
/// use lie::{LieGroup, SO3, Tangent, Vec3};
///
/// let quarter = SO3::exp(&Tangent([0.0, 0.0, core::f64::consts::FRAC_PI_2]));
/// let turned = quarter.rotate(Vec3([1.0, 0.0, 0.0]));
/// assert!((turned - Vec3([0.0, 1.0, 0.0])).norm() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SO3<S = f64> {
    matrix: Mat3<S>,
}

impl<S: Scalar> Default for SO3<S> {
    fn default() -> Self {
        Self::identity()
    }
}

impl<S> SO3<S> {
    /// The matrix $R$.
    #[inline(always)]
    pub fn matrix(&self) -> &Mat3<S> {
        &self.matrix
    }
}

impl<S: Scalar> SO3<S> {
    /// The identity.
    #[inline(always)]
    pub fn identity() -> Self {
        Self::from_matrix_unchecked(Mat3::identity())
    }

    /// The rotation with this matrix, brought to the group by a polar step.
    ///
    /// # Errors
    /// [`NotARotation`] where $\lVert I - R^T R\rVert$ exceeds $\sqrt\varepsilon$ of the scalar (1.5e-8 for `f64`), the determinant is negative or a number is not finite.
    pub fn from_matrix(matrix: Mat3<S>) -> Result<Self, NotARotation> {
        let mut rotation = Self::from_matrix_unchecked(matrix);
        let (defect, tolerance) = (rotation.orthogonality_error(), S::EPSILON.sqrt());
        rotation.normalize();
        let determinant = matrix.determinant();
        // The magnitude of a scalar has no sign: it is that with which it adds up.
        let size = determinant.magnitude();
        let positive = (determinant + S::from_f64(size)).magnitude() > size;
        let rotates = defect <= tolerance && positive;
        rotates.then_some(rotation).ok_or(NotARotation {
            defect,
            determinant: if positive { size } else { -size },
            tolerance,
        })
    }

    /// The rotation with this matrix, taken on trust.
    #[inline(always)]
    pub fn from_matrix_unchecked(matrix: Mat3<S>) -> Self {
        Self { matrix }
    }

    /// The rotation of the quaternion $(w, x, y, z)$, which is brought to unit length.
    ///
    /// A zero quaternion gives a matrix that is not finite.
    #[inline(always)]
    pub fn from_quaternion([w, x, y, z]: [S; 4]) -> Self {
        let v = Vec3([x, y, z]);
        let two = S::from_f64(2.0) / (w * w + v.norm_squared());
        let vv = (v * two).outer(v);
        let diagonal = S::one() - two * v.norm_squared();
        Self::from_matrix_unchecked(vv + (v * (two * w)).hat() + Mat3::diagonal([diagonal; 3]))
    }

    /// A unit quaternion $(w, x, y, z)$ of this rotation, its largest entry positive (Shepperd's method).
    ///
    /// ```
    /// use lie::SO3;
    ///
    /// let half_turn = SO3::from_quaternion([0.0, 0.0, 1.0, 0.0]);
    /// assert_eq!(half_turn.to_quaternion(), [0.0, 0.0, 1.0, 0.0]);
    /// ```
    #[inline(always)]
    pub fn to_quaternion(&self) -> [S; 4] {
        let m = self.matrix.0;
        let one = S::one();
        let [a, b, c] = self.matrix.skew_vee().0;
        let (p, q, r) = (m[0][1] + m[1][0], m[0][2] + m[2][0], m[1][2] + m[2][1]);
        // Four times q q^T, a row for each entry of q: the row of the largest entry is well conditioned.
        let rows = [
            [one + m[0][0] + m[1][1] + m[2][2], a, b, c],
            [a, one + m[0][0] - m[1][1] - m[2][2], p, q],
            [b, p, one - m[0][0] + m[1][1] - m[2][2], r],
            [c, q, r, one - m[0][0] - m[1][1] + m[2][2]],
        ];
        let (mut best, mut size) = (rows[0], rows[0][0]);
        for (i, row) in rows.iter().enumerate().skip(1) {
            let larger = size.less(row[i]);
            best = core::array::from_fn(|j| S::select(larger, row[j], best[j]));
            size = S::select(larger, row[i], size);
        }
        let scale = S::from_f64(0.5) / size.sqrt();
        best.map(|x| x * scale)
    }

    /// $R x$.
    #[inline(always)]
    pub fn rotate(&self, x: Vec3<S>) -> Vec3<S> {
        self.matrix * x
    }

    /// $R^T x$.
    #[inline(always)]
    pub fn inverse_rotate(&self, x: Vec3<S>) -> Vec3<S> {
        self.matrix.transpose_mul(x)
    }

    /// $R - I$, with small relative error also where $R$ is close to the identity.
    ///
    /// The skew part $\hat s = \frac12 (R - R^T)$ and [the symmetric one](Self::symmetric_minus_identity): entry by
    /// entry, $R - I$ would lose the digits that a step of size $h$ divides by $h$.
    #[inline(always)]
    pub fn minus_identity(&self) -> Mat3<S> {
        self.matrix.vee().hat() + self.symmetric_minus_identity()
    }

    /// $(R - I) x$ and $\mathrm{tr}[(R - I) A]$ with small relative error, without forming the matrix; see [`Displacement`].
    #[inline(always)]
    pub fn displacement(&self) -> Displacement<S> {
        let (s, trace) = (self.matrix.vee(), self.matrix.trace());
        let moderate = S::zero().less(trace);
        let safe = S::select(moderate, trace, S::one());
        Displacement {
            rotation: *self,
            s,
            square: s.norm_squared(),
            scale: S::from_f64(2.0) / (S::one() + safe),
            moderate,
        }
    }

    /// The symmetric part of $R - I$, likewise: $\hat s^2 / (1 + \cos\theta)$ with $\hat s = \frac12 (R - R^T)$.
    #[inline(always)]
    pub fn symmetric_minus_identity(&self) -> Mat3<S> {
        let (s, trace) = (self.matrix.vee(), self.matrix.trace());
        let moderate = S::zero().less(trace);
        let scale = S::from_f64(2.0) / (S::one() + S::select(moderate, trace, S::one()));
        let near = (s.outer(s) - Mat3::diagonal([s.norm_squared(); 3])) * scale;
        let sum = (self.matrix + self.matrix.transpose()) * S::from_f64(0.5);
        let far = sum - Mat3::identity();
        let entry = |i: usize, j: usize| S::select(moderate, near[(i, j)], far[(i, j)]);
        let row = |i: usize| [entry(i, 0), entry(i, 1), entry(i, 2)];
        Mat3([row(0), row(1), row(2)])
    }

    /// $\lVert I - R^T R \rVert_F$.
    pub fn orthogonality_error(&self) -> f64 {
        (Mat3::identity() - self.matrix.transpose() * self.matrix).frobenius()
    }

    /// The $\xi$ with $\mathrm{cay}(\xi)^2 = R$: $2 v / (1 + w)$ for the unit quaternion $(w, v)$ with $w \ge 0$.
    ///
    /// It exists up to the angle $\pi$, where the chart of $R$ itself ends.
    #[inline(always)]
    pub(crate) fn cayley_of_root(&self) -> Vec3<S> {
        let [w, x, y, z] = self.to_quaternion();
        let negative = w.less(S::zero());
        let two = S::from_f64(2.0);
        let scale = two / (S::one() + S::select(negative, -w, w));
        Vec3([x, y, z]) * S::select(negative, -scale, scale)
    }

    /// $1 / (1 + |\xi|^2/4)$, the Cayley map's factor.
    #[inline(always)]
    fn cayley_scale(xi: Vec3<S>) -> S {
        S::one() / xi.norm_squared().mul_add(S::from_f64(0.25), S::one())
    }

    #[inline(always)]
    fn dexp(w: Vec3<S>, eta: Vec3<S>) -> Vec3<S> {
        let [_, c2, c3, ..] = stumpff(w.norm_squared());
        let once = w.cross(eta);
        eta - once * c2 + w.cross(once) * c3
    }

    #[inline(always)]
    fn dexp_inv(w: Vec3<S>, eta: Vec3<S>) -> Vec3<S> {
        let [factor, _] = dexp_inv_factor(w.norm_squared());
        let once = w.cross(eta);
        eta + once * S::from_f64(0.5) + w.cross(once) * factor
    }

    #[inline(always)]
    fn dcay_dual(w: Vec3<S>, mu: Vec3<S>) -> Vec3<S> {
        (mu + (w * S::from_f64(0.5)).cross(mu)) * Self::cayley_scale(w)
    }
}

/// $R - I = \hat s + \frac{1}{1 + \cos\theta} \hat s^2$ with $\hat s = \frac12 (R - R^T)$, for products with vectors.
///
/// ```
/// use lie::{LieGroup, SO3, Tangent, Vec3};
///
/// let (x, angle) = (Vec3([0.0, 1.0, 0.0]), 1e-9_f64);
/// let moved = SO3::exp(&Tangent([0.0, 0.0, angle])).displacement().apply(x);
/// assert_eq!(moved[0], -angle);
/// assert!((moved[1] / (-0.5 * angle * angle) - 1.0).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Displacement<S: Scalar> {
    rotation: SO3<S>,
    s: Vec3<S>,
    square: S,
    /// $1 / (1 + \cos\theta)$, for moderate angles.
    scale: S,
    moderate: S::Mask,
}

impl<S: Scalar> Displacement<S> {
    /// $(R - I) x$.
    #[inline(always)]
    pub fn apply(&self, x: Vec3<S>) -> Vec3<S> {
        let s = self.s;
        let near = s.cross(x) + (s * s.dot(x) - x * self.square) * self.scale;
        let far = self.rotation.rotate(x) - x;
        Vec3::of(|i| S::select(self.moderate, near[i], far[i]))
    }

    /// $\mathrm{tr}[(R - I) A]$ for a symmetric constant $A$.
    #[inline(always)]
    pub fn trace_with(&self, a: Mat3) -> S {
        let near = (self.s.dot(a.apply(self.s)) - self.square.times(a.trace())) * self.scale;
        let m = self.rotation.matrix;
        let far = a.row(0).pair(m.row(0)) + a.row(1).pair(m.row(1)) + a.row(2).pair(m.row(2));
        S::select(self.moderate, near, far - S::from_f64(a.trace()))
    }
}

impl<S: Scalar> LieGroup for SO3<S> {
    type Scalar = S;
    type Algebra = Tangent<3, S>;
    type Dual = Cotangent<3, S>;
    type WithScalar<T: Scalar> = SO3<T>;

    #[inline(always)]
    fn zero_algebra(&self) -> Tangent<3, S> {
        Tangent::zero()
    }

    #[inline(always)]
    fn zero_dual(&self) -> Cotangent<3, S> {
        Cotangent::zero()
    }

    #[inline(always)]
    fn convert<A: Scalar, B: Scalar>(g: &SO3<A>, f: impl Fn(A) -> B + Copy) -> Over<Self, B> {
        let row = |[x, y, z]: [A; 3]| [f(x), f(y), f(z)];
        let [a, b, c] = g.matrix.0;
        SO3::from_matrix_unchecked(Mat3([row(a), row(b), row(c)]))
    }

    #[inline(always)]
    fn compose(&self, h: &Self) -> Self {
        Self::from_matrix_unchecked(self.matrix * h.matrix)
    }

    #[inline(always)]
    fn inverse(&self) -> Self {
        Self::from_matrix_unchecked(self.matrix.transpose())
    }

    /// Rodrigues' formula $I + c_1 \hat\xi + c_2 \hat\xi^2$ with the Stumpff functions of $|\xi|^2$.
    #[inline(always)]
    fn exp(xi: &Tangent<3, S>) -> Self {
        let w = xi.vec3();
        let x = w.norm_squared();
        let [c1, c2] = stumpff2(x);
        let symmetric = (w * c2).outer(w) + Mat3::diagonal([S::one() - c2 * x; 3]);
        Self::from_matrix_unchecked((w * c1).hat() + symmetric)
    }

    #[inline(always)]
    fn log(&self) -> Result<Tangent<3, S>, NotUnique<Tangent<3, S>>> {
        let [w, x, y, z] = self.to_quaternion();
        let v = Vec3([x, y, z]);
        let negative = w.less(S::zero());
        let scale = angle_over_sine(v.norm_squared(), S::select(negative, -w, w));
        let xi = Tangent::from(v * S::select(negative, -scale, scale));
        // The quaternion's rounding leaves a half turn this far from w = 0.
        let mut unique = true;
        let guarded = xi.0.map(|x| {
            let inside = x.guarded(w, 2.0 * S::EPSILON);
            unique &= inside.is_some();
            inside.unwrap_or(x)
        });
        let xi = Tangent(guarded);
        match unique {
            true => Ok(xi),
            false => Err(NotUnique { representative: xi }),
        }
    }

    #[inline(always)]
    fn adjoint(&self, xi: &Tangent<3, S>) -> Tangent<3, S> {
        self.rotate(xi.vec3()).into()
    }

    #[inline(always)]
    fn bracket(xi: &Tangent<3, S>, eta: &Tangent<3, S>) -> Tangent<3, S> {
        xi.vec3().cross(eta.vec3()).into()
    }

    fn units(&self, units: &mut Units) {
        units.angles(3);
    }

    #[inline(always)]
    fn is_finite(&self) -> bool {
        let m = self.matrix;
        (m.row(0) + m.row(1) + m.row(2)).is_finite()
    }

    #[inline(always)]
    fn coadjoint(&self, mu: &Cotangent<3, S>) -> Cotangent<3, S> {
        self.inverse_rotate(mu.vec3()).into()
    }

    #[inline(always)]
    fn coadjoint_bracket(xi: &Tangent<3, S>, mu: &Cotangent<3, S>) -> Cotangent<3, S> {
        mu.vec3().cross(xi.vec3()).into()
    }

    /// $I + \frac{1}{1 + |\xi|^2/4} \left(\hat\xi + \frac12 \hat\xi^2\right)$: the rotation by $2 \arctan(|\xi|/2)$.
    #[inline(always)]
    fn cayley(xi: &Tangent<3, S>) -> Self {
        let w = xi.vec3();
        let scale = Self::cayley_scale(w);
        let half = S::from_f64(0.5) * scale;
        let diagonal = half.neg_mul_add(w.norm_squared(), S::one());
        let ([x, y, z], [p, q, r], [a, b, c]) = ((w * half).0, w.0, (w * scale).0);
        Self::from_matrix_unchecked(Mat3([
            [x.mul_add(p, diagonal), x.mul_add(q, -c), x.mul_add(r, b)],
            [y.mul_add(p, c), y.mul_add(q, diagonal), y.mul_add(r, -a)],
            [z.mul_add(p, -b), z.mul_add(q, a), z.mul_add(r, diagonal)],
        ]))
    }

    #[inline(always)]
    fn cayley_inverse(&self) -> Result<Tangent<3, S>, OutsideChart> {
        let denominator = S::one() + self.matrix.trace();
        // 1 + tr R = 4 cos^2(theta/2), whose rounding error is a few epsilon.
        let denominator = denominator
            .guarded(denominator, 8.0 * S::EPSILON)
            .ok_or(OutsideChart)?;
        Ok((self.matrix.skew_vee() * (S::from_f64(2.0) / denominator)).into())
    }

    /// $1 - c_2 \hat\xi + c_3 \hat\xi^2$, or $\frac{1}{1 + |\xi|^2/4} \left(1 - \frac12 \hat\xi\right)$: the transpose at
    /// $-\xi$, for $\hat\xi^T = -\hat\xi$.
    #[inline(always)]
    fn d_left<R: Retraction>(xi: &Tangent<3, S>, eta: &Tangent<3, S>) -> Tangent<3, S> {
        let (w, eta) = (xi.vec3(), eta.vec3());
        match R::CHART {
            Chart::Exp => Self::dexp(w, eta).into(),
            Chart::Cayley => Self::dcay_dual(-w, eta).into(),
        }
    }

    /// The transpose of [`d_left`](LieGroup::d_left), likewise.
    #[inline(always)]
    fn d_left_dual<R: Retraction>(xi: &Tangent<3, S>, mu: &Cotangent<3, S>) -> Cotangent<3, S> {
        let (w, mu) = (xi.vec3(), mu.vec3());
        match R::CHART {
            Chart::Exp => Self::dexp(-w, mu).into(),
            Chart::Cayley => Self::dcay_dual(w, mu).into(),
        }
    }

    /// $1 + \frac12 \hat\xi + g(|\xi|^2) \hat\xi^2$ with $g$ of `dexp_inv_factor`, or
    /// $1 + \frac12 \hat\xi + \frac14 \xi \xi^T$.
    #[inline(always)]
    fn d_left_inv<R: Retraction>(xi: &Tangent<3, S>, eta: &Tangent<3, S>) -> Tangent<3, S> {
        let (w, eta) = (xi.vec3(), eta.vec3());
        match R::CHART {
            Chart::Exp => Self::dexp_inv(w, eta).into(),
            Chart::Cayley => {
                let half = w * S::from_f64(0.5);
                let along = half.dot(eta) * S::from_f64(0.5);
                (eta + half.cross(eta)).plus(along, w).into()
            }
        }
    }

    #[inline(always)]
    fn d_left_inv_dual<R: Retraction>(xi: &Tangent<3, S>, mu: &Cotangent<3, S>) -> Cotangent<3, S> {
        let (w, mu) = (xi.vec3(), mu.vec3());
        match R::CHART {
            Chart::Exp => Self::dexp_inv(-w, mu).into(),
            Chart::Cayley => {
                let half = w * S::from_f64(0.5);
                let along = half.dot(mu) * S::from_f64(0.5);
                (mu + mu.cross(half)).plus(along, w).into()
            }
        }
    }

    /// $\frac12 \eta \times \mu + g (\mu (\xi\cdot\eta) + \eta (\xi\cdot\mu) - 2 \xi (\mu\cdot\eta)) + 2 g' \xi\, \mu\cdot\hat\xi^2\eta$,
    /// or $\frac12 \eta \times \mu + \frac14 (\mu (\xi\cdot\eta) + \eta (\xi\cdot\mu))$.
    #[inline(always)]
    fn d_left_inv_gradient<R: Retraction>(
        xi: &Tangent<3, S>,
        mu: &Cotangent<3, S>,
        eta: &Tangent<3, S>,
    ) -> Cotangent<3, S> {
        let (w, mu, eta) = (xi.vec3(), mu.vec3(), eta.vec3());
        match R::CHART {
            Chart::Exp => {
                let [factor, slope] = dexp_inv_factor(w.norm_squared());
                let (both, twice) = (mu.dot(eta), mu.dot(w.cross(w.cross(eta))));
                let along = slope * twice - factor * both;
                let products = mu * w.dot(eta) + eta * w.dot(mu);
                (eta.cross(mu) * S::from_f64(0.5) + products * factor + w * (along + along)).into()
            }
            Chart::Cayley => {
                let (half, quarter) = (eta * S::from_f64(0.5), w * S::from_f64(0.25));
                let turned = half.cross(mu).plus(quarter.dot(eta), mu);
                turned.plus(quarter.dot(mu), eta).into()
            }
        }
    }

    /// By [the quaternion](Self::to_quaternion), which is accurate at every angle.
    #[inline(always)]
    fn sqrt(&self) -> Self {
        Self::cayley(&self.cayley_of_root().into())
    }

    #[inline(always)]
    fn inverse_coadjoint_into(&self, mu: &Cotangent<3, S>, out: &mut Cotangent<3, S>) {
        *out = self.rotate(mu.vec3()).into();
    }

    #[inline(always)]
    fn zero_carry(&self) -> Self {
        Self::from_matrix_unchecked(Mat3::zero())
    }

    /// $R + R (F - I)$: the increment is as small as the turn, and so is its rounding.
    #[inline(always)]
    fn advance(&mut self, f: &Self, carry: &mut Self) {
        let increment = self.matrix * f.minus_identity();
        let rows = self.matrix.0.iter_mut().zip(&mut carry.matrix.0);
        for ((row, carry), increment) in rows.zip(increment.0) {
            add_all_compensated(row, increment, carry);
        }
    }

    /// One Newton–Schulz step of the polar decomposition, $R \leftarrow \frac12 R (3 I - R^T R)$.
    ///
    /// It costs one and a half products. Ten million products by one small rotation leave a defect of 3e-9 without it;
    /// with one such step every 32 products it stays below 2e-14.
    #[inline(always)]
    fn normalize(&mut self) {
        let r = self.matrix;
        let defect = Mat3::identity() - r.transpose() * r;
        self.matrix += r * defect * S::from_f64(0.5);
    }
}

/// $2 \operatorname{atan2}(\sqrt n, w) / \sqrt n$ for $n = \sin^2\frac\theta2$, $w = \cos\frac\theta2 \ge 0$; even in $\sqrt n$, so smooth at zero.
#[inline(always)]
fn angle_over_sine<S: Scalar>(n: S, w: S) -> S {
    /// Terms of the arc tangent's series: $0.02^9 / 19 < 10^{-16}$.
    const TERMS: u32 = 9;
    let small = n.less(S::from_f64(0.02) * w * w);
    let t = n / S::select(small, w * w, S::one());
    let coefficient = |k: u32| S::from_f64(1.0 / f64::from(2 * k + 1));
    let series = (0..TERMS)
        .rev()
        .fold(S::zero(), |sum, k| coefficient(k) - t * sum);
    let root = S::select(small, S::one(), n).sqrt();
    let (near, far) = (series / w, root.atan2(w) / root);
    S::select(small, near, far) * S::from_f64(2.0)
}
