//! Experiments on integrators: what a structure-preserving method is compared
//! with, and how the comparison is drawn.
//!
//! * [`problems`] — classical test problems, each with its solution and its
//!   conserved quantities;
//! * [`baseline`] — explicit competitors, adaptive and of a fixed step, on raw
//!   matrices and on the group, and an independent reference;
//! * [`contender`] — methods and baselines under one name each, run in one way;
//! * [`work_precision`] — what each of them costs for which error;
//! * [`stability`] — in which steps each of them fails, how, and at which wall;
//! * [`survey`] — order, energy, momentum maps and symplecticity of any method
//!   on a test problem, and methods that are wrong on purpose;

pub mod baseline;
pub mod contender;
pub mod problems;
pub mod stability;
pub mod survey;
pub mod work_precision;

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
