//! Graphs put together: the numbers of one at arguments from another.

use std::collections::HashMap;

use crate::graph::Graph;
use crate::node::{Id, Node};
use crate::walk::reachable;

impl Graph {
    /// The numbers `out` of another graph, with these arguments for its inputs.
    ///
    /// Constants among the arguments are used at once, so this is also how an input is given a value for good.
    ///
    /// ```
    /// use trace::record;
    ///
    /// let square = record(1, |x| vec![x[0] * x[0]])?;
    /// let mut graph = record(2, |x| vec![x[0] + x[1]])?;
    /// let sum = graph.outputs()[0];
    /// let three = graph.constant(3.0);
    /// let nine = graph.call(&square, &[three], square.outputs());
    /// assert_eq!(graph.as_constant(nine[0]), Some(9.0));
    /// // (x + y)², by x.
    /// let squared = graph.call(&square, &[sum], square.outputs());
    /// assert_eq!(graph.pattern(&squared, &graph.inputs()).row(0), [0, 1]);
    /// # Ok::<(), trace::TraceError>(())
    /// ```
    ///
    /// # Panics
    /// Where there are fewer arguments than inputs, or a node is not of its graph.
    pub fn call(&mut self, other: &Graph, arguments: &[Id], out: &[Id]) -> Vec<Id> {
        let mut here: HashMap<Id, Id> = HashMap::new();
        for id in reachable(out.iter().copied(), |id| other.node(id).operands()) {
            let at = |x: Id| here[&x];
            let new = match other.node(id) {
                Node::Constant(c) => self.constant(c.number()),
                Node::Input(k) => arguments[k as usize],
                Node::Unary(op, x) => self.unary(op, at(x)),
                Node::Binary(op, x, y) => self.binary(op, at(x), at(y)),
                Node::MulAdd(x) => self.mul_add(x.map(at)),
                Node::NegMulAdd(x) => self.neg_mul_add(x.map(at)),
                Node::Select { less, yes, no } => self.select(less.map(at), at(yes), at(no)),
            };
            here.insert(id, new);
        }
        out.iter().map(|id| here[id]).collect()
    }
}
