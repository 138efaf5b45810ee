//! The instructions that some nodes of a graph need, one after the other.

use std::collections::{HashMap, HashSet};

use crate::graph::Graph;
use crate::instruction::{Instruction, Op};
use crate::node::{Binary, Id, Node, Unary};
use crate::walk::as_needed;

/// Instructions over nodes.
#[derive(Default)]
pub(crate) struct Lowered {
    pub(crate) instructions: Vec<Instruction>,
    /// The constants of [`Op::Times`].
    pub(crate) factors: Vec<f64>,
    /// Constants among the nodes.
    pub(crate) constants: Vec<Id>,
    /// Angles whose sine and cosine are computed.
    paired: HashSet<Id>,
}

/// What computes the outputs and nothing else; what `first` needs comes first.
pub(crate) fn lower(graph: &Graph, outputs: &[Id], first: &[Id]) -> Lowered {
    let nodes = as_needed(graph, first.iter().chain(outputs).copied());
    let pairs = pairs(graph, &nodes);
    let mut places: HashMap<Id, Vec<u32>> = HashMap::new();
    for (k, id) in outputs.iter().enumerate() {
        places.entry(*id).or_default().push(k as u32);
    }
    let mut lowered = Lowered::default();
    for id in &nodes {
        lowered.push(graph, *id, &pairs);
        for to in places.get(id).into_iter().flatten() {
            let (op, to, args) = (Op::Store, *to, [id.0, 0, 0, 0]);
            lowered.instructions.push(Instruction { op, to, args });
        }
    }
    lowered
}

/// The nodes of sine and cosine of each angle of which both are needed.
fn pairs(graph: &Graph, nodes: &[Id]) -> HashMap<Id, [Id; 2]> {
    let of = |op| {
        nodes.iter().filter_map(move |id| match graph.node(*id) {
            Node::Unary(found, x) if found == op => Some((x, *id)),
            _ => None,
        })
    };
    let sines: HashMap<Id, Id> = of(Unary::Sin).collect();
    let both = of(Unary::Cos).filter_map(|(x, cos)| Some((x, [*sines.get(&x)?, cos])));
    both.collect()
}

impl Lowered {
    fn push(&mut self, graph: &Graph, id: Id, pairs: &HashMap<Id, [Id; 2]>) {
        let none = Id(0);
        let (op, args) = match graph.node(id) {
            Node::Constant(_) => return self.constants.push(id),
            Node::Input(k) => (Op::Load, [Id(k), none, none, none]),
            Node::Unary(Unary::Neg, x) => (Op::Neg, [x, none, none, none]),
            Node::Unary(Unary::Sin | Unary::Cos, x) if pairs.contains_key(&x) => {
                return self.push_pair(x, pairs[&x]);
            }
            Node::Unary(op, x) => (Op::Unary(op), [x, none, none, none]),
            Node::Binary(Binary::Mul, x, y) => match (graph.as_constant(x), graph.as_constant(y)) {
                (Some(c), _) => (Op::Times, [y, self.factor(c), none, none]),
                (_, Some(c)) => (Op::Times, [x, self.factor(c), none, none]),
                _ => (Op::Mul, [x, y, none, none]),
            },
            Node::Binary(op, x, y) => (binary(op), [x, y, none, none]),
            Node::MulAdd([x, a, b]) => (Op::MulAdd, [x, a, b, none]),
            Node::NegMulAdd([x, a, b]) => (Op::NegMulAdd, [x, a, b, none]),
            Node::Select {
                less: [l, r],
                yes,
                no,
            } => (Op::Select, [l, r, yes, no]),
        };
        let (to, args) = (id.0, args.map(|x| x.0));
        self.instructions.push(Instruction { op, to, args });
    }

    /// Sine and cosine at once, at the first of the two.
    fn push_pair(&mut self, x: Id, [sin, cos]: [Id; 2]) {
        if self.paired.insert(x) {
            let (op, to, args) = (Op::SinCos, sin.0, [x.0, cos.0, 0, 0]);
            self.instructions.push(Instruction { op, to, args });
        }
    }

    fn factor(&mut self, c: f64) -> Id {
        self.factors.push(c);
        Id(self.factors.len() as u32 - 1)
    }
}

fn binary(op: Binary) -> Op {
    match op {
        Binary::Add => Op::Add,
        Binary::Sub => Op::Sub,
        Binary::Mul => Op::Mul,
        Binary::Div => Op::Div,
        Binary::Rem | Binary::Atan2 => Op::Binary(op),
    }
}
