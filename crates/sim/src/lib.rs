//! Runs of scenes: from a scene, a method or an accuracy, a time and a schedule to frames and a report.
//!
//! ```
//! use articulated_fluid::{Scene, scene};
//! use sim::{Method, Plan, Schedule, Simulation};
//!
//! let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
//! let method: Method = "gauss-4".parse()?;
//! let plan = Plan { choice: method.into(), until: 2.0, schedule: Schedule::Seconds(0.5), ..Plan::default() };
//! let mut simulation = Simulation::new(&scene, &plan)?;
//! for frame in simulation.by_ref() {
//!     let frame = frame?;
//!     println!("{} s: head at {:?} m, {} J", frame.t(), frame.position().0, frame.sample.energy);
//! }
//! let report = simulation.report();
//! assert_eq!((report.samples, report.steps), (5, 20));
//! assert!(report.energy_error_max_relative < Some(1e-8));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! | what | where |
//! |---|---|
//! | a run of a scene, from frame to frame | [`Simulation`], by a [`Plan`] |
//! | any integrator on its way | [`Run`] |
//! | the integrators by name | [`Method`] |
//! | a method, or an accuracy that one is found for | [`Choice`] |
//! | what is known of an accuracy | [`Checked`] |
//! | when there are steps, and frames | [`Clock`], [`Schedule`] |
//! | what is seen at one time | [`Frame`], [`Sample`] |
//! | what drives do | [`DriveSample`], [`DriveReport`] |
//! | how far a run strays from what the motion keeps | [`Watch`] |
//! | what a run comes to | [`Report`] |
//! | a trajectory as CSV | [`Table`], [`COLUMNS`](table::COLUMNS) |
//! | a file that is whole or not there | [`AtomicFile`](file::AtomicFile) |

mod accuracy;

mod choice;
mod clock;
mod companion;
mod dense;
mod distance;
mod drives;
mod error;
mod estimate;
pub mod file;
mod frame;
pub mod method;
pub mod number;
mod report;
mod run;
mod schedule;
mod scout;
mod simulation;
pub mod table;
mod watch;

pub use accuracy::Checked;
pub use choice::{Choice, Chosen};
pub use clock::Clock;
pub use distance::distance;
pub use drives::DriveReport;
pub use error::{LARGEST_ACCURACY, MAX_STEPS, SimError};
pub use frame::{DriveSample, Frame, Sample};
pub use method::{BoxedIntegrator, Method, UnknownMethod};
pub use report::Report;
pub use run::{Cost, Run, See};
pub use schedule::{Due, Schedule};
pub use simulation::{CHUNK, Plan, Simulation, check_told};
pub use table::Table;
pub use watch::Watch;

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
