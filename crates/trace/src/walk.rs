//! The part of a graph that a result is made of.

use std::collections::HashSet;

use crate::graph::Graph;
use crate::node::{Binary, Id, Node};

/// The nodes that `roots` are made of, roots included, each after those it reads.
///
/// `next` gives the nodes that count as read. The cost is that of the nodes found, not of the whole graph.
pub(crate) fn reachable<I: Iterator<Item = Id>>(
    roots: impl IntoIterator<Item = Id>,
    next: impl Fn(Id) -> I,
) -> Vec<Id> {
    let (mut found, mut open) = (HashSet::new(), Vec::from_iter(roots));
    while let Some(id) = open.pop() {
        count_visit();
        if found.insert(id) {
            open.extend(next(id));
        }
    }
    let mut found = Vec::from_iter(found);
    found.sort_unstable();
    found
}

/// The same, each node immediately before it is first needed, for the roots one after the other.
///
/// So numbers that belong together are computed together, and few are alive at a time.
pub(crate) fn as_needed(graph: &Graph, roots: impl IntoIterator<Item = Id>) -> Vec<Id> {
    let (mut order, mut found) = (Vec::new(), HashSet::new());
    let mut open = Vec::new();
    for root in roots {
        open.push((root, false));
        while let Some((id, complete)) = open.pop() {
            if complete {
                order.push(id);
            } else if found.insert(id) {
                open.push((id, true));
                let operands: Vec<Id> = graph.node(id).operands().collect();
                open.extend(operands.into_iter().rev().map(|x| (x, false)));
            }
        }
    }
    order
}

impl Graph {
    /// The operands of a number that it depends on: a factor beside the constant zero is none of them.
    ///
    /// The derivative by such a factor is zero, although the number is not where the factor is not finite.
    pub(crate) fn dependencies(&self, id: Id) -> impl Iterator<Item = Id> {
        let node = self.node(id);
        let hidden = match node {
            Node::Binary(Binary::Mul, x, y)
            | Node::MulAdd([x, y, _])
            | Node::NegMulAdd([x, y, _])
                if self.is_zero(x) || self.is_zero(y) =>
            {
                2
            }
            _ => 0,
        };
        node.operands().skip(hidden)
    }
}

#[cfg(not(test))]
fn count_visit() {}

#[cfg(test)]
pub(crate) use counting::{count_visit, visits};

#[cfg(test)]
mod counting {
    use std::cell::Cell;

    thread_local!(static VISITS: Cell<usize> = const { Cell::new(0) });

    pub(crate) fn count_visit() {
        VISITS.set(VISITS.get() + 1);
    }

    /// The visits of nodes that `job` makes on this thread.
    pub(crate) fn visits(job: impl FnOnce()) -> usize {
        VISITS.set(0);
        job();
        VISITS.get()
    }
}
