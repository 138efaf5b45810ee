//! A formula from Python as a Lagrangian, or as a force.

use std::sync::Arc;

use dvi::{Context, Force, Lagrangian, System};
use lie::{AlgebraOver, DualOver, Over, Scalar, VectorSpace};
use trace::Program;

use super::elements::{Counts, Elements, counts, write};

/// A formula of time, parameters, the numbers of the configuration and the velocity.
#[derive(Clone)]
pub struct Formula {
    pub program: Arc<Program>,
}

impl Formula {
    /// Its numbers; none where it is of another shape.
    ///
    /// Over the scalar that records, this writes the formula down again: so the integrators get its graph.
    #[inline(always)]
    fn evaluate<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Elements, S>,
        xi: &AlgebraOver<Elements, S>,
    ) -> Option<Vec<S>> {
        let mut inputs = Vec::with_capacity(self.program.inputs());
        inputs.push(at.t);
        inputs.extend(at.all);
        write(g, &mut inputs);
        let start = inputs.len();
        inputs.resize(start + xi.dim(), S::zero());
        xi.write(&mut inputs[start..]);
        let mut out = vec![S::zero(); self.program.outputs()];
        let mut memory = self.program.memory();
        self.program.run(&mut memory, &inputs, &mut out).ok()?;
        Some(out)
    }
}

/// A Lagrangian that was recorded from Python, and is never called again.
#[derive(Clone)]
pub struct Recorded {
    pub formula: Formula,
    pub counts: Counts,
    pub parameters: Arc<[f64]>,
}

impl System for Recorded {
    type Group = Elements;

    fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    fn fits(&self, g: &Elements) -> bool {
        counts(g) == self.counts
    }
}

impl Lagrangian for Recorded {
    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Elements, S>,
        xi: &AlgebraOver<Elements, S>,
    ) -> S {
        let value = self.formula.evaluate(at, g, xi);
        value.map_or(S::from_f64(f64::NAN), |value| value[0])
    }
}

/// A force likewise: the coordinates of the dual.
#[derive(Clone)]
pub struct RecordedForce(pub Formula);

impl Force for RecordedForce {
    type Group = Elements;
    const INLINE: bool = true;

    #[inline(always)]
    fn force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Elements, S>,
        xi: &AlgebraOver<Elements, S>,
        out: &mut DualOver<Elements, S>,
    ) {
        match self.0.evaluate(at, g, xi) {
            Some(force) => out.read(&force),
            None => (0..out.dim()).for_each(|i| out.set(i, S::from_f64(f64::NAN))),
        }
    }
}
