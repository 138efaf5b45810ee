//! The graph of a formula: each number once, after those it is made of.

use std::collections::HashMap;

use serde::{Deserialize, Serialize};

use crate::error::GraphError;
use crate::node::{Bits, Id, Node};

/// A formula as data: inputs, operations and outputs.
///
/// A [recording](crate::record) makes one, or a front end by its methods. Equal nodes are one node, and what is made of constants alone is
/// a constant. Nodes only read nodes before them, so that their order is one to evaluate them in.
///
/// ```
/// use trace::{Binary, Graph, Program, Unary};
///
/// // sin(x y), and its derivatives.
/// let mut graph = Graph::new(2);
/// let [x, y] = [graph.input(0), graph.input(1)];
/// let product = graph.binary(Binary::Mul, x, y);
/// let sine = graph.unary(Unary::Sin, product);
/// let slopes = graph.gradient(sine, &[x, y]);
///
/// let program = Program::new(&graph, &slopes);
/// let (mut memory, mut out) = (program.memory(), [0.0; 2]);
/// program.run(&mut memory, &[2.0, 0.5], &mut out)?;
/// assert_eq!(out, [0.5 * 1.0_f64.cos(), 2.0 * 1.0_f64.cos()]);
/// # Ok::<(), trace::WrongLength>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Data", into = "Data")]
pub struct Graph {
    nodes: Vec<Node>,
    places: HashMap<Node, Id>,
    inputs: usize,
    outputs: Vec<Id>,
}

impl Graph {
    /// A graph of this many inputs and nothing else.
    pub fn new(inputs: usize) -> Self {
        let mut graph = Self {
            inputs,
            ..Self::default()
        };
        for k in 0..inputs {
            graph.intern(Node::Input(k as u32));
        }
        graph
    }

    /// The node of input `k`.
    ///
    /// # Panics
    /// Where there is no such input.
    pub fn input(&self, k: usize) -> Id {
        assert!(k < self.inputs, "there are {} inputs, not {k}", self.inputs);
        Id(k as u32)
    }

    /// The nodes of all inputs, in order.
    pub fn inputs(&self) -> Vec<Id> {
        (0..self.inputs).map(|k| self.input(k)).collect()
    }

    /// The nodes of the results, in order.
    pub fn outputs(&self) -> &[Id] {
        &self.outputs
    }

    /// Makes these nodes the results.
    ///
    /// # Panics
    /// Where one is not of this graph.
    pub fn set_outputs(&mut self, outputs: &[Id]) {
        outputs.iter().for_each(|id| {
            self.node(*id);
        });
        self.outputs = outputs.to_vec();
    }

    /// How a number is made.
    ///
    /// # Panics
    /// Where it is not of this graph.
    pub fn node(&self, id: Id) -> Node {
        self.nodes[id.index()]
    }

    /// How all its numbers are made, in order.
    pub fn nodes(&self) -> impl Iterator<Item = Node> {
        self.nodes.iter().copied()
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The number of a constant; none of others.
    pub fn as_constant(&self, id: Id) -> Option<f64> {
        match self.node(id) {
            Node::Constant(bits) => Some(bits.number()),
            _ => None,
        }
    }

    /// A constant.
    pub fn constant(&mut self, x: f64) -> Id {
        self.intern(Node::Constant(Bits::of(x)))
    }

    /// The place of a node, new where it is not there yet.
    pub(crate) fn intern(&mut self, node: Node) -> Id {
        debug_assert!(node.operands().all(|x| x.index() < self.len()));
        let new = Id(self.nodes.len() as u32);
        let place = *self.places.entry(node).or_insert(new);
        if place == new {
            self.nodes.push(node);
        }
        place
    }
}

/// What is written of a graph.
#[derive(Serialize, Deserialize)]
struct Data {
    inputs: usize,
    nodes: Vec<Node>,
    outputs: Vec<Id>,
}

impl From<Graph> for Data {
    fn from(graph: Graph) -> Self {
        Self {
            inputs: graph.inputs,
            nodes: graph.nodes,
            outputs: graph.outputs,
        }
    }
}

impl TryFrom<Data> for Graph {
    type Error = GraphError;

    fn try_from(data: Data) -> Result<Self, GraphError> {
        let (inputs, nodes) = (data.inputs, data.nodes.len());
        let mut graph = Self {
            inputs,
            ..Self::default()
        };
        for (node, data) in data.nodes.into_iter().enumerate() {
            let input = matches!(data, Node::Input(k) if k as usize == node);
            if input != (node < inputs) || (!input && matches!(data, Node::Input(_))) {
                return Err(GraphError::Inputs { node, inputs });
            }
            if let Some(operand) = data.operands().map(Id::index).find(|x| *x >= node) {
                return Err(GraphError::Order { node, operand });
            }
            let first = graph.intern(data).index();
            if first != node {
                return Err(GraphError::Twice { node, first });
            }
        }
        if nodes < inputs {
            let node = nodes;
            return Err(GraphError::Inputs { node, inputs });
        }
        for (output, id) in data.outputs.iter().enumerate() {
            let node = id.index();
            if node >= nodes {
                return Err(GraphError::Output {
                    output,
                    node,
                    nodes,
                });
            }
        }
        graph.outputs = data.outputs;
        Ok(graph)
    }
}
