//! Experiments on integrators: what a structure-preserving method is compared
//! with, and how the comparison is drawn.
//!
//! * [`problems`] — classical test problems, each with its solution and its
//!   conserved quantities;
//! * [`on_group`] — an independent reference for any continuous system on a
//!   Lie group;
//! * [`methods`] — the integrators of the fish chain's model, by name;
//! * [`accuracy`] — a scene's integrator for a wanted accuracy;
//! * [`baseline`] — the non-geometric competitor: adaptive explicit
//!   Runge–Kutta, also good as a tight-tolerance reference solution;
//! * [`dop853`] — the same pair 8(5,3), inlined for the bodies' own equations;
//! * [`explicit`] — Runge–Kutta methods of a fixed step, on the group and on
//!   raw matrices;
//! * [`contender`] — methods and baselines under one name each, run in one way;
//! * [`work_precision`] — what each of them costs for which error;
//! * [`stability`] — in which steps each of them fails, how, and at which wall;
//! * [`watch`] — how far a run strays from what the motion keeps;
//! * [`survey`] — order, energy, momentum maps and symplecticity of any method
//!   on a test problem, and methods that are wrong on purpose;

pub mod accuracy;
pub mod baseline;
pub mod contender;
pub mod dop853;
pub mod explicit;
pub mod methods;
pub mod on_group;
pub mod problems;
pub mod raw;
pub mod stability;
pub mod survey;
pub mod watch;
pub mod work_precision;
