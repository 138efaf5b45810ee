//! Operations on the numbers of a graph, simplified where that changes no bit of any result.

use crate::graph::Graph;
use crate::node::{Binary, Id, Node, Unary};

/// Each rule holds for every double, infinities, NaN and signed zeros included. So $0 x$ is kept: it is not zero where $x$ is not finite;
/// and $x + 0$ is kept: it is $+0$ where $x = -0$.
impl Graph {
    /// A function of one number.
    pub fn unary(&mut self, op: Unary, x: Id) -> Id {
        match (op, self.node(x)) {
            (_, Node::Constant(c)) => self.constant(op.apply(c.number())),
            (Unary::Neg, Node::Unary(Unary::Neg, inner)) => inner,
            (Unary::Real, Node::Unary(Unary::Real, _)) => x,
            _ => self.intern(Node::Unary(op, x)),
        }
    }

    /// A function of two numbers.
    pub fn binary(&mut self, op: Binary, x: Id, y: Id) -> Id {
        if let (Some(a), Some(b)) = (self.as_constant(x), self.as_constant(y)) {
            return self.constant(op.apply(a, b));
        }
        if let Some(simpler) = self.simplify(op, x, y) {
            return simpler;
        }
        // One order for what may be exchanged, so that equal numbers are one node.
        let (x, y) = if op.commutes() && y < x {
            (y, x)
        } else {
            (x, y)
        };
        self.intern(Node::Binary(op, x, y))
    }

    /// $x a + b$.
    pub fn mul_add(&mut self, [x, a, b]: [Id; 3]) -> Id {
        if let Some(product) = self.exact_product(x, a) {
            return self.binary(Binary::Add, product, b);
        }
        if self.is(b, -0.0) {
            return self.binary(Binary::Mul, x, a);
        }
        self.intern(Node::MulAdd([x.min(a), x.max(a), b]))
    }

    /// $b - x a$.
    pub fn neg_mul_add(&mut self, [x, a, b]: [Id; 3]) -> Id {
        if let Some(product) = self.exact_product(x, a) {
            return self.binary(Binary::Sub, b, product);
        }
        self.intern(Node::NegMulAdd([x.min(a), x.max(a), b]))
    }

    /// `yes` where the first of `less` is below the second, `no` elsewhere.
    pub fn select(&mut self, less: [Id; 2], yes: Id, no: Id) -> Id {
        if yes == no {
            return yes;
        }
        if let [Some(l), Some(r)] = less.map(|x| self.as_constant(x)) {
            return if l < r { yes } else { no };
        }
        if let Some((less, same)) = self.as_indicator(less) {
            let (yes, no) = if same { (yes, no) } else { (no, yes) };
            return self.select(less, yes, no);
        }
        let (yes, no) = (self.taken(less, yes, true), self.taken(less, no, false));
        if yes == no {
            return yes;
        }
        self.intern(Node::Select { less, yes, no })
    }

    fn simplify(&mut self, op: Binary, x: Id, y: Id) -> Option<Id> {
        match op {
            Binary::Add => self.simplify_sum(x, y).or_else(|| self.simplify_sum(y, x)),
            Binary::Sub if self.is(y, 0.0) => Some(x),
            Binary::Sub => {
                let negated = self.negated(y)?;
                Some(self.binary(Binary::Add, x, negated))
            }
            Binary::Mul => self.unit_product(x, y).or_else(|| self.unit_product(y, x)),
            Binary::Div if self.is(y, 1.0) => Some(x),
            Binary::Div if self.is(y, -1.0) => Some(self.unary(Unary::Neg, x)),
            _ => None,
        }
    }

    /// $x + (-0) = x$ and $x + (-y) = x - y$.
    fn simplify_sum(&mut self, x: Id, y: Id) -> Option<Id> {
        if self.is(y, -0.0) {
            return Some(x);
        }
        let negated = self.negated(y)?;
        Some(self.binary(Binary::Sub, x, negated))
    }

    /// $x \cdot 1$ and $x \cdot (-1)$.
    fn unit_product(&mut self, x: Id, y: Id) -> Option<Id> {
        if self.is(y, 1.0) {
            return Some(x);
        }
        self.is(y, -1.0).then(|| self.unary(Unary::Neg, x))
    }

    /// A product that is rounded nowhere, so that it makes no difference whether it is fused with a sum.
    fn exact_product(&mut self, x: Id, a: Id) -> Option<Id> {
        if let (Some(x), Some(a)) = (self.as_constant(x), self.as_constant(a)) {
            let product = x * a;
            return (x.mul_add(a, -product) == 0.0).then(|| self.constant(product));
        }
        self.unit_product(x, a).or_else(|| self.unit_product(a, x))
    }

    fn negated(&self, x: Id) -> Option<Id> {
        match self.node(x) {
            Node::Unary(Unary::Neg, inner) => Some(inner),
            _ => None,
        }
    }

    /// The comparison that $0 < y$ repeats where $y$ is one or zero by it, and whether it is one where it holds.
    fn as_indicator(&self, [zero, y]: [Id; 2]) -> Option<([Id; 2], bool)> {
        let Node::Select { less, yes, no } = self.node(y) else {
            return None;
        };
        let is = |id, x| self.as_constant(id) == Some(x);
        match is(zero, 0.0) {
            true if is(yes, 1.0) && is(no, 0.0) => Some((less, true)),
            true if is(yes, 0.0) && is(no, 1.0) => Some((less, false)),
            _ => None,
        }
    }

    /// What `x` is where it is known how `compared` comes out.
    fn taken(&self, compared: [Id; 2], x: Id, holds: bool) -> Id {
        match self.node(x) {
            Node::Select { less, yes, no } if less == compared => {
                if holds {
                    yes
                } else {
                    no
                }
            }
            _ => x,
        }
    }

    /// Whether `x` is this constant, to the bit.
    pub(crate) fn is(&self, x: Id, constant: f64) -> bool {
        self.as_constant(x)
            .is_some_and(|c| c.to_bits() == constant.to_bits())
    }

    /// Whether `x` is the constant zero, of either sign.
    pub(crate) fn is_zero(&self, x: Id) -> bool {
        self.as_constant(x) == Some(0.0)
    }
}
