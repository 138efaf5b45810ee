//! The operators of a linear space, for small arrays of numbers.

/// Implements `+`, `-` and the multiple by a scalar for a type that `of` makes of a function of the index, and whose entries
/// are `at(i)`.
macro_rules! linear_operators {
    ($type:ident $(, $N:ident)?) => {
        impl<$(const $N: usize,)? S: Scalar> core::ops::Add for $type<$($N,)? S> {
            type Output = Self;
            #[inline(always)]
            fn add(self, y: Self) -> Self {
                Self::of(#[inline(always)] |i| self.at(i) + y.at(i))
            }
        }

        impl<$(const $N: usize,)? S: Scalar> core::ops::Sub for $type<$($N,)? S> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, y: Self) -> Self {
                Self::of(#[inline(always)] |i| self.at(i) - y.at(i))
            }
        }

        impl<$(const $N: usize,)? S: Scalar> core::ops::Neg for $type<$($N,)? S> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self::of(#[inline(always)] |i| -self.at(i))
            }
        }

        impl<$(const $N: usize,)? S: Scalar> core::ops::Mul<S> for $type<$($N,)? S> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, a: S) -> Self {
                Self::of(#[inline(always)] |i| self.at(i) * a)
            }
        }

        impl<$(const $N: usize,)? S: Scalar> core::ops::AddAssign for $type<$($N,)? S> {
            #[inline(always)]
            fn add_assign(&mut self, y: Self) {
                *self = *self + y;
            }
        }

        impl<$(const $N: usize,)? S: Scalar> core::ops::SubAssign for $type<$($N,)? S> {
            #[inline(always)]
            fn sub_assign(&mut self, y: Self) {
                *self = *self - y;
            }
        }
    };
}

pub(crate) use linear_operators;
