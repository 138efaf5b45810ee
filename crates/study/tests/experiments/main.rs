//! The baselines, the test problems, and what the methods show on systems: one program, for what they share is
//! compiled once.

mod baseline;
mod common;
mod contenders;
mod hard;
mod laws;
mod problems;
mod scales;
mod stability;
mod systems;
mod tableaux;
mod views;
mod work_precision;
