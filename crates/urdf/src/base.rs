//! What the robot stands on: nothing, or the world.

use urdf_rs::{Joint, JointType};

use crate::error::UrdfError;
use crate::mass::Mass;
use crate::pose::Pose;
use crate::tree::{On, Part};

/// What holds the root link.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Base {
    /// Nothing: the robot floats.
    Free,
    /// The world.
    World,
}

/// A body of the scene: links that are fixed to each other, and how they hang.
#[derive(Debug)]
pub(crate) struct Body<'a> {
    pub part: Part<'a>,
    pub hang: Hang<'a>,
    pub mass: Mass,
}

/// How a body hangs.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Hang<'a> {
    /// On nothing; the frame that it starts in.
    Free(Pose),
    /// Held by the world; whether its mass is one of the file.
    Held { has_mass: bool },
    /// On a joint with this frame in the body above, or in the world.
    Joint {
        joint: &'a Joint,
        parent: Option<usize>,
        at: Pose,
    },
}

impl Hang<'_> {
    /// Whether the body is held and has no mass of its own.
    pub fn is_stand_in(&self) -> bool {
        matches!(self, Self::Held { has_mass: false })
    }
}

/// The bodies of a robot, and why its base is as it is.
pub(crate) fn stand(
    parts: Vec<Part>,
    base: Option<Base>,
) -> Result<(Vec<Body>, &'static str), UrdfError> {
    let masses = parts.iter().map(mass).collect::<Result<Vec<_>, _>>()?;
    let has_mass = masses[0].mass > 0.0;
    if let Some(first) = floating(&parts, has_mass, base)? {
        let bodies = bodies(parts, masses, 1, first)?;
        return Ok((bodies, "free, by the floating joint of the file"));
    }
    let (base, why) = match (base, parts[0].name()) {
        (Some(Base::Free), _) => (Base::Free, "free, as asked for"),
        (Some(Base::World), _) => (Base::World, "held by the world, as asked for"),
        (None, "world") => (Base::World, "held, as the root link is named world"),
        (None, _) if has_mass => (Base::Free, "free, as the root link has a mass"),
        (None, _) => (Base::World, "held, as the root link has no mass"),
    };
    let bodies = match base {
        Base::Free => bodies(parts, masses, 0, Hang::Free(Pose::identity())),
        Base::World => held(parts, masses),
    };
    Ok((bodies?, why))
}

/// How the one body starts that floats beside a massless root, if the robot has such a joint.
fn floating<'a>(
    parts: &[Part<'a>],
    has_mass: bool,
    base: Option<Base>,
) -> Result<Option<Hang<'a>>, UrdfError> {
    let mut joints = parts.iter().filter_map(|part| part.on);
    let Some(on) = joints.find(|on| on.joint.joint_type == JointType::Floating) else {
        return Ok(None);
    };
    let is_base = on.parent == 0 && on_root(parts) == 1 && !has_mass;
    match is_base && base != Some(Base::World) {
        true => Ok(Some(Hang::Free(on.at))),
        false => Err(UrdfError::Floating {
            joint: on.joint.name.clone(),
        }),
    }
}

/// How many parts hang on the root.
fn on_root(parts: &[Part]) -> usize {
    let joints = parts.iter().filter_map(|part| part.on);
    joints.filter(|on| on.parent == 0).count()
}

/// The bodies of a robot whose root link is held.
fn held(parts: Vec<Part>, mut masses: Vec<Mass>) -> Result<Vec<Body>, UrdfError> {
    match (masses[0].mass > 0.0, on_root(&parts), parts.get(1)) {
        (false, 0, _) => Err(UrdfError::Empty),
        // What stands for the world need be no body.
        (false, 1, Some(Part { on: Some(on), .. })) => {
            let first = joint(on, 1);
            bodies(parts, masses, 1, first)
        }
        _ => {
            let has_mass = masses[0].check(parts[0].name()).is_ok();
            if !has_mass {
                masses[0] = Mass::of_one();
            }
            bodies(parts, masses, 0, Hang::Held { has_mass })
        }
    }
}

/// The mass of a part, in the frame of its first link.
fn mass(part: &Part) -> Result<Mass, UrdfError> {
    let masses = part.links.iter();
    let masses = masses.map(|(link, frame)| Ok(Mass::of(link)?.seen_from(frame)));
    Ok(Mass::sum(&masses.collect::<Result<Vec<_>, UrdfError>>()?))
}

/// The bodies of these parts, without so many at the start.
fn bodies<'a>(
    parts: Vec<Part<'a>>,
    masses: Vec<Mass>,
    without: usize,
    first: Hang<'a>,
) -> Result<Vec<Body<'a>>, UrdfError> {
    let mut bodies = Vec::with_capacity(parts.len());
    let parts = parts.into_iter().zip(masses).skip(without);
    for (index, (part, mass)) in parts.enumerate() {
        mass.check(part.name())?;
        let hang = match (index, part.on) {
            (1.., Some(on)) => joint(&on, without),
            _ => first,
        };
        bodies.push(Body { part, hang, mass });
    }
    Ok(bodies)
}

fn joint<'a>(on: &On<'a>, without: usize) -> Hang<'a> {
    Hang::Joint {
        joint: on.joint,
        parent: on.parent.checked_sub(without),
        at: on.at,
    }
}
