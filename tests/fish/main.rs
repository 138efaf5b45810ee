//! The paper's fish chain under every method: one program, for the methods on this model are compiled once.

mod allocation;
#[path = "../../crates/articulated-fluid/tests/model/by_duals.rs"]
mod by_duals;
mod common;
mod conservation;
mod forms;
mod gauss;
mod laws;
#[path = "../../crates/articulated-fluid/tests/model/on_se3.rs"]
mod on_se3;
mod paper;
mod value_only;
