//! One SIMD register of doubles.
//!
//! The types are not to be named outside: whoever holds a value of one was given it by [`run`](super::run), after the
//! processor was asked.

use core::fmt::Debug;
use core::marker::PhantomData;
use core::ops::{
    Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign,
};

use num_traits::{One, Zero};
use pulp::{Simd, WithSimd, bytemuck};

use super::per_lane::PerLane;
use crate::numeric::larger;
use crate::{Batch, DualNumber, Scalar};

/// The registers of an instruction set.
pub trait Register: Copy + Debug + 'static {
    type Simd: Simd;

    fn is_available() -> bool;

    /// To be called only where it [is available](Self::is_available).
    fn token() -> Self::Simd;
}

macro_rules! register {
    ($name:ident, $simd:ty, $features:ty, $token:expr) => {
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Register for $name {
            type Simd = $simd;

            #[inline]
            fn is_available() -> bool {
                <$features>::try_new().is_some()
            }

            #[inline(always)]
            #[allow(unsafe_code, reason = "`run` has asked the processor")]
            fn token() -> $simd {
                $token(unsafe { <$features>::new_unchecked() })
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
register!(Fma, pulp::x86::V3_128b, pulp::x86::V3, pulp::x86::V3_128b);
#[cfg(target_arch = "x86_64")]
register!(Avx2, pulp::x86::V3, pulp::x86::V3, core::convert::identity);
#[cfg(target_arch = "x86_64")]
register!(
    Avx512,
    pulp::x86::V4,
    pulp::x86::V4,
    core::convert::identity
);
#[cfg(target_arch = "aarch64")]
register!(
    Neon,
    pulp::aarch64::Neon,
    pulp::aarch64::Neon,
    core::convert::identity
);

type Doubles<R> = <<R as Register>::Simd as Simd>::f64s;

/// What the doubles of a register are to a formula.
pub trait Meaning: Copy + Debug + Send + Sync + 'static {}

/// Items of a [`Batch`].
#[derive(Clone, Copy, Debug)]
pub struct Items;

/// One number, of a problem of its own in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Problems;

impl Meaning for Items {}
impl Meaning for Problems {}

/// As many doubles as a register of `R` holds.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct Lanes<R: Register, M = Items>(Doubles<R>, PhantomData<M>);

impl<R: Register, M: Meaning> Lanes<R, M> {
    #[inline(always)]
    fn of(doubles: Doubles<R>) -> Self {
        Self(doubles, PhantomData)
    }

    /// The same double in each lane.
    #[inline(always)]
    fn everywhere(x: f64) -> Self {
        Self::of(R::token().splat_f64s(x))
    }

    #[inline(always)]
    fn magnitudes(self) -> Self {
        Self::of(R::token().abs_f64s(self.0))
    }

    #[inline(always)]
    fn larger_each(self, other: Self) -> Self {
        Self::of(R::token().max_f64s(self.0, other.0))
    }

    #[inline(always)]
    fn vectorised<O>(f: impl FnOnce() -> O) -> O {
        struct Call<F>(F);
        impl<O, F: FnOnce() -> O> WithSimd for Call<F> {
            type Output = O;
            #[inline(always)]
            fn with_simd<S: Simd>(self, _: S) -> O {
                (self.0)()
            }
        }
        R::token().vectorize(Call(f))
    }

    /// Number by number, for what the registers cannot do.
    #[inline(always)]
    fn each(mut self, f: impl Fn(usize, f64) -> f64) -> Self {
        for (i, x) in self.numbers_mut().iter_mut().enumerate() {
            *x = f(i, *x);
        }
        self
    }

    #[inline(always)]
    fn numbers(&self) -> &[f64] {
        bytemuck::cast_slice(core::slice::from_ref(&self.0))
    }

    #[inline(always)]
    fn numbers_mut(&mut self) -> &mut [f64] {
        bytemuck::cast_slice_mut(core::slice::from_mut(&mut self.0))
    }
}

macro_rules! operator {
    ($($trait:ident $method:ident $assign:ident $assign_method:ident $of_simd:ident),+) => { $(
        impl<R: Register, M: Meaning> $trait for Lanes<R, M> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, y: Self) -> Self {
                Self::of(R::token().$of_simd(self.0, y.0))
            }
        }

        impl<R: Register, M: Meaning> $assign for Lanes<R, M> {
            #[inline(always)]
            fn $assign_method(&mut self, y: Self) {
                *self = Self::of(R::token().$of_simd(self.0, y.0));
            }
        }
    )+ };
}

operator!(
    Add add AddAssign add_assign add_f64s,
    Sub sub SubAssign sub_assign sub_f64s,
    Mul mul MulAssign mul_assign mul_f64s,
    Div div DivAssign div_assign div_f64s
);

impl<R: Register, M: Meaning> Rem for Lanes<R, M> {
    type Output = Self;
    #[inline(always)]
    fn rem(self, y: Self) -> Self {
        self.each(|i, x| x % y.numbers()[i])
    }
}

impl<R: Register, M: Meaning> RemAssign for Lanes<R, M> {
    #[inline(always)]
    fn rem_assign(&mut self, y: Self) {
        *self = *self % y;
    }
}

impl<R: Register, M: Meaning> Neg for Lanes<R, M> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::of(R::token().neg_f64s(self.0))
    }
}

impl<R: Register, M: Meaning> PartialEq for Lanes<R, M> {
    #[inline(always)]
    fn eq(&self, y: &Self) -> bool {
        self.numbers() == y.numbers()
    }
}

impl<R: Register, M: Meaning> Zero for Lanes<R, M> {
    #[inline(always)]
    fn zero() -> Self {
        Self::everywhere(0.0)
    }
    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.numbers().iter().all(|x| *x == 0.0)
    }
}

impl<R: Register, M: Meaning> One for Lanes<R, M> {
    #[inline(always)]
    fn one() -> Self {
        Self::everywhere(1.0)
    }
}

impl<R: Register, M: Meaning> Scalar for Lanes<R, M> {
    type Mask = <R::Simd as Simd>::m64s;
    type Real = Self;
    type Jet = DualNumber<Self>;
    const EPSILON: f64 = f64::EPSILON;
    const DUAL_LEVELS: u32 = 0;
    const IS_SINGLE: bool = false;

    #[inline(always)]
    fn compiled<O>(f: impl FnOnce() -> O) -> O {
        Self::vectorised(f)
    }
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::everywhere(x)
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self::of(R::token().mul_add_e_f64s(self.0, a.0, b.0))
    }
    #[inline(always)]
    fn neg_mul_add(self, a: Self, b: Self) -> Self {
        Self::of(R::token().negate_mul_add_e_f64s(self.0, a.0, b.0))
    }
    #[inline(always)]
    fn real(self) -> Self {
        self
    }
    #[inline(always)]
    fn from_real(x: Self) -> Self {
        x
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::of(R::token().sqrt_f64s(self.0))
    }
    #[inline(always)]
    fn exp(self) -> Self {
        self.each(|_, x| x.exp())
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.each(|_, x| x.ln())
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        self.each(|_, x| x.tanh())
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        (self.each(|_, x| x.sin()), self.each(|_, x| x.cos()))
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        self.each(|i, y| y.atan2(x.numbers()[i]))
    }
    fn smooth<const N: usize>(self, f: &dyn Fn(f64, u32) -> [f64; N]) -> [Self; N] {
        let mut values = [self; N];
        for (lane, x) in self.numbers().iter().enumerate() {
            for (all, y) in values.iter_mut().zip(f(*x, 0)) {
                *all = all.each(|i, old| if i == lane { y } else { old });
            }
        }
        values
    }
    #[inline(always)]
    fn less(self, rhs: Self) -> Self::Mask {
        R::token().less_than_f64s(self.0, rhs.0)
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self::of(R::token().select_f64s(mask, yes.0, no.0))
    }
    /// The largest of them; not a number where one is not.
    #[inline(always)]
    fn magnitude(self) -> f64 {
        self.numbers().iter().map(|x| x.abs()).fold(0.0, larger)
    }
}

impl<R: Register> Batch for Lanes<R> {
    type Item = f64;
    const ITEMS: usize = R::Simd::F64_LANES;

    #[inline(always)]
    fn splat(item: f64) -> Self {
        Self::everywhere(item)
    }

    #[inline(always)]
    #[allow(unsafe_code, reason = "a transparent wrapper of plain doubles")]
    fn items(batches: &[Self]) -> &[f64] {
        let length = batches.len() * Self::ITEMS;
        unsafe { core::slice::from_raw_parts(batches.as_ptr().cast(), length) }
    }

    #[inline(always)]
    #[allow(unsafe_code, reason = "a transparent wrapper of plain doubles")]
    fn items_mut(batches: &mut [Self]) -> &mut [f64] {
        let length = batches.len() * Self::ITEMS;
        unsafe { core::slice::from_raw_parts_mut(batches.as_mut_ptr().cast(), length) }
    }

    #[inline(always)]
    fn sum(self) -> f64 {
        R::token().reduce_sum_f64s(self.0)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.magnitudes()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.larger_each(other)
    }

    #[inline(always)]
    fn run<O>(f: impl FnOnce() -> O) -> O {
        Self::vectorised(f)
    }
}

impl<R: Register> Batch for Lanes<R, Problems> {
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
        self.magnitudes()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.larger_each(other)
    }

    #[inline(always)]
    fn run<O>(f: impl FnOnce() -> O) -> O {
        Self::vectorised(f)
    }
}

impl<R: Register> PerLane for Lanes<R, Problems> {
    const LANES: usize = R::Simd::F64_LANES;

    #[inline(always)]
    fn lanes(&self) -> &[f64] {
        self.numbers()
    }

    #[inline(always)]
    fn lanes_mut(&mut self) -> &mut [f64] {
        self.numbers_mut()
    }
}
