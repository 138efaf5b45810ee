//! Small matrices of three by three.

use core::ops::{Index, IndexMut, Mul};

use crate::operators::linear_operators;
use crate::{Scalar, Vec3};

/// A 3×3 matrix, row by row.
///
/// ```
/// use lie::{Mat3, Vec3};
///
/// let m = Mat3::diagonal([1.0, 2.0, 4.0]);
/// assert_eq!(m * Vec3([1.0, 1.0, 1.0]), Vec3([1.0, 2.0, 4.0]));
/// assert_eq!(m.inverse() * m, Mat3::identity());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mat3<S = f64>(pub [[S; 3]; 3]);

impl<S: Scalar> Vec3<S> {
    /// The hat map $\hat{\cdot}: \mathbb{R}^3 \to \mathfrak{so}(3)$, $\hat x y = x \times y$.
    #[inline(always)]
    pub fn hat(self) -> Mat3<S> {
        let ([x, y, z], o) = (self.0, S::zero());
        Mat3([[o, -z, y], [z, o, -x], [-y, x, o]])
    }

    /// $x y^T$.
    #[inline(always)]
    pub fn outer(self, y: Self) -> Mat3<S> {
        Mat3([(y * self[0]).0, (y * self[1]).0, (y * self[2]).0])
    }
}

impl<S: Scalar> Mat3<S> {
    /// The zero matrix.
    #[inline(always)]
    pub fn zero() -> Self {
        Self([[S::zero(); 3]; 3])
    }

    /// The identity matrix.
    #[inline(always)]
    pub fn identity() -> Self {
        Self::diagonal([S::one(); 3])
    }

    /// The diagonal matrix with these entries.
    #[inline(always)]
    pub fn diagonal([a, b, c]: [S; 3]) -> Self {
        let o = S::zero();
        Self([[a, o, o], [o, b, o], [o, o, c]])
    }

    /// The matrix of these rows. Not by `array::map`, which moves large entries, dual numbers, through memory.
    #[inline(always)]
    fn of(row: impl Fn(usize) -> Vec3<S>) -> Self {
        Self([row(0).0, row(1).0, row(2).0])
    }

    #[inline(always)]
    fn at(&self, i: usize) -> Vec3<S> {
        self.row(i)
    }

    /// $A^T$.
    #[inline(always)]
    pub fn transpose(self) -> Self {
        let [a, b, c] = self.0;
        Self([[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]])
    }

    /// $A^T x$, without forming the transpose.
    #[inline(always)]
    pub fn transpose_mul(self, x: Vec3<S>) -> Vec3<S> {
        (self.row(0) * x[0])
            .plus(x[1], self.row(1))
            .plus(x[2], self.row(2))
    }

    /// Row `i`.
    #[inline(always)]
    pub fn row(self, i: usize) -> Vec3<S> {
        Vec3(self.0[i])
    }

    /// $\mathrm{tr} A$.
    #[inline(always)]
    pub fn trace(self) -> S {
        self.0[0][0] + self.0[1][1] + self.0[2][2]
    }

    /// $\det A$.
    #[inline(always)]
    pub fn determinant(self) -> S {
        self.row(0).dot(self.row(1).cross(self.row(2)))
    }

    /// $A^{-1}$, by the adjugate; of a singular matrix, not finite.
    #[inline(always)]
    pub fn inverse(self) -> Self {
        let (a, b, c) = (self.row(0), self.row(1), self.row(2));
        let (bc, ca, ab) = (b.cross(c), c.cross(a), a.cross(b));
        let scale = S::one() / a.dot(bc);
        Self([(bc * scale).0, (ca * scale).0, (ab * scale).0]).transpose()
    }

    /// $(A - A^T)^\vee$, the vector $v$ with $\hat v = A - A^T$.
    #[inline(always)]
    pub fn skew_vee(self) -> Vec3<S> {
        let m = self.0;
        Vec3([m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]])
    }

    /// The vee map $\mathfrak{so}(3) \to \mathbb{R}^3$, inverse of [`Vec3::hat`]; reads the skew part.
    #[inline(always)]
    pub fn vee(self) -> Vec3<S> {
        self.skew_vee() * S::from_f64(0.5)
    }

    /// $A x A^T$ for a symmetric `x`.
    #[inline(always)]
    pub fn conjugate(self, x: Self) -> Self {
        self * x * self.transpose()
    }

    /// The Frobenius norm, by the real parts.
    pub fn frobenius(self) -> f64 {
        let squares = self.0.iter().flatten().map(|x| x.magnitude().powi(2));
        squares.sum::<f64>().sqrt()
    }
}

impl Mat3<f64> {
    /// $A x$ with the constant $A$: cheaper over dual numbers than [lifting](Self::lift) it.
    ///
    /// ```
    /// use lie::{Mat3, Vec3};
    ///
    /// assert_eq!(Mat3::diagonal([1.0, 2.0, 3.0]).apply(Vec3([1.0_f32; 3])), Vec3([1.0, 2.0, 3.0]));
    /// ```
    #[inline(always)]
    pub fn apply<S: Scalar>(self, x: Vec3<S>) -> Vec3<S> {
        Vec3([
            self.row(0).pair(x),
            self.row(1).pair(x),
            self.row(2).pair(x),
        ])
    }

    /// The same matrix over another scalar, as a constant.
    #[inline(always)]
    pub fn lift<S: Scalar>(self) -> Mat3<S> {
        Mat3::of(|i| self.row(i).lift())
    }
}

impl<S> Index<(usize, usize)> for Mat3<S> {
    type Output = S;
    #[inline(always)]
    fn index(&self, (i, j): (usize, usize)) -> &S {
        &self.0[i][j]
    }
}

impl<S> IndexMut<(usize, usize)> for Mat3<S> {
    #[inline(always)]
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut S {
        &mut self.0[i][j]
    }
}

impl<S: Scalar> Mul<Vec3<S>> for Mat3<S> {
    type Output = Vec3<S>;
    #[inline(always)]
    fn mul(self, x: Vec3<S>) -> Vec3<S> {
        Vec3([self.row(0).dot(x), self.row(1).dot(x), self.row(2).dot(x)])
    }
}

impl<S: Scalar> Mul for Mat3<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Self::of(|i| b.transpose_mul(self.row(i)))
    }
}

linear_operators!(Mat3);
