//! Experiments on integrators: what a structure-preserving method is compared
//! with, and how the comparison is drawn.
//!
//! * [`baseline`] — the non-geometric competitor: adaptive explicit
//!   Runge–Kutta, also good as a tight-tolerance reference solution;
//! * [`figure`] — grids of line charts, written as SVG and PNG without any
//!   font of the system.

pub mod baseline;
pub mod figure;
pub mod raw;
