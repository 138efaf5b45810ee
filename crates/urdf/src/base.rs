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

/// The bodies of a robot, and why its base is as it is.
pub(crate) fn stand(
    mut parts: Vec<Part>,
    base: Option<Base>,
) -> Result<(Vec<Body>, &'static str), UrdfError> {
    let mut masses = parts.iter().map(mass).collect::<Result<Vec<_>, _>>()?;
    let on_root = |part: &&Part| part.on.is_some_and(|on| on.parent == 0);
    let (hanging, has_mass) = (parts.iter().filter(on_root).count(), masses[0].mass > 0.0);
    let floats = |part: &&Part| {
        part.on
            .is_some_and(|on| on.joint.joint_type == JointType::Floating)
    };
    let floating = parts.iter().find(floats).and_then(|part| part.on);
    if let Some(on) = floating {
        if has_mass || hanging > 1 || on.parent != 0 || base == Some(Base::World) {
            let joint = on.joint.name.clone();
            return Err(UrdfError::Floating { joint });
        }
        (parts.remove(0), masses.remove(0));
        let bodies = bodies(parts, masses, 1, Hang::Free(on.at))?;
        return Ok((bodies, "free, by the floating joint of the file"));
    }
    let (base, why) = match (base, parts[0].name()) {
        (Some(Base::Free), _) => (Base::Free, "free, as asked for"),
        (Some(Base::World), _) => (Base::World, "held by the world, as asked for"),
        (None, "world") => (Base::World, "held, as the root link is named world"),
        (None, _) if has_mass => (Base::Free, "free, as the root link has a mass"),
        (None, _) => (
            Base::World,
            "held by the world, as the root link has no mass",
        ),
    };
    let bodies = match (base, has_mass, hanging) {
        (Base::Free, ..) => bodies(parts, masses, 0, Hang::Free(Pose::identity())),
        (Base::World, false, 0) => Err(UrdfError::Empty),
        // What stands for the world need be no body.
        (Base::World, false, 1) => {
            (parts.remove(0), masses.remove(0));
            let on = parts[0].on.map(|on| joint(&on, 1));
            bodies(parts, masses, 1, on.ok_or(UrdfError::Empty)?)
        }
        (Base::World, ..) => {
            let has_mass = masses[0].check(parts[0].name()).is_ok();
            if !has_mass {
                masses[0] = Mass::of_one();
            }
            bodies(parts, masses, 0, Hang::Held { has_mass })
        }
    }?;
    Ok((bodies, why))
}

/// The mass of a part, in the frame of its first link.
fn mass(part: &Part) -> Result<Mass, UrdfError> {
    let masses = part.links.iter();
    let masses = masses.map(|(link, frame)| Ok(Mass::of(link)?.seen_from(frame)));
    Ok(Mass::sum(&masses.collect::<Result<Vec<_>, UrdfError>>()?))
}

/// The bodies of these parts, before which so many were left out.
fn bodies<'a>(
    parts: Vec<Part<'a>>,
    masses: Vec<Mass>,
    without: usize,
    first: Hang<'a>,
) -> Result<Vec<Body<'a>>, UrdfError> {
    let mut bodies = Vec::with_capacity(parts.len());
    for (index, (part, mass)) in parts.into_iter().zip(masses).enumerate() {
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
