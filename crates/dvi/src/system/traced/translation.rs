//! How the numbers of a group element change along left-trivialised velocities.

use lie::{Jet, LieGroup, Over, RealGroup, Scalar, VectorSpace};
use trace::{Degree, Graph, Id, TraceError, Traced, record};

use super::elements::{count, numbers, with_numbers};
use crate::numerics::duals::for_each_chunk;

/// Dual numbers over recorded ones.
type J = <Traced as Scalar>::Jet;

/// The derivatives $\partial n_k(g \exp \zeta) / \partial \zeta_d$ at $\zeta = 0$ of the numbers $n_k$ of an element, as formulas of these.
pub(super) struct Translations {
    graph: Graph,
    /// A row of directions for each number.
    dim: usize,
}

impl Translations {
    pub(super) fn new<G: RealGroup>(g: &G) -> Result<Self, TraceError> {
        let dim = g.zero_algebra().dim();
        let mut graph = record(count(g), |n| derivatives(g, n))?;
        let out: Vec<Id> = graph.outputs().to_vec();
        let simple: Vec<Id> = out.iter().map(|y| without_zeros(&mut graph, *y)).collect();
        graph.set_outputs(&simple);
        Ok(Self { graph, dim })
    }

    /// The left-trivialised derivative of what has the derivatives `slopes` by the numbers `n`.
    pub(super) fn trivialise(&self, graph: &mut Graph, n: &[Id], slopes: &[Id]) -> Vec<Id> {
        let rates = graph.call(&self.graph, n, self.graph.outputs());
        let mut tau = vec![graph.constant(-0.0); self.dim];
        for (slope, rates) in slopes.iter().zip(rates.chunks_exact(self.dim.max(1))) {
            for (sum, rate) in tau.iter_mut().zip(rates) {
                // Neither a number that L does not depend on nor a direction that does not change it.
                if graph.as_constant(*slope) != Some(0.0) && graph.as_constant(*rate) != Some(0.0) {
                    *sum = graph.mul_add([*slope, *rate, *sum]);
                }
            }
        }
        tau
    }
}

fn derivatives<G: RealGroup>(g: &G, n: &[Traced]) -> Vec<Traced> {
    let lifted: Vec<J> = n.iter().map(|x| J::constant(*x)).collect();
    let g = with_numbers(g, &lifted);
    let mut zeta = g.zero_algebra();
    let dim = zeta.dim();
    let mut all = vec![Traced::from_f64(0.0); n.len() * dim];
    for_each_chunk(dim, |first| {
        lie::seed(&mut zeta, first);
        let moved = g.compose(&Over::<G, J>::exp(&zeta));
        for (row, x) in all.chunks_exact_mut(dim).zip(numbers::<G, J>(&moved)) {
            let partials = row[first..].iter_mut().take(lie::JET_DIRECTIONS);
            partials.enumerate().for_each(|(d, y)| *y = x.partial(d));
        }
    });
    all
}

/// The same derivative without the terms that are zero for every element; products of matrices leave many.
///
/// It is linear in the numbers of a matrix; a derivative that is not stays as it is.
fn without_zeros(graph: &mut Graph, y: Id) -> Id {
    let inputs = graph.inputs();
    if graph.degree(y, &inputs) > Degree::Linear {
        return y;
    }
    let zeros: Vec<Id> = inputs.iter().map(|_| graph.constant(0.0)).collect();
    let itself = graph.clone();
    let start = graph.call(&itself, &zeros, &[y])[0];
    let start = if graph.as_constant(start) == Some(0.0) {
        graph.constant(-0.0)
    } else {
        start
    };
    let columns: Vec<Id> = graph
        .pattern(&[y], &inputs)
        .row(0)
        .iter()
        .map(|j| inputs[*j])
        .collect();
    let slopes = graph.gradient(y, &columns);
    let terms = slopes.into_iter().zip(columns);
    terms.fold(start, |sum, (slope, x)| graph.mul_add([slope, x, sum]))
}
