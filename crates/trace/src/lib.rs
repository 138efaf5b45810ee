//! Formulas recorded once: their graph, exact derivatives, and programs that compute them over any scalar.
//!
//! A formula is written over [`lie::Scalar`]. [`record`] runs it once over [`Traced`] numbers, which have no value and write down
//! what is done with them. The [`Graph`] that comes of it is [differentiated](Graph::gradient) in reverse, so that a gradient costs a few
//! values however many variables there are. A [`Program`] computes any of its numbers over doubles, SIMD lanes or dual numbers.
//!
//! ```
//! use lie::Scalar;
//! use trace::{Degree, Program};
//!
//! /// The Lagrangian of a double pendulum, by two angles and their rates: masses of 1 kg, rods of 1 m, gravity 9.81 N/kg.
//! fn lagrangian<S: Scalar>([a, b, u, v]: [S; 4]) -> S {
//!     let kinetic = u * u + v * v * S::from_f64(0.5) + u * v * (a - b).cos();
//!     kinetic + (a.cos() + a.cos() + b.cos()) * S::from_f64(9.81)
//! }
//!
//! let mut graph = trace::record(4, |x| vec![lagrangian([x[0], x[1], x[2], x[3]])])?;
//! let (value, x) = (graph.outputs()[0], graph.inputs());
//! // The rates enter quadratically: the mass matrix depends on the angles alone.
//! assert_eq!(graph.degree(value, &x[2..]), Degree::Quadratic);
//!
//! // The value, the momenta and the forces.
//! let mut wanted = graph.gradient(value, &x);
//! wanted.push(value);
//! let program = Program::new(&graph, &wanted);
//! let (mut memory, mut out) = (program.memory(), [0.0; 5]);
//! program.run(&mut memory, &[0.3, 0.3, 1.0, 2.0], &mut out)?;
//! assert_eq!(out[4], lagrangian([0.3, 0.3, 1.0, 2.0]));
//! assert_eq!(out[2..4], [4.0, 3.0]);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # What a formula may do
//! * It chooses by [`less`](lie::Scalar::less) and [`select`](lie::Scalar::select). Both branches are computed, and only the one taken counts.
//! * It may not look at a value: `==`, [`is_zero`](num_traits::Zero::is_zero) and [`magnitude`](lie::Scalar::magnitude) refuse the
//!   recording, with the place in the source. So do functions of the library that return a `Result` by a value, such as a logarithm near its cut.
//! * What it reads from elsewhere is a constant. Time and parameters must be inputs if they are to change.
//! * Its loops are unrolled: it is recorded for one size, and again for another.

#![forbid(unsafe_code)]

mod build;
mod call;
mod degree;
mod error;
mod gradient;
mod graph;
mod instruction;
mod lower;
mod node;
mod pattern;
mod program;
mod recording;
mod schedule;
mod slots;
mod traced;
mod walk;

pub use degree::Degree;
pub use error::{GraphError, TraceError, WrongLength};
pub use graph::Graph;
pub use node::{Binary, Bits, Id, Node, Unary};
pub use pattern::Pattern;
pub use program::Program;
pub use traced::{Comparison, Traced, record};

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
