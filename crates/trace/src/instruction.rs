//! The instructions of a program.

use crate::node::{Binary, Unary};

/// What an instruction does; those in inner loops by themselves, the costly ones by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Op {
    /// The input of index `args[0]`.
    Load,
    /// The output of index `to`.
    Store,
    Add,
    Sub,
    Mul,
    Div,
    Neg,
    MulAdd,
    NegMulAdd,
    Select,
    /// The product with the constant of index `args[1]`.
    Times,
    /// The sine, and the cosine to `args[1]`.
    SinCos,
    Unary(Unary),
    Binary(Binary),
}

/// One instruction: an operation, where its result goes and what it reads.
///
/// The numbers are those of nodes before slots are given out, and of slots after.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Instruction {
    pub(crate) op: Op,
    pub(crate) to: u32,
    pub(crate) args: [u32; 4],
}

impl Instruction {
    /// What it reads.
    pub(crate) fn reads(&self) -> &[u32] {
        &self.args[..self.arity()]
    }

    /// The same with what it reads renamed.
    pub(crate) fn renamed(mut self, name: impl Fn(u32) -> u32) -> Self {
        let arity = self.arity();
        self.args[..arity].iter_mut().for_each(|x| *x = name(*x));
        self
    }

    /// The name of its result, if it has one.
    pub(crate) fn result(&mut self) -> Option<&mut u32> {
        (self.op != Op::Store).then_some(&mut self.to)
    }

    /// A second place that it writes.
    pub(crate) fn second(&mut self) -> Option<&mut u32> {
        (self.op == Op::SinCos).then_some(&mut self.args[1])
    }

    /// All its places, one after the other: where the result goes, what it reads, and what else it names.
    pub(crate) fn places(&self) -> impl Iterator<Item = u32> {
        let named = match self.op {
            Op::Load => 1,
            Op::Times | Op::SinCos => 2,
            _ => self.arity(),
        };
        core::iter::once(self.to).chain(self.args.into_iter().take(named))
    }

    /// Whether it is more than a number taken from one place to another.
    pub(crate) fn computes(&self) -> bool {
        !matches!(self.op, Op::Load | Op::Store)
    }

    fn arity(&self) -> usize {
        match self.op {
            Op::Load => 0,
            Op::Store | Op::Neg | Op::Times | Op::SinCos | Op::Unary(_) => 1,
            Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Binary(_) => 2,
            Op::MulAdd | Op::NegMulAdd => 3,
            Op::Select => 4,
        }
    }
}
