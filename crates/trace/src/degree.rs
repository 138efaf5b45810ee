//! How a result grows with some variables.

use std::collections::HashMap;

use crate::graph::Graph;
use crate::node::{Binary, Id, Node, Unary};
use crate::walk::reachable;

/// The degree of a polynomial, as far as it matters to mechanics: a quadratic kinetic energy has a mass matrix without velocities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Degree {
    /// It does not change.
    Constant,
    /// Its first derivatives do not change.
    Linear,
    /// Its second derivatives do not change.
    Quadratic,
    /// More than that, or no polynomial.
    More,
}

impl Degree {
    /// That of a product.
    fn times(self, other: Self) -> Self {
        match self as u8 + other as u8 {
            0 => Self::Constant,
            1 => Self::Linear,
            2 => Self::Quadratic,
            _ => Self::More,
        }
    }

    /// That of a function other than a polynomial.
    fn transcendental(self) -> Self {
        match self {
            Self::Constant => Self::Constant,
            _ => Self::More,
        }
    }
}

impl Graph {
    /// The degree of the result `out` in all of `wrt` together.
    ///
    /// It is read off the graph, and so an upper bound: terms that cancel count.
    ///
    /// ```
    /// use trace::{Binary, Degree, Graph};
    ///
    /// let mut graph = Graph::new(2);
    /// let [x, y] = [graph.input(0), graph.input(1)];
    /// let product = graph.binary(Binary::Mul, x, y);
    /// assert_eq!(graph.degree(product, &[x]), Degree::Linear);
    /// assert_eq!(graph.degree(product, &[x, y]), Degree::Quadratic);
    /// ```
    ///
    /// # Panics
    /// Where a node is not of this graph.
    pub fn degree(&self, out: Id, wrt: &[Id]) -> Degree {
        self.degrees(&[out], wrt)[0]
    }

    /// The [degree](Self::degree) of each of `out`, found in one pass.
    ///
    /// # Panics
    /// Where a node is not of this graph.
    pub fn degrees(&self, out: &[Id], wrt: &[Id]) -> Vec<Degree> {
        let mut known: HashMap<Id, Degree> = wrt.iter().map(|x| (*x, Degree::Linear)).collect();
        for id in reachable(out.iter().copied(), |id| self.dependencies(id)) {
            if !known.contains_key(&id) {
                let degree = self.degree_of(id, &known);
                known.insert(id, degree);
            }
        }
        out.iter().map(|id| known[id]).collect()
    }

    fn degree_of(&self, id: Id, known: &HashMap<Id, Degree>) -> Degree {
        // What is hidden by a zero factor is not among the known.
        let of = |x: Id| known.get(&x).copied().unwrap_or(Degree::Constant);
        let product = |x: Id, y: Id| match self.is_zero(x) || self.is_zero(y) {
            true => Degree::Constant,
            false => of(x).times(of(y)),
        };
        match self.node(id) {
            Node::Constant(_) | Node::Input(_) => Degree::Constant,
            Node::Unary(Unary::Neg, x) => of(x),
            Node::Unary(_, x) => of(x).transcendental(),
            Node::Binary(Binary::Add | Binary::Sub, x, y) => of(x).max(of(y)),
            Node::Binary(Binary::Mul, x, y) => product(x, y),
            Node::Binary(Binary::Div, x, y) if of(y) == Degree::Constant => of(x),
            Node::Binary(_, x, y) => of(x).max(of(y)).transcendental(),
            Node::MulAdd([x, a, b]) | Node::NegMulAdd([x, a, b]) => product(x, a).max(of(b)),
            Node::Select {
                less: [l, r],
                yes,
                no,
            } => of(l).max(of(r)).transcendental().max(of(yes)).max(of(no)),
        }
    }
}
