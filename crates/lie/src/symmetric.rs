//! Small symmetric matrices of three by three.

use core::ops::Mul;

use crate::operators::linear_operators;
use crate::{Mat3, Scalar, Vec3};

/// A symmetric 3×3 matrix by its upper triangle, row by row: $a_{11}, a_{12}, a_{13}, a_{22}, a_{23}, a_{33}$.
///
/// ```
/// use lie::{Mat3, Sym3, Vec3};
///
/// let a = Sym3([4.0, 1.0, 0.0, 3.0, 0.0, 2.0]);
/// let x = a.ldl().solve(a * Vec3([1.0, 2.0, 3.0]));
/// assert!((x - Vec3([1.0, 2.0, 3.0])).norm() < 1e-15);
/// assert_eq!(a.turned(&Mat3::identity()), a);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sym3<S = f64>(pub [S; 6]);

impl<S: Scalar> Sym3<S> {
    /// The zero matrix.
    #[inline(always)]
    pub fn zero() -> Self {
        Self([S::zero(); 6])
    }

    #[inline(always)]
    fn of(entry: impl Fn(usize) -> S) -> Self {
        Self([entry(0), entry(1), entry(2), entry(3), entry(4), entry(5)])
    }

    #[inline(always)]
    fn at(&self, i: usize) -> S {
        self.0[i]
    }

    /// $a I$.
    #[inline(always)]
    pub fn isotropic(a: S) -> Self {
        let o = S::zero();
        Self([a, o, o, a, o, a])
    }

    /// The upper triangle of a matrix that is symmetric.
    #[inline(always)]
    pub fn upper(a: &Mat3<S>) -> Self {
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = a.0;
        Self([xx, xy, xz, yy, yz, zz])
    }

    /// The upper triangle of $A B^T$, where that is symmetric.
    #[inline(always)]
    pub fn product(a: &Mat3<S>, b: &Mat3<S>) -> Self {
        let entry = |i: usize, j: usize| a.row(i).dot(b.row(j));
        Self([
            entry(0, 0),
            entry(0, 1),
            entry(0, 2),
            entry(1, 1),
            entry(1, 2),
            entry(2, 2),
        ])
    }

    /// The upper triangle of $\hat x A$, where that is symmetric.
    #[inline(always)]
    pub fn hat_times(x: Vec3<S>, a: &Mat3<S>) -> Self {
        let ([x, y, z], [p, q, r]) = (x.0, a.0);
        let entry = |a: S, p: S, b: S, q: S| b.neg_mul_add(q, a * p);
        Self([
            entry(y, r[0], z, q[0]),
            entry(y, r[1], z, q[1]),
            entry(y, r[2], z, q[2]),
            entry(z, p[1], x, r[1]),
            entry(z, p[2], x, r[2]),
            entry(x, q[2], y, p[2]),
        ])
    }

    /// All nine entries.
    #[inline(always)]
    pub fn matrix(&self) -> Mat3<S> {
        let [xx, xy, xz, yy, yz, zz] = self.0;
        Mat3([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    }

    /// The factorisation $A = L D L^T$ of a positive definite matrix; of a singular one, not finite.
    ///
    /// Backward stable without square roots: unlike the adjugate, it keeps digits where the eigenvalues are far apart.
    #[inline(always)]
    pub fn ldl(&self) -> Ldl3<S> {
        let [xx, xy, xz, yy, yz, zz] = self.0;
        let x = S::one() / xx;
        let (yx, zx) = (xy * x, xz * x);
        let y = S::one() / yx.neg_mul_add(xy, yy);
        let rest = zx.neg_mul_add(xy, yz);
        let zy = rest * y;
        let z = S::one() / zy.neg_mul_add(rest, zx.neg_mul_add(xz, zz));
        Ldl3 {
            lower: [yx, zx, zy],
            pivots: Vec3([x, y, z]),
        }
    }

    /// $C A C^T$: the matrix in the frame that $C$ leads to.
    #[inline(always)]
    pub fn turned(&self, c: &Mat3<S>) -> Self {
        Self::product(&(*c * self.matrix()), c)
    }

    /// $A \hat x$: the rows of $A$, each crossed with $x$.
    #[inline(always)]
    pub fn times_hat(&self, x: Vec3<S>) -> Mat3<S> {
        let a = self.matrix();
        Mat3([
            a.row(0).cross(x).0,
            a.row(1).cross(x).0,
            a.row(2).cross(x).0,
        ])
    }
}

/// The factors $L$, with ones on its diagonal, and $D^{-1}$ of $A = L D L^T$.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ldl3<S = f64> {
    /// $l_{21}, l_{31}, l_{32}$.
    lower: [S; 3],
    /// The diagonal of $D^{-1}$.
    pivots: Vec3<S>,
}

impl<S: Scalar> Ldl3<S> {
    /// The factors of the identity.
    #[inline(always)]
    pub fn identity() -> Self {
        Self {
            lower: [S::zero(); 3],
            pivots: Vec3([S::one(); 3]),
        }
    }

    /// $L^{-1} x$.
    #[inline(always)]
    pub fn forward(&self, x: Vec3<S>) -> Vec3<S> {
        let [yx, zx, zy] = self.lower;
        let y = yx.neg_mul_add(x[0], x[1]);
        let z = zy.neg_mul_add(y, zx.neg_mul_add(x[0], x[2]));
        Vec3([x[0], y, z])
    }

    /// $D^{-1} x$.
    #[inline(always)]
    pub fn scale(&self, x: Vec3<S>) -> Vec3<S> {
        let d = self.pivots;
        Vec3([x[0] * d[0], x[1] * d[1], x[2] * d[2]])
    }

    /// $L^{-T} x$.
    #[inline(always)]
    pub fn backward(&self, x: Vec3<S>) -> Vec3<S> {
        let [yx, zx, zy] = self.lower;
        let y = zy.neg_mul_add(x[2], x[1]);
        let first = zx.neg_mul_add(x[2], yx.neg_mul_add(y, x[0]));
        Vec3([first, y, x[2]])
    }

    /// $A^{-1} x$.
    #[inline(always)]
    pub fn solve(&self, x: Vec3<S>) -> Vec3<S> {
        self.backward(self.scale(self.forward(x)))
    }
}

impl Ldl3 {
    /// Whether the matrix is positive definite.
    pub fn is_positive(&self) -> bool {
        self.pivots.0.iter().all(|pivot| *pivot > 0.0)
    }
}

impl Sym3<f64> {
    /// The same matrix over another scalar, as a constant.
    #[inline(always)]
    pub fn lift<S: Scalar>(&self) -> Sym3<S> {
        Sym3::upper(&self.matrix().lift())
    }
}

impl<S: Scalar> Mul<Vec3<S>> for Sym3<S> {
    type Output = Vec3<S>;
    #[inline(always)]
    fn mul(self, x: Vec3<S>) -> Vec3<S> {
        self.matrix() * x
    }
}

linear_operators!(Sym3);
