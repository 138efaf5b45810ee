//! Runs to look at: a page that moves in any browser, a scene for editors, arrays for NumPy.
//!
//! ```
//! use articulated_fluid::{Scene, scene};
//! use sim::{Plan, Schedule, Simulation};
//! use view::{Motion, Recording, page};
//!
//! let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
//! let plan = Plan { until: 1.0, schedule: Schedule::Seconds(0.1), ..Plan::default() };
//! let mut simulation = Simulation::new(&scene, &plan)?;
//! let mut recording = Recording::new(simulation.model());
//! for frame in simulation.by_ref() {
//!     recording.add(&frame?);
//! }
//! let motion = Motion { name: "lgvi", facts: "", recording: &recording };
//! let text = page(&scene, "a boat", &[motion]);
//! assert!(text.starts_with("<!doctype html>") && text.contains("a boat"));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! | what | where |
//! |---|---|
//! | what is seen of a run, thinned | [`Recording`] |
//! | a page, with one motion or two | [`page`] |
//! | a glTF file, binary | [`glb`] |
//! | a NumPy archive | [`Arrays`] |

mod arrays;
mod charts;
mod colours;
mod gltf;
mod motion;
mod npz;
mod pack;
mod page;
mod recording;
mod solid;

pub use arrays::Arrays;
pub use gltf::glb;
pub use motion::{Motion, facts};
pub use npz::NpzError;
pub use page::page;
pub use recording::{MOST_FRAMES, Recording};

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
