//! Direct products: tuples and arrays of groups, and the run-time-sized [`Power`].
//!
//! Every operation acts factor by factor; algebra and dual are the tuple or array of the factors'. Each is written once,
//! for a factor `i`: `at!(x, i)` is that of `x`, `$each!(x, y | z; ..)` acts on all in order, reading `x` and `y` and writing
//! `z`, `$build!` makes a product of what they give.

use core::array::from_fn;

use num_traits::Zero;

use crate::numeric::larger;
use crate::{
    LieGroup, NotUnique, OutsideChart, Over, Power, Retraction, Scalar, Units, VectorSpace,
};

/// A field of a tuple, or an entry of a container of equal factors.
macro_rules! at {
    ($x:ident, $i:ident) => {
        $x[$i]
    };
    ($x:ident, $i:tt) => {
        $x.$i
    };
}

macro_rules! each_of_tuple {
    ($($read:ident),* $(| $($written:ident),+)?; $($i:tt => $action:expr),+) => { $($action;)+ };
}

macro_rules! each_of_equal {
    ($like:ident $(, $read:ident)* $(| $($written:ident),+)?; $i:ident => $action:expr) => {
        let n = $like.len();
        // As slices of one length they are indexed without checks.
        $(let $read = &$read[..n];)*
        $($(let $written = &mut $written[..n];)+)?
        for $i in 0..n {
            $action;
        }
    };
}

macro_rules! build_tuple {
    ($like:ident; $($i:tt => $factor:expr),+) => { ($($factor,)+) };
}

macro_rules! build_array {
    ($like:ident; $i:ident => $factor:expr) => {
        from_fn(|$i| $factor)
    };
}

macro_rules! build_power {
    ($like:ident; $i:ident => $factor:expr) => {
        Power((0..$like.len()).map(|$i| $factor).collect())
    };
}

/// The methods of [`VectorSpace`] that are alike for all products.
macro_rules! vectors_by_factor {
    ($each:ident, $($i:tt),+) => {
        #[inline(always)]
        fn dim(&self) -> usize {
            let mut dim = 0;
            $each!(self; $($i => dim += at!(self, $i).dim()),+);
            dim
        }
        #[inline(always)]
        fn write(&self, out: &mut [Self::Scalar]) {
            let mut start = 0;
            $each!(self; $($i => {
                at!(self, $i).write(&mut out[start..]);
                start += at!(self, $i).dim();
            }),+);
            debug_assert_eq!(start, self.dim());
        }
        #[inline(always)]
        fn read(&mut self, from: &[Self::Scalar]) {
            let mut start = 0;
            $each!(self; $($i => {
                at!(self, $i).read(&from[start..]);
                start += at!(self, $i).dim();
            }),+);
            debug_assert_eq!(start, self.dim());
        }
        #[inline(always)]
        fn set_zero(&mut self) {
            $each!(self; $($i => at!(self, $i).set_zero()),+);
        }
        #[inline(always)]
        fn copy_from(&mut self, y: &Self) {
            $each!(self, y; $($i => at!(self, $i).copy_from(&at!(y, $i))),+);
        }
        #[inline(always)]
        fn scale(&mut self, a: Self::Scalar) {
            $each!(self; $($i => at!(self, $i).scale(a)),+);
        }
        #[inline(always)]
        fn add_scaled(&mut self, a: Self::Scalar, y: &Self) {
            $each!(self, y; $($i => at!(self, $i).add_scaled(a, &at!(y, $i))),+);
        }
        #[inline(always)]
        fn set_sum(&mut self, x: &Self, a: Self::Scalar, y: &Self) {
            $each!(self, x, y; $($i => at!(self, $i).set_sum(&at!(x, $i), a, &at!(y, $i))),+);
        }
        #[inline(always)]
        fn max_magnitude(&self) -> f64 {
            let mut largest = 0.0;
            $each!(self; $($i => largest = larger(largest, at!(self, $i).max_magnitude())),+);
            largest
        }
    };
}

/// The methods of [`LieGroup`] that are alike for all products.
macro_rules! group_by_factor {
    ($build:ident, $each:ident, $($i:tt: $G:ident),+) => {
        #[inline(always)]
        fn zero_algebra(&self) -> Self::Algebra {
            $build!(self; $($i => at!(self, $i).zero_algebra()),+)
        }
        #[inline(always)]
        fn zero_dual(&self) -> Self::Dual {
            $build!(self; $($i => at!(self, $i).zero_dual()),+)
        }
        #[inline(always)]
        fn convert<X: Scalar, Y: Scalar>(g: &Over<Self, X>, f: impl Fn(X) -> Y + Copy) -> Over<Self, Y> {
            $build!(g; $($i => $G::convert(&at!(g, $i), f)),+)
        }
        #[inline(always)]
        fn compose(&self, h: &Self) -> Self {
            $build!(self; $($i => at!(self, $i).compose(&at!(h, $i))),+)
        }
        #[inline(always)]
        fn inverse(&self) -> Self {
            $build!(self; $($i => at!(self, $i).inverse()),+)
        }
        #[inline(always)]
        fn exp(xi: &Self::Algebra) -> Self {
            $build!(xi; $($i => $G::exp(&at!(xi, $i))),+)
        }
        /// Unique where those of all factors are.
        #[inline(always)]
        fn log(&self) -> Result<Self::Algebra, NotUnique<Self::Algebra>> {
            let mut unique = true;
            let xi = $build!(self; $($i => at!(self, $i).log().unwrap_or_else(|e| {
                unique = false;
                e.representative
            })),+);
            if unique { Ok(xi) } else { Err(NotUnique { representative: xi }) }
        }
        #[inline(always)]
        fn adjoint(&self, xi: &Self::Algebra) -> Self::Algebra {
            $build!(self; $($i => at!(self, $i).adjoint(&at!(xi, $i))),+)
        }
        #[inline(always)]
        fn bracket(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
            $build!(xi; $($i => $G::bracket(&at!(xi, $i), &at!(eta, $i))),+)
        }
        #[inline(always)]
        fn is_finite(&self) -> bool {
            $each!(self; $($i => if !at!(self, $i).is_finite() { return false }),+);
            true
        }
        #[inline(always)]
        fn normalize(&mut self) {
            $each!(self; $($i => at!(self, $i).normalize()),+);
        }
        #[inline(always)]
        fn pair(mu: &Self::Dual, xi: &Self::Algebra) -> Self::Scalar {
            let mut sum = Self::Scalar::zero();
            $each!(mu, xi; $($i => sum += $G::pair(&at!(mu, $i), &at!(xi, $i))),+);
            sum
        }
        #[inline(always)]
        fn coadjoint(&self, mu: &Self::Dual) -> Self::Dual {
            $build!(self; $($i => at!(self, $i).coadjoint(&at!(mu, $i))),+)
        }
        #[inline(always)]
        fn coadjoint_bracket(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
            $build!(xi; $($i => $G::coadjoint_bracket(&at!(xi, $i), &at!(mu, $i))),+)
        }
        #[inline(always)]
        fn cayley(xi: &Self::Algebra) -> Self {
            $build!(xi; $($i => $G::cayley(&at!(xi, $i))),+)
        }
        #[inline(always)]
        fn cayley_inverse(&self) -> Result<Self::Algebra, OutsideChart> {
            let mut inside = Ok(());
            let xi = $build!(self; $($i => at!(self, $i).cayley_inverse().unwrap_or_else(|e| {
                inside = Err(e);
                at!(self, $i).zero_algebra()
            })),+);
            inside.map(|()| xi)
        }
        #[inline(always)]
        fn sqrt(&self) -> Self {
            $build!(self; $($i => at!(self, $i).sqrt()),+)
        }
        #[inline(always)]
        fn d_left<R: Retraction>(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
            $build!(xi; $($i => $G::d_left::<R>(&at!(xi, $i), &at!(eta, $i))),+)
        }
        #[inline(always)]
        fn d_left_inv<R: Retraction>(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
            $build!(xi; $($i => $G::d_left_inv::<R>(&at!(xi, $i), &at!(eta, $i))),+)
        }
        #[inline(always)]
        fn d_left_dual<R: Retraction>(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
            $build!(xi; $($i => $G::d_left_dual::<R>(&at!(xi, $i), &at!(mu, $i))),+)
        }
        #[inline(always)]
        fn d_left_inv_dual<R: Retraction>(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
            $build!(xi; $($i => $G::d_left_inv_dual::<R>(&at!(xi, $i), &at!(mu, $i))),+)
        }
        #[inline(always)]
        fn d_left_inv_gradient<R: Retraction>(xi: &Self::Algebra, mu: &Self::Dual, eta: &Self::Algebra) -> Self::Dual {
            $build!(xi; $($i => $G::d_left_inv_gradient::<R>(&at!(xi, $i), &at!(mu, $i), &at!(eta, $i))),+)
        }
        #[inline(always)]
        fn convert_into<X: Scalar, Y: Scalar>(g: &Over<Self, X>, f: impl Fn(X) -> Y + Copy, out: &mut Over<Self, Y>) {
            $each!(g | out; $($i => $G::convert_into(&at!(g, $i), f, &mut at!(out, $i))),+);
        }
        #[inline(always)]
        fn compose_into(&self, h: &Self, out: &mut Self) {
            $each!(self, h | out; $($i => at!(self, $i).compose_into(&at!(h, $i), &mut at!(out, $i))),+);
        }
        #[inline(always)]
        fn inverse_into(&self, out: &mut Self) {
            $each!(self | out; $($i => at!(self, $i).inverse_into(&mut at!(out, $i))),+);
        }
        #[inline(always)]
        fn retract_into<R: Retraction>(xi: &Self::Algebra, out: &mut Self) {
            $each!(xi | out; $($i => $G::retract_into::<R>(&at!(xi, $i), &mut at!(out, $i))),+);
        }
        #[inline(always)]
        fn retract_inverse_into<R: Retraction>(&self, out: &mut Self::Algebra) -> Result<(), OutsideChart> {
            $each!(self | out; $($i => at!(self, $i).retract_inverse_into::<R>(&mut at!(out, $i))?),+);
            Ok(())
        }
        #[inline(always)]
        fn sqrt_into(&self, out: &mut Self) {
            $each!(self | out; $($i => at!(self, $i).sqrt_into(&mut at!(out, $i))),+);
        }
        #[inline(always)]
        fn coadjoint_into(&self, mu: &Self::Dual, out: &mut Self::Dual) {
            $each!(self, mu | out; $($i => at!(self, $i).coadjoint_into(&at!(mu, $i), &mut at!(out, $i))),+);
        }
        #[inline(always)]
        fn inverse_coadjoint_into(&self, mu: &Self::Dual, out: &mut Self::Dual) {
            $each!(self, mu | out; $($i => at!(self, $i).inverse_coadjoint_into(&at!(mu, $i), &mut at!(out, $i))),+);
        }
        #[inline(always)]
        fn zero_carry(&self) -> Self {
            $build!(self; $($i => at!(self, $i).zero_carry()),+)
        }
        #[inline(always)]
        fn advance(&mut self, f: &Self, carry: &mut Self) {
            $each!(self, f | carry; $($i => at!(self, $i).advance(&at!(f, $i), &mut at!(carry, $i))),+);
        }
        #[inline(always)]
        fn chart_enter_into<R: Retraction>(c: &Self::Algebra, pi: &Self::Dual, (f, mu): (&mut Self, &mut Self::Dual)) {
            $each!(c, pi | f, mu; $($i => {
                let out = (&mut at!(f, $i), &mut at!(mu, $i));
                $G::chart_enter_into::<R>(&at!(c, $i), &at!(pi, $i), out)
            }),+);
        }
        #[inline(always)]
        fn chart_leave_into<R: Retraction>(
            c: &Self::Algebra,
            momentum: &Self::Dual,
            (f, mu, pi): (&mut Self, &mut Self::Dual, &mut Self::Dual),
        ) {
            $each!(c, momentum | f, mu, pi; $($i => {
                let out = (&mut at!(f, $i), &mut at!(mu, $i), &mut at!(pi, $i));
                $G::chart_leave_into::<R>(&at!(c, $i), &at!(momentum, $i), out)
            }),+);
        }
        #[inline(always)]
        fn chart_rates_into<R: Retraction>(
            (c, pi): (&Self::Algebra, &Self::Dual),
            (xi, tau): (&Self::Algebra, &Self::Dual),
            (c_dot, pi_dot): (&mut Self::Algebra, &mut Self::Dual),
        ) {
            $each!(c, pi, xi, tau | c_dot, pi_dot; $($i => {
                let out = (&mut at!(c_dot, $i), &mut at!(pi_dot, $i));
                $G::chart_rates_into::<R>((&at!(c, $i), &at!(pi, $i)), (&at!(xi, $i), &at!(tau, $i)), out)
            }),+);
        }
        #[inline(always)]
        fn chart_velocity_into<R: Retraction>(c: &Self::Algebra, xi: &Self::Algebra, c_dot: &mut Self::Algebra) {
            $each!(c, xi | c_dot; $($i => $G::chart_velocity_into::<R>(&at!(c, $i), &at!(xi, $i), &mut at!(c_dot, $i))),+);
        }
    };
}

macro_rules! tuple {
    ($($i:tt: $G:ident),+) => {
        impl<S: Scalar, $($G: VectorSpace<Scalar = S>),+> VectorSpace for ($($G,)+) {
            type Scalar = S;
            vectors_by_factor!(each_of_tuple, $($i),+);

            #[inline(always)]
            fn get(&self, i: usize) -> S {
                let mut i = i;
                $(
                    if i < self.$i.dim() {
                        return self.$i.get(i);
                    }
                    i -= self.$i.dim();
                )+
                panic!("coordinate {i} past the last one")
            }
            #[inline(always)]
            fn set(&mut self, i: usize, value: S) {
                let mut i = i;
                $(
                    if i < self.$i.dim() {
                        return self.$i.set(i, value);
                    }
                    i -= self.$i.dim();
                )+
                panic!("coordinate {i} past the last one")
            }
            #[inline(always)]
            fn same_shape(&self, other: &Self) -> bool {
                $(self.$i.same_shape(&other.$i))&&+
            }
        }

        impl<S: Scalar, $($G: LieGroup<Scalar = S>),+> LieGroup for ($($G,)+) {
            type Scalar = S;
            type Algebra = ($($G::Algebra,)+);
            type Dual = ($($G::Dual,)+);
            type WithScalar<T: Scalar> = ($($G::WithScalar<T>,)+);
            group_by_factor!(build_tuple, each_of_tuple, $($i: $G),+);

            #[inline(always)]
            fn same_shape(&self, other: &Self) -> bool {
                $(self.$i.same_shape(&other.$i))&&+
            }
            fn units(&self, units: &mut Units) {
                $(self.$i.units(units);)+
            }
        }
    };
}

tuple!(0: A, 1: B);
tuple!(0: A, 1: B, 2: C);
tuple!(0: A, 1: B, 2: C, 3: D);

/// A container of equal factors.
macro_rules! equal {
    ([$($generics:tt)*] $container:ty, $build:ident, $algebra:ty, $dual:ty, [$T:ident] $with:ty) => {
        impl<G: VectorSpace, $($generics)*> VectorSpace for $container {
            type Scalar = G::Scalar;
            vectors_by_factor!(each_of_equal, i);

            #[inline(always)]
            fn get(&self, i: usize) -> G::Scalar {
                let n = self[0].dim();
                self[i / n].get(i % n)
            }
            #[inline(always)]
            fn set(&mut self, i: usize, value: G::Scalar) {
                let n = self[0].dim();
                self[i / n].set(i % n, value);
            }
            #[inline(always)]
            fn same_shape(&self, other: &Self) -> bool {
                self.len() == other.len() && self.iter().zip(other.iter()).all(|(a, b)| a.same_shape(b))
            }
        }

        impl<G: LieGroup, $($generics)*> LieGroup for $container {
            type Scalar = G::Scalar;
            type Algebra = $algebra;
            type Dual = $dual;
            type WithScalar<$T: Scalar> = $with;
            group_by_factor!($build, each_of_equal, i: G);

            #[inline(always)]
            fn same_shape(&self, other: &Self) -> bool {
                self.len() == other.len() && self.iter().zip(other.iter()).all(|(a, b)| a.same_shape(b))
            }
            fn units(&self, units: &mut Units) {
                units.repeat(self.len(), |units| self[0].units(units));
            }
        }
    };
}

equal!(
    [const N: usize] [G; N], build_array,
    [G::Algebra; N], [G::Dual; N], [T] [G::WithScalar<T>; N]
);
equal!(
    [] Power<G>, build_power,
    Power<G::Algebra>, Power<G::Dual>, [T] Power<G::WithScalar<T>>
);
