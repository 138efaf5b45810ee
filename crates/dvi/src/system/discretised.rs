//! Discrete Lagrangians from continuous ones, by quadrature.

use lie::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, Retraction, Scalar, VectorSpace};

use super::context::{Adapter, Context, System};
use super::discrete::{Derivatives, DiscreteLagrangian};
use super::lagrangian::{Discretised, Lagrangian, is_defined};
use super::lifted::Arguments;
use super::quadrature::Place;
use super::state::Still;

/// Storage of a [`Discretised`] Lagrangian or force, made when first needed.
pub struct DiscretisedWorkspace<G: RealGroup, S: Scalar>(Option<Between<G, S>>);

impl<G: RealGroup, S: Scalar> Default for DiscretisedWorkspace<G, S> {
    fn default() -> Self {
        Self(None)
    }
}

impl<G: RealGroup, S: Scalar> DiscretisedWorkspace<G, S> {
    #[inline(always)]
    pub(super) fn for_shape_of(&mut self, g: &Over<G, S>) -> &mut Between<G, S> {
        self.0.get_or_insert_with(|| Between::new(g))
    }
}

/// What a rule sees along a step.
pub(super) struct Between<G: RealGroup, S: Scalar> {
    /// $\tau^{-1}(f)/h$; not a number outside the chart.
    pub(super) xi: AlgebraOver<G, S>,
    /// $f^{1/2}$, where the rule looks there.
    pub(super) root: Over<G, S>,
    /// Where the rule looks.
    pub(super) place: Over<G, S>,
    /// A force, there and moved to an end of the step.
    pub(super) force: [DualOver<G, S>; 2],
}

impl<G: RealGroup, S: Scalar> Between<G, S> {
    #[inline(always)]
    fn new(g: &Over<G, S>) -> Self {
        Self {
            xi: g.zero_algebra(),
            root: g.clone(),
            place: g.clone(),
            force: [g.zero_dual(), g.zero_dual()],
        }
    }

    #[inline(always)]
    pub(super) fn set_velocity<R: Retraction>(&mut self, f: &Over<G, S>, h: S) {
        let inside = f.retract_inverse_into::<R>(&mut self.xi).is_ok();
        let scale = if inside { h } else { S::from_f64(f64::NAN) };
        for i in 0..self.xi.dim() {
            self.xi.set(i, self.xi.get(i) / scale);
        }
    }

    /// Goes to a place of the step of size `h` by `f` from `g`; the time there.
    #[inline(always)]
    pub(super) fn go<'a>(
        &mut self,
        place: Place,
        at: Context<'a, S>,
        (g, f): (&Over<G, S>, &Over<G, S>),
        h: S,
    ) -> Context<'a, S> {
        let same = |x: S| x;
        match place {
            Place::Start => {
                G::convert_into::<S, S>(g, same, &mut self.place);
                at
            }
            Place::Middle => {
                f.sqrt_into(&mut self.root);
                g.compose_into(&self.root, &mut self.place);
                at.at(at.t + h * S::from_f64(0.5))
            }
            Place::End => {
                g.compose_into(f, &mut self.place);
                at.at(at.t + h)
            }
        }
    }
}

impl<L: System, R> Adapter for Discretised<L, R> {
    type Inner = L;

    fn inner(&self) -> &L {
        &self.system
    }
}

impl<L: Lagrangian, R: Retraction> Discretised<L, R> {
    #[inline(always)]
    fn value_between<S: Scalar>(
        &self,
        (at, (g, f), h): Arguments<'_, L::Group, S>,
        between: &mut Between<L::Group, S>,
    ) -> S {
        between.set_velocity::<R>(f, h);
        let nodes = self.rule.nodes().iter();
        let terms = nodes.map(|&(weight, place)| {
            let at = between.go(place, at, (g, f), h);
            self.system.value(at, &between.place, &between.xi) * S::from_f64(weight)
        });
        terms.fold(S::zero(), |sum, term| sum + term) * h
    }
}

impl<L: Lagrangian, R: Retraction> DiscreteLagrangian for Discretised<L, R> {
    type Workspace<S: Scalar> = DiscretisedWorkspace<L::Group, S::Jet>;

    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
    ) -> S {
        self.value_between((at, (g, f), h), &mut Between::new(g))
    }

    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
        work: &mut Self::Workspace<S>,
        out: &mut Derivatives<L::Group, S>,
    ) {
        if out.by_recording(self, (at, (g, f), h)) {
            return;
        }
        out.by_jets_of((at, (g, f), h), |arguments| {
            let (_, (g, _), _) = arguments;
            self.value_between(arguments, work.for_shape_of(g))
        });
    }

    fn is_defined(&self, t: f64, g: &L::Group, still: &Still<L::Group>) -> bool {
        is_defined(&self.system, t, g, still)
    }

    fn order(&self) -> u32 {
        self.rule.order()
    }

    fn is_symmetric(&self) -> bool {
        self.rule.is_symmetric()
    }
}
