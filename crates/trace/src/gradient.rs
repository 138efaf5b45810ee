//! Derivatives by reverse mode, as further nodes of the graph.

use std::collections::HashMap;

use crate::graph::Graph;
use crate::node::{Binary, Id, Node, Unary};
use crate::pattern::Pattern;
use crate::walk::reachable;

impl Graph {
    /// The derivatives of `root` by each of `wrt`, to which nodes are added.
    ///
    /// The cost is that of the nodes that `root` is made of; a few further nodes are added for each. The derivatives are those
    /// of the formula: by a branch that [`select`](Self::select) does not take, they are zero, whatever happens in it. A factor beside the
    /// constant zero counts as absent, although the product is no number where that factor is not finite.
    ///
    /// # Panics
    /// Where a node is not of this graph.
    pub fn gradient(&mut self, root: Id, wrt: &[Id]) -> Vec<Id> {
        let nodes = reachable([root], |id| self.dependencies(id));
        let mut sweep = Sweep::new(self, root, &nodes, wrt);
        nodes.iter().rev().for_each(|id| sweep.pass(*id));
        wrt.iter().map(|x| sweep.result(*x)).collect()
    }

    /// The products of the matrix $\partial g_i / \partial x_j$ with a direction, from the left: $\sum_i d_i \, \partial g_i / \partial x_j$.
    ///
    /// With `grads` the [gradient](Self::gradient) by `wrt`, the matrix is the Hessian, which is symmetric; it is not formed.
    ///
    /// # Panics
    /// Where a node is not of this graph.
    pub fn hessian_vector(&mut self, grads: &[Id], direction: &[Id], wrt: &[Id]) -> Vec<Id> {
        let zero = self.constant(-0.0);
        let pairs = grads.iter().zip(direction);
        let along = pairs.fold(zero, |sum, (g, d)| self.mul_add([*g, *d, sum]));
        self.gradient(along, wrt)
    }

    /// The derivatives $\partial y_i / \partial x_j$ of the results `out` that are not zero throughout, in the order of the pattern, row by row.
    ///
    /// # Panics
    /// Where a node is not of this graph.
    pub fn jacobian(&mut self, out: &[Id], wrt: &[Id]) -> (Pattern, Vec<Id>) {
        let pattern = self.pattern(out, wrt);
        let mut entries = Vec::with_capacity(pattern.entries());
        for (i, y) in out.iter().enumerate() {
            let columns: Vec<Id> = pattern.row(i).iter().map(|j| wrt[*j]).collect();
            entries.extend(self.gradient(*y, &columns));
        }
        (pattern, entries)
    }
}

/// How the root changes with a node.
///
/// `value` has a meaning where `live` is positive alone. Elsewhere no branch that leads here is taken, and it may be no number: it is
/// replaced by zero where it meets other paths, not multiplied by zero.
#[derive(Clone, Copy)]
struct Adjoint {
    value: Id,
    live: Id,
}

/// A backward pass over the nodes that a root is made of.
struct Sweep<'a> {
    graph: &'a mut Graph,
    /// Of the nodes that depend on a variable: what is known of them so far.
    adjoints: HashMap<Id, Option<Adjoint>>,
    zero: Id,
    one: Id,
}

impl<'a> Sweep<'a> {
    fn new(graph: &'a mut Graph, root: Id, nodes: &[Id], wrt: &[Id]) -> Self {
        let mut adjoints: HashMap<Id, Option<Adjoint>> = wrt.iter().map(|x| (*x, None)).collect();
        for id in nodes {
            if graph.dependencies(*id).any(|x| adjoints.contains_key(&x)) {
                adjoints.insert(*id, None);
            }
        }
        let (zero, one) = (graph.constant(0.0), graph.constant(1.0));
        if let Some(adjoint) = adjoints.get_mut(&root) {
            *adjoint = Some(Adjoint {
                value: one,
                live: one,
            });
        }
        Self {
            graph,
            adjoints,
            zero,
            one,
        }
    }

    /// The derivative by a variable.
    fn result(&mut self, x: Id) -> Id {
        match self.adjoints.get(&x) {
            Some(Some(adjoint)) => self.everywhere(*adjoint),
            _ => self.zero,
        }
    }

    /// Hands the adjoint of a node on to those it reads.
    fn pass(&mut self, id: Id) {
        let Some(Some(adjoint)) = self.adjoints.get(&id).copied() else {
            return;
        };
        match self.graph.node(id) {
            Node::Constant(_) | Node::Input(_) | Node::Unary(Unary::Real, _) => {}
            Node::Unary(op, x) => self.pass_unary(adjoint, op, id, x),
            Node::Binary(op, x, y) => self.pass_binary(adjoint, op, id, [x, y]),
            Node::MulAdd([x, a, b]) => {
                self.pass_product(adjoint, x, a);
                self.add(b, adjoint);
            }
            Node::NegMulAdd([x, a, b]) => {
                let negated = self.negated(adjoint);
                self.pass_product(negated, x, a);
                self.add(b, adjoint);
            }
            Node::Select { less, yes, no } => self.pass_choice(adjoint, less, yes, no),
        }
    }

    fn pass_unary(&mut self, adjoint: Adjoint, op: Unary, result: Id, x: Id) {
        if !self.is_active(x) {
            return;
        }
        match op {
            Unary::Neg => {
                let negated = self.negated(adjoint);
                self.add(x, negated);
            }
            Unary::Sqrt => {
                let half = self.graph.constant(0.5);
                let half = self.times(adjoint, half);
                let slope = self.over(half, result);
                self.add(x, slope);
            }
            Unary::Exp => self.add_product(x, adjoint, result),
            Unary::Ln => {
                let slope = self.over(adjoint, x);
                self.add(x, slope);
            }
            Unary::Tanh => {
                let slope = self.graph.neg_mul_add([result, result, self.one]);
                self.add_product(x, adjoint, slope);
            }
            Unary::Sin => {
                let cos = self.graph.unary(Unary::Cos, x);
                self.add_product(x, adjoint, cos);
            }
            Unary::Cos => {
                let sin = self.graph.unary(Unary::Sin, x);
                let negated = self.negated(adjoint);
                self.add_product(x, negated, sin);
            }
            Unary::Real => {}
        }
    }

    fn pass_binary(&mut self, adjoint: Adjoint, op: Binary, result: Id, [x, y]: [Id; 2]) {
        match op {
            Binary::Add => {
                self.add(x, adjoint);
                self.add(y, adjoint);
            }
            Binary::Sub => {
                self.add(x, adjoint);
                let negated = self.negated(adjoint);
                self.add(y, negated);
            }
            Binary::Mul => self.pass_product(adjoint, x, y),
            Binary::Div => {
                let slope = self.over(adjoint, y);
                self.add(x, slope);
                let negated = self.negated(slope);
                self.add_product(y, negated, result);
            }
            Binary::Rem => {
                self.add(x, adjoint);
                // The whole quotient, constant between its jumps.
                let multiple = self.graph.binary(Binary::Sub, x, result);
                let quotient = self.graph.binary(Binary::Div, multiple, y);
                let negated = self.negated(adjoint);
                self.add_product(y, negated, quotient);
            }
            Binary::Atan2 => {
                let square = self.graph.binary(Binary::Mul, x, x);
                let square = self.graph.mul_add([y, y, square]);
                let slope = self.over(adjoint, square);
                self.add_product(x, slope, y);
                let negated = self.negated(slope);
                self.add_product(y, negated, x);
            }
        }
    }

    fn pass_product(&mut self, adjoint: Adjoint, x: Id, y: Id) {
        if x == y {
            let value = self.graph.binary(Binary::Add, adjoint.value, adjoint.value);
            return self.add_product(x, Adjoint { value, ..adjoint }, x);
        }
        self.add_product(x, adjoint, y);
        self.add_product(y, adjoint, x);
    }

    fn pass_choice(&mut self, adjoint: Adjoint, less: [Id; 2], yes: Id, no: Id) {
        for (branch, holds) in [(yes, true), (no, false)] {
            if self.is_active(branch) {
                let (taken, other) = if holds {
                    (adjoint.live, self.zero)
                } else {
                    (self.zero, adjoint.live)
                };
                let live = self.graph.select(less, taken, other);
                self.add(branch, Adjoint { live, ..adjoint });
            }
        }
    }

    fn is_active(&self, x: Id) -> bool {
        self.adjoints.contains_key(&x)
    }

    fn negated(&mut self, x: Adjoint) -> Adjoint {
        let value = self.graph.unary(Unary::Neg, x.value);
        Adjoint { value, ..x }
    }

    fn times(&mut self, x: Adjoint, factor: Id) -> Adjoint {
        let value = self.graph.binary(Binary::Mul, x.value, factor);
        Adjoint { value, ..x }
    }

    fn over(&mut self, x: Adjoint, divisor: Id) -> Adjoint {
        let value = self.graph.binary(Binary::Div, x.value, divisor);
        Adjoint { value, ..x }
    }

    /// Adds the product with a slope to the adjoint of `x`.
    fn add_product(&mut self, x: Id, adjoint: Adjoint, slope: Id) {
        if self.graph.is_zero(slope) {
            return;
        }
        match self.adjoints.get(&x).copied() {
            None => {}
            Some(Some(known)) if known.live == adjoint.live => {
                let value = self.graph.mul_add([adjoint.value, slope, known.value]);
                self.adjoints.insert(x, Some(Adjoint { value, ..known }));
            }
            _ => {
                let product = self.times(adjoint, slope);
                self.add(x, product);
            }
        }
    }

    /// Adds to the adjoint of `x`.
    fn add(&mut self, x: Id, adjoint: Adjoint) {
        if !self.is_active(x) || self.graph.is_zero(adjoint.value) {
            return;
        }
        let sum = match self.adjoints.get(&x).copied().flatten() {
            None => adjoint,
            Some(known) => self.sum(known, adjoint),
        };
        self.adjoints.insert(x, Some(sum));
    }

    fn sum(&mut self, x: Adjoint, y: Adjoint) -> Adjoint {
        let (values, live) = if x.live == y.live {
            ([x.value, y.value], x.live)
        } else {
            let values = [self.everywhere(x), self.everywhere(y)];
            (values, self.either(x.live, y.live))
        };
        let value = self.graph.binary(Binary::Add, values[0], values[1]);
        Adjoint { value, live }
    }

    /// The value where it has a meaning, and zero elsewhere.
    fn everywhere(&mut self, x: Adjoint) -> Id {
        self.graph.select([self.zero, x.live], x.value, self.zero)
    }

    fn either(&mut self, x: Id, y: Id) -> Id {
        if x == self.one || y == self.one {
            return self.one;
        }
        self.graph.select([self.zero, x], self.one, y)
    }
}

#[cfg(test)]
mod tests {
    use lie::Scalar;

    use crate::walk::visits;
    use crate::{Graph, Program, record};

    /// A chain of `n` masses: each is tied to the next, and its inertia depends on its place.
    fn chain<S: Scalar>(x: &[S], v: &[S]) -> S {
        let half = S::from_f64(0.5);
        let kinetic = x.iter().zip(v).fold(S::zero(), |sum, (x, v)| {
            sum + *v * *v * (S::one() + *x * *x)
        });
        let stretch = x
            .windows(2)
            .fold(S::zero(), |sum, x| sum + Scalar::cos(x[1] - x[0]));
        kinetic * half + stretch
    }

    /// Nodes of the graph, nodes visited on the way and instructions, with all derivatives that mechanics asks for.
    fn costs(n: usize) -> [usize; 3] {
        let mut graph = Graph::default();
        let mut instructions = 0;
        let visited = visits(|| {
            graph = record(2 * n, |x| vec![chain(&x[..n], &x[n..])]).unwrap();
            let inputs = graph.inputs();
            let mut wanted = graph.gradient(graph.outputs()[0], &inputs);
            let momenta = wanted[n..].to_vec();
            let (pattern, masses) = graph.jacobian(&momenta, &inputs[n..]);
            assert_eq!(pattern.entries(), n);
            let products = graph.hessian_vector(&momenta, &inputs[..n], &inputs);
            wanted.extend(masses.into_iter().chain(products));
            instructions = Program::new(&graph, &wanted).instructions();
        });
        [graph.len(), visited, instructions]
    }

    /// Twice the size costs twice as much, by counting.
    #[test]
    fn the_cost_is_linear_in_the_size() {
        let [few, some, many] = [50, 100, 200].map(costs);
        for (k, few) in few.into_iter().enumerate() {
            assert!(
                many[k] - some[k] <= 2 * (some[k] - few) + 2,
                "{few} {} {}",
                some[k],
                many[k]
            );
            assert!(few > 0);
        }
    }

    /// A gradient costs a few values, however many variables there are.
    #[test]
    fn a_gradient_costs_a_few_values() {
        let n = 100;
        let mut graph = record(2 * n, |x| vec![chain(&x[..n], &x[n..])]).unwrap();
        let (root, inputs) = (graph.outputs().to_vec(), graph.inputs());
        let value = Program::new(&graph, &root).instructions();
        let slopes = graph.gradient(root[0], &inputs);
        let gradient = Program::new(&graph, &slopes).instructions();
        assert!(gradient <= 3 * value, "{gradient} {value}");
    }

    #[test]
    fn the_square_has_the_slope_two_x() {
        let mut graph = record(1, |x| vec![x[0] * x[0]]).unwrap();
        let slope = graph.gradient(graph.outputs()[0], &graph.inputs());
        assert_eq!(Program::new(&graph, &slope).instructions(), 1);
    }
}
