//! Dual copies of the arguments of a Lagrangian, moved along the basis of the algebra in chunks.

use lie::{AlgebraOver, Cayley, Jet, LieGroup, Over, RealGroup, Scalar};
use num_traits::Zero;

use super::context::Context;
use crate::numerics::duals::lift;

/// An element of `G` over the duals of `S`.
type Moved<G, S> = Over<G, <S as Scalar>::Jet>;

/// The arguments of a discrete Lagrangian: time and parameters, $g$ and $f$, and $h$.
pub(crate) type Arguments<'a, G, S> = (Context<'a, S>, (&'a Over<G, S>, &'a Over<G, S>), S);

/// $g$ and $f$ over the duals of `S`, with room for the moved one.
pub(crate) struct Lifted<G: RealGroup, S: Scalar> {
    t: S::Jet,
    h: S::Jet,
    parameters: Vec<S::Jet>,
    g: Moved<G, S>,
    f: Moved<G, S>,
    zeta: AlgebraOver<G, S::Jet>,
    small: Moved<G, S>,
    moved: Moved<G, S>,
}

impl<G: RealGroup, S: Scalar> Lifted<G, S> {
    pub(crate) fn new(g: &Over<G, S>) -> Self {
        let g = G::convert::<S, S::Jet>(g, Jet::constant);
        let zeta = g.zero_algebra();
        Self {
            t: S::Jet::zero(),
            h: S::Jet::zero(),
            parameters: Vec::new(),
            f: g.clone(),
            small: g.clone(),
            moved: g.clone(),
            g,
            zeta,
        }
    }

    pub(crate) fn g(&self) -> &Moved<G, S> {
        &self.g
    }

    pub(crate) fn zero_algebra(&self) -> AlgebraOver<G, S::Jet> {
        self.g.zero_algebra()
    }

    pub(crate) fn set(&mut self, (at, (g, f), h): Arguments<'_, G, S>) {
        self.set_g(at, g);
        self.h = Jet::constant(h);
        G::convert_into::<S, S::Jet>(f, Jet::constant, &mut self.f);
    }

    pub(crate) fn set_g(&mut self, at: Context<S>, g: &Over<G, S>) {
        self.t = Jet::constant(at.t);
        lift(at.all, Jet::constant, &mut self.parameters);
        G::convert_into::<S, S::Jet>(g, Jet::constant, &mut self.g);
    }

    /// The time and the parameters.
    pub(crate) fn context(&self) -> Context<'_, S::Jet> {
        Context::new(self.t, &self.parameters)
    }

    /// $(g, f \exp\zeta)$ with the directions from `first` on; to first order, any retraction is the exponential.
    pub(crate) fn moving_f(&mut self, first: usize) -> Arguments<'_, G, S::Jet> {
        self.step_along(first);
        self.f.compose_into(&self.small, &mut self.moved);
        (self.context(), (&self.g, &self.moved), self.h)
    }

    /// $(g \exp\eta, f)$, likewise.
    pub(crate) fn moving_g(&mut self, first: usize) -> Arguments<'_, G, S::Jet> {
        self.step_along(first);
        self.g.compose_into(&self.small, &mut self.moved);
        (self.context(), (&self.moved, &self.f), self.h)
    }

    fn step_along(&mut self, first: usize) {
        lie::seed(&mut self.zeta, first);
        Over::<G, S::Jet>::retract_into::<Cayley>(&self.zeta, &mut self.small);
    }
}
