//! Discrete Lagrangians and discrete forces from continuous ones, by quadrature.

use core::fmt::Debug;
use core::marker::PhantomData;
use core::ops::Range;

use lie::{AlgebraOver, Cayley, LieGroup, Over, RealGroup, Retraction, Scalar, VectorSpace};

use crate::{DiscreteLagrangian, Force, Forced, Lagrangian, lagrangian};

/// Where along a step from $g$ to $g f$ a rule looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// $g$, at $t$.
    Start,
    /// $g f^{1/2}$, at $t + h/2$: on the group, the same from both ends.
    Middle,
    /// $g f$, at $t + h$.
    End,
}

/// A quadrature rule over one step, $\int_0^h \varphi \approx h \sum_i b_i \varphi_i$.
pub trait Quadrature: Copy + Debug + Default + 'static {
    /// The name to print.
    const NAME: &'static str;
    /// Weights $b_i$ and places; the weights sum to one.
    const NODES: &'static [(f64, Place)];
    /// The order of the variational integrator.
    const ORDER: u32;
    /// Whether the rule is the same read backwards.
    const SYMMETRIC: bool;
}

macro_rules! rule {
    ($(#[$doc:meta])* $name:ident, $label:literal, $order:literal, $symmetric:literal, $nodes:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;

        impl Quadrature for $name {
            const NAME: &'static str = $label;
            const NODES: &'static [(f64, Place)] = &$nodes;
            const ORDER: u32 = $order;
            const SYMMETRIC: bool = $symmetric;
        }
    };
}

rule! {
    /// $\varphi$ at the start of the step: order 1, the rule of (22).
    LeftPoint, "left", 1, false, [(1.0, Place::Start)]
}
rule! {
    /// $\varphi$ at the end of the step: order 1, the adjoint of [`LeftPoint`].
    RightPoint, "right", 1, false, [(1.0, Place::End)]
}
rule! {
    /// $\varphi$ in the middle of the step: order 2, symmetric.
    Midpoint, "midpoint", 2, true, [(1.0, Place::Middle)]
}
rule! {
    /// The mean of $\varphi$ at both ends of the step: order 2, symmetric.
    Trapezoid, "trapezoidal", 2, true, [(0.5, Place::Start), (0.5, Place::End)]
}

/// A continuous Lagrangian or force made discrete by the rule `Q`, with one velocity for the whole step by the retraction `R`.
///
/// With $\xi = \tau^{-1}(f)/h$, $L_d(t, g, f) = h \sum_i b_i L(t + c_i h, g f^{c_i}, \xi)$. Where $f$ is outside the
/// retraction's chart, a turn by $\pi$, the value is not a number and the step is refused.
///
/// Made by [`Lagrangian::discretise`]; on groups of run-time size its value allocates.
///
/// ```
/// use dvi::{DiscreteLagrangian, Discretised, Lagrangian, Trapezoid};
/// use lie::{Exp, LieGroup, Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg on a spring of 4 N/m.
/// struct Spring;
///
/// impl Lagrangian for Spring {
///     type Group = Rn<1>;
///     fn value<S: Scalar>(&self, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         (v[0] * v[0] - x.0[0] * x.0[0] * S::from_f64(4.0)) * S::from_f64(0.5)
///     }
/// }
///
/// let discrete = Spring.discretise::<Trapezoid>().with_retraction::<Exp>();
/// assert_eq!(discrete.value(&Rn([1.0]), &Rn([0.5]), 0.5), 0.5 * (0.5 - 2.0 * (1.0 + 2.25) / 2.0));
/// assert_eq!((discrete.order(), discrete.is_symmetric()), (2, true));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Discretised<L, Q, R = Cayley> {
    pub(crate) system: L,
    rule: PhantomData<(Q, R)>,
}

impl<L, Q: Quadrature> Discretised<L, Q> {
    /// The system by the rule `Q`, through the Cayley map.
    pub fn new(system: L) -> Self {
        Self {
            system,
            rule: PhantomData,
        }
    }
}

impl<L, Q: Quadrature, R: Retraction> Discretised<L, Q, R> {
    /// The same rule through another retraction: another method of the same order.
    pub fn with_retraction<P: Retraction>(self) -> Discretised<L, Q, P> {
        Discretised {
            system: self.system,
            rule: PhantomData,
        }
    }

    /// The system with a force, by the same rule: discrete Lagrange–d'Alembert.
    pub fn with_force<F: Force>(self, force: F) -> Forced<Self, Discretised<F, Q, R>> {
        let force = Discretised {
            system: force,
            rule: PhantomData,
        };
        Forced::new(self, force)
    }

    /// The continuous system.
    pub fn system(&self) -> &L {
        &self.system
    }
}

/// $\tau^{-1}(f)/h$; not a number outside the chart.
#[inline(always)]
pub(crate) fn mean_velocity<R: Retraction, G: RealGroup, S: Scalar>(
    f: &Over<G, S>,
    h: S,
) -> AlgebraOver<G, S> {
    let (mut c, inside) = match f.retract_inverse::<R>() {
        Ok(c) => (c, true),
        Err(_) => (f.zero_algebra(), false),
    };
    let scale = if inside { h } else { S::from_f64(f64::NAN) };
    for i in 0..c.dim() {
        c.set(i, c.get(i) / scale);
    }
    c
}

/// The configuration and the time at a place along the step.
#[inline(always)]
pub(crate) fn at<G: RealGroup, S: Scalar>(
    place: Place,
    (t, h): (S, S),
    (g, f): (&Over<G, S>, &Over<G, S>),
) -> (S, Over<G, S>) {
    match place {
        Place::Start => (t, g.clone()),
        Place::Middle => (t + h * S::from_f64(0.5), g.compose(&f.sqrt())),
        Place::End => (t + h, g.compose(f)),
    }
}

impl<L: Lagrangian, Q: Quadrature, R: Retraction> DiscreteLagrangian for Discretised<L, Q, R> {
    type Group = L::Group;

    fn value<S: Scalar>(&self, g: &Over<L::Group, S>, f: &Over<L::Group, S>, h: S) -> S {
        self.value_at(S::zero(), g, f, h)
    }

    fn value_at<S: Scalar>(&self, t: S, g: &Over<L::Group, S>, f: &Over<L::Group, S>, h: S) -> S {
        let xi = mean_velocity::<R, L::Group, S>(f, h);
        let terms = Q::NODES.iter().map(|&(weight, place)| {
            let (t, g) = at::<L::Group, S>(place, (t, h), (g, f));
            self.system.value_at(t, &g, &xi) * S::from_f64(weight)
        });
        terms.fold(S::zero(), |sum, term| sum + term) * h
    }

    fn cyclic(&self) -> Range<usize> {
        self.system.cyclic()
    }

    fn fits(&self, g: &L::Group) -> bool {
        self.system.fits(g)
    }

    fn is_defined(&self, t: f64, g: &L::Group) -> bool {
        lagrangian::is_defined(&self.system, t, g)
    }

    fn order(&self) -> u32 {
        Q::ORDER
    }

    fn is_symmetric(&self) -> bool {
        Q::SYMMETRIC
    }
}
