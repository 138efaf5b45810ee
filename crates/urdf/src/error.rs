//! Why a robot is no scene.

use articulated_fluid::scene::MOST_BYTES;
use articulated_fluid::{EllipsoidError, SceneError};
use thiserror::Error;

/// Why a URDF cannot be imported; names are those of the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum UrdfError {
    /// The file cannot be read, or is not UTF-8.
    #[error("the robot cannot be read: {0}")]
    Io(#[source] std::io::Error),
    /// The text is longer than a robot is.
    #[error("the robot is larger than {} MB; expected a URDF as text", MOST_BYTES / 1_000_000)]
    TooLarge,
    /// The text cannot be parsed.
    #[error("the text cannot be read as a URDF: {reason}")]
    Text {
        /// What the parser says.
        reason: String,
    },
    /// The density of the fluid is negative or not finite.
    #[error("the fluid's density is {density:?}; expected a finite number >= 0, in kg/m^3")]
    Density {
        /// The value given, kg/m³.
        density: f64,
    },
    /// There is no link.
    #[error("the robot has no link; expected at least one <link>")]
    NoLink,
    /// Two links have the same name.
    #[error("two links are named {link:?}; give each a name of its own")]
    DuplicateLink {
        /// Their name.
        link: String,
    },
    /// A joint names a link that is not there.
    #[error(
        "joint {joint:?} names the link {link:?}, which the file does not have; correct the name, or add the link"
    )]
    UnknownLink {
        /// The joint.
        joint: String,
        /// What it names.
        link: String,
    },
    /// A link is the child of two joints.
    #[error(
        "link {link:?} is the child of the joints {:?} and {:?}, a closed loop; only trees can be imported: remove one of the two", joints[0], joints[1]
    )]
    TwoParents {
        /// The link.
        link: String,
        /// The joints.
        joints: [String; 2],
    },
    /// Links hang together in a cycle, so that no link is the root.
    #[error("link {link:?} hangs on itself through its parents; remove one joint of the cycle")]
    Cycle {
        /// One of the links.
        link: String,
    },
    /// More than one link hangs on nothing.
    #[error(
        "the links {:?} and {:?} both hang on nothing; join them by a joint, or import each robot on its own", links[0], links[1]
    )]
    TwoRoots {
        /// The first two of them.
        links: [String; 2],
    },
    /// A joint that slides.
    #[error(
        "joint {joint:?} is prismatic, and a scene has no sliding joints; where it may be held, make its type \"fixed\" with its origin at that place"
    )]
    Prismatic {
        /// The joint.
        joint: String,
    },
    /// A joint in a plane.
    #[error(
        "joint {joint:?} is planar, and a scene has no such joints; make its type \"floating\", where the motion stays in the plane by itself, or \"fixed\""
    )]
    Planar {
        /// The joint.
        joint: String,
    },
    /// A floating joint elsewhere than between a massless root and the one body on it.
    #[error(
        "joint {joint:?} is floating, but only the whole robot may float: such a joint goes from a root link without mass to the one link on it, with a free base"
    )]
    Floating {
        /// The joint.
        joint: String,
    },
    /// A joint that follows another one.
    #[error(
        "joint {joint:?} mimics {other:?}, and a scene has no gears; remove its <mimic>, so that it moves on its own, or make its type \"fixed\""
    )]
    Mimic {
        /// The joint.
        joint: String,
        /// What it follows.
        other: String,
    },
    /// A link without mass that would move.
    #[error(
        "link {link:?} moves, but neither it nor what is fixed to it has a mass; give it an <inertial>, or make the joint above or below it \"fixed\""
    )]
    NoMass {
        /// The link.
        link: String,
    },
    /// A mass is negative, not finite, or too small to divide by.
    #[error("link {link:?} has the mass {mass:?}; expected a finite number >= 0, in kg")]
    Mass {
        /// The link.
        link: String,
        /// The value given, kg.
        mass: f64,
    },
    /// An inertia that no rigid body has.
    #[error(
        "link {link:?} has, with what is fixed to it, the principal moments of inertia {moments:?} kg m^2; expected three numbers > 0, none above the sum of the two others: correct its <inertia>"
    )]
    Inertia {
        /// The link.
        link: String,
        /// The moments, kg m², ascending.
        moments: [f64; 3],
    },
    /// A number is not finite, or the axis of a joint has no direction.
    #[error("{element} {name:?} has {what} {value:?}; expected {expected}")]
    Number {
        /// `link` or `joint`.
        element: &'static str,
        /// Its name.
        name: String,
        /// What the value is.
        what: &'static str,
        /// The value given.
        value: Vec<f64>,
        /// What is expected.
        expected: &'static str,
    },
    /// A collision shape is no solid.
    #[error("link {link:?} has a collision shape with no ellipsoid of its size: {source}")]
    Shape {
        /// The link.
        link: String,
        /// What is wrong.
        source: EllipsoidError,
    },
    /// Nothing of the robot has a mass.
    #[error("no link that could move has a mass; give the links <inertial> elements")]
    Empty,
    /// The numbers are too extreme for a scene.
    #[error("the robot makes no scene, as its numbers are too extreme: {0}")]
    Scene(#[from] SceneError),
}
