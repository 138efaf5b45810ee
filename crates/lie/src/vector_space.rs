//! Algebra and dual elements: vectors with coordinates, told apart by type.

use core::fmt::Debug;
use core::ops::{Index, IndexMut};

use num_traits::Zero;

use crate::numeric::larger;
use crate::operators::linear_operators;
use crate::{Scalar, Vec3};

/// A finite-dimensional real vector space with fixed coordinates: a Lie algebra or its dual.
///
/// Only `dim`, `get` and `set` are required. An index at or past `dim` is a caller's error and may panic.
pub trait VectorSpace: Clone + Debug + PartialEq + Send + Sync + 'static {
    /// The numbers.
    type Scalar: Scalar;

    /// The number of coordinates.
    fn dim(&self) -> usize;

    /// Coordinate `i`.
    fn get(&self, i: usize) -> Self::Scalar;

    /// Replaces coordinate `i`.
    fn set(&mut self, i: usize, value: Self::Scalar);

    /// Writes the coordinates to the front of a slice at least `dim` long.
    #[inline(always)]
    fn write(&self, out: &mut [Self::Scalar]) {
        for (i, x) in out.iter_mut().enumerate().take(self.dim()) {
            *x = self.get(i);
        }
    }

    /// Reads the coordinates from the front of a slice at least `dim` long.
    #[inline(always)]
    fn read(&mut self, from: &[Self::Scalar]) {
        for (i, x) in from.iter().enumerate().take(self.dim()) {
            self.set(i, *x);
        }
    }

    /// Sets every coordinate to zero.
    #[inline(always)]
    fn set_zero(&mut self) {
        for i in 0..self.dim() {
            self.set(i, Self::Scalar::zero());
        }
    }

    /// $x \leftarrow y$, in place; `clone_from` of a tuple would allocate where a factor does.
    #[inline(always)]
    fn copy_from(&mut self, y: &Self) {
        for i in 0..self.dim() {
            self.set(i, y.get(i));
        }
    }

    /// $x \leftarrow a x$.
    #[inline(always)]
    fn scale(&mut self, a: Self::Scalar) {
        for i in 0..self.dim() {
            self.set(i, a * self.get(i));
        }
    }

    /// $x \leftarrow x + a y$.
    #[inline(always)]
    fn add_scaled(&mut self, a: Self::Scalar, y: &Self) {
        for i in 0..self.dim() {
            self.set(i, a.mul_add(y.get(i), self.get(i)));
        }
    }

    /// Sets this vector to $x + a y$, in place.
    #[inline(always)]
    fn set_sum(&mut self, x: &Self, a: Self::Scalar, y: &Self) {
        for i in 0..self.dim() {
            self.set(i, a.mul_add(y.get(i), x.get(i)));
        }
    }

    /// The Euclidean norm of the coordinates, squared, by the real parts.
    #[inline(always)]
    fn norm_squared(&self) -> f64 {
        let squares = (0..self.dim()).map(|i| self.get(i).magnitude());
        squares.fold(0.0, |sum, x| sum + x * x)
    }

    /// The largest magnitude of the coordinates, NaN where any is NaN.
    #[inline(always)]
    fn max_magnitude(&self) -> f64 {
        let coordinates = (0..self.dim()).map(|i| self.get(i).magnitude());
        coordinates.fold(0.0, larger)
    }

    /// Whether the two have the same number of coordinates, block by block.
    #[inline(always)]
    fn same_shape(&self, other: &Self) -> bool {
        self.dim() == other.dim()
    }

    /// The zero vector of the same shape.
    fn zero_like(&self) -> Self {
        let mut zero = self.clone();
        zero.set_zero();
        zero
    }

    /// The coordinates, in a new vector.
    fn coordinates(&self) -> Vec<Self::Scalar> {
        (0..self.dim()).map(|i| self.get(i)).collect()
    }
}

macro_rules! coordinate_vector {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name<const N: usize, S = f64>(pub [S; N]);

        impl<const N: usize, S: Scalar> VectorSpace for $name<N, S> {
            type Scalar = S;
            #[inline(always)]
            fn dim(&self) -> usize {
                N
            }
            #[inline(always)]
            fn get(&self, i: usize) -> S {
                self.0[i]
            }
            #[inline(always)]
            fn set(&mut self, i: usize, value: S) {
                self.0[i] = value;
            }
            #[inline(always)]
            fn write(&self, out: &mut [S]) {
                out[..N].copy_from_slice(&self.0);
            }
            #[inline(always)]
            fn read(&mut self, from: &[S]) {
                self.0.copy_from_slice(&from[..N]);
            }
        }

        impl<const N: usize, S: Scalar> $name<N, S> {
            /// The zero vector.
            #[inline(always)]
            pub fn zero() -> Self {
                Self([S::zero(); N])
            }

            #[inline(always)]
            fn of(entry: impl Fn(usize) -> S) -> Self {
                let mut x = Self::zero();
                for i in 0..N {
                    x.0[i] = entry(i);
                }
                x
            }

            #[inline(always)]
            fn at(&self, i: usize) -> S {
                self.0[i]
            }
        }

        impl<S: Scalar> $name<3, S> {
            /// The coordinates as a vector.
            #[inline(always)]
            pub fn vec3(&self) -> Vec3<S> {
                Vec3(self.0)
            }
        }

        impl<S> From<Vec3<S>> for $name<3, S> {
            #[inline(always)]
            fn from(x: Vec3<S>) -> Self {
                Self(x.0)
            }
        }

        impl<S: Scalar> From<(Vec3<S>, Vec3<S>)> for $name<6, S> {
            #[inline(always)]
            fn from((Vec3([a, b, c]), Vec3([d, e, f])): (Vec3<S>, Vec3<S>)) -> Self {
                Self([a, b, c, d, e, f])
            }
        }

        impl<S: Scalar> $name<6, S> {
            /// The rotational and the translational half.
            #[inline(always)]
            pub fn split(&self) -> (Vec3<S>, Vec3<S>) {
                let [a, b, c, d, e, f] = self.0;
                (Vec3([a, b, c]), Vec3([d, e, f]))
            }
        }

        impl<const N: usize, S> Index<usize> for $name<N, S> {
            type Output = S;
            #[inline(always)]
            fn index(&self, i: usize) -> &S {
                &self.0[i]
            }
        }

        impl<const N: usize, S> IndexMut<usize> for $name<N, S> {
            #[inline(always)]
            fn index_mut(&mut self, i: usize) -> &mut S {
                &mut self.0[i]
            }
        }

        linear_operators!($name, N);
    };
}

coordinate_vector! {
    /// An element of a Lie algebra $\mathfrak g$ in coordinates: a velocity $\xi$.
    ///
    /// ```
    /// use lie::Tangent;
    ///
    /// let xi = Tangent([1.0, 2.0, 3.0]) * 2.0 - Tangent([1.0, 1.0, 1.0]);
    /// assert_eq!(xi, Tangent([1.0, 3.0, 5.0]));
    /// ```
    ///
    /// A velocity and a momentum do not add:
    ///
    /// ```compile_fail
    /// use lie::{Cotangent, Tangent};
    ///
    /// let nonsense = Tangent([1.0, 2.0, 3.0]) + Cotangent([1.0, 1.0, 1.0]);
    /// ```
    Tangent
}

coordinate_vector! {
    /// An element of the dual $\mathfrak g^\ast$ in the dual coordinates: a momentum $\mu$.
    Cotangent
}

impl<const N: usize, S: Scalar> Cotangent<N, S> {
    /// The pairing $\langle \mu, \xi \rangle$.
    ///
    /// ```
    /// use lie::{Cotangent, Tangent};
    ///
    /// assert_eq!(Cotangent([1.0, 2.0]).pair(&Tangent([3.0, 4.0])), 11.0);
    /// ```
    #[inline(always)]
    pub fn pair(&self, xi: &Tangent<N, S>) -> S {
        (0..N).fold(S::zero(), |sum, i| self[i].mul_add(xi[i], sum))
    }
}
