//! The numbers that every formula here is written over.

use core::fmt::Debug;
use core::ops::Neg;

use num_traits::{NumAssignOps, NumOps, One, Zero};

/// Directions that one [`Scalar::Jet`] carries.
///
/// The dimension of a product of groups cannot size an array on stable Rust, so derivatives are
/// taken in chunks of this many directions.
pub const JET_DIRECTIONS: usize = 6;

/// A number that the formulas of this crate run over: `f64`, `f32`, dual numbers, SIMD lanes.
///
/// Group code takes no data-dependent branch. Where two expressions are needed, both are evaluated
/// and [`select`](Scalar::select) picks one. So dual numbers keep their derivative, and lanes
/// stay side by side.
///
/// ```
/// use lie::Scalar;
///
/// fn hypotenuse<S: Scalar>(a: S, b: S) -> S {
///     (a * a + b * b).sqrt()
/// }
/// assert_eq!(hypotenuse(3.0_f64, 4.0), 5.0);
/// assert_eq!(hypotenuse(3.0_f32, 4.0), 5.0);
/// ```
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + Zero
    + One
    + NumOps
    + NumAssignOps
    + Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// The outcome of a comparison: `bool`, or one bit a lane.
    type Mask: Copy;

    /// The numbers without their derivatives: what is left of a dual number at any depth.
    type Real: Scalar<Real = Self::Real>;

    /// Dual numbers over this scalar with [`JET_DIRECTIONS`] directions.
    type Jet: Jet<Value = Self>;

    /// The distance from 1 to the next larger number of the underlying float.
    const EPSILON: f64;

    /// How many levels of dual numbers this scalar nests: 0 for floats, one more than the inner scalar's for duals.
    const DUAL_LEVELS: u32;

    /// Whether it stands for one number; [lanes](crate::lanes) stand for several.
    const IS_SINGLE: bool = true;

    /// The nearest number to `x`, a constant under differentiation.
    fn from_f64(x: f64) -> Self;

    /// $c x$ for a constant $c$; dual numbers need not carry its derivatives along.
    #[inline(always)]
    fn times(self, c: f64) -> Self {
        self * Self::from_f64(c)
    }

    /// $x a + b$, rounded once where the instructions for it are at hand.
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }

    /// $b - x a$, likewise.
    #[inline(always)]
    fn neg_mul_add(self, a: Self, b: Self) -> Self {
        b - self * a
    }

    /// The value without derivatives.
    fn real(self) -> Self::Real;

    /// A constant under differentiation.
    fn from_real(x: Self::Real) -> Self;

    /// The square root.
    fn sqrt(self) -> Self;

    /// $e^x$.
    fn exp(self) -> Self;

    /// The natural logarithm.
    fn ln(self) -> Self;

    /// The hyperbolic tangent: a smooth sign, for friction say.
    fn tanh(self) -> Self;

    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);

    /// The sine.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// The cosine.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }

    /// $x^n$ for a whole $n \ge 0$, by products.
    #[inline(always)]
    fn powi(self, n: u32) -> Self {
        (0..n).fold(Self::one(), |power, _| power * self)
    }

    /// The angle of the point `(x, self)` in the plane, in $(-\pi, \pi]$.
    fn atan2(self, x: Self) -> Self;

    /// The values here of smooth functions of one real variable, known by their derivatives: `f(x, k)` gives the $k$-th ones at $x$.
    ///
    /// What a formula over scalars cannot say, such as a spline through measured points, is lifted so to dual numbers and lanes.
    ///
    /// ```
    /// use lie::{Jet, Scalar};
    ///
    /// let sine = |x: f64, k: u32| [(x + f64::from(k) * std::f64::consts::FRAC_PI_2).sin()];
    /// let [y] = <f64 as Scalar>::Jet::variable(0.5, 0).smooth(&sine);
    /// assert_eq!(y.value(), 0.5_f64.sin());
    /// assert!((y.partial(0) - 0.5_f64.cos()).abs() < 1e-15);
    /// ```
    fn smooth<const N: usize>(self, f: &dyn Fn(f64, u32) -> [f64; N]) -> [Self; N];

    /// Whether `self < rhs`, by the real parts.
    fn less(self, rhs: Self) -> Self::Mask;

    /// `yes` where the mask holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// This number where `by` is larger than `least` in magnitude, or is no number; none elsewhere.
    ///
    /// It guards a domain, such as that of a chart. A recording, which has no value to look at, always gives a number: one that will be
    /// no number outside the domain.
    #[inline(always)]
    fn guarded(self, by: Self, least: f64) -> Option<Self> {
        let outside = by.magnitude() <= least;
        (!outside).then_some(self)
    }

    /// Runs `f` compiled for the instructions of this scalar, as far as `f` and all it calls is inlined; see [`Batch::run`](crate::Batch::run).
    ///
    /// So a function over any scalar need not be inlined itself.
    #[inline(always)]
    fn compiled<O>(f: impl FnOnce() -> O) -> O {
        f()
    }

    /// The largest absolute value of the real parts; for pivots, tolerances and tests, not for formulas.
    fn magnitude(self) -> f64;
}

/// A dual number: a value with its derivatives along [`JET_DIRECTIONS`] directions.
///
/// ```
/// use lie::{Jet, Scalar};
///
/// let x = <f64 as Scalar>::Jet::variable(3.0, 0);
/// let y = x * x;
/// assert_eq!((y.value(), y.partial(0), y.partial(1)), (9.0, 6.0, 0.0));
/// ```
pub trait Jet: Scalar {
    /// What is differentiated.
    type Value: Scalar;

    /// A number with no derivative.
    fn constant(value: Self::Value) -> Self;

    /// The variable of direction `direction`, which must be below [`JET_DIRECTIONS`].
    fn variable(value: Self::Value, direction: usize) -> Self;

    /// The value.
    fn value(self) -> Self::Value;

    /// The derivative along `direction`.
    fn partial(self, direction: usize) -> Self::Value;
}
