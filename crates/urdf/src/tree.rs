//! The tree of a robot: parts of links that are fixed to each other, on joints that move.

use std::collections::{HashMap, HashSet, VecDeque};

use urdf_rs::{Joint, JointType, Link, Robot};

use crate::error::UrdfError;
use crate::pose::Pose;

/// Links that are fixed to each other.
#[derive(Debug)]
pub(crate) struct Part<'a> {
    /// The links, the one that carries the others first, and their frames in its frame.
    pub links: Vec<(&'a Link, Pose)>,
    /// The joint that moves it.
    pub on: Option<On<'a>>,
}

/// How a part hangs on another one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct On<'a> {
    pub joint: &'a Joint,
    /// The index of the part above.
    pub parent: usize,
    /// The joint's frame in that of the part above.
    pub at: Pose,
}

impl Part<'_> {
    /// The name of the link that carries the others.
    pub fn name(&self) -> &str {
        &self.links[0].0.name
    }

    /// That name; where it stands for the world, that of the first link with a mass.
    pub fn name_of_body(&self) -> &str {
        let mut links = self.links.iter().map(|(link, _)| *link);
        let heavy = links.find(|link| link.inertial.mass.value > 0.0);
        match (self.name(), heavy) {
            ("world", Some(link)) => &link.name,
            (name, _) => name,
        }
    }
}

/// The parts of a robot, the root first and each after the one above it.
pub(crate) fn parts(robot: &Robot) -> Result<Vec<Part<'_>>, UrdfError> {
    let links = index(robot)?;
    let below = below(robot, &links)?;
    let root = root(robot)?;
    let start = |link: usize, on| Part {
        links: vec![(&robot.links[link], Pose::identity())],
        on,
    };
    let (mut parts, mut queue) = (vec![], VecDeque::from([(root, None)]));
    while let Some((link, on)) = queue.pop_front() {
        let (parent, mut part) = (parts.len(), start(link, on));
        let mut open = VecDeque::from([(link, Pose::identity())]);
        while let Some((link, frame)) = open.pop_front() {
            for joint in &below[link] {
                let at = frame.then(&Pose::of(&joint.origin));
                let child = links[&joint.child.link[..]];
                match joint.joint_type {
                    JointType::Fixed => {
                        part.links.push((&robot.links[child], at));
                        open.push_back((child, at));
                    }
                    _ => queue.push_back((child, Some(On { joint, parent, at }))),
                }
            }
        }
        parts.push(part);
    }
    let reached: usize = parts.iter().map(|part| part.links.len()).sum();
    match reached == robot.links.len() {
        true => Ok(parts),
        false => Err(cycle(robot, &parts)),
    }
}

/// The links by their names.
fn index(robot: &Robot) -> Result<HashMap<&str, usize>, UrdfError> {
    let mut links = HashMap::new();
    for (i, link) in robot.links.iter().enumerate() {
        if links.insert(&link.name[..], i).is_some() {
            let link = link.name.clone();
            return Err(UrdfError::DuplicateLink { link });
        }
    }
    Ok(links)
}

/// The joints that hang on each link, in the order of the file.
fn below<'a>(
    robot: &'a Robot,
    links: &HashMap<&str, usize>,
) -> Result<Vec<Vec<&'a Joint>>, UrdfError> {
    let mut below = vec![vec![]; robot.links.len()];
    let mut above: Vec<Option<&Joint>> = vec![None; robot.links.len()];
    for joint in &robot.joints {
        let find = |link: &str| {
            let found = links.get(link).copied();
            found.ok_or_else(|| UrdfError::UnknownLink {
                joint: joint.name.clone(),
                link: link.to_owned(),
            })
        };
        let (parent, child) = (find(&joint.parent.link)?, find(&joint.child.link)?);
        check(joint)?;
        below[parent].push(joint);
        if let Some(other) = above[child].replace(joint) {
            return Err(UrdfError::TwoParents {
                link: joint.child.link.clone(),
                joints: [other.name.clone(), joint.name.clone()],
            });
        }
    }
    Ok(below)
}

/// Refuses joints that a scene does not have, and numbers that are none.
fn check(joint: &Joint) -> Result<(), UrdfError> {
    let name = joint.name.clone();
    let number = |what, value: &[f64], expected| UrdfError::Number {
        element: "joint",
        name: name.clone(),
        what,
        value: value.to_vec(),
        expected,
    };
    let origin = [joint.origin.xyz.0, joint.origin.rpy.0].concat();
    if !origin.iter().all(|x| x.is_finite()) {
        return Err(number(
            "the origin",
            &origin,
            "finite numbers, in m and rad",
        ));
    }
    match (joint.joint_type.clone(), &joint.mimic) {
        (JointType::Fixed | JointType::Floating, _) => return Ok(()),
        (JointType::Prismatic, _) => return Err(UrdfError::Prismatic { joint: name }),
        (JointType::Planar, _) => return Err(UrdfError::Planar { joint: name }),
        (_, Some(mimic)) => {
            let other = mimic.joint.clone();
            return Err(UrdfError::Mimic { joint: name, other });
        }
        (JointType::Revolute | JointType::Continuous, None) => {
            let axis = joint.axis.xyz.0;
            if !axis.iter().all(|x| x.is_finite()) || axis == [0.0; 3] {
                return Err(number("the axis", &axis, "finite numbers, not all 0"));
            }
        }
        (JointType::Spherical, None) => {}
    }
    let damping = joint.dynamics.as_ref().map_or(0.0, |d| d.damping);
    match damping.is_finite() && damping >= 0.0 {
        true => Ok(()),
        false => Err(number(
            "the damping",
            &[damping],
            "a finite number >= 0, in N m s/rad",
        )),
    }
}

/// The one link that hangs on nothing.
fn root(robot: &Robot) -> Result<usize, UrdfError> {
    let hang: HashSet<&str> = robot.joints.iter().map(|j| &j.child.link[..]).collect();
    let roots = robot.links.iter().enumerate();
    let mut roots = roots.filter(|(_, link)| !hang.contains(&link.name[..]));
    match (roots.next(), roots.next(), robot.links.first()) {
        (_, _, None) => Err(UrdfError::NoLink),
        (None, _, Some(link)) => Err(UrdfError::Cycle {
            link: link.name.clone(),
        }),
        (Some((_, one)), Some((_, other)), _) => Err(UrdfError::TwoRoots {
            links: [one.name.clone(), other.name.clone()],
        }),
        (Some((root, _)), None, _) => Ok(root),
    }
}

/// The error that links hang on each other, beside the tree.
fn cycle(robot: &Robot, parts: &[Part]) -> UrdfError {
    let reached = parts.iter().flat_map(|part| &part.links);
    let reached: HashSet<&str> = reached.map(|(link, _)| &link.name[..]).collect();
    let mut names = robot.links.iter().map(|link| &link.name[..]);
    let link = names.find(|name| !reached.contains(name));
    UrdfError::Cycle {
        link: link.unwrap_or_default().to_owned(),
    }
}
