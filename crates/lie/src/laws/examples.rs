//! What the laws are tried on.

use super::linear::{basis, filled, zero};
use crate::{LieGroup, VectorSpace};

/// The examples given, and those that every algebra has.
pub(super) struct Examples<'a, G: LieGroup> {
    pub(super) elements: &'a [G],
    /// The velocities given, for the laws that take three.
    pub(super) given: &'a [G::Algebra],
    pub(super) basis: Vec<G::Algebra>,
    /// Zero, the basis, and the velocities given.
    pub(super) velocities: Vec<G::Algebra>,
    /// The dual basis, and a momentum for each velocity given: its coordinates in reverse.
    pub(super) momenta: Vec<G::Dual>,
}

impl<'a, G: LieGroup> Examples<'a, G> {
    /// There must be an element.
    pub(super) fn new(elements: &'a [G], given: &'a [G::Algebra]) -> Self {
        let (algebra, dual) = (elements[0].zero_algebra(), elements[0].zero_dual());
        let basis_of_algebra = basis(&algebra);
        let reversed = |xi: &G::Algebra| filled(&dual, &|i| xi.get(xi.dim() - 1 - i));
        Self {
            elements,
            given,
            velocities: [&[zero(&algebra)], &basis_of_algebra[..], given].concat(),
            basis: basis_of_algebra,
            momenta: [basis(&dual), given.iter().map(reversed).collect()].concat(),
        }
    }

    /// An element whose shape stands for all.
    pub(super) fn shape(&self) -> &G {
        &self.elements[0]
    }
}
