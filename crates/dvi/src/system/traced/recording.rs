//! What is recorded of a system, with what it tells of itself.

use core::ops::Range;
use std::sync::Arc;

use lie::RealGroup;

use super::compile::Programs;
use super::storage::Shared;

/// What is recorded of a system, for configurations of one shape: a [`TracedSystem`](crate::TracedSystem) is made of it.
#[derive(Clone, Debug)]
pub struct Recording<G: RealGroup> {
    pub(crate) programs: Arc<Programs>,
    /// For the program of the value at rest.
    pub(super) at_rest: Shared<G>,
    pub(super) shape: G,
    pub(super) told: Told,
}

/// What a system tells of itself.
#[derive(Clone, Debug)]
pub(super) struct Told {
    pub(super) parameters: Vec<f64>,
    pub(super) cyclic: Range<usize>,
    pub(super) is_driven: bool,
    pub(super) terms: usize,
    pub(super) is_symplectic: bool,
}
