//! A discrete Lagrangian without its inertia.

use core::ops::Range;

use dvi::{Context, Derivatives, DiscreteLagrangian, Still, System};
use lie::{Over, Scalar};

/// The same discrete Lagrangian without the model's inertia: its steps are solved with Newton's matrix from dual numbers.
#[derive(Clone, Debug)]
pub struct ByDuals<L>(pub L);

impl<L: System> System for ByDuals<L> {
    type Group = L::Group;

    fn parameters(&self) -> &[f64] {
        self.0.parameters()
    }
    fn cyclic(&self) -> Range<usize> {
        self.0.cyclic()
    }
    fn fits(&self, g: &L::Group) -> bool {
        self.0.fits(g)
    }
    fn is_driven(&self) -> bool {
        self.0.is_driven()
    }
    fn is_symplectic(&self) -> bool {
        self.0.is_symplectic()
    }
}

impl<L: DiscreteLagrangian> DiscreteLagrangian for ByDuals<L> {
    type Workspace<S: Scalar> = L::Workspace<S>;

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
        work: &mut L::Workspace<S>,
        out: &mut Derivatives<L::Group, S>,
    ) {
        self.0.derivatives(at, g, f, h, work, out);
    }
    fn is_defined(&self, t: f64, g: &L::Group, still: &Still<L::Group>) -> bool {
        self.0.is_defined(t, g, still)
    }
    fn order(&self) -> u32 {
        self.0.order()
    }
    fn is_symmetric(&self) -> bool {
        self.0.is_symmetric()
    }
}
