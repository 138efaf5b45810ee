//! Which results depend on which variables.

use std::collections::HashMap;

use crate::graph::Graph;
use crate::node::Id;
use crate::walk::reachable;

/// A sparse table: a row for each result, with the variables that it depends on.
///
/// ```
/// use trace::{Binary, Graph};
///
/// let mut graph = Graph::new(3);
/// let x = graph.inputs();
/// let out = [graph.binary(Binary::Mul, x[0], x[2]), x[1]];
/// let pattern = graph.pattern(&out, &x);
/// assert_eq!(pattern.row(0), [0, 2]);
/// assert_eq!(pattern.row(1), [1]);
/// assert_eq!((pattern.rows(), pattern.entries()), (2, 3));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// The end of each row among `columns`.
    ends: Vec<usize>,
    columns: Vec<usize>,
}

impl Pattern {
    /// The indices of the variables that result `i` depends on, ascending.
    ///
    /// # Panics
    /// Where there is no such row.
    pub fn row(&self, i: usize) -> &[usize] {
        let start = i.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.columns[start..self.ends[i]]
    }

    /// How many results there are.
    pub fn rows(&self) -> usize {
        self.ends.len()
    }

    /// How many pairs of a result and a variable there are.
    pub fn entries(&self) -> usize {
        self.columns.len()
    }
}

impl Graph {
    /// Which of the results `out` depend on which of `wrt`.
    ///
    /// It is read off the graph: a dependence that cancels counts, and so does one through a comparison. A factor
    /// beside the constant zero does not. The cost of a row is that of the nodes which the result is made of.
    ///
    /// # Panics
    /// Where a node is not of this graph.
    pub fn pattern(&self, out: &[Id], wrt: &[Id]) -> Pattern {
        let mut places: HashMap<Id, Vec<usize>> = HashMap::new();
        for (j, x) in wrt.iter().enumerate() {
            places.entry(*x).or_default().push(j);
        }
        let (mut ends, mut columns) = (Vec::with_capacity(out.len()), Vec::new());
        for y in out {
            let start = columns.len();
            let nodes = reachable([*y], |id| self.dependencies(id));
            columns.extend(nodes.iter().filter_map(|id| places.get(id)).flatten());
            columns[start..].sort_unstable();
            ends.push(columns.len());
        }
        Pattern { ends, columns }
    }
}
