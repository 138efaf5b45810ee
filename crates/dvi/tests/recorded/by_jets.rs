//! Derivatives by dual numbers, whatever could be recorded.

use dvi::{Context, Derivatives, DiscreteLagrangian, System};
use lie::{Over, Scalar};

/// A discrete Lagrangian by dual numbers whatever can be recorded.
#[derive(Clone, Copy)]
pub struct ByJets<L>(pub L);

impl<L: DiscreteLagrangian> System for ByJets<L> {
    type Group = L::Group;
    fn parameters(&self) -> &[f64] {
        self.0.parameters()
    }
}

impl<L: DiscreteLagrangian> DiscreteLagrangian for ByJets<L> {
    type Workspace<S: Scalar> = ();
    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
    ) -> S {
        self.0.value(at, g, f, h)
    }
    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
        (): &mut (),
        out: &mut Derivatives<L::Group, S>,
    ) {
        out.by_jets(&self.0, at, g, f, h);
    }
}
