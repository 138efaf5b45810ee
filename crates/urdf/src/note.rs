//! What of a robot does not go into its scene.

use std::fmt;

/// What of a URDF a scene does not have, or has otherwise; displayed as one line.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// The limits of these joints are in comments, and not enforced.
    Limits {
        /// The joints.
        joints: Vec<String>,
    },
    /// The dry friction of these joints is left out.
    Friction {
        /// The joints.
        joints: Vec<String>,
    },
    /// Meshes of these links are not read: their inertia gives the ellipsoid, unless they have other shapes.
    Meshes {
        /// The links.
        links: Vec<String>,
    },
    /// These links have neither a shape nor an inertia, and displace no fluid.
    NoShape {
        /// The links.
        links: Vec<String>,
    },
    /// The ellipsoids of these links were thinner than a hundredth of their length, and were made that thick.
    Thin {
        /// The links.
        links: Vec<String>,
    },
    /// A name has characters that names of scenes do not have, or is that of another.
    Renamed {
        /// The name in the file.
        from: String,
        /// The name in the scene.
        to: String,
    },
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Limits { joints } => {
                write!(f, "limits are not enforced, of {}", listed("joint", joints))
            }
            Self::Friction { joints } => {
                write!(
                    f,
                    "dry friction is left out, of {}",
                    listed("joint", joints)
                )
            }
            Self::Meshes { links } => write!(
                f,
                "collision meshes are not read, and an ellipsoid of the inertia stands for them, of {}",
                listed("link", links)
            ),
            Self::NoShape { links } => write!(
                f,
                "neither collision shape nor inertia, so that no fluid is displaced, of {}",
                listed("link", links)
            ),
            Self::Thin { links } => write!(
                f,
                "the inertia is that of a sheet or a rod, and the ellipsoid is 1 % thick, of {}",
                listed("link", links)
            ),
            Self::Renamed { from, to } => write!(f, "{from:?} is named {to:?} in the scene"),
        }
    }
}

/// The first of the names, and how many there are.
fn listed(element: &str, names: &[String]) -> String {
    const TOLD: usize = 3;
    let first: Vec<String> = names.iter().take(TOLD).map(|x| format!("{x:?}")).collect();
    let (first, plural) = (first.join(", "), if names.len() == 1 { "" } else { "s" });
    match names.len().saturating_sub(TOLD) {
        0 => format!("{element}{plural} {first}"),
        more => format!("{element}{plural} {first} and {more} more"),
    }
}
