//! Discrete Lagrangians from continuous ones, by quadrature.

use lie::{AlgebraOver, LieGroup, Over, RealGroup, Retraction, Scalar, VectorSpace};

use super::context::{Adapter, Context, System};
use super::discrete::DiscreteLagrangian;
use super::lagrangian::{Discretised, Lagrangian, is_defined};
use super::quadrature::Place;

/// $\tau^{-1}(f)/h$; not a number outside the chart.
#[inline(always)]
pub(super) fn mean_velocity<R: Retraction, G: RealGroup, S: Scalar>(
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

impl<L: System, R> Adapter for Discretised<L, R> {
    type Inner = L;

    fn inner(&self) -> &L {
        &self.system
    }
}

impl<L: Lagrangian, R: Retraction> DiscreteLagrangian for Discretised<L, R> {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
    ) -> S {
        let xi = mean_velocity::<R, L::Group, S>(f, h);
        let value = |place| match place {
            Place::Start => self.system.value(at, g, &xi),
            Place::Middle => {
                let middle = at.at(at.t + h * S::from_f64(0.5));
                self.system.value(middle, &g.compose(&f.sqrt()), &xi)
            }
            Place::End => self.system.value(at.at(at.t + h), &g.compose(f), &xi),
        };
        let nodes = self.rule.nodes().iter();
        let terms = nodes.map(|&(weight, place)| value(place) * S::from_f64(weight));
        terms.fold(S::zero(), |sum, term| sum + term) * h
    }

    fn is_defined(&self, t: f64, g: &L::Group) -> bool {
        is_defined(&self.system, t, g)
    }

    fn order(&self) -> u32 {
        self.rule.order()
    }

    fn is_symmetric(&self) -> bool {
        self.rule.is_symmetric()
    }
}
