//! Measuring a method on a test problem: order, energy, momentum maps, symplecticity.
//!
//! | what | call |
//! |---|---|
//! | a method whose type is forgotten, so that measurements are compiled once for each group | [`Method`] |
//! | the error against the exact solution as the step shrinks | [`convergence`] |
//! | energy, momentum maps and residuals of a long run | [`long_run`] |
//! | what a straight line does best | [`slope`] |
//! | motions worth measuring | [`systems`] |
//! | methods that are wrong on purpose | [`wrong`] |
//!
//! ```
//! use dvi::Quadrature;
//! use lie::Cayley;
//! use study::survey::{self, systems, variational};
//!
//! let top = systems::heavy_top()?;
//! let mut method = variational::<_, Cayley>(top.lagrangian, Quadrature::Midpoint);
//! let run = survey::long_run(&top, &mut method, top.time / 100.0, 1000, 7)?;
//! assert!(run.band < 1e-2 && run.momenta.iter().all(|change| *change < 1e-12));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod convergence;
mod long_run;
mod method;
pub mod systems;
pub mod wrong;

pub use convergence::{Convergence, SurveyError, convergence};
pub use long_run::{LongRun, long_run};
pub use method::{Method, composition, gauss, variational};

/// The slope of the line through the points, by least squares; not a number for fewer than two.
///
/// ```
/// assert_eq!(study::survey::slope(&[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)]), 2.0);
/// ```
#[must_use]
pub fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |part: fn(&(f64, f64)) -> f64| points.iter().map(part).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let (xy, xx) = points.iter().fold((0.0, 0.0), |(xy, xx), p| {
        (xy + (p.0 - x) * (p.1 - y), xx + (p.0 - x).powi(2))
    });
    xy / xx
}
