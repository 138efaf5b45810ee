//! Vectors and symmetric matrices of the plane.

use core::ops::{Add, AddAssign, Mul, Sub, SubAssign};

use lie::{SO2, Scalar};

/// A vector of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Vec2<S = f64>(pub(super) [S; 2]);

impl<S: Scalar> Vec2<S> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self([S::zero(); 2])
    }

    /// $J x$: the quarter turn, $J (x_1, x_2) = (-x_2, x_1)$.
    #[inline(always)]
    pub(super) fn quarter_turn(self) -> Self {
        let [x, y] = self.0;
        Self([-y, x])
    }

    /// $x \cdot y$.
    #[inline(always)]
    pub(super) fn dot(self, y: Self) -> S {
        self.0[0] * y.0[0] + self.0[1] * y.0[1]
    }

    /// $x \times y = J x \cdot y$, along the normal.
    #[inline(always)]
    pub(super) fn cross(self, y: Self) -> S {
        self.0[0] * y.0[1] - self.0[1] * y.0[0]
    }

    /// $R x$.
    #[inline(always)]
    pub(super) fn rotated(self, r: &SO2<S>) -> Self {
        Self(r.rotate(self.0))
    }

    /// $R^T x$.
    #[inline(always)]
    pub(super) fn rotated_back(self, r: &SO2<S>) -> Self {
        Self(r.inverse_rotate(self.0))
    }
}

impl Vec2 {
    /// The same vector over another scalar, as a constant.
    #[inline(always)]
    pub(super) fn lift<S: Scalar>(self) -> Vec2<S> {
        Vec2([S::from_f64(self.0[0]), S::from_f64(self.0[1])])
    }
}

impl<S: Scalar> Add for Vec2<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, y: Self) -> Self {
        Self([self.0[0] + y.0[0], self.0[1] + y.0[1]])
    }
}

impl<S: Scalar> Sub for Vec2<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, y: Self) -> Self {
        Self([self.0[0] - y.0[0], self.0[1] - y.0[1]])
    }
}

impl<S: Scalar> Mul<S> for Vec2<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, a: S) -> Self {
        Self([self.0[0] * a, self.0[1] * a])
    }
}

impl<S: Scalar> AddAssign for Vec2<S> {
    #[inline(always)]
    fn add_assign(&mut self, y: Self) {
        *self = *self + y;
    }
}

impl<S: Scalar> SubAssign for Vec2<S> {
    #[inline(always)]
    fn sub_assign(&mut self, y: Self) {
        *self = *self - y;
    }
}

/// A symmetric 2×2 matrix: $a_{11}, a_{12}, a_{22}$.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sym2<S = f64>(pub(super) [S; 3]);

impl<S: Scalar> Sym2<S> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self([S::zero(); 3])
    }

    /// $A^{-1}$; of a singular matrix, not finite.
    #[inline(always)]
    pub(super) fn inverse(self) -> Self {
        let [xx, xy, yy] = self.0;
        let scale = S::one() / (xx * yy - xy * xy);
        Self([yy * scale, -(xy * scale), xx * scale])
    }

    /// $R A R^T$: the deviator turns by twice the angle.
    #[inline(always)]
    pub(super) fn turned(self, r: &SO2<S>) -> Self {
        let [xx, xy, yy] = self.0;
        let (mean, difference) = ((xx + yy).times(0.5), (xx - yy).times(0.5));
        let (c, s) = (r.cos(), r.sin());
        let (cos, sin) = (c * c - s * s, (c * s).times(2.0));
        let turned = cos * difference - sin * xy;
        Self([mean + turned, sin * difference + cos * xy, mean - turned])
    }

    /// $a\, x x^T$.
    #[inline(always)]
    pub(super) fn along(x: Vec2<S>, a: S) -> Self {
        let ([x, y], [ax, ay]) = (x.0, (x * a).0);
        Self([ax * x, ax * y, ay * y])
    }
}

impl Sym2 {
    /// $A x$ with the constant $A$: cheaper over dual numbers than [lifting](Self::lift) it.
    #[inline(always)]
    pub(super) fn apply<S: Scalar>(self, x: Vec2<S>) -> Vec2<S> {
        let ([xx, xy, yy], [x, y]) = (self.0, x.0);
        Vec2([x.times(xx) + y.times(xy), x.times(xy) + y.times(yy)])
    }

    /// The same matrix over another scalar, as a constant.
    #[inline(always)]
    pub(super) fn lift<S: Scalar>(self) -> Sym2<S> {
        let [xx, xy, yy] = self.0;
        Sym2([S::from_f64(xx), S::from_f64(xy), S::from_f64(yy)])
    }
}

impl<S: Scalar> Mul<Vec2<S>> for Sym2<S> {
    type Output = Vec2<S>;
    #[inline(always)]
    fn mul(self, x: Vec2<S>) -> Vec2<S> {
        let ([xx, xy, yy], [x, y]) = (self.0, x.0);
        Vec2([xx * x + xy * y, xy * x + yy * y])
    }
}

impl<S: Scalar> Add for Sym2<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        let (a, b) = (self.0, b.0);
        Self([a[0] + b[0], a[1] + b[1], a[2] + b[2]])
    }
}

impl<S: Scalar> Sub for Sym2<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        let (a, b) = (self.0, b.0);
        Self([a[0] - b[0], a[1] - b[1], a[2] - b[2]])
    }
}
