//! The floats as scalars.

use crate::{DualNumber, Scalar};

macro_rules! float {
    ($float:ident) => {
        impl Scalar for $float {
            type Mask = bool;
            type Real = $float;
            type Jet = DualNumber<$float>;
            const EPSILON: f64 = $float::EPSILON as f64;
            const DUAL_LEVELS: u32 = 0;

            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as $float
            }
            #[inline(always)]
            fn real(self) -> $float {
                self
            }
            #[inline(always)]
            fn from_real(x: $float) -> Self {
                x
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $float::sqrt(self)
            }
            #[inline(always)]
            fn exp(self) -> Self {
                $float::exp(self)
            }
            #[inline(always)]
            fn ln(self) -> Self {
                $float::ln(self)
            }
            #[inline(always)]
            fn tanh(self) -> Self {
                $float::tanh(self)
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $float::sin_cos(self)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                $float::atan2(self, x)
            }
            #[inline(always)]
            fn smooth<const N: usize>(self, f: &dyn Fn(f64, u32) -> [f64; N]) -> [Self; N] {
                f(self as f64, 0).map(|y| y as $float)
            }
            #[inline(always)]
            fn less(self, rhs: Self) -> bool {
                self < rhs
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
            #[inline(always)]
            fn magnitude(self) -> f64 {
                self.abs() as f64
            }
        }
    };
}

float!(f64);
float!(f32);
