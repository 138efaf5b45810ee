//! What an evaluation writes to.

use lie::{DualOver, LieGroup, Over, Scalar, VectorSpace};
use trace::Program;

use super::elements;
use crate::system::context::Context;
use crate::system::lagrangian::Lagrangian;

/// Storage of an evaluation, made when first needed.
pub struct TracedWorkspace<L: Lagrangian, S: Scalar>(Option<Storage<L, S>>);

/// Storage for configurations of one shape.
pub(super) struct Storage<L: Lagrangian, S: Scalar> {
    memory: Vec<S>,
    inputs: Vec<S>,
    outputs: Vec<S>,
    scratch: Over<L::Group, S>,
}

impl<L: Lagrangian, S: Scalar> Default for TracedWorkspace<L, S> {
    fn default() -> Self {
        Self(None)
    }
}

impl<L: Lagrangian, S: Scalar> TracedWorkspace<L, S> {
    /// The storage for configurations of the shape of `g`.
    #[inline(always)]
    pub(super) fn of_shape(
        &mut self,
        program: &Program,
        g: &Over<L::Group, S>,
    ) -> &mut Storage<L, S> {
        self.0.take_if(|known| !known.scratch.same_shape(g));
        self.0.get_or_insert_with(|| Storage {
            memory: program.memory(),
            inputs: vec![S::zero(); program.inputs()],
            outputs: vec![S::zero(); program.outputs()],
            scratch: g.clone(),
        })
    }
}

impl<L: Lagrangian, S: Scalar> Storage<L, S> {
    /// The outputs of the program; none where it was recorded for another shape.
    #[inline(always)]
    pub(super) fn run(
        &mut self,
        program: &Program,
        at: Context<S>,
        g: &Over<L::Group, S>,
        mu: &DualOver<L::Group, S>,
    ) -> Option<&[S]> {
        let before = self.inputs.len().checked_sub(mu.dim())?;
        let (head, momentum) = self.inputs.split_at_mut(before);
        let (context, numbers) = head.split_at_mut_checked(1 + at.all.len())?;
        context[0] = at.t;
        context[1..].copy_from_slice(at.all);
        mu.write(momentum);
        let fits = elements::write::<L::Group, S>(g, &mut self.scratch, numbers);
        if !fits || self.outputs.len() != 2 * mu.dim() {
            return None;
        }
        program
            .run(&mut self.memory, &self.inputs, &mut self.outputs)
            .ok()?;
        Some(&self.outputs)
    }
}
