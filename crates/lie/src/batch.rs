//! Several numbers treated as one scalar.

use num_traits::Zero;

use crate::{DualNumber, Scalar};

/// A scalar that stands for one number or for several side by side.
///
/// A float and a dual number are one item. A SIMD register is several: a formula over it is evaluated for as many
/// arguments at once. [`lanes`](crate::lanes) hands one out that fits the processor.
///
/// ```
/// use lie::Batch;
///
/// assert_eq!((f64::ITEMS, f64::splat(2.0)), (1, 2.0));
/// assert_eq!(f64::items(&[1.0, 2.0]), [1.0, 2.0]);
/// ```
pub trait Batch: Scalar {
    /// One of the numbers.
    type Item: Scalar;

    /// How many there are.
    const ITEMS: usize;

    /// The same number everywhere.
    fn splat(item: Self::Item) -> Self;

    /// The numbers of a slice, one batch after the other.
    fn items(batches: &[Self]) -> &[Self::Item];

    /// The same, to be changed.
    fn items_mut(batches: &mut [Self]) -> &mut [Self::Item];

    /// The sum of the numbers.
    fn sum(self) -> Self::Item;

    /// The magnitude of each number.
    fn abs(self) -> Self;

    /// The lane-wise maximum; unspecified if either is NaN.
    fn max(self, other: Self) -> Self;

    /// Runs `f` compiled for the instructions of this scalar, as far as `f` and all it calls is inlined.
    fn run<O>(f: impl FnOnce() -> O) -> O;
}

macro_rules! single {
    ($($generic:ident)? => $type:ty) => {
        impl$(<$generic: Scalar>)? Batch for $type {
            type Item = Self;
            const ITEMS: usize = 1;

            #[inline(always)]
            fn splat(item: Self) -> Self {
                item
            }
            #[inline(always)]
            fn items(batches: &[Self]) -> &[Self] {
                batches
            }
            #[inline(always)]
            fn items_mut(batches: &mut [Self]) -> &mut [Self] {
                batches
            }
            #[inline(always)]
            fn sum(self) -> Self {
                self
            }
            #[inline(always)]
            fn abs(self) -> Self {
                Self::select(self.less(Self::zero()), -self, self)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self::select(self.less(other), other, self)
            }
            #[inline(always)]
            fn run<O>(f: impl FnOnce() -> O) -> O {
                f()
            }
        }
    };
}

single!(=> f64);
single!(=> f32);
single!(T => DualNumber<T>);
