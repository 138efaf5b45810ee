//! The choice of a map from the algebra to the group: the exponential or the Cayley map.

use core::fmt::Debug;

/// A retraction $\tau: \mathfrak g \to G$: $\tau(0) = e$, $\mathrm d\tau_0 = 1$, $\tau(-\xi) = \tau(\xi)^{-1}$.
///
/// [`Exp`] and [`Cayley`] are the two. Integrators take either as a type parameter, and so do the methods of
/// [`LieGroup`](crate::LieGroup), from [`retract`](crate::LieGroup::retract) to its differentials.
pub trait Retraction: Copy + Debug + Default + 'static {
    /// Which of the two it is. The compiler knows it, so a `match` on it costs nothing.
    const CHART: Chart;

    /// The name to print.
    const NAME: &'static str;
}

/// The two retractions, to tell apart in a group's closed forms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chart {
    /// The exponential's.
    Exp,
    /// The Cayley map's.
    Cayley,
}

/// The exponential map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exp;

impl Retraction for Exp {
    const CHART: Chart = Chart::Exp;
    const NAME: &'static str = "exp";
}

/// The Cayley map: no trigonometry, no branch; the exponential on groups that have none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cayley;

impl Retraction for Cayley {
    const CHART: Chart = Chart::Cayley;
    const NAME: &'static str = "cayley";
}
