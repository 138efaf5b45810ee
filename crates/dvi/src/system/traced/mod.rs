//! Hamilton's equations of a Lagrangian that was recorded once.

mod cache;
mod compile;
mod discrete;
mod error;
mod inertia;
mod part;
mod recording;
mod storage;
mod system;
mod translation;

use lie::{LieGroup, RealGroup, Scalar, VectorSpace};
use trace::record;

pub(crate) use self::cache::Cache;
pub(crate) use self::compile::Programs;
use self::compile::{Layout, compile};
pub(crate) use self::discrete::{DiscreteCache, DiscreteProgram, DiscreteRecording};
pub use self::error::TracedError;
pub(crate) use self::part::Home;
pub use self::recording::Recording;
pub use self::storage::TracedWorkspace;
pub use self::system::TracedSystem;
use self::translation::Translations;
use super::context::Context;
use super::continuous::ContinuousSystem;
use super::dual_system::DualSystem;
use super::lagrangian::Lagrangian;
use crate::numerics::elements;

impl Programs {
    /// Those of a Lagrangian, for configurations of the shape of `g`.
    pub(crate) fn of<L: Lagrangian>(lagrangian: &L, g: &L::Group) -> Result<Self, TracedError> {
        let layout = Layout::of(lagrangian.parameters().len(), g);
        let recorded = record(layout.len(), |x| {
            let g = elements::with_numbers(g, &x[layout.numbers()]);
            let mut xi = g.zero_algebra();
            xi.read(&x[layout.velocity()]);
            let at = Context::new(x[0], &x[layout.parameters()]);
            vec![lagrangian.value(at, &g, &xi)]
        })?;
        compile(recorded, layout, &Translations::new(g)?)
    }

    /// Velocity and force of a state, one after the other.
    pub(crate) fn rates<G: RealGroup>(
        &self,
        at: Context<f64>,
        g: &G,
        mu: &G::Dual,
    ) -> Option<Vec<f64>> {
        storage::once(&self.rates, at, g, mu)
    }

    /// The energy of a state.
    pub(crate) fn energy<G: RealGroup>(
        &self,
        at: Context<f64>,
        g: &G,
        mu: &G::Dual,
    ) -> Option<f64> {
        storage::once(&self.energy, at, g, mu).map(|out| out[0])
    }

    /// The first pivot of the inertia that is not clearly positive, with its coordinate.
    pub(crate) fn pivot<G: RealGroup>(&self, at: Context<f64>, g: &G) -> Option<(usize, Pivot)> {
        /// Roundings that elimination may leave in place of a zero, for each coordinate.
        const ROUNDINGS: f64 = 8.0;
        let out = storage::once(&self.inertia, at, g, &g.zero_dual())?;
        let (pivots, diagonal) = out.split_at(out.len() / 2);
        let rounding = ROUNDINGS * f64::EPSILON * pivots.len() as f64;
        let mut all = pivots.iter().zip(diagonal).enumerate();
        all.find_map(|(k, (pivot, entry))| {
            let size = rounding * entry.abs();
            match *pivot {
                pivot if pivot > size => None,
                pivot if pivot < -size => Some((k, Pivot::Negative)),
                pivot if pivot.is_nan() => Some((k, Pivot::Unknown)),
                _ => Some((k, Pivot::Zero)),
            }
        })
    }
}

/// A pivot of an inertia that is not positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pivot {
    /// There is no inertia.
    Zero,
    /// The inertia is indefinite.
    Negative,
    /// The inertia is not a number.
    Unknown,
}

/// A coordinate without inertia, by what is recorded; by dual numbers where pivots do not tell.
pub(crate) fn without_inertia<L: Lagrangian>(
    lagrangian: &L,
    programs: &Programs,
    (t, g): (f64, &L::Group),
) -> Option<usize> {
    match programs.pivot(Context::new(t, lagrangian.parameters()), g)? {
        (coordinate, Pivot::Zero) => Some(coordinate),
        _ => DualSystem(lagrangian).without_inertia(t, g),
    }
}

/// Takes velocity and force from where they are one after the other; no numbers where there are none.
#[inline(always)]
pub(crate) fn read_rates<S: Scalar>(
    found: Option<&[S]>,
    xi: &mut impl VectorSpace<Scalar = S>,
    tau: &mut impl VectorSpace<Scalar = S>,
) {
    match found.and_then(|out| out.split_at_checked(xi.dim())) {
        Some((velocity, force)) if force.len() == tau.dim() => {
            xi.read(velocity);
            tau.read(force);
        }
        _ => {
            (0..xi.dim()).for_each(|i| xi.set(i, S::from_f64(f64::NAN)));
            (0..tau.dim()).for_each(|i| tau.set(i, S::from_f64(f64::NAN)));
        }
    }
}
