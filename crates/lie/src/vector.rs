//! Small vectors of three.

use core::ops::{Index, IndexMut};

use crate::Scalar;
use crate::operators::linear_operators;

/// A vector of three numbers, $x \in \mathbb{R}^3$.
///
/// ```
/// use lie::Vec3;
///
/// let x = Vec3([1.0, 0.0, 0.0]);
/// let y = Vec3([0.0, 1.0, 0.0]);
/// assert_eq!(x.cross(y), Vec3([0.0, 0.0, 1.0]));
/// assert_eq!(x.hat() * y, x.cross(y));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec3<S = f64>(pub [S; 3]);

impl<S: Scalar> Vec3<S> {
    /// The zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        Self([S::zero(); 3])
    }

    #[inline(always)]
    pub(crate) fn of(entry: impl Fn(usize) -> S) -> Self {
        Self([entry(0), entry(1), entry(2)])
    }

    #[inline(always)]
    fn at(&self, i: usize) -> S {
        self.0[i]
    }

    /// $x \cdot y$.
    #[inline(always)]
    pub fn dot(self, y: Self) -> S {
        let sum = self[1].mul_add(y[1], self[0] * y[0]);
        self[2].mul_add(y[2], sum)
    }

    /// $x \times y$.
    #[inline(always)]
    pub fn cross(self, y: Self) -> Self {
        Self([
            self[2].neg_mul_add(y[1], self[1] * y[2]),
            self[0].neg_mul_add(y[2], self[2] * y[0]),
            self[1].neg_mul_add(y[0], self[0] * y[1]),
        ])
    }

    /// $x + a y$.
    #[inline(always)]
    pub fn plus(self, a: S, y: Self) -> Self {
        let [x0, x1, x2] = self.0;
        Self([
            y[0].mul_add(a, x0),
            y[1].mul_add(a, x1),
            y[2].mul_add(a, x2),
        ])
    }

    /// $|x|^2$.
    #[inline(always)]
    pub fn norm_squared(self) -> S {
        self.dot(self)
    }

    /// Whether every entry is finite.
    #[inline(always)]
    pub fn is_finite(self) -> bool {
        (self[0].magnitude() + self[1].magnitude() + self[2].magnitude()).is_finite()
    }

    /// $|x|$; not differentiable at zero.
    #[inline(always)]
    pub fn norm(self) -> S {
        self.norm_squared().sqrt()
    }
}

impl Vec3<f64> {
    /// $a \cdot x$ with this constant $a$: cheaper over dual numbers than [lifting](Self::lift) it.
    #[inline(always)]
    pub fn pair<S: Scalar>(self, x: Vec3<S>) -> S {
        x[0].times(self[0]) + x[1].times(self[1]) + x[2].times(self[2])
    }

    /// The same vector over another scalar, as a constant.
    #[inline(always)]
    pub fn lift<S: Scalar>(self) -> Vec3<S> {
        let [x, y, z] = self.0;
        Vec3([S::from_f64(x), S::from_f64(y), S::from_f64(z)])
    }
}

impl<S> Index<usize> for Vec3<S> {
    type Output = S;
    #[inline(always)]
    fn index(&self, i: usize) -> &S {
        &self.0[i]
    }
}

impl<S> IndexMut<usize> for Vec3<S> {
    #[inline(always)]
    fn index_mut(&mut self, i: usize) -> &mut S {
        &mut self.0[i]
    }
}

linear_operators!(Vec3);
