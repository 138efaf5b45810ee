//! Robots of [URDF](http://wiki.ros.org/urdf/XML) files as scenes.
//!
//! [`import`] takes the text of a URDF to the text of a [scene](articulated_fluid::scene), with comments that tell where each number is from:
//! * Links that are fixed to each other are one body. It has the axes of the link that carries the others; as everywhere in a
//!   scene, its origin is its mass centre.
//! * Joints that turn are hinges, `spherical` ones balls. The scene starts in the robot's zero pose, at rest.
//! * The `damping` of a joint becomes that of the scene. Limits and dry friction do not act, and a [`Note`] says so.
//! * In a fluid, each link has the added mass and the buoyancy of ellipsoids; meshes are not read. See [`ShapeFrom`].
//!
//! What a scene does not have is refused by its name: `prismatic` and `planar` joints, joints that mimic others, closed loops, and links
//! that move without a mass. [`UrdfError`] says what to do.
//!
//! ```
//! let text = r#"
//!     <robot name="pendulum">
//!       <link name="world"/>
//!       <link name="rod">
//!         <inertial>
//!           <origin xyz="0 0 -0.5"/><mass value="2"/>
//!           <inertia ixx="0.17" iyy="0.17" izz="0.01" ixy="0" ixz="0" iyz="0"/>
//!         </inertial>
//!       </link>
//!       <joint name="pivot" type="continuous">
//!         <parent link="world"/><child link="rod"/><axis xyz="0 1 0"/>
//!       </joint>
//!     </robot>"#;
//! let imported = urdf::import(text, &urdf::Options::default())?;
//! let pivot = imported.scene.mount.as_ref().ok_or("the rod hangs on the world")?;
//! assert_eq!((&pivot.name[..], pivot.at_child), ("pivot", [0.0, 0.0, 0.5]));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod base;
mod error;
mod fluid;
mod mass;
mod names;
mod note;
mod options;
mod pose;
mod principal;
mod scene;
mod shape;
mod text;
mod told;
mod tree;

use std::io;
use std::path::Path;

use articulated_fluid::Scene;
use articulated_fluid::scene::{MOST_BYTES, read_bounded};

pub use base::Base;
pub use error::UrdfError;
pub use note::Note;
pub use options::Options;
pub use shape::ShapeFrom;

/// A robot that has become a scene.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Imported {
    /// The text of the scene, with comments.
    pub text: String,
    /// What it says.
    pub scene: Scene,
    /// What of the robot is not in it.
    pub notes: Vec<Note>,
}

/// The scene of the robot that the URDF `text` describes.
///
/// # Errors
/// [`UrdfError`] for the first thing of it that a scene does not have.
pub fn import(text: &str, options: &Options) -> Result<Imported, UrdfError> {
    let density = options.density;
    if !(density.is_finite() && density >= 0.0) {
        return Err(UrdfError::Density { density });
    }
    if text.len() > MOST_BYTES {
        return Err(UrdfError::TooLarge);
    }
    let robot = text::parse(text)?;
    let (bodies, base) = base::stand(tree::parts(&robot)?, options.base)?;
    let (text, notes) = scene::write(&robot.name, &bodies, base, options)?;
    let scene = Scene::parse(&text, "the scene of the robot")?;
    Ok(Imported { text, scene, notes })
}

/// The scene of the robot in the URDF file `path`.
///
/// # Errors
/// [`UrdfError::Io`] if the file cannot be read as UTF-8 text, else as [`import`].
pub fn load(path: &Path, options: &Options) -> Result<Imported, UrdfError> {
    let bytes = read_bounded(path).map_err(UrdfError::Io)?;
    match str::from_utf8(&bytes) {
        Ok(text) => import(text, options),
        // The end may be one of a text that goes on.
        Err(_) if bytes.len() > MOST_BYTES => Err(UrdfError::TooLarge),
        Err(error) => {
            let source = io::Error::new(io::ErrorKind::InvalidData, error);
            Err(UrdfError::Io(source))
        }
    }
}

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
