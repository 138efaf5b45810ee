//! Dual numbers along the basis of a vector space, in chunks.

use lie::{Jet, VectorSpace};
use num_traits::Zero;

/// Calls `body` with the first direction of every chunk.
#[inline(always)]
pub(crate) fn for_each_chunk(dim: usize, body: impl FnMut(usize)) {
    (0..dim).step_by(lie::JET_DIRECTIONS).for_each(body);
}

/// Copies the derivatives of a chunk into the coordinates from `first` on.
///
/// Where there is no value, these are not numbers either: the derivative of a logarithm is finite where its value is not.
#[inline(always)]
pub(crate) fn read_partials<V: VectorSpace>(
    out: &mut V,
    first: usize,
    value: impl Jet<Value = V::Scalar>,
) {
    let end = out.dim().min(first + lie::JET_DIRECTIONS);
    let poison = value.value() * V::Scalar::zero();
    for i in first..end {
        out.set(i, value.partial(i - first) + poison);
    }
}

/// Sets the columns of a chunk by their rows and directions.
#[inline(always)]
pub(crate) fn set_columns<'a>(
    columns: impl Iterator<Item = &'a mut [f64]>,
    entry: impl Fn(usize, usize) -> f64,
) {
    for (direction, column) in columns.take(lie::JET_DIRECTIONS).enumerate() {
        for (row, x) in column.iter_mut().enumerate() {
            *x = entry(row, direction);
        }
    }
}

/// `x`, the variable of its own direction where the chunk from `first` on holds its index.
#[inline(always)]
pub(crate) fn seeded<J: Jet>(x: J::Value, index: usize, first: usize) -> J {
    match index.checked_sub(first) {
        Some(direction) if direction < lie::JET_DIRECTIONS => J::variable(x, direction),
        _ => J::constant(x),
    }
}

/// $x \leftarrow x + y$ for a `y` that is not differentiated.
#[inline(always)]
pub(crate) fn add_constant<V, W>(x: &mut V, y: &W)
where
    V: VectorSpace<Scalar: Jet<Value = W::Scalar>>,
    W: VectorSpace,
{
    for i in 0..x.dim() {
        x.set(i, x.get(i) + V::Scalar::constant(y.get(i)));
    }
}

/// What the derivatives along `dim` directions cost, in evaluations: each chunk its value and its directions.
pub(crate) fn in_duals(dim: usize) -> u32 {
    (dim.div_ceil(lie::JET_DIRECTIONS) * (1 + lie::JET_DIRECTIONS)) as u32
}

/// The parameters of a system as constants over another scalar, into `out`.
pub(crate) fn lift<S: Copy, T>(parameters: &[S], constant: impl Fn(S) -> T, out: &mut Vec<T>) {
    out.clear();
    out.extend(parameters.iter().map(|p| constant(*p)));
}
