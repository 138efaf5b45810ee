//! The power of a group whose exponent is known only at run time.

use core::ops::{Deref, DerefMut};

/// $G^n$ with $n$ chosen at run time, or the vectors of its algebra or dual.
///
/// One container for all three: `Power<SO3>` is a group, `Power<Tangent<3>>` its algebra and
/// `Power<Cotangent<3>>` its dual. It dereferences to a slice. The `*_into` methods reuse the storage of
/// their output, which must have as many factors. All factors have the same dimension, and a power of no
/// factors is the trivial group.
///
/// ```
/// use lie::{LieGroup, Power, SO3, VectorSpace};
///
/// let attitudes = Power::new(vec![SO3::<f64>::identity(); 30]);
/// assert_eq!(attitudes.zero_algebra().dim(), 90);
/// assert_eq!(attitudes.compose(&attitudes), attitudes);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Power<T>(pub(crate) Vec<T>);

impl<T> Power<T> {
    /// The factors, in order.
    pub fn new(factors: Vec<T>) -> Self {
        Self(factors)
    }
}

impl<T> Deref for Power<T> {
    type Target = [T];
    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T> DerefMut for Power<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}

impl<T> FromIterator<T> for Power<T> {
    fn from_iter<I: IntoIterator<Item = T>>(factors: I) -> Self {
        Self(factors.into_iter().collect())
    }
}
