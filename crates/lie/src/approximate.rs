//! `approx`'s traits, entry by entry.

use approx::{AbsDiffEq, RelativeEq, UlpsEq};

use crate::{Cotangent, Mat3, Power, Rn, SE2, SE3, SO2, SO3, Tangent, Vec3};

/// Implements the traits for a type by its entries, each comparable.
macro_rules! by_entries {
    ([$($generics:tt)*], $type:ty, |$x:ident| $entries:expr) => {
        impl<S, $($generics)*> $type {
            fn entries(&self) -> impl Iterator<Item = &S> {
                let $x = self;
                $entries
            }
        }

        impl<S: AbsDiffEq<Epsilon: Copy>, $($generics)*> AbsDiffEq for $type {
            type Epsilon = S::Epsilon;
            fn default_epsilon() -> S::Epsilon {
                S::default_epsilon()
            }
            fn abs_diff_eq(&self, other: &Self, epsilon: S::Epsilon) -> bool {
                same(self.entries(), other.entries(), |a: &S, b| a.abs_diff_eq(b, epsilon))
            }
        }

        impl<S: RelativeEq<Epsilon: Copy>, $($generics)*> RelativeEq for $type {
            fn default_max_relative() -> S::Epsilon {
                S::default_max_relative()
            }
            fn relative_eq(&self, other: &Self, epsilon: S::Epsilon, max: S::Epsilon) -> bool {
                same(self.entries(), other.entries(), |a: &S, b| a.relative_eq(b, epsilon, max))
            }
        }

        impl<S: UlpsEq<Epsilon: Copy>, $($generics)*> UlpsEq for $type {
            fn default_max_ulps() -> u32 {
                S::default_max_ulps()
            }
            fn ulps_eq(&self, other: &Self, epsilon: S::Epsilon, max: u32) -> bool {
                same(self.entries(), other.entries(), |a: &S, b| a.ulps_eq(b, epsilon, max))
            }
        }
    };
}

by_entries!([], Vec3<S>, |x| x.0.iter());
by_entries!([], Mat3<S>, |m| m.0.as_flattened().iter());
by_entries!([], SO3<S>, |r| r.matrix().entries());
by_entries!([], SE3<S>, |g| g
    .rotation
    .entries()
    .chain(g.translation.entries()));
by_entries!([], SO2<S>, |r| r.parts().into_iter());
by_entries!([], SE2<S>, |g| g.rotation.entries().chain(&g.translation));
by_entries!([const N: usize], Rn<N, S>, |x| x.0.iter());
by_entries!([const N: usize], Tangent<N, S>, |xi| xi.0.iter());
by_entries!([const N: usize], Cotangent<N, S>, |mu| mu.0.iter());
by_entries!([], Power<S>, |g| g.0.iter());

fn same<'a, T: 'a>(
    mut a: impl Iterator<Item = &'a T>,
    mut b: impl Iterator<Item = &'a T>,
    equal: impl Fn(&T, &T) -> bool,
) -> bool {
    loop {
        match (a.next(), b.next()) {
            (None, None) => return true,
            (Some(a), Some(b)) if equal(a, b) => {}
            _ => return false,
        }
    }
}
