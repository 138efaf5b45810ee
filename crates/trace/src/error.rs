//! What can go wrong.

use core::panic::Location;

use thiserror::Error;

/// Why a formula could not be recorded.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TraceError {
    /// The formula asked for the value of a number that is not a constant, to branch on it say.
    ///
    /// The branch would be frozen as it is for one sample, and wrong for others.
    #[error(
        "the formula asks for the value of a recorded number (`{operation}` at {at}); choose with `Scalar::less` and `Scalar::select` instead"
    )]
    Branch {
        /// What asked for it.
        operation: &'static str,
        /// Where in the source.
        at: &'static Location<'static>,
    },
    /// The formula calls a function that is known by its derivatives alone at a number that is not a constant.
    ///
    /// [`Scalar::smooth`](lie::Scalar::smooth) borrows the function, so that a graph cannot keep it.
    #[error(
        "`Scalar::smooth` of a recorded number cannot be recorded (at {at}); write the function as a formula, or leave this system untraced"
    )]
    Smooth {
        /// Where in the source.
        at: &'static Location<'static>,
    },
    /// The formula uses a number of another recording: of one that has ended, is on another thread or is outside this one.
    #[error(
        "the formula uses a number of another recording (at {at}); use its inputs and constants alone"
    )]
    Foreign {
        /// Where in the source.
        at: &'static Location<'static>,
    },
}

/// Why data is not a graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum GraphError {
    /// The first nodes are not the inputs, in order.
    #[error("node {node} should be input {node}: the {inputs} inputs come first, in order")]
    Inputs {
        /// The node.
        node: usize,
        /// How many inputs there are.
        inputs: usize,
    },
    /// A node reads one that does not come before it.
    #[error("node {node} reads node {operand}: it may only read nodes before it")]
    Order {
        /// The node.
        node: usize,
        /// What it reads.
        operand: usize,
    },
    /// A node is there twice.
    #[error("node {node} is the same as node {first}: each is to be there once")]
    Twice {
        /// The node.
        node: usize,
        /// Where it was before.
        first: usize,
    },
    /// An output is no node.
    #[error("output {output} is node {node}, and there are {nodes} nodes")]
    Output {
        /// The index of the output.
        output: usize,
        /// The node it names.
        node: usize,
        /// How many there are.
        nodes: usize,
    },
}

/// A program was given slices that do not fit it.
///
/// A formula over groups of run-time size is recorded for one size: record it again when the size changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "the program takes {expected} {what}, and was given {found}; record the formula again where its size has changed"
)]
pub struct WrongLength {
    /// Which slice.
    pub what: &'static str,
    /// The length that fits.
    pub expected: usize,
    /// Its length.
    pub found: usize,
}

impl TraceError {
    /// Where in the source it was noticed; where inlined code of a library notices it, that is there.
    pub fn at(&self) -> &'static Location<'static> {
        match self {
            Self::Branch { at, .. } | Self::Smooth { at } | Self::Foreign { at } => at,
        }
    }
}
