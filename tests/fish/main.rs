//! The paper's fish chain under every method: one program, for the methods on this model are compiled once.

mod allocation;
mod common;
mod conservation;
mod forms;
mod gauss;
mod laws;
mod paper;
