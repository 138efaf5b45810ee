//! Work against precision: what each [`Contender`](crate::contender::Contender) costs for which error, on a scene of one's own.
//!
//! A [`Sweep`] runs one contender from long steps, or loose tolerances, to short ones. Errors are the largest over the run at
//! [`SAMPLES`] times, never the endpoint's, against a [`Reference`] that two methods have found independently. Below the difference of
//! these no error is known. Time is that of stepping alone, the least of several runs; beside it stand counts, which
//! no other program on the machine disturbs. What fails [stays](Point::outcome), with its cause.
//!
//! ```
//! use articulated_fluid::{Scene, scene};
//! use study::contender::{Contender, Problem};
//! use study::work_precision::{Reference, Sweep, Timing};
//!
//! let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
//! let problem = Problem { model: scene.model()?, start: scene.initial_state()?, until: 1.0 };
//! let reference = Reference::new(&problem)?;
//! let sweep = Sweep::new("gauss-4".parse()?, &problem, &reference, Timing::ONCE);
//! let best = sweep.filter_map(|point| Some(point.outcome.ok()?.errors.attitude));
//! assert!(best.fold(f64::MAX, f64::min) < 1e-9);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod cheapest;
mod errors;
mod horizon;
mod picture;
mod reference;
mod sweep;
mod table;
mod timing;

pub use cheapest::{Choice, cheapest};
pub use errors::Errors;
pub(crate) use errors::apart;
pub use horizon::Horizon;
pub use picture::picture;
pub(crate) use reference::fastest_rate;
pub use reference::{Reference, UnknownReference};
pub use sweep::{Curve, MEANINGFUL, Measured, Point, Sweep};
pub use table::csv;
pub(crate) use table::{optional, quoted};
pub use timing::Timing;

/// Intervals between the times at which a run is looked at.
pub const SAMPLES: u64 = 200;
