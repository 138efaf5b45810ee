//! Linear algebra by `get` and `set` alone, so that a wrong method of a vector space cannot hide itself.

use crate::{Scalar, VectorSpace};

/// The vector of the shape of `shape` with these coordinates.
// Inlined, it would be compiled into every law of every group.
#[inline(never)]
pub(super) fn filled<V: VectorSpace>(shape: &V, coordinate: &dyn Fn(usize) -> V::Scalar) -> V {
    let mut x = shape.clone();
    (0..shape.dim()).for_each(|i| x.set(i, coordinate(i)));
    x
}

pub(super) fn zero<V: VectorSpace>(shape: &V) -> V {
    filled(shape, &|_| V::Scalar::from_f64(0.0))
}

/// The basis $e_1, \dots, e_n$.
pub(super) fn basis<V: VectorSpace>(shape: &V) -> Vec<V> {
    let unit = |k: usize| filled(shape, &|i| V::Scalar::from_f64(f64::from(i == k)));
    (0..shape.dim()).map(unit).collect()
}

/// A vector with no coordinate zero and no two alike: what a method must overwrite or use.
pub(super) fn generic<V: VectorSpace>(shape: &V, offset: f64) -> V {
    let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    filled(shape, &|i| {
        V::Scalar::from_f64(sign(i) * (offset + 0.125 * i as f64))
    })
}

/// $a x$.
pub(super) fn scaled<V: VectorSpace>(x: &V, a: f64) -> V {
    filled(x, &|i| x.get(i) * V::Scalar::from_f64(a))
}

/// $x + y$.
pub(super) fn sum<V: VectorSpace>(x: &V, y: &V) -> V {
    filled(x, &|i| x.get(i) + y.get(i))
}

/// The Euclidean length.
pub(super) fn length<V: VectorSpace>(x: &V) -> f64 {
    let squares = (0..x.dim()).map(|i| x.get(i).magnitude().powi(2));
    squares.sum::<f64>().sqrt()
}

/// $x$, or the vector along it of this length where $x$ is longer.
pub(super) fn at_most<V: VectorSpace>(x: &V, limit: f64) -> V {
    scaled(x, limit / length(x).max(limit))
}

/// One plus the largest coordinate, infinite where a coordinate is not a number.
pub(super) fn vector_size<V: VectorSpace>(x: &V) -> f64 {
    let coordinates = (0..x.dim()).map(|i| x.get(i).magnitude());
    coordinates.fold(1.0, |size, a| {
        let next = 1.0 + a;
        if next.is_nan() {
            f64::INFINITY
        } else {
            next.max(size)
        }
    })
}
