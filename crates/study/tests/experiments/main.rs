//! The baseline, the test problems, and what the methods show on systems: one program, for what they share is
//! compiled once.

mod baseline;
mod common;
mod contenders;
mod hard;
mod laws;
mod methods;
mod problems;
mod scales;
mod stability;
mod systems;
mod views;
mod work_precision;
