//! From the value by the velocity to the velocity and the force by the momentum.

use core::ops::Range;

use lie::{LieGroup, VectorSpace};
use trace::{Binary, Degree, Graph, Id, Program};

use super::error::TracedError;
use super::translation::Translations;
use super::{elements, inertia};
use crate::system::lagrangian::Lagrangian;

/// Where the inputs are: time, parameters, the numbers of the configuration, and the velocity or the momentum.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    parameters: usize,
    numbers: usize,
    dim: usize,
}

impl Layout {
    pub(super) fn of<L: Lagrangian>(lagrangian: &L, g: &L::Group) -> Self {
        Self {
            parameters: lagrangian.parameters().len(),
            numbers: elements::count(g),
            dim: g.zero_algebra().dim(),
        }
    }

    pub(super) fn len(self) -> usize {
        self.velocity().end
    }

    pub(super) fn parameters(self) -> Range<usize> {
        1..1 + self.parameters
    }

    pub(super) fn numbers(self) -> Range<usize> {
        let start = self.parameters().end;
        start..start + self.numbers
    }

    pub(super) fn velocity(self) -> Range<usize> {
        let start = self.numbers().end;
        start..start + self.dim
    }
}

/// The program of the velocity and the force, from the graph of the value.
pub(super) fn compile(
    mut value: Graph,
    layout: Layout,
    translations: &Translations,
) -> Result<Program, TracedError> {
    let (root, inputs) = (value.outputs()[0], value.inputs());
    let velocity = &inputs[layout.velocity()];
    let slopes = value.gradient(root, &inputs[layout.numbers().start..]);
    let (by_numbers, momenta) = slopes.split_at(layout.numbers);
    let linear = |m: &Id| value.degree(*m, velocity) <= Degree::Linear;
    if let Some(coordinate) = momenta.iter().position(|m| !linear(m)) {
        return Err(TracedError::NotQuadratic { coordinate });
    }
    let (pattern, entries) = value.jacobian(momenta, velocity);

    let mut graph = Graph::new(layout.len());
    let mut known = graph.inputs();
    let mu = known.split_off(layout.velocity().start);
    let rest = [&known[..], &vec![graph.constant(0.0); layout.dim]].concat();
    let at_rest = graph.call(&value, &rest, momenta);
    let moving: Vec<Id> = mu
        .iter()
        .zip(at_rest)
        .map(|(mu, b)| without(&mut graph, *mu, b))
        .collect();
    let entries = graph.call(&value, &rest, &entries);
    let mut out = inertia::solve(&mut graph, (&pattern, &entries), &moving);
    let slopes = graph.call(&value, &[&known[..], &out].concat(), by_numbers);
    out.extend(translations.trivialise(&mut graph, &known[layout.numbers()], &slopes));
    Ok(Program::new(&graph, &out))
}

/// A momentum less that at rest.
fn without(graph: &mut Graph, mu: Id, at_rest: Id) -> Id {
    match graph.as_constant(at_rest) {
        Some(0.0) => mu,
        _ => graph.binary(Binary::Sub, mu, at_rest),
    }
}
