//! Lagrangians recorded from Python, and what runs them.

mod elements;
mod native;
mod recorded;
mod run;
mod tracer;

pub use native::{NativeSystem, exp};
pub use tracer::{Comparison, NativeFormula, NativeRecording, Tracer};
