//! Generic fall-backs for a group that gives no closed form: transposes by pairing, small solves.

use num_traits::One;

use crate::{Lu, VectorSpace};

/// The $\nu$ with $\langle \nu, e_i \rangle = \langle \mu, A e_i \rangle$ for the basis $e_i$ of the algebra.
pub(crate) fn transpose_by_pairing<A: VectorSpace, D: VectorSpace<Scalar = A::Scalar>>(
    mu: &D,
    shape: &A,
    pair: impl Fn(&D, &A) -> A::Scalar,
    map: impl Fn(&A) -> A,
) -> D {
    let mut nu = mu.zero_like();
    for i in 0..mu.dim() {
        nu.set(i, pair(mu, &map(&basis(shape, i))));
    }
    nu
}

/// The $x$ with $A x = b$; not finite where $A$ is singular.
pub(crate) fn solve<A: VectorSpace>(b: &A, map: impl Fn(&A) -> A) -> A {
    let mut matrix = Lu::new(b.dim());
    for j in 0..b.dim() {
        map(&basis(b, j)).write(matrix.column_mut(j));
    }
    matrix.factorise(|_, _| 1.0);
    let (mut x, mut numbers) = (b.clone(), b.coordinates());
    matrix.solve(&mut numbers, |entry| entry);
    x.read(&numbers);
    x
}

/// The basis vector $e_i$ of the algebra that `shape` lies in.
pub(crate) fn basis<V: VectorSpace>(shape: &V, i: usize) -> V {
    let mut e = shape.zero_like();
    e.set(i, V::Scalar::one());
    e
}
