//! Maps from the algebra to the group: the exponential and the Cayley map.

use core::fmt::Debug;

use crate::{LieGroup, OutsideChart, VectorSpace};

/// A retraction $\tau: \mathfrak g \to G$: $\tau(0) = e$, $\mathrm d\tau_0 = 1$, $\tau(-\xi) = \tau(\xi)^{-1}$.
///
/// [`Exp`] and [`Cayley`] are the two; integrators take either as a type parameter.
///
/// ```
/// use lie::{Cayley, Exp, Retraction, SO3, Tangent};
///
/// let xi = Tangent([1e-3, 2e-3, -1e-3]);
/// let (a, b): (SO3, SO3) = (Exp::retract(&xi), Cayley::retract(&xi));
/// assert!((*a.matrix() - *b.matrix()).frobenius() < 1e-8);
/// ```
pub trait Retraction: Copy + Debug + Default + 'static {
    /// The name to print.
    const NAME: &'static str;

    /// $\tau(\xi)$.
    fn retract<G: LieGroup>(xi: &G::Algebra) -> G;

    /// $\tau(\xi)$ into `out`.
    fn retract_into<G: LieGroup>(xi: &G::Algebra, out: &mut G);

    /// $\tau^{-1}(g)$.
    ///
    /// # Errors
    /// [`OutsideChart`] where the inverse does not exist or is not unique.
    fn inverse<G: LieGroup>(g: &G) -> Result<G::Algebra, OutsideChart>;

    /// The left-trivialised differential: $\tau(\xi)^{-1} \frac{d}{ds}\vert_{s=0} \tau(\xi + s \eta)$.
    fn d_left<G: LieGroup>(xi: &G::Algebra, eta: &G::Algebra) -> G::Algebra;

    /// The inverse of [`d_left`](Self::d_left) in `eta`.
    fn d_left_inv<G: LieGroup>(xi: &G::Algebra, eta: &G::Algebra) -> G::Algebra;

    /// The transpose of [`d_left`](Self::d_left): the $\nu$ with
    /// $\langle \nu, \eta\rangle = \langle \mu, \mathrm d\tau_\xi \eta\rangle$.
    fn d_left_dual<G: LieGroup>(xi: &G::Algebra, mu: &G::Dual) -> G::Dual;

    /// The transpose of [`d_left_inv`](Self::d_left_inv).
    fn d_left_inv_dual<G: LieGroup>(xi: &G::Algebra, mu: &G::Dual) -> G::Dual;

    /// The gradient in $\xi$ of $\langle \mu, \mathrm d\tau_\xi^{-1} \eta\rangle$, with $\mu$ and $\eta$ fixed.
    ///
    /// ```
    /// use lie::{Cayley, Cotangent, Retraction, SO3, Tangent};
    ///
    /// // At zero, the map is 1 + ad/2 to first order.
    /// let (xi, mu, eta) = (Tangent([0.0; 3]), Cotangent([1.0, 0.0, 0.0]), Tangent([0.0, 1.0, 0.0]));
    /// let gradient = Cayley::d_left_inv_gradient::<SO3>(&xi, &mu, &eta);
    /// assert_eq!(gradient, Cotangent([0.0, 0.0, -0.5]));
    /// ```
    fn d_left_inv_gradient<G: LieGroup>(xi: &G::Algebra, mu: &G::Dual, eta: &G::Algebra)
    -> G::Dual;

    /// The right-trivialised differential: $\frac{d}{ds}\vert_{s=0} \tau(\xi + s \eta) \tau(\xi)^{-1}$, which is
    /// the left-trivialised one at $-\xi$.
    fn d_right<G: LieGroup>(xi: &G::Algebra, eta: &G::Algebra) -> G::Algebra {
        Self::d_left::<G>(&negated(xi), eta)
    }

    /// The inverse of [`d_right`](Self::d_right) in `eta`.
    fn d_right_inv<G: LieGroup>(xi: &G::Algebra, eta: &G::Algebra) -> G::Algebra {
        Self::d_left_inv::<G>(&negated(xi), eta)
    }
}

fn negated<V: VectorSpace>(xi: &V) -> V {
    let mut minus = xi.clone();
    for i in 0..xi.dim() {
        minus.set(i, -xi.get(i));
    }
    minus
}

/// The exponential map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exp;

/// The Cayley map: no trigonometry, no branch; the exponential on groups that have none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cayley;

macro_rules! retraction {
    ($name:ident, $label:literal, $map:ident, $into:ident, $d:ident, $d_inv:ident,
     $d_dual:ident, $d_inv_dual:ident, $d_inv_gradient:ident, $inverse:expr) => {
        impl Retraction for $name {
            const NAME: &'static str = $label;
            #[inline(always)]
            fn retract<G: LieGroup>(xi: &G::Algebra) -> G {
                G::$map(xi)
            }
            #[inline(always)]
            fn retract_into<G: LieGroup>(xi: &G::Algebra, out: &mut G) {
                G::$into(xi, out);
            }
            #[inline(always)]
            fn inverse<G: LieGroup>(g: &G) -> Result<G::Algebra, OutsideChart> {
                $inverse(g)
            }
            #[inline(always)]
            fn d_left<G: LieGroup>(xi: &G::Algebra, eta: &G::Algebra) -> G::Algebra {
                G::$d(xi, eta)
            }
            #[inline(always)]
            fn d_left_inv<G: LieGroup>(xi: &G::Algebra, eta: &G::Algebra) -> G::Algebra {
                G::$d_inv(xi, eta)
            }
            #[inline(always)]
            fn d_left_dual<G: LieGroup>(xi: &G::Algebra, mu: &G::Dual) -> G::Dual {
                G::$d_dual(xi, mu)
            }
            #[inline(always)]
            fn d_left_inv_dual<G: LieGroup>(xi: &G::Algebra, mu: &G::Dual) -> G::Dual {
                G::$d_inv_dual(xi, mu)
            }
            #[inline(always)]
            fn d_left_inv_gradient<G: LieGroup>(
                xi: &G::Algebra,
                mu: &G::Dual,
                eta: &G::Algebra,
            ) -> G::Dual {
                G::$d_inv_gradient(xi, mu, eta)
            }
        }
    };
}

retraction!(
    Exp,
    "exp",
    exp,
    exp_into,
    dexp,
    dexp_inv,
    dexp_dual,
    dexp_inv_dual,
    dexp_inv_gradient,
    |g: &G| g.log().map_err(|_| OutsideChart)
);
retraction!(
    Cayley,
    "cayley",
    cayley,
    cayley_into,
    dcay,
    dcay_inv,
    dcay_dual,
    dcay_inv_dual,
    dcay_inv_gradient,
    G::cayley_inverse
);
