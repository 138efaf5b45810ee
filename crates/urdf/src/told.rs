//! What is told of a robot: comments of the scene, and notes.

use urdf_rs::{Joint, JointType, Link};

use crate::note::Note;
use crate::shape::{Origin, Solid};

/// What was met on the way.
#[derive(Debug, Default)]
pub(crate) struct Told {
    limits: Vec<String>,
    friction: Vec<String>,
    meshes: Vec<String>,
    no_shape: Vec<String>,
    thin: Vec<String>,
    renamed: Vec<Note>,
}

impl Told {
    /// The notes, one of each kind but for names.
    pub fn into_notes(self) -> Vec<Note> {
        let some = |names: Vec<String>, note: fn(Vec<String>) -> Note| {
            (!names.is_empty()).then(|| note(names))
        };
        let kinds = [
            some(self.limits, |joints| Note::Limits { joints }),
            some(self.friction, |joints| Note::Friction { joints }),
            some(self.meshes, |links| Note::Meshes { links }),
            some(self.no_shape, |links| Note::NoShape { links }),
            some(self.thin, |links| Note::Thin { links }),
        ];
        kinds.into_iter().flatten().chain(self.renamed).collect()
    }

    /// That a name of the file is another one in the scene.
    pub fn name(&mut self, from: &str, to: &str) {
        if from != to {
            let [from, to] = [from, to].map(str::to_owned);
            self.renamed.push(Note::Renamed { from, to });
        }
    }

    /// Which ellipsoids stand for a link, as comments.
    pub fn solids(&mut self, link: &Link, solids: &[Solid], is_mesh: bool) -> String {
        let name = || link.name.clone();
        if solids.is_empty() {
            self.no_shape.push(name());
            return format!(
                "# {:?} has neither a collision shape nor an inertia, and displaces nothing.\n",
                link.name
            );
        }
        if is_mesh {
            self.meshes.push(name());
        }
        let line = |solid: &Solid| {
            let [a, b, c] = solid.ellipsoid.semi_axes().map(short);
            let from = match solid.origin {
                Origin::Collision(kind) => format!("collision {kind}"),
                Origin::Inertia { is_thin: false } => "inertia".to_owned(),
                Origin::Inertia { is_thin: true } => "inertia, made 1 % thick".to_owned(),
            };
            format!(
                "# {:?} displaces the ellipsoid of its {from}: semi-axes {a}, {b}, {c} m.\n",
                link.name
            )
        };
        let is_thin = |solid: &Solid| solid.origin == Origin::Inertia { is_thin: true };
        if solids.iter().any(is_thin) {
            self.thin.push(name());
        }
        solids.iter().map(line).collect()
    }

    /// What a joint is, and what of it does not act, as a comment.
    pub fn joint(&mut self, joint: &Joint) -> String {
        let kind = match joint.joint_type {
            JointType::Spherical => "Spherical",
            JointType::Continuous => "Continuous",
            _ => "Revolute",
        };
        let limits = limits(joint);
        if !limits.is_empty() {
            self.limits.push(joint.name.clone());
        }
        let friction = joint.dynamics.as_ref().map_or(0.0, |d| d.friction);
        let friction = match friction {
            0.0 => None,
            friction => {
                self.friction.push(joint.name.clone());
                Some(format!("dry friction {} N m", short(friction)))
            }
        };
        let missing: Vec<String> = limits.into_iter().chain(friction).collect();
        match missing.is_empty() {
            true => format!("# {kind}.\n"),
            false => format!("# {kind}. Not enforced: {}.\n", missing.join(", ")),
        }
    }
}

/// The limits of a joint; an effort or a speed of 0 is one that was not given.
fn limits(joint: &Joint) -> Vec<String> {
    let limit = &joint.limit;
    let range = [limit.lower, limit.upper];
    let mut limits = vec![];
    if joint.joint_type == JointType::Revolute && range != [0.0; 2] {
        let [lower, upper] = range.map(short);
        limits.push(format!("{lower} to {upper} rad"));
    }
    let mut most = |value: f64, unit: &str| {
        if value.is_finite() && value != 0.0 {
            limits.push(format!("{} {unit}", short(value)));
        }
    };
    most(limit.effort, "N m");
    most(limit.velocity, "rad/s");
    limits
}

/// A number with four digits, as Rust has no format of significant ones.
pub(crate) fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    // Without the sign of a zero.
    format!("{:?}", rounded + 0.0)
}
