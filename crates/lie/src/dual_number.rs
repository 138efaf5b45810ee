//! Dual numbers: a value and its derivatives along a fixed number of directions.

use core::array::from_fn;
use core::ops::{
    Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign,
};

use num_traits::{One, Zero};

use crate::{JET_DIRECTIONS, Jet, Scalar};

/// $x + \sum_d \epsilon_d \partial_d x$ with $\epsilon_d \epsilon_e = 0$, over any scalar: nested, they give higher derivatives.
///
/// Plain arrays of a fixed size, so that whole formulas are inlined and vectorised; and over any [`Scalar`], lanes included.
///
/// ```
/// use lie::{DualNumber, Jet, Scalar};
///
/// let x: DualNumber = DualNumber::variable(4.0, 0);
/// assert_eq!(x.sqrt().partial(0), 0.25);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DualNumber<T = f64> {
    value: T,
    partials: [T; JET_DIRECTIONS],
}

impl<T: Scalar> DualNumber<T> {
    #[inline(always)]
    fn new(value: T, partial: impl Fn(usize) -> T) -> Self {
        let mut partials = [T::zero(); JET_DIRECTIONS];
        let mut direction = 0;
        while direction < JET_DIRECTIONS {
            partials[direction] = partial(direction);
            direction += 1;
        }
        Self { value, partials }
    }

    /// A function of this number with this value and slope.
    #[inline(always)]
    fn chain(self, value: T, slope: T) -> Self {
        Self::new(value, |d| self.partials[d] * slope)
    }
}

impl<T: Scalar> Zero for DualNumber<T> {
    #[inline(always)]
    fn zero() -> Self {
        Self::constant(T::zero())
    }
    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.value.is_zero()
    }
}

impl<T: Scalar> One for DualNumber<T> {
    #[inline(always)]
    fn one() -> Self {
        Self::constant(T::one())
    }
}

impl<T: Scalar> Neg for DualNumber<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.value, |d| -self.partials[d])
    }
}

impl<T: Scalar> Add for DualNumber<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, y: Self) -> Self {
        Self::new(self.value + y.value, |d| self.partials[d] + y.partials[d])
    }
}

impl<T: Scalar> Sub for DualNumber<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, y: Self) -> Self {
        Self::new(self.value - y.value, |d| self.partials[d] - y.partials[d])
    }
}

impl<T: Scalar> Mul for DualNumber<T> {
    type Output = Self;
    #[inline(always)]
    #[allow(clippy::suspicious_arithmetic_impl, reason = "the product rule")]
    fn mul(self, y: Self) -> Self {
        Self::new(self.value * y.value, |d| {
            self.partials[d] * y.value + self.value * y.partials[d]
        })
    }
}

impl<T: Scalar> Div for DualNumber<T> {
    type Output = Self;
    #[inline(always)]
    #[allow(clippy::suspicious_arithmetic_impl, reason = "the quotient rule")]
    fn div(self, y: Self) -> Self {
        let (quotient, inverse) = (self.value / y.value, T::one() / y.value);
        Self::new(quotient, |d| {
            (self.partials[d] - quotient * y.partials[d]) * inverse
        })
    }
}

impl<T: Scalar> Rem for DualNumber<T> {
    type Output = Self;
    /// $x - \operatorname{trunc}(x/y) y$, the quotient being constant between its jumps.
    #[inline(always)]
    fn rem(self, y: Self) -> Self {
        let rest = self.value % y.value;
        let quotient = (self.value - rest) / y.value;
        Self::new(rest, |d| self.partials[d] - quotient * y.partials[d])
    }
}

macro_rules! assign {
    ($($trait:ident $method:ident $operator:tt),+) => { $(
        impl<T: Scalar> $trait for DualNumber<T> {
            #[inline(always)]
            fn $method(&mut self, y: Self) {
                *self = *self $operator y;
            }
        }
    )+ };
}

assign!(AddAssign add_assign +, SubAssign sub_assign -, MulAssign mul_assign *, DivAssign div_assign /, RemAssign rem_assign %);

impl<T: Scalar> Scalar for DualNumber<T> {
    type Mask = T::Mask;
    type Real = T::Real;
    type Jet = DualNumber<Self>;
    const EPSILON: f64 = T::EPSILON;
    const DUAL_LEVELS: u32 = T::DUAL_LEVELS + 1;
    const IS_SINGLE: bool = T::IS_SINGLE;

    #[inline(always)]
    fn compiled<O>(f: impl FnOnce() -> O) -> O {
        T::compiled(f)
    }

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::constant(T::from_f64(x))
    }
    #[inline(always)]
    fn times(self, c: f64) -> Self {
        Self::new(self.value.times(c), |d| self.partials[d].times(c))
    }
    #[inline(always)]
    fn real(self) -> T::Real {
        self.value.real()
    }
    #[inline(always)]
    fn from_real(x: T::Real) -> Self {
        Self::constant(T::from_real(x))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, T::from_f64(0.5) / root)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let power = self.value.exp();
        self.chain(power, power)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.chain(self.value.ln(), T::one() / self.value)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        let tanh = self.value.tanh();
        self.chain(tanh, T::one() - tanh * tanh)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        // Not by the derivative of the arc tangent of a quotient: x may be zero.
        let square = x.value * x.value + self.value * self.value;
        let (a, b) = (x.value / square, self.value / square);
        Self::new(self.value.atan2(x.value), |d| {
            a * self.partials[d] - b * x.partials[d]
        })
    }
    fn smooth<const N: usize>(self, f: &dyn Fn(f64, u32) -> [f64; N]) -> [Self; N] {
        if self.partials.iter().all(|p| p.magnitude() == 0.0) {
            // The slope of a constant is not asked for: it may not be known.
            return self.value.smooth(f).map(|y| Self::new(y, |_| T::zero()));
        }
        let slopes = self.value.smooth(&|x, k| f(x, k + 1));
        let values = self.value.smooth(f);
        from_fn(|i| self.chain(values[i], slopes[i]))
    }
    #[inline(always)]
    fn less(self, rhs: Self) -> T::Mask {
        self.value.less(rhs.value)
    }
    #[inline(always)]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        Self::new(T::select(mask, yes.value, no.value), |d| {
            T::select(mask, yes.partials[d], no.partials[d])
        })
    }
    #[inline(always)]
    fn magnitude(self) -> f64 {
        self.value.magnitude()
    }
}

impl<T: Scalar> Jet for DualNumber<T> {
    type Value = T;

    #[inline(always)]
    fn constant(value: T) -> Self {
        Self::new(value, |_| T::zero())
    }
    #[inline(always)]
    fn variable(value: T, direction: usize) -> Self {
        let one = |d| if d == direction { T::one() } else { T::zero() };
        Self::new(value, one)
    }
    #[inline(always)]
    fn value(self) -> T {
        self.value
    }
    #[inline(always)]
    fn partial(self, direction: usize) -> T {
        self.partials[direction]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type J = DualNumber;
    type JJ = DualNumber<J>;

    /// Every operation, at a generic point.
    fn formula<S: Scalar>(x: S, y: S) -> S {
        let (sin, cos) = (x * y).sin_cos();
        let mut sum = (x * x + y).sqrt().times(1.5) / (S::from_f64(2.0) + sin) - cos * -x;
        sum += x.atan2(y) * y + Scalar::tanh(x - y) * Scalar::exp(y * x);
        sum += Scalar::ln(x + y + S::one()) * Scalar::powi(x, 3) + Scalar::sin(x) * Scalar::cos(y);
        sum -= (x * S::from_f64(7.0)) % (y + S::one());
        let mask = x.less(y);
        S::select(mask, sum * x, sum / x)
    }

    #[test]
    fn first_derivatives_are_those_of_differences() {
        for (x, y) in [(0.7, 1.3), (1.9, 0.4), (0.9, -0.2)] {
            let f = formula(J::variable(x, 0), J::variable(y, 5));
            let w = 1e-5;
            let slopes = [
                (formula(x + w, y) - formula(x - w, y)) / (2.0 * w),
                (formula(x, y + w) - formula(x, y - w)) / (2.0 * w),
            ];
            assert_eq!(f.value(), formula(x, y));
            // Truncation, w², and rounding over w.
            assert!((f.partial(0) - slopes[0]).abs() < 1e-8);
            assert!((f.partial(5) - slopes[1]).abs() < 1e-8);
            assert_eq!(f.partial(2), 0.0);
        }
    }

    #[test]
    fn second_derivatives_are_those_of_first_ones() {
        let (x, y, w) = (0.7, 1.3, 1e-5);
        let twice = |x: f64, d| JJ::variable(J::variable(x, d), d);
        let f = formula(twice(x, 0), twice(y, 1));
        let slope = |x: f64, y: f64| formula(J::variable(x, 0), J::variable(y, 1)).partial(0);
        let xx = (slope(x + w, y) - slope(x - w, y)) / (2.0 * w);
        let xy = (slope(x, y + w) - slope(x, y - w)) / (2.0 * w);
        assert!((f.partial(0).partial(0) - xx).abs() < 1e-8);
        assert!((f.partial(0).partial(1) - xy).abs() < 1e-8);
        assert!((f.partial(1).partial(0) - xy).abs() < 1e-8);
    }

    #[test]
    fn the_angle_is_smooth_where_x_is_zero() {
        let angle = J::variable(2.0, 0).atan2(J::variable(0.0, 1));
        assert_eq!((angle.partial(0), angle.partial(1)), (0.0, -0.5));
    }
}
