//! The nodes of a graph: one number each, by an operation on earlier ones.

use lie::Scalar;
use serde::{Deserialize, Serialize};

/// A node of a [`Graph`](crate::Graph): its place in the graph that made it.
///
/// In another graph it means another number, or none: a method given such a place may panic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Id(pub(crate) u32);

impl Id {
    /// The place as an index.
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A constant, told from others by its bits: $0$ and $-0$ are two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Bits(u64);

impl Bits {
    pub(crate) fn of(x: f64) -> Self {
        Self(x.to_bits())
    }

    /// The number.
    pub fn number(self) -> f64 {
        f64::from_bits(self.0)
    }
}

/// A function of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Unary {
    /// $-x$.
    Neg,
    /// $\sqrt x$.
    Sqrt,
    /// $e^x$.
    Exp,
    /// $\ln x$.
    Ln,
    /// $\tanh x$.
    Tanh,
    /// $\sin x$.
    Sin,
    /// $\cos x$.
    Cos,
    /// $x$ as a constant under differentiation.
    Real,
}

impl Unary {
    /// Its value at `x`.
    #[inline(always)]
    pub fn apply<S: Scalar>(self, x: S) -> S {
        match self {
            Self::Neg => -x,
            Self::Sqrt => x.sqrt(),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Tanh => x.tanh(),
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Real => S::from_real(x.real()),
        }
    }
}

/// A function of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Binary {
    /// $x + y$.
    Add,
    /// $x - y$.
    Sub,
    /// $x y$.
    Mul,
    /// $x / y$.
    Div,
    /// The rest of $x / y$, with the sign of $x$.
    Rem,
    /// The angle of the point $(y, x)$: that of [`Scalar::atan2`], called on $x$.
    Atan2,
}

impl Binary {
    /// Its value at `x` and `y`.
    #[inline(always)]
    pub fn apply<S: Scalar>(self, x: S, y: S) -> S {
        match self {
            Self::Add => x + y,
            Self::Sub => x - y,
            Self::Mul => x * y,
            Self::Div => x / y,
            Self::Rem => x % y,
            Self::Atan2 => x.atan2(y),
        }
    }

    /// Whether $x$ and $y$ may change places.
    pub(crate) fn commutes(self) -> bool {
        matches!(self, Self::Add | Self::Mul)
    }
}

/// How a number comes from earlier ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Node {
    /// A constant.
    Constant(Bits),
    /// The input of this index.
    Input(u32),
    /// A function of one number.
    Unary(Unary, Id),
    /// A function of two numbers.
    Binary(Binary, Id, Id),
    /// $x a + b$, by [`Scalar::mul_add`].
    MulAdd([Id; 3]),
    /// $b - x a$, by [`Scalar::neg_mul_add`].
    NegMulAdd([Id; 3]),
    /// `yes` where the first of `less` is below the second, `no` elsewhere.
    Select {
        /// The two that are compared.
        less: [Id; 2],
        /// Taken where the comparison holds.
        yes: Id,
        /// Taken elsewhere, and where a number compared is not one.
        no: Id,
    },
}

impl Node {
    /// The nodes that it reads, in order.
    pub fn operands(self) -> impl Iterator<Item = Id> {
        let none = Id(0);
        let (all, count) = match self {
            Self::Constant(_) | Self::Input(_) => ([none; 4], 0),
            Self::Unary(_, x) => ([x, none, none, none], 1),
            Self::Binary(_, x, y) => ([x, y, none, none], 2),
            Self::MulAdd([x, a, b]) | Self::NegMulAdd([x, a, b]) => ([x, a, b, none], 3),
            Self::Select {
                less: [l, r],
                yes,
                no,
            } => ([l, r, yes, no], 4),
        };
        all.into_iter().take(count)
    }
}
