//! Scenes: bodies, joints, fluid and initial state as a TOML file.
//!
//! ```toml
#![doc = include_str!("example.toml")]
//! ```
//!
//! [`KEYS`] documents each key with its unit and default; [`reference()`] prints them. Whatever is
//! wrong in a file is reported as `FILE:LINE:COLUMN: KEY: what is wrong; expected ...`, where the
//! line is that of the key. Unknown keys are errors.
//!
//! Published numbers have few digits. A matrix that is symmetric to 1e-3 of its largest entry is made symmetric, a quaternion
//! of length 1 to 1e-3 is normalised, and [`Scene::notes`] says so. Anything further off is refused.
//!
//! The bodies form a tree: the first body is its root, the head, and every other one hangs by exactly
//! one joint on a body that is listed before it. A joint leaves its child some motion free, or moves it as told; the
//! first body may hang on `"world"`. Any body may be the first: a free tree on ball joints is stepped on its heaviest one.
//!
//! A scene that moves in a coordinate plane, with all numbers out of the plane exactly zero, is stepped
//! in the plane. One in a tilted plane is stepped in space.

mod bodies;
mod description;
pub(crate) mod entry;
pub(crate) mod error;
mod forms;
mod joints;
mod keys;
pub(crate) mod laws;
mod matrices;
mod mobility;
mod note;
mod overlap;
mod rates;
mod source;
mod start;
mod values;

use std::io;
use std::path::Path;

pub use description::{Form, Scene, SceneBody, SceneJoint, SceneMount, StartVelocity};
pub use error::{MOST_BYTES, SceneError};
pub use keys::{KEYS, Key, reference};
pub use mobility::Mobility;
pub use note::{Correction, Note};
pub use overlap::{Overlap, Overlaps};

use entry::{Table, Value};
use forms::Surroundings;
use source::Source;
pub use source::{Reads, read_bounded};

/// A scene file with every key, as shown in the documentation of this module.
pub const EXAMPLE: &str = include_str!("example.toml");

impl Scene {
    /// Reads the scene in `text`; `file` only names it in error messages.
    ///
    /// ```
    /// use articulated_fluid::scene::Scene;
    ///
    /// let text = "
    ///     [fluid]
    ///     density = 1000
    ///     [[body]]
    ///     name = 'hull'
    ///     semi_axes = [2, 0, 0.5]
    /// ";
    /// let error = Scene::parse(text, "boat.toml").unwrap_err();
    /// assert_eq!(
    ///     error.to_string(),
    ///     "boat.toml:6:5: body.semi_axes: the semi-axis along y is 0.0; \
    ///      expected a finite number > 0, in m"
    /// );
    /// ```
    ///
    /// # Errors
    ///
    /// [`SceneError::Invalid`] for the first thing wrong: TOML syntax, an unknown or missing key,
    /// a value of the wrong type or size, not finite or out of range, no tree. [`SceneError::TooLarge`] of a text
    /// longer than [`MOST_BYTES`].
    pub fn parse(text: &str, file: &str) -> Result<Self, SceneError> {
        Self::parse_by(text, file, &read_bounded)
    }

    fn parse_by(text: &str, file: &str, reads: &Reads) -> Result<Self, SceneError> {
        if text.len() > MOST_BYTES {
            let file = file.to_owned();
            return Err(SceneError::TooLarge { file });
        }
        let source = Source::new(text, file, reads);
        let tree = source.parse()?;
        let scene = read(&Table::root(&source, tree.get_ref())?)?;
        let notes = source.into_notes();
        Ok(Self { notes, ..scene })
    }

    /// Reads the scene in the file `path`.
    ///
    /// # Errors
    ///
    /// [`SceneError::Io`] if the file cannot be read as UTF-8 text, else as [`Scene::parse`].
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        Self::load_by(path, &read_bounded)
    }

    /// Reads the scene in the file `path`, and the tables that it names, by `reads` instead of from the disk.
    ///
    /// So a caller can keep what was read, and read the scene again where those files are not.
    ///
    /// ```
    /// use articulated_fluid::Scene;
    ///
    /// let text = b"fluid.density = 0\n[[body]]\nname = 'ball'\nmass = 1\ninertia = [1, 1, 1]";
    /// let scene = Scene::load_by("no/such/file.toml".as_ref(), &|_| Ok(text.to_vec()))?;
    /// assert_eq!(scene.bodies[0].name, "ball");
    /// # Ok::<(), articulated_fluid::scene::SceneError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Scene::load`].
    pub fn load_by(path: &Path, reads: &Reads) -> Result<Self, SceneError> {
        let file = path.display().to_string();
        match reads(path) {
            Ok(bytes) => match std::str::from_utf8(&bytes) {
                Ok(text) => Self::parse_by(text, &file, reads),
                // The end may be one of a text that goes on.
                Err(_) if bytes.len() > MOST_BYTES => Err(SceneError::TooLarge { file }),
                Err(error) => {
                    let source = io::Error::new(io::ErrorKind::InvalidData, error);
                    Err(SceneError::Io { file, source })
                }
            },
            Err(source) => Err(SceneError::Io { file, source }),
        }
    }
}

/// All but the notes.
fn read(root: &Table) -> Result<Scene, SceneError> {
    let tables = root.read("body", vec![], Value::tables)?;
    let joints = root.read("joint", vec![], Value::tables)?;
    let start = root.read("start", None, |start| start.table().map(Some))?;
    let fluid = root.require("fluid")?.table()?;

    let title = root.read("title", None, |title| title.text().map(Some))?;
    let density = fluid.require("density")?.not_negative()?;
    let gravity = root.read("gravity", [0.0; 3], Value::array)?;
    let around = Surroundings {
        density,
        gravity: gravity != [0.0; 3],
    };
    if tables.is_empty() {
        return Err(root.missing("body"));
    }
    let (names, mut bodies) = bodies::check(&tables, &around)?;
    let gaits = root.read("gait", vec![], Value::tables)?;
    let (mount, joints) = joints::check(&joints, &gaits, &names)?;
    let (position, velocity) = start::read(start.as_ref(), mount.as_ref())?;
    let floats = velocity == StartVelocity::NoMomentum;
    rates::set(&tables, (mount.as_ref(), &joints), floats, &mut bodies)?;
    Ok(Scene {
        title: title.map(str::to_owned),
        gravity,
        density,
        bodies,
        mount,
        joints,
        position,
        velocity,
        notes: vec![],
    })
}
