//! The discrete Lagrangian by its value alone.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{Context, DiscreteLagrangian, Still, System};
use lgvi::{articulated_fluid, dvi, lie};
use lie::Scalar;

/// (22) without its derivatives (29)–(33).
pub struct ValueOnly(pub ArticulatedBody);

impl System for ValueOnly {
    type Group = Configuration;
}

impl DiscreteLagrangian for ValueOnly {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Configuration<S>,
        f: &Configuration<S>,
        h: S,
    ) -> S {
        DiscreteLagrangian::value(&self.0, at, g, f, h)
    }

    fn is_defined(&self, _: f64, _: &Configuration, _: &Still<Configuration>) -> bool {
        true
    }
}
