//! The keys of a scene file: the one place that documents them.

use std::borrow::Cow;

use crate::joints;

/// The documentation of one key of a scene file.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[non_exhaustive]
pub struct Key {
    /// Dotted path: `fluid.density`; a table has an entry of its own.
    pub path: &'static str,
    /// What value is expected, with its unit.
    pub value: &'static str,
    /// What holds without the key.
    pub default: &'static str,
    /// What the value means.
    pub meaning: &'static str,
}

const fn key(
    path: &'static str,
    value: &'static str,
    default: &'static str,
    meaning: &'static str,
) -> Key {
    Key {
        path,
        value,
        default,
        meaning,
    }
}

const REQUIRED: &str = "required";
/// A value of a time law.
const LAW: &str = "a finite number for a hinge or an array of 3 for a ball, in rad; of a torque in N m, of a thrust in N";
/// Tables with the keys of `joint.motion`.
const LAWS: [&str; 3] = ["joint.torque", "joint.servo.target", "body.thrust.force"];

/// Every key that a scene file may have, in the order of the schema.
pub const KEYS: &[Key] = &[
    key("title", "a string", "none", "what the scene shows"),
    key(
        "gravity",
        "an array of 3 finite numbers, in m/s^2",
        "zero",
        "acceleration of gravity in the reference frame; less buoyancy, it acts at the mass centres",
    ),
    key("fluid", "one table [fluid]", REQUIRED, "the perfect fluid"),
    key(
        "fluid.density",
        "a finite number >= 0, in kg/m^3",
        REQUIRED,
        "density of the fluid; 0 is a vacuum",
    ),
    key(
        "start",
        "one table [start]",
        "at rest at the origin",
        "initial state of the first body's mass centre",
    ),
    key(
        "start.position",
        "an array of 3 finite numbers, in m",
        "zero",
        "position in the reference frame",
    ),
    key(
        "start.velocity",
        "an array of 3 finite numbers, in m/s, or \"zero-momentum\"",
        "zero",
        "velocity in the reference frame; \"zero-momentum\": that of no total linear momentum",
    ),
    key(
        "start.momentum",
        "\"zero\"",
        "that of the velocities",
        "no linear and no angular momentum: the first body's velocities follow, and joint_rate is 0 where not given; \
         not with velocity, nor with a base on the world",
    ),
    key(
        "body",
        "one table [[body]] for each body",
        "at least one is required",
        "a rigid body; on the first, the head, the others hang, each listed after its parent",
    ),
    key(
        "body.name",
        "a unique name of letters a-z A-Z, digits, - _ / and .",
        REQUIRED,
        "name of the body in joints and in results",
    ),
    key(
        "body.semi_axes",
        "an array of 3 finite numbers > 0, in m",
        "another form: mass and inertia, or total_mass and total_inertia",
        "semi-axes along the body's x, y, z of a uniform ellipsoid; \
         its added mass and inertia follow",
    ),
    key(
        "body.mass",
        "a finite number > 0, in kg",
        "with semi_axes neutral buoyancy: fluid density times volume",
        "mass of the body alone, with semi_axes or inertia",
    ),
    key(
        "body.inertia",
        "an array of 3 numbers > 0 (diagonal) or of 3 rows of 3 numbers \
         (symmetric to 1e-3 of the largest, positive definite), in kg m^2",
        "another form: semi_axes, or total_mass and total_inertia",
        "inertia of the body alone about the mass centre, in the body's frame, with mass",
    ),
    key(
        "body.added_mass",
        "an array of 3 numbers >= 0 (diagonal) or of 3 rows of 3 numbers, or of 6 rows of 6 \
         (symmetric to 1e-3 of the largest, positive semidefinite), in kg, kg m and kg m^2",
        "zero",
        "added mass in the body's frame, with inertia; 6 rows have the added inertia in them, translation first, about the mass centre",
    ),
    key(
        "body.added_inertia",
        "an array of 3 numbers >= 0 (diagonal) or of 3 rows of 3 numbers \
         (symmetric to 1e-3 of the largest, positive semidefinite), in kg m^2",
        "zero",
        "added inertia about the mass centre, in the body's frame, with inertia",
    ),
    key(
        "body.volume",
        "a finite number >= 0, in m^3",
        "that of shape; required with gravity in a fluid",
        "displaced volume, with inertia; its buoyancy acts at the mass centre",
    ),
    key(
        "body.total_mass",
        "an array of 3 numbers > 0 (diagonal) or of 3 rows of 3 numbers \
         (symmetric to 1e-3 of the largest, positive definite), in kg",
        "another form: semi_axes, or mass and inertia",
        "mass of the body plus added mass, in the body's frame; not with gravity",
    ),
    key(
        "body.total_inertia",
        "an array of 3 numbers > 0 (diagonal) or of 3 rows of 3 numbers \
         (symmetric to 1e-3 of the largest, positive definite), in kg m^2",
        "another form: semi_axes, or mass and inertia",
        "inertia of the body plus added inertia about the mass centre, in the body's frame",
    ),
    key(
        "body.shape",
        "an array of 3 finite numbers > 0, in m",
        "none",
        "semi-axes of the body's ellipsoid, with inertia or total_mass: \
         for warnings of overlap and the default of volume",
    ),
    key(
        "body.buoyancy_at",
        "an array of 3 finite numbers, in m",
        "the mass centre",
        "where the buoyancy acts, from the mass centre in the body's frame",
    ),
    key(
        "body.drag",
        "a table { linear, quadratic, angular_linear, angular_quadratic, smooth_below }",
        "none",
        "force and moment against the motion along and about the body's axes, at its mass centre",
    ),
    key(
        "body.drag.linear",
        "an array of 3 finite numbers >= 0, in N s/m",
        "zero",
        "force for the velocity",
    ),
    key(
        "body.drag.quadratic",
        "an array of 3 finite numbers >= 0, in N s^2/m^2",
        "zero",
        "force for the velocity times its size, axis by axis",
    ),
    key(
        "body.drag.angular_linear",
        "an array of 3 finite numbers >= 0, in N m s",
        "zero",
        "moment for the angular velocity",
    ),
    key(
        "body.drag.angular_quadratic",
        "an array of 3 finite numbers >= 0, in N m s^2",
        "zero",
        "moment for the angular velocity times its size, axis by axis",
    ),
    key(
        "body.drag.smooth_below",
        "a finite number >= 0, in m/s",
        "0",
        "speed below which quadratic drag is rounded off: methods of high order ask for it where a velocity changes sign",
    ),
    key(
        "body.thrust",
        "a table { force, at }",
        "none",
        "a force that goes with the body",
    ),
    key(
        "body.thrust.force",
        "an array of 3 finite numbers, in N, or a table with the keys of joint.motion",
        REQUIRED,
        "the force, in the body's frame",
    ),
    key(
        "body.thrust.at",
        "an array of 3 finite numbers, in m",
        "the mass centre",
        "where it acts, from the mass centre in the body's frame",
    ),
    key(
        "body.attitude",
        "an array of 4 numbers w, x, y, z: a quaternion of length 1 (to 1e-3), \
         a table { axis, angle } or \"aligned\"",
        "\"aligned\" with the reference frame",
        "initial attitude, body to reference frame",
    ),
    key(
        "body.attitude.axis",
        "an array of 3 finite numbers, not all 0",
        REQUIRED,
        "direction of the axis of rotation",
    ),
    key(
        "body.attitude.angle",
        "a finite number, in rad",
        REQUIRED,
        "angle of rotation about the axis",
    ),
    key(
        "body.angular_velocity",
        "an array of 3 finite numbers, in rad/s",
        "zero",
        "initial angular velocity in the body's frame",
    ),
    key(
        "body.joint_rate",
        "an array of 3 finite numbers, in rad/s",
        "angular_velocity",
        "initial angular velocity relative to the parent, in the body's frame; \
         not for the first body",
    ),
    key(
        "joint",
        "one table [[joint]] for each body but the first",
        "none, for a body alone",
        "a joint, free or moved as told; one more may hang the first body on the world",
    ),
    key(
        "joint.name",
        "a name of letters a-z A-Z, digits, - _ / and . that no other joint has",
        "the name of the child",
        "name of the joint in gaits and in results",
    ),
    key(
        "joint.parent",
        "the name of a body listed before the child, or \"world\" for the first body",
        REQUIRED,
        "the body on which the child hangs",
    ),
    key(
        "joint.child",
        "the name of a body other than the first",
        REQUIRED,
        "the body that hangs on the parent; each is the child of one joint; on \"world\", the first body",
    ),
    key(
        "joint.at_parent",
        "an array of 3 finite numbers, in m",
        REQUIRED,
        "the joint from the parent's mass centre, in the parent's frame; on the world in the reference frame",
    ),
    key(
        "joint.at_child",
        "an array of 3 finite numbers, in m",
        REQUIRED,
        "the joint from the child's mass centre, in the child's frame",
    ),
    key("joint.type", joints::WORDS[0], "\"ball\"", joints::WORDS[1]),
    key(
        "joint.axis",
        "an array of 3 finite numbers, not all 0",
        "required by a hinge",
        "axis of a hinge, of any length, in the child's frame; its angle is not limited",
    ),
    key(
        "joint.rest",
        "an array of 4 numbers w, x, y, z: a quaternion of length 1 (to 1e-3), \
         a table { axis, angle } or \"aligned\"",
        "\"aligned\" with the parent's frame",
        "attitude of the child on the parent: of a fixed joint, of a hinge at the angle 0, of a motion at 0",
    ),
    key(
        "joint.rest.axis",
        "an array of 3 finite numbers, not all 0",
        REQUIRED,
        "direction of the axis of rotation",
    ),
    key(
        "joint.rest.angle",
        "a finite number, in rad",
        REQUIRED,
        "angle of rotation about the axis",
    ),
    key(
        "joint.angle",
        "a finite number, in rad",
        "0",
        "angle of a free hinge at the start",
    ),
    key(
        "joint.rate",
        "a finite number, in rad/s",
        "0",
        "rate of a free hinge at the start",
    ),
    key(
        "joint.rest_angle",
        "a finite number, in rad",
        "0",
        "angle q0 at which the spring of a hinge is at rest",
    ),
    key(
        "joint.stiffness",
        "a finite number >= 0, in N m",
        "0: a free joint",
        "k of the potential k (1 - cos theta), theta the angle between the frames of parent and child: \
         the joint is at rest where they are aligned; of a hinge, in N m/rad, of k (q - q0)^2 / 2",
    ),
    key(
        "joint.motion",
        "a table { amplitude, frequency, phase, bias, ramp, harmonics } or { file, columns, repeat }",
        "the joint is free",
        "the angle of a hinge, or the rotation vector of a ball after rest, as told: \
         bias + ramp(t) amplitude sin(2 pi frequency t + phase)",
    ),
    key(
        "joint.motion.amplitude",
        LAW,
        "0",
        "amplitude of the sinusoid",
    ),
    key(
        "joint.motion.frequency",
        "a finite number, in Hz",
        "required with an amplitude",
        "frequency of the sinusoid",
    ),
    key("joint.motion.phase", LAW, "0", "phase of the sinusoid"),
    key("joint.motion.bias", LAW, "0", "what the sinusoid is about"),
    key(
        "joint.motion.ramp",
        "a finite number >= 0, in s",
        "0",
        "time in which the motion comes up from rest, smoothly",
    ),
    key(
        "joint.motion.harmonics",
        "an array of pairs [amplitude, phase], each a number for a hinge or an array of 3 for a ball",
        "none",
        "further sinusoids: the k-th, from 0, at k + 1 times the frequency",
    ),
    key(
        "joint.motion.file",
        "a path, from the folder of the scene",
        "a sinusoid",
        "a CSV table whose first row has names: time in s, then the angle or the three numbers in rad; \
         a cubic spline goes through its rows; steps do not end at its times, where the third derivative jumps, \
         so that no method is of higher order than 3 across them",
    ),
    key(
        "joint.motion.columns",
        "an array of the names of the time and of each number",
        "the first columns of the table",
        "which columns of the table are read",
    ),
    key(
        "joint.motion.repeat",
        "true or false",
        "false: the motion is defined up to the last row only",
        "whether the table is repeated; its last row then equals the first",
    ),
    key(
        "joint.damping",
        "a finite number >= 0, in N m s/rad",
        "0",
        "of a damper: the torque on the child against its rate on the parent",
    ),
    key(
        "joint.torque",
        "a table with the keys of joint.motion, in N m",
        "none",
        "torque on the child, in its frame, of a hinge about the axis; the parent has the opposite one",
    ),
    key(
        "joint.servo",
        "a table { kp, kd, target }",
        "none",
        "a motor that pulls the joint to its target; to follow a motion exactly, take joint.motion",
    ),
    key(
        "joint.servo.kp",
        "a finite number >= 0, in N m/rad",
        REQUIRED,
        "torque for the angle that is missing, of a ball for its sine",
    ),
    key(
        "joint.servo.kd",
        "a finite number >= 0, in N m s/rad",
        "0",
        "torque against the rate beside the target's",
    ),
    key(
        "joint.servo.target",
        "a table with the keys of joint.motion",
        REQUIRED,
        "the angle of a hinge, or the rotation vector of a ball, to follow",
    ),
    key(
        "joint.place",
        "a table { amplitude, frequency, phase, bias, ramp, harmonics }",
        "at_parent",
        "how the place of a joint to the world moves, from at_parent on",
    ),
    key(
        "joint.place.amplitude",
        "an array of 3 finite numbers, in m",
        "zero",
        "amplitude of the sinusoid",
    ),
    key(
        "joint.place.frequency",
        "a finite number, in Hz",
        "required with an amplitude",
        "frequency of the sinusoid",
    ),
    key(
        "joint.place.phase",
        "an array of 3 finite numbers, in rad",
        "zero",
        "phase of the sinusoid",
    ),
    key(
        "joint.place.bias",
        "an array of 3 finite numbers, in m",
        "zero",
        "what the sinusoid is about, from at_parent",
    ),
    key(
        "joint.place.ramp",
        "a finite number >= 0, in s",
        "0",
        "time in which the motion comes up from rest, smoothly",
    ),
    key(
        "joint.place.harmonics",
        "an array of pairs [amplitude, phase], each an array of 3",
        "none",
        "further sinusoids: the k-th, from 0, at k + 1 times the frequency",
    ),
    key(
        "gait",
        "one table [[gait]] for each wave over joints",
        "none",
        "moves several joints in turn: the j-th of the list, from 0, has the phase less j phase_lag",
    ),
    key(
        "gait.joints",
        "an array of names of joints",
        REQUIRED,
        "the joints that the wave runs over, all hinges or all balls",
    ),
    key(
        "gait.amplitude",
        "a finite number for hinges or an array of 3 for balls, in rad",
        "0",
        "amplitude of the sinusoid",
    ),
    key(
        "gait.frequency",
        "a finite number, in Hz",
        "required with an amplitude",
        "frequency of the sinusoid",
    ),
    key(
        "gait.phase",
        "a finite number for hinges or an array of 3 for balls, in rad",
        "0",
        "phase of the first joint",
    ),
    key(
        "gait.phase_lag",
        "a finite number, in rad",
        "0",
        "by how much each joint lags behind the one before",
    ),
    key(
        "gait.bias",
        "a finite number for hinges or an array of 3 for balls, in rad",
        "0",
        "what the sinusoid is about",
    ),
    key(
        "gait.ramp",
        "a finite number >= 0, in s",
        "0",
        "time in which the motion comes up from rest, smoothly",
    ),
];

/// [`KEYS`] as text to show to users.
///
/// ```
/// use articulated_fluid::scene::reference;
///
/// assert!(reference().contains("fluid.density: a finite number >= 0, in kg/m^3"));
/// ```
pub fn reference() -> String {
    let entry = |key: &Key| {
        let Key {
            path,
            value,
            default,
            meaning,
        } = key;
        let default = match *default {
            REQUIRED => REQUIRED.to_owned(),
            default => format!("default: {default}"),
        };
        format!("{path}: {value}\n    {meaning}\n    {default}\n")
    };
    KEYS.iter().map(entry).collect()
}

/// The path under which the key at `path` is documented: all time laws have the keys of one.
fn documented(path: &str) -> Cow<'_, str> {
    let law = LAWS.iter().find_map(|law| path.strip_prefix(law));
    match law {
        Some(key) if key.is_empty() || key.starts_with('.') => format!("joint.motion{key}").into(),
        _ => path.into(),
    }
}

/// What is expected as the value of the key at `path`.
pub(super) fn expected(path: &str) -> Option<&'static str> {
    let own = KEYS.iter().find(|key| key.path == path);
    own.or_else(|| KEYS.iter().find(|key| key.path == documented(path)))
        .map(|key| key.value)
}

/// The names of the keys in the table at `path`.
pub(super) fn below(path: &str) -> impl Iterator<Item = &'static str> {
    let path = documented(path).into_owned();
    let name = move |key: &'static Key| match (&path[..], key.path.rsplit_once('.')) {
        ("", None) => Some(key.path),
        (_, Some((table, name))) if table == path => Some(name),
        _ => None,
    };
    KEYS.iter().filter_map(name)
}
