//! From the value by the velocity to the velocity and the force by the momentum.

use core::ops::Range;

use lie::{RealGroup, VectorSpace};
use trace::{Binary, Degree, Graph, Id, Node, Program, Unary};

use super::error::TracedError;
use super::inertia::{self, Solution};
use super::translation::Translations;
use crate::numerics::elements;

/// The most operations for the factors of an inertia that are written on a graph: a program ten times as long takes seconds to make.
const LIMIT: usize = 1_000_000;

/// Where the inputs are: time, parameters, the numbers of the configuration, and the velocity or the momentum.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    parameters: usize,
    numbers: usize,
    dim: usize,
}

impl Layout {
    pub(super) fn of<G: RealGroup>(parameters: usize, g: &G) -> Self {
        Self {
            parameters,
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

/// The programs of a Lagrangian that is quadratic in the velocity; each takes time, parameters, numbers and momentum.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Programs {
    /// The velocity and the force, and the same as a graph.
    pub(crate) rates: Program,
    pub(crate) flow: Graph,
    /// The energy.
    pub(crate) energy: Program,
    /// The pivots of the inertia, and its diagonal.
    pub(crate) inertia: Program,
    /// The value at rest.
    pub(crate) at_rest: Program,
}

/// The programs from the graph of the value by the velocity.
pub(super) fn compile(
    mut value: Graph,
    layout: Layout,
    translations: &Translations,
) -> Result<Programs, TracedError> {
    let (root, inputs) = (value.outputs()[0], value.inputs());
    let velocity = &inputs[layout.velocity()];
    let slopes = value.gradient(root, &inputs[layout.numbers().start..]);
    let (by_numbers, momenta) = slopes.split_at(layout.numbers);
    let degrees = value.degrees(momenta, velocity);
    if let Some(coordinate) = degrees.iter().position(|d| *d > Degree::Linear) {
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
    let solution = inertia::solve(&mut graph, (&pattern, &entries), &moving, LIMIT);
    let Solution {
        x: xi,
        pivots,
        diagonal,
    } = solution.ok_or(TracedError::Dense {
        dim: layout.dim,
        limit: LIMIT,
    })?;
    let wanted = [by_numbers, &[root]].concat();
    let mut slopes = graph.call(&value, &[&known[..], &xi].concat(), &wanted);
    let value_there = slopes.pop().unwrap_or(root);
    let mut out = xi.clone();
    out.extend(translations.trivialise(&mut graph, &known[layout.numbers()], &slopes));
    if has_logarithm(&value) {
        poison(&mut graph, value_there, &mut out);
    }
    let at_rest = graph.call(&value, &rest, &[root]);
    let mut energy = graph.unary(Unary::Neg, value_there);
    for (mu, xi) in mu.iter().zip(&xi) {
        energy = graph.mul_add([*mu, *xi, energy]);
    }
    let [energy, inertia, at_rest] =
        [vec![energy], [pivots, diagonal].concat(), at_rest].map(|out| Program::new(&graph, &out));
    graph.set_outputs(&out);
    Ok(Programs {
        rates: rates(&graph),
        flow: graph,
        energy,
        inertia,
        at_rest,
    })
}

/// The program of the velocity and the force, which are the outputs of a graph.
pub(super) fn rates(flow: &Graph) -> Program {
    Program::in_order(flow, flow.outputs(), &side_by_side(flow.outputs()))
}

/// Both halves in step: what is computed for a coordinate of one is near what that of the other needs.
pub(super) fn side_by_side(out: &[Id]) -> Vec<Id> {
    let (one, other) = out.split_at(out.len() / 2);
    let pairs = one.iter().zip(other);
    pairs.flat_map(|(a, b)| [*a, *b]).collect()
}

/// Whether there is a logarithm: its derivative is a number where it is none itself.
pub(super) fn has_logarithm(graph: &Graph) -> bool {
    graph
        .nodes()
        .any(|node| matches!(node, Node::Unary(Unary::Ln, _)))
}

/// Makes the first result no number where `value` is none.
pub(super) fn poison(graph: &mut Graph, value: Id, out: &mut [Id]) {
    let zero = graph.constant(0.0);
    if let Some(first) = out.first_mut() {
        *first = graph.mul_add([zero, value, *first]);
    }
}

/// A momentum less that at rest.
fn without(graph: &mut Graph, mu: Id, at_rest: Id) -> Id {
    match graph.as_constant(at_rest) {
        Some(0.0) => mu,
        _ => graph.binary(Binary::Sub, mu, at_rest),
    }
}
