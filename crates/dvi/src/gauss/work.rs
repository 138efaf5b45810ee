//! The storage of a method's steps.

use lie::{Batch, LieGroup, VectorSpace};

use super::newton::SweepNewton;
use super::predictor::Predictor;
use super::sweep::Sweep;
use super::tableau::Tableau;
use super::update::Update;
use crate::numerics::sizes::{Kinds, Sizes};
use crate::{ContinuousSystem, State, System};

/// How far a step is solved, and by what: by default to rounding, by all there is.
#[derive(Clone, Copy, Default)]
pub(super) struct Limits {
    /// See [`Gauss::with_tolerance`](crate::Gauss::with_tolerance).
    pub(super) tolerance: f64,
    /// Refuses a step that the plain iteration does not solve: such steps do not pay.
    pub(super) sweeps_only: bool,
}

pub(super) type Method<'a, C> = (&'a C, &'a Tableau);
pub(super) type Start<'a, C> = (&'a State<<C as System>::Group>, f64);

/// Storage of the steps; the stages are computed over `S`.
pub(super) struct Work<C: ContinuousSystem, S: Batch<Item = f64>> {
    pub(super) sweep: Sweep<C, S>,
    pub(super) predictor: Predictor<S>,
    pub(super) update: Update<C::Group>,
    /// $\pi_0$ of the stages, what their end asks it to be, and its difference from $\mu_k$ in the last step.
    pub(super) start: Vec<f64>,
    pub(super) wanted: Vec<f64>,
    pub(super) drift: Vec<f64>,
    /// Storage to compare the first two: their difference, and the largest numbers of each kind and block.
    pub(super) mismatch: [Vec<f64>; 3],
    pub(super) difference: <C::Group as LieGroup>::Dual,
    pub(super) sizes: Sizes,
    /// Storage for a configuration whose numbers are moved to measure noise.
    pub(super) moved: C::Group,
    /// Steps for which the noise is taken to be as it was measured.
    pub(super) noise_holds: u32,
    /// Made when first needed.
    pub(super) newton: Option<SweepNewton<C>>,
    pub(super) linearised: Option<SweepNewton<C>>,
    /// Steps to solve by Newton's method before the plain iteration is tried again.
    pub(super) long_steps: u32,
}

impl<C: ContinuousSystem, S: Batch<Item = f64>> Work<C, S> {
    pub(super) fn new(tableau: &Tableau, g: &C::Group) -> Self {
        let (dim, kinds) = (g.zero_dual().dim(), Kinds::of(g).count);
        Self {
            sweep: Sweep::new(tableau, g),
            predictor: Predictor::new(tableau.nodes.len(), dim),
            update: Update::new(g),
            start: vec![0.0; dim],
            wanted: vec![0.0; dim],
            drift: vec![0.0; dim],
            mismatch: [dim, kinds, kinds].map(|n| vec![0.0; n]),
            difference: g.zero_dual(),
            sizes: Sizes::new(g, 0..0, None),
            moved: g.clone(),
            noise_holds: 0,
            newton: None,
            linearised: None,
            long_steps: 0,
        }
    }
}
