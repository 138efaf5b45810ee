//! How the numbers of a group element change along left-trivialised velocities.

use crate::numerics::elements;
use lie::{Cayley, LieGroup, Over, RealGroup, VectorSpace};
use trace::{Degree, Graph, Id, TraceError, Traced, record};

/// The derivatives $\partial n_k(g \exp \zeta) / \partial \zeta_d$ at $\zeta = 0$ of the numbers $n_k$ of an element, as formulas of these.
///
/// Of each number those directions alone that change it: few, whatever the size of the group.
pub(crate) struct Translations {
    graph: Graph,
    /// The directions of each number, with the derivatives along them.
    rates: Vec<Vec<(usize, Id)>>,
    dim: usize,
}

impl Translations {
    pub(crate) fn new<G: RealGroup>(g: &G) -> Result<Self, TraceError> {
        let (numbers, dim) = (elements::count(g), g.zero_algebra().dim());
        let mut moved = record(numbers + dim, |x| moved(g, x.split_at(numbers)))?;
        let (out, inputs) = (moved.outputs().to_vec(), moved.inputs());
        let (pattern, slopes) = moved.jacobian(&out, &inputs[numbers..]);

        let mut graph = Graph::new(numbers);
        let mut still = graph.inputs();
        still.resize(numbers + dim, graph.constant(0.0));
        let slopes = graph.call(&moved, &still, &slopes);
        let mut slopes = without_zeros(&mut graph, &slopes).into_iter();
        let rates = (0..numbers).map(|k| {
            let row = pattern.row(k).iter().copied().zip(slopes.by_ref());
            row.filter(|(_, rate)| graph.as_constant(*rate) != Some(0.0))
                .collect()
        });
        Ok(Self {
            rates: rates.collect(),
            graph,
            dim,
        })
    }

    /// The left-trivialised derivative of what has the derivatives `slopes` by the numbers `n`.
    pub(crate) fn trivialise(&self, graph: &mut Graph, n: &[Id], slopes: &[Id]) -> Vec<Id> {
        let mut tau = vec![graph.constant(-0.0); self.dim];
        for (slope, rates) in slopes.iter().zip(&self.rates) {
            // A number that L does not depend on.
            if graph.as_constant(*slope) == Some(0.0) {
                continue;
            }
            let directions: Vec<Id> = rates.iter().map(|(_, rate)| *rate).collect();
            let values = graph.call(&self.graph, n, &directions);
            for ((d, _), rate) in rates.iter().zip(values) {
                tau[*d] = graph.mul_add([*slope, rate, tau[*d]]);
            }
        }
        tau
    }
}

/// The numbers of $g \exp \zeta$; to first order, any retraction is the exponential.
fn moved<G: RealGroup>(g: &G, (n, along): (&[Traced], &[Traced])) -> Vec<Traced> {
    let g = elements::with_numbers(g, n);
    let mut zeta = g.zero_algebra();
    zeta.read(along);
    let small = Over::<G, Traced>::retract::<Cayley>(&zeta);
    elements::numbers::<G, Traced>(&g.compose(&small))
}

/// The same derivatives without the terms that are zero for every element; products of matrices leave many.
///
/// They are linear in the numbers of a matrix; one that is not stays as it is.
fn without_zeros(graph: &mut Graph, all: &[Id]) -> Vec<Id> {
    let inputs = graph.inputs();
    let (degrees, pattern) = (graph.degrees(all, &inputs), graph.pattern(all, &inputs));
    let mut at_zero = Graph::new(0);
    let zeros = vec![at_zero.constant(0.0); inputs.len()];
    let starts = at_zero.call(&*graph, &zeros, all);
    let linear = |(i, y): (usize, &Id)| {
        if degrees[i] > Degree::Linear {
            return *y;
        }
        let start = at_zero.as_constant(starts[i]).filter(|start| *start != 0.0);
        let start = graph.constant(start.unwrap_or(-0.0));
        let columns: Vec<Id> = pattern.row(i).iter().map(|j| inputs[*j]).collect();
        let slopes = graph.gradient(*y, &columns).into_iter();
        let terms = slopes
            .zip(columns)
            .filter(|(slope, _)| !is_zero(graph, *slope));
        let terms: Vec<(Id, Id)> = terms.collect();
        terms
            .into_iter()
            .fold(start, |sum, (slope, x)| graph.mul_add([slope, x, sum]))
    };
    all.iter().enumerate().map(linear).collect()
}

fn is_zero(graph: &Graph, x: Id) -> bool {
    graph.as_constant(x) == Some(0.0)
}
