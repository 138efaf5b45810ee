//! The text of a scene.

use lie::{LieGroup, Mat3, SO3, Vec3};
use urdf_rs::{Joint, JointType};

use crate::base::{Body, Hang};
use crate::error::UrdfError;
use crate::fluid::{Share, share};
use crate::names::Names;
use crate::note::Note;
use crate::options::Options;
use crate::shape::{ShapeFrom, Solid, has_meshes_alone, solids};
use crate::told::{Told, short};

/// The bodies as a scene, and what is left out; `base` tells how the first one stands.
pub(crate) fn write(
    robot: &str,
    bodies: &[Body],
    base: &str,
    options: &Options,
) -> Result<(String, Vec<Note>), UrdfError> {
    let (mut told, mut given) = (Told::default(), Names::without("world"));
    let mut names = vec![];
    for body in bodies {
        let name = given.give(body.part.name_of_body());
        told.name(body.part.name_of_body(), &name);
        names.push(name);
    }
    let turns = turns(bodies);
    let (mut listed, mut displaced) = (String::new(), 0.0);
    for ((body, name), turn) in bodies.iter().zip(&names).zip(&turns) {
        let (text, volume) = one(body, name, turn, options, &mut told)?;
        listed += &text;
        displaced += volume * options.density;
    }
    let (mut joints, mut given) = (String::new(), Names::default());
    // The weld of the base comes last, as no joint of the file should lose its name to it.
    for index in (1..bodies.len()).chain([0]) {
        joints += &joint(index, bodies, &names, &mut given, &mut told);
    }
    let own = bodies.iter().filter(|body| !body.hang.is_stand_in());
    let mass = own.map(|body| body.mass.mass).sum();
    let notes = told.into_notes();
    let head = head(robot, base, options, [mass, displaced], &notes);
    Ok((format!("{head}{listed}{joints}"), notes))
}

/// All but bodies and joints.
fn head(
    robot: &str,
    base: &str,
    options: &Options,
    [mass, displaced]: [f64; 2],
    notes: &[Note],
) -> String {
    let robot = match robot {
        "" => "a robot",
        name => name,
    };
    let (fluid, again) = match options.density {
        0.0 => (String::new(), ""),
        _ => (
            format!(" It displaces {} kg of the fluid.", short(displaced)),
            "; for another one, import the robot again",
        ),
    };
    let notes: Vec<String> = notes
        .iter()
        .map(|note| format!("# Note: {note}.\n"))
        .collect();
    format!(
        "\
# A robot of a URDF, as lgvi import wrote it.
# Each body has the axes of its link, and its mass centre as origin. It starts at rest, with all angles 0.
# The base is {base}. The whole has {} kg.{fluid}
{}
title = {}
gravity = [0, 0, -9.81] # m/s^2, with z up; without this line nothing has a weight
fluid.density = {} # kg/m^3{again}
",
        short(mass),
        notes.concat(),
        quoted(robot),
        number(options.density),
    )
}

/// A body, and the volume that it displaces.
fn one(
    body: &Body,
    name: &str,
    turn: &SO3,
    options: &Options,
    told: &mut Told,
) -> Result<(String, f64), UrdfError> {
    let mut text = match &body.hang {
        Hang::Free(pose) => {
            let position = vector(pose.place(body.mass.centre));
            format!("\n[start]\nposition = {position}\n\n")
        }
        _ => "\n".to_owned(),
    };
    text += &links(body);
    let share = match options.density > 0.0 && !body.hang.is_stand_in() {
        true => {
            let (comments, share) = in_fluid(body, options, told)?;
            text += &comments;
            Some(share)
        }
        false => None,
    };
    let mass = &body.mass;
    let inertia = symmetric(mass.inertia);
    text += &format!(
        "[[body]]\nname = {}\nmass = {}\ninertia = {inertia}\n",
        quoted(name),
        number(mass.mass)
    );
    if let Some(share) = &share {
        text += &of_fluid(share);
    }
    let is_free = matches!(body.hang, Hang::Free(_)) || is_ball(&body.hang);
    if is_free && *turn != SO3::identity() {
        text += &format!("attitude = {}\n", quaternion(turn));
    }
    Ok((text, share.map_or(0.0, |share| share.volume)))
}

/// Which links a body is, as a comment.
fn links(body: &Body) -> String {
    let mut links = body
        .part
        .links
        .iter()
        .map(|(link, _)| format!("{:?}", link.name));
    let first = links.next().unwrap_or_default();
    let others: Vec<String> = links.collect();
    let others = match &others[..] {
        [] => String::new(),
        others => format!(", with what is fixed to it: {}", others.join(", ")),
    };
    let held = match body.hang {
        Hang::Held { has_mass: false } => {
            ". It is held, so that its mass plays no part, and any will do"
        }
        Hang::Held { has_mass: true } => ". It is held",
        _ => "",
    };
    format!("# Link {first}{others}{held}.\n")
}

/// What a body displaces, with comments that tell of each link where that is from.
fn in_fluid(body: &Body, options: &Options, told: &mut Told) -> Result<(String, Share), UrdfError> {
    let (mut comments, mut all) = (String::new(), Vec::<Solid>::new());
    for (link, frame) in &body.part.links {
        let own = solids(link, options.shape_from)?;
        let is_mesh = options.shape_from == ShapeFrom::Collision && has_meshes_alone(link);
        let is_frame = own.is_empty() && link.collision.is_empty();
        // A link that is a frame alone has nothing to tell.
        if !(is_frame && body.part.links.len() > 1) {
            comments += &told.solids(link, &own, is_mesh);
        }
        all.extend(own.into_iter().map(|solid| solid.seen_from(frame)));
    }
    Ok((comments, share(&all, body.mass.centre, options.density)))
}

fn of_fluid(share: &Share) -> String {
    let added = match share.coupling == Mat3::zero() {
        true => format!(
            "added_mass = {}\nadded_inertia = {}\n",
            symmetric(share.mass),
            symmetric(share.inertia)
        ),
        false => {
            let rows = share.rows().map(|row| format!("  {},\n", array(&row)));
            format!("added_mass = [\n{}]\n", rows.concat())
        }
    };
    let centre = match share.centre == Vec3::zero() {
        true => String::new(),
        false => format!("buoyancy_at = {}\n", vector(share.centre)),
    };
    format!("{added}volume = {}\n{centre}", number(share.volume))
}

/// How the body of this index hangs.
fn joint(
    index: usize,
    bodies: &[Body],
    names: &[String],
    given: &mut Names,
    told: &mut Told,
) -> String {
    let (body, child) = (&bodies[index], quoted(&names[index]));
    let at_child = vector(-body.mass.centre);
    let (joint, parent, at) = match body.hang {
        Hang::Free(_) => return String::new(),
        Hang::Held { .. } => {
            let name = quoted(&given.give("base"));
            return format!(
                "\n[[joint]]\nname = {name}\nparent = \"world\"\nchild = {child}\nat_parent = [0, 0, 0]\nat_child = {at_child}\ntype = \"fixed\"\n"
            );
        }
        Hang::Joint { joint, parent, at } => (joint, parent, at),
    };
    let name = given.give(&joint.name);
    told.name(&joint.name, &name);
    let (parent, origin) = match parent {
        Some(parent) => (&names[parent][..], bodies[parent].mass.centre),
        None => ("world", Vec3::zero()),
    };
    let mut text = format!(
        "\n{}[[joint]]\nname = {}\nparent = {}\nchild = {child}\nat_parent = {}\nat_child = {at_child}\n",
        told.joint(joint),
        quoted(&name),
        quoted(parent),
        vector(at.at - origin),
    );
    if joint.joint_type != JointType::Spherical {
        text += &hinge(joint, &at.turn);
    }
    match joint.dynamics.as_ref().map_or(0.0, |d| d.damping) {
        0.0 => text,
        damping => text + &format!("damping = {}\n", number(damping)),
    }
}

fn hinge(joint: &Joint, rest: &SO3) -> String {
    let rest = match *rest == SO3::identity() {
        true => String::new(),
        false => format!("rest = {}\n", quaternion(rest)),
    };
    format!(
        "type = \"hinge\"\naxis = {}\n{rest}",
        array(&joint.axis.xyz.0)
    )
}

fn is_ball(hang: &Hang) -> bool {
    matches!(hang, Hang::Joint { joint, .. } if joint.joint_type == JointType::Spherical)
}

/// The attitudes of the bodies in the zero pose.
fn turns(bodies: &[Body]) -> Vec<SO3> {
    let mut turns: Vec<SO3> = Vec::with_capacity(bodies.len());
    for body in bodies {
        turns.push(match body.hang {
            Hang::Free(pose) => pose.turn,
            Hang::Held { .. } => SO3::identity(),
            Hang::Joint { parent, at, .. } => match parent {
                Some(parent) => turns[parent].compose(&at.turn),
                None => at.turn,
            },
        });
    }
    turns
}

/// A number that is read again to the last bit.
fn number(x: f64) -> String {
    // Without the sign of a zero.
    format!("{:?}", x + 0.0)
}

fn array(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|x| number(*x)).collect();
    format!("[{}]", values.join(", "))
}

fn vector(x: Vec3) -> String {
    array(&x.0)
}

fn quaternion(turn: &SO3) -> String {
    array(&turn.to_quaternion())
}

/// A matrix by its diagonal, where that is all.
fn symmetric(matrix: Mat3) -> String {
    let rows = matrix.0;
    let off = [rows[0][1], rows[0][2], rows[1][2]];
    match off == [0.0; 3] {
        true => array(&[rows[0][0], rows[1][1], rows[2][2]]),
        false => format!("[{}]", rows.map(|row| array(&row)).join(", ")),
    }
}

/// A string of TOML on one line.
fn quoted(text: &str) -> String {
    let text: String = text
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
