//! Direct products: tuples and arrays of groups, and the run-time-sized [`Power`].
//!
//! Every operation acts factor by factor; algebra and dual are the tuple or array of the factors'.

use core::array::from_fn;

use crate::{
    LieGroup, NotUnique, OutsideChart, Over, Power, Retraction, Scalar, Units, VectorSpace,
};

/// Collects the factors' logarithms: unique where all are.
struct Logs {
    unique: bool,
}

impl Logs {
    fn take<A: core::fmt::Debug>(&mut self, log: Result<A, NotUnique<A>>) -> A {
        log.unwrap_or_else(|e| {
            self.unique = false;
            e.representative
        })
    }

    fn finish<A: core::fmt::Debug>(self, representative: A) -> Result<A, NotUnique<A>> {
        if self.unique {
            Ok(representative)
        } else {
            Err(NotUnique { representative })
        }
    }
}

macro_rules! tuple {
    ($($G:ident . $i:tt),+) => {
        impl<S: Scalar, $($G: VectorSpace<Scalar = S>),+> VectorSpace for ($($G,)+) {
            type Scalar = S;

            #[inline(always)]
            fn dim(&self) -> usize {
                0 $(+ self.$i.dim())+
            }
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
            fn write(&self, out: &mut [S]) {
                let mut start = 0;
                $(
                    self.$i.write(&mut out[start..]);
                    start += self.$i.dim();
                )+
                debug_assert_eq!(start, self.dim());
            }
            #[inline(always)]
            fn read(&mut self, from: &[S]) {
                let mut start = 0;
                $(
                    self.$i.read(&from[start..]);
                    start += self.$i.dim();
                )+
                debug_assert_eq!(start, self.dim());
            }
            #[inline(always)]
            fn same_shape(&self, other: &Self) -> bool {
                $(self.$i.same_shape(&other.$i))&&+
            }
            #[inline(always)]
            fn set_zero(&mut self) {
                $(self.$i.set_zero();)+
            }
            #[inline(always)]
            fn copy_from(&mut self, y: &Self) {
                $(self.$i.copy_from(&y.$i);)+
            }
            #[inline(always)]
            fn scale(&mut self, a: S) {
                $(self.$i.scale(a);)+
            }
            #[inline(always)]
            fn add_scaled(&mut self, a: S, y: &Self) {
                $(self.$i.add_scaled(a, &y.$i);)+
            }
            #[inline(always)]
            fn set_sum(&mut self, x: &Self, a: S, y: &Self) {
                $(self.$i.set_sum(&x.$i, a, &y.$i);)+
            }
            #[inline(always)]
            fn max_magnitude(&self) -> f64 {
                [$(self.$i.max_magnitude()),+]
                    .into_iter()
                    .fold(0.0, |a: f64, b| if a >= b || a.is_nan() { a } else { b })
            }
        }

        impl<S: Scalar, $($G: LieGroup<Scalar = S>),+> LieGroup for ($($G,)+) {
            type Scalar = S;
            type Algebra = ($($G::Algebra,)+);
            type Dual = ($($G::Dual,)+);
            type WithScalar<T: Scalar> = ($($G::WithScalar<T>,)+);

            #[inline(always)]
            fn zero_algebra(&self) -> Self::Algebra {
                ($(self.$i.zero_algebra(),)+)
            }
            #[inline(always)]
            fn zero_dual(&self) -> Self::Dual {
                ($(self.$i.zero_dual(),)+)
            }
            #[inline(always)]
            fn convert<A_: Scalar, B_: Scalar>(
                g: &Over<Self, A_>,
                f: impl Fn(A_) -> B_ + Copy,
            ) -> Over<Self, B_> {
                ($($G::convert(&g.$i, f),)+)
            }
            #[inline(always)]
            fn compose(&self, h: &Self) -> Self {
                ($(self.$i.compose(&h.$i),)+)
            }
            #[inline(always)]
            fn inverse(&self) -> Self {
                ($(self.$i.inverse(),)+)
            }
            #[inline(always)]
            fn exp(xi: &Self::Algebra) -> Self {
                ($($G::exp(&xi.$i),)+)
            }
            #[inline(always)]
            fn log(&self) -> Result<Self::Algebra, NotUnique<Self::Algebra>> {
                let mut logs = Logs { unique: true };
                let xi = ($(logs.take(self.$i.log()),)+);
                logs.finish(xi)
            }
            #[inline(always)]
            fn adjoint(&self, xi: &Self::Algebra) -> Self::Algebra {
                ($(self.$i.adjoint(&xi.$i),)+)
            }
            #[inline(always)]
            fn bracket(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
                ($($G::bracket(&xi.$i, &eta.$i),)+)
            }
            #[inline(always)]
            fn same_shape(&self, other: &Self) -> bool {
                $(self.$i.same_shape(&other.$i))&&+
            }
            fn units(&self, units: &mut Units) {
                $(self.$i.units(units);)+
            }
            #[inline(always)]
            fn coadjoint(&self, mu: &Self::Dual) -> Self::Dual {
                ($(self.$i.coadjoint(&mu.$i),)+)
            }
            #[inline(always)]
            fn coadjoint_bracket(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
                ($($G::coadjoint_bracket(&xi.$i, &mu.$i),)+)
            }
            #[inline(always)]
            fn d_left<R_: Retraction>(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
                ($($G::d_left::<R_>(&xi.$i, &eta.$i),)+)
            }
            #[inline(always)]
            fn d_left_inv<R_: Retraction>(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
                ($($G::d_left_inv::<R_>(&xi.$i, &eta.$i),)+)
            }
            #[inline(always)]
            fn cayley(xi: &Self::Algebra) -> Self {
                ($($G::cayley(&xi.$i),)+)
            }
            #[inline(always)]
            fn cayley_inverse(&self) -> Result<Self::Algebra, OutsideChart> {
                Ok(($(self.$i.cayley_inverse()?,)+))
            }
            #[inline(always)]
            fn d_left_dual<R_: Retraction>(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
                ($($G::d_left_dual::<R_>(&xi.$i, &mu.$i),)+)
            }
            #[inline(always)]
            fn d_left_inv_dual<R_: Retraction>(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
                ($($G::d_left_inv_dual::<R_>(&xi.$i, &mu.$i),)+)
            }
            #[inline(always)]
            fn d_left_inv_gradient<R_: Retraction>(xi: &Self::Algebra, mu: &Self::Dual, eta: &Self::Algebra) -> Self::Dual {
                ($($G::d_left_inv_gradient::<R_>(&xi.$i, &mu.$i, &eta.$i),)+)
            }
            #[inline(always)]
            fn sqrt(&self) -> Self {
                ($(self.$i.sqrt(),)+)
            }
            #[inline(always)]
            fn is_finite(&self) -> bool {
                $(self.$i.is_finite())&&+
            }
            #[inline(always)]
            fn normalize(&mut self) {
                $(self.$i.normalize();)+
            }
            #[inline(always)]
            fn compose_into(&self, h: &Self, out: &mut Self) {
                $(self.$i.compose_into(&h.$i, &mut out.$i);)+
            }
            #[inline(always)]
            fn coadjoint_into(&self, mu: &Self::Dual, out: &mut Self::Dual) {
                $(self.$i.coadjoint_into(&mu.$i, &mut out.$i);)+
            }
            #[inline(always)]
            fn inverse_into(&self, out: &mut Self) {
                $(self.$i.inverse_into(&mut out.$i);)+
            }
            #[inline(always)]
            fn inverse_coadjoint_into(&self, mu: &Self::Dual, out: &mut Self::Dual) {
                $(self.$i.inverse_coadjoint_into(&mu.$i, &mut out.$i);)+
            }
            #[inline(always)]
            fn zero_carry(&self) -> Self {
                ($(self.$i.zero_carry(),)+)
            }
            #[inline(always)]
            fn advance(&mut self, f: &Self, carry: &mut Self) {
                $(self.$i.advance(&f.$i, &mut carry.$i);)+
            }
            #[inline(always)]
            fn chart_enter_into<R_: Retraction>(
                c: &Self::Algebra,
                pi: &Self::Dual,
                (f, mu): (&mut Self, &mut Self::Dual),
            ) {
                $($G::chart_enter_into::<R_>(&c.$i, &pi.$i, (&mut f.$i, &mut mu.$i));)+
            }
            #[inline(always)]
            fn chart_leave_into<R_: Retraction>(
                c: &Self::Algebra,
                momentum: &Self::Dual,
                (f, mu, pi): (&mut Self, &mut Self::Dual, &mut Self::Dual),
            ) {
                $($G::chart_leave_into::<R_>(
                    &c.$i,
                    &momentum.$i,
                    (&mut f.$i, &mut mu.$i, &mut pi.$i),
                );)+
            }
            #[inline(always)]
            fn chart_rates_into<R_: Retraction>(
                (c, pi): (&Self::Algebra, &Self::Dual),
                (xi, tau): (&Self::Algebra, &Self::Dual),
                (c_dot, pi_dot): (&mut Self::Algebra, &mut Self::Dual),
            ) {
                $($G::chart_rates_into::<R_>(
                    (&c.$i, &pi.$i),
                    (&xi.$i, &tau.$i),
                    (&mut c_dot.$i, &mut pi_dot.$i),
                );)+
            }
            #[inline(always)]
            fn chart_velocity_into<R_: Retraction>(
                c: &Self::Algebra,
                xi: &Self::Algebra,
                c_dot: &mut Self::Algebra,
            ) {
                $($G::chart_velocity_into::<R_>(&c.$i, &xi.$i, &mut c_dot.$i);)+
            }
            #[inline(always)]
            fn retract_into<R_: Retraction>(xi: &Self::Algebra, out: &mut Self) {
                $($G::retract_into::<R_>(&xi.$i, &mut out.$i);)+
            }
            #[inline(always)]
            fn convert_into<A_: Scalar, B_: Scalar>(
                g: &Over<Self, A_>,
                f: impl Fn(A_) -> B_ + Copy,
                out: &mut Over<Self, B_>,
            ) {
                $($G::convert_into(&g.$i, f, &mut out.$i);)+
            }
        }
    };
}

tuple!(A.0, B.1);
tuple!(A.0, B.1, C.2);
tuple!(A.0, B.1, C.2, D.3);

/// Implements the vector space or group that acts factor by factor, for a container of equal factors.
///
/// `$map` builds a container from a function of the index, shaped like its first argument.
macro_rules! repeated {
    ($G:ident, [$($generics:tt)*], $container:ty, $algebra:ty, $dual:ty, [$T:ident] $with:ty, $map:expr) => {
        impl<$G: VectorSpace, $($generics)*> VectorSpace for $container {
            type Scalar = $G::Scalar;

            #[inline(always)]
            fn dim(&self) -> usize {
                self.iter().map(VectorSpace::dim).sum()
            }
            #[inline(always)]
            fn get(&self, i: usize) -> $G::Scalar {
                let n = self[0].dim();
                self[i / n].get(i % n)
            }
            #[inline(always)]
            fn set(&mut self, i: usize, value: $G::Scalar) {
                let n = self[0].dim();
                self[i / n].set(i % n, value);
            }
            #[inline(always)]
            fn write(&self, out: &mut [$G::Scalar]) {
                let mut rest = out;
                for x in self.iter() {
                    x.write(rest);
                    rest = &mut rest[x.dim()..];
                }
            }
            #[inline(always)]
            fn read(&mut self, from: &[$G::Scalar]) {
                let mut rest = from;
                for x in self.iter_mut() {
                    x.read(rest);
                    rest = &rest[x.dim()..];
                }
            }
            #[inline(always)]
            fn same_shape(&self, other: &Self) -> bool {
                self.len() == other.len() && self.iter().zip(other.iter()).all(|(a, b)| a.same_shape(b))
            }
            #[inline(always)]
            fn set_zero(&mut self) {
                self.iter_mut().for_each(VectorSpace::set_zero);
            }
            #[inline(always)]
            fn copy_from(&mut self, y: &Self) {
                self.iter_mut().zip(y.iter()).for_each(|(x, y)| x.copy_from(y));
            }
            #[inline(always)]
            fn scale(&mut self, a: $G::Scalar) {
                self.iter_mut().for_each(|x| x.scale(a));
            }
            #[inline(always)]
            fn add_scaled(&mut self, a: $G::Scalar, y: &Self) {
                self.iter_mut().zip(y.iter()).for_each(|(x, y)| x.add_scaled(a, y));
            }
            #[inline(always)]
            fn set_sum(&mut self, x: &Self, a: $G::Scalar, y: &Self) {
                for ((out, x), y) in self.iter_mut().zip(x.iter()).zip(y.iter()) {
                    out.set_sum(x, a, y);
                }
            }
            #[inline(always)]
            fn max_magnitude(&self) -> f64 {
                self.iter()
                    .map(VectorSpace::max_magnitude)
                    .fold(0.0, |a: f64, b| if a >= b || a.is_nan() { a } else { b })
            }
        }

        impl<$G: LieGroup, $($generics)*> LieGroup for $container {
            type Scalar = $G::Scalar;
            type Algebra = $algebra;
            type Dual = $dual;
            type WithScalar<$T: Scalar> = $with;

            #[inline(always)]
            fn zero_algebra(&self) -> Self::Algebra {
                $map(self.len(), |i: usize| self[i].zero_algebra())
            }
            #[inline(always)]
            fn zero_dual(&self) -> Self::Dual {
                $map(self.len(), |i: usize| self[i].zero_dual())
            }
            #[inline(always)]
            fn convert<A_: Scalar, B_: Scalar>(
                g: &Over<Self, A_>,
                f: impl Fn(A_) -> B_ + Copy,
            ) -> Over<Self, B_> {
                $map(g.len(), |i: usize| $G::convert(&g[i], f))
            }
            #[inline(always)]
            fn compose(&self, h: &Self) -> Self {
                $map(self.len(), |i: usize| self[i].compose(&h[i]))
            }
            #[inline(always)]
            fn inverse(&self) -> Self {
                $map(self.len(), |i: usize| self[i].inverse())
            }
            #[inline(always)]
            fn exp(xi: &Self::Algebra) -> Self {
                $map(xi.len(), |i: usize| $G::exp(&xi[i]))
            }
            #[inline(always)]
            fn log(&self) -> Result<Self::Algebra, NotUnique<Self::Algebra>> {
                let mut logs = Logs { unique: true };
                let xi = $map(self.len(), |i: usize| logs.take(self[i].log()));
                logs.finish(xi)
            }
            #[inline(always)]
            fn adjoint(&self, xi: &Self::Algebra) -> Self::Algebra {
                $map(self.len(), |i: usize| self[i].adjoint(&xi[i]))
            }
            #[inline(always)]
            fn bracket(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
                $map(xi.len(), |i: usize| $G::bracket(&xi[i], &eta[i]))
            }
            #[inline(always)]
            fn same_shape(&self, other: &Self) -> bool {
                self.len() == other.len() && self.iter().zip(other.iter()).all(|(a, b)| a.same_shape(b))
            }
            fn units(&self, units: &mut Units) {
                units.repeat(self.iter());
            }
            #[inline(always)]
            fn coadjoint(&self, mu: &Self::Dual) -> Self::Dual {
                $map(self.len(), |i: usize| self[i].coadjoint(&mu[i]))
            }
            #[inline(always)]
            fn coadjoint_bracket(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
                $map(xi.len(), |i: usize| $G::coadjoint_bracket(&xi[i], &mu[i]))
            }
            #[inline(always)]
            fn d_left<R_: Retraction>(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
                $map(xi.len(), |i: usize| $G::d_left::<R_>(&xi[i], &eta[i]))
            }
            #[inline(always)]
            fn d_left_inv<R_: Retraction>(xi: &Self::Algebra, eta: &Self::Algebra) -> Self::Algebra {
                $map(xi.len(), |i: usize| $G::d_left_inv::<R_>(&xi[i], &eta[i]))
            }
            #[inline(always)]
            fn cayley(xi: &Self::Algebra) -> Self {
                $map(xi.len(), |i: usize| $G::cayley(&xi[i]))
            }
            #[inline(always)]
            fn cayley_inverse(&self) -> Result<Self::Algebra, OutsideChart> {
                let mut inside = Ok(());
                let xi = $map(self.len(), |i: usize| {
                    self[i].cayley_inverse().unwrap_or_else(|e| {
                        inside = Err(e);
                        self[i].zero_algebra()
                    })
                });
                inside.map(|()| xi)
            }
            #[inline(always)]
            fn d_left_dual<R_: Retraction>(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
                $map(xi.len(), |i: usize| $G::d_left_dual::<R_>(&xi[i], &mu[i]))
            }
            #[inline(always)]
            fn d_left_inv_dual<R_: Retraction>(xi: &Self::Algebra, mu: &Self::Dual) -> Self::Dual {
                $map(xi.len(), |i: usize| $G::d_left_inv_dual::<R_>(&xi[i], &mu[i]))
            }
            #[inline(always)]
            fn d_left_inv_gradient<R_: Retraction>(xi: &Self::Algebra, mu: &Self::Dual, eta: &Self::Algebra) -> Self::Dual {
                $map(xi.len(), |i: usize| $G::d_left_inv_gradient::<R_>(&xi[i], &mu[i], &eta[i]))
            }
            #[inline(always)]
            fn sqrt(&self) -> Self {
                $map(self.len(), |i: usize| self[i].sqrt())
            }
            #[inline(always)]
            fn is_finite(&self) -> bool {
                self.iter().all(LieGroup::is_finite)
            }
            #[inline(always)]
            fn normalize(&mut self) {
                self.iter_mut().for_each(LieGroup::normalize);
            }
            #[inline(always)]
            fn compose_into(&self, h: &Self, out: &mut Self) {
                for ((g, h), out) in self.iter().zip(h.iter()).zip(out.iter_mut()) {
                    g.compose_into(h, out);
                }
            }
            #[inline(always)]
            fn coadjoint_into(&self, mu: &Self::Dual, out: &mut Self::Dual) {
                for ((g, mu), out) in self.iter().zip(mu.iter()).zip(out.iter_mut()) {
                    g.coadjoint_into(mu, out);
                }
            }
            #[inline(always)]
            fn inverse_into(&self, out: &mut Self) {
                self.iter().zip(out.iter_mut()).for_each(|(g, out)| g.inverse_into(out));
            }
            #[inline(always)]
            fn inverse_coadjoint_into(&self, mu: &Self::Dual, out: &mut Self::Dual) {
                for ((g, mu), out) in self.iter().zip(mu.iter()).zip(out.iter_mut()) {
                    g.inverse_coadjoint_into(mu, out);
                }
            }
            #[inline(always)]
            fn zero_carry(&self) -> Self {
                $map(self.len(), |i: usize| self[i].zero_carry())
            }
            #[inline(always)]
            fn advance(&mut self, f: &Self, carry: &mut Self) {
                for ((g, f), carry) in self.iter_mut().zip(f.iter()).zip(carry.iter_mut()) {
                    g.advance(f, carry);
                }
            }
            #[inline(always)]
            fn chart_enter_into<R_: Retraction>(
                c: &Self::Algebra,
                pi: &Self::Dual,
                (f, mu): (&mut Self, &mut Self::Dual),
            ) {
                for i in 0..c.len() {
                    $G::chart_enter_into::<R_>(&c[i], &pi[i], (&mut f[i], &mut mu[i]));
                }
            }
            #[inline(always)]
            fn chart_leave_into<R_: Retraction>(
                c: &Self::Algebra,
                momentum: &Self::Dual,
                (f, mu, pi): (&mut Self, &mut Self::Dual, &mut Self::Dual),
            ) {
                for i in 0..c.len() {
                    let out = (&mut f[i], &mut mu[i], &mut pi[i]);
                    $G::chart_leave_into::<R_>(&c[i], &momentum[i], out);
                }
            }
            #[inline(always)]
            fn chart_rates_into<R_: Retraction>(
                (c, pi): (&Self::Algebra, &Self::Dual),
                (xi, tau): (&Self::Algebra, &Self::Dual),
                (c_dot, pi_dot): (&mut Self::Algebra, &mut Self::Dual),
            ) {
                for i in 0..c.len() {
                    let out = (&mut c_dot[i], &mut pi_dot[i]);
                    $G::chart_rates_into::<R_>((&c[i], &pi[i]), (&xi[i], &tau[i]), out);
                }
            }
            #[inline(always)]
            fn chart_velocity_into<R_: Retraction>(
                c: &Self::Algebra,
                xi: &Self::Algebra,
                c_dot: &mut Self::Algebra,
            ) {
                for i in 0..c.len() {
                    $G::chart_velocity_into::<R_>(&c[i], &xi[i], &mut c_dot[i]);
                }
            }
            #[inline(always)]
            fn retract_into<R_: Retraction>(xi: &Self::Algebra, out: &mut Self) {
                xi.iter().zip(out.iter_mut()).for_each(|(xi, out)| $G::retract_into::<R_>(xi, out));
            }
            #[inline(always)]
            fn convert_into<A_: Scalar, B_: Scalar>(
                g: &Over<Self, A_>,
                f: impl Fn(A_) -> B_ + Copy,
                out: &mut Over<Self, B_>,
            ) {
                g.iter().zip(out.iter_mut()).for_each(|(g, out)| $G::convert_into(g, f, out));
            }
        }
    };
}

repeated!(
    G, [const N: usize], [G; N], [G::Algebra; N], [G::Dual; N], [T] [G::WithScalar<T>; N],
    |_, f| from_fn(f)
);

repeated!(
    G, [], Power<G>, Power<G::Algebra>, Power<G::Dual>, [T] Power<G::WithScalar<T>>,
    |n, f| Power((0..n).map(f).collect())
);
