//! Where methods fail: every method in steps of every size, over a parameter of a scene, for a long time.
//!
//! A [`Map`] runs a [`Grid`] of cells side by side. Each is a method in steps of one size $h$ on the scene at one value of a [`Parameter`].
//! The map says of each which [`Class`] it is of. The thresholds are the constants here: a run must keep the energy within a
//! [band](ENERGY_BAND) and without [drift](ENERGY_DRIFT), the [momenta](MOMENTUM), and the [group](GROUP).
//!
//! # Silently wrong
//! A run may keep all of that and still be another motion. A rigid body that turns steadily about an axis keeps its energy and its
//! momentum at *any* rate of its attitude. So does a step equation with two roots, at the second of them. A chaotic motion can be
//! compared with a reference over a short time only, and a method of low order in long steps is inaccurate without being wrong. So the
//! comparison is made 32 times over the run, each time anew from the *method's own* state. It takes a short window: one step, or twice as
//! many and so on, until the motion has turned a body by half a radian. An attitude that is off by a [radian](WRONG) at its end is off by
//! more than the motion itself. Where a single step turns further, a step that is so wrong does not even tell a direction. The
//! reference is the pair 8(5,3) [in charts](crate::baseline::on_group); where it contradicts, `gauss-8` in short steps must agree with it. A run
//! without any comparison is not called good.
//!
//! # The wall
//! What ends where a method's steps become too long is its [`Wall`]. Of a refused step it is asked whether the equation of the step has a
//! solution. From the state where the step was refused, shorter steps are solved and made longer bit by bit, each from the solution of
//! the one before. Where that arrives near the motion, the wall is the solver's, at this step: what would come after it is not known. Where
//! no way on is found before, as at a fold, it is taken for the equation's: evidence, and no proof.
//!
//! ```
//! use std::time::Duration;
//! use articulated_fluid::{Scene, scene};
//! use study::stability::{Class, Grid, Map, Pace, Parameter};
//!
//! let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
//! let methods = ["lgvi".parse()?, "rk4".parse()?];
//! let grid = Grid::new(Parameter::Spin, &[1.0], &methods, &[0.1, 0.2], 10.0);
//! let pace = Pace { budget: Duration::from_secs(60), stop: &|| false, done: &|| () };
//! let map = Map::new(&scene, grid, &pace)?;
//! assert_eq!(map.count(Class::NotRun), 0);
//! assert_eq!(map.cell(0, 0, 0).class, Class::Good);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod map;
mod outcome;
mod parameter;
mod picture;
mod run;
mod table;
mod wall;
mod window;

pub use map::{Grid, Map, Pace};
pub use outcome::{
    Class, ENERGY_BAND, ENERGY_DRIFT, ENERGY_TREND, GROUP, MOMENTUM, Outcome, WRONG,
};
pub use parameter::{Parameter, ParameterError, UnknownParameter};
pub use picture::picture;
pub use table::csv;
pub use wall::{Limit, Wall};
