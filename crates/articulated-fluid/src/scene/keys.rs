//! The keys of a scene file: the one place that documents them.

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
        "an array of 3 numbers >= 0 (diagonal) or of 3 rows of 3 numbers \
         (symmetric to 1e-3 of the largest, positive semidefinite), in kg",
        "zero",
        "added mass in the body's frame, with inertia",
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
        "a ball joint",
    ),
    key(
        "joint.parent",
        "the name of a body listed before the child",
        REQUIRED,
        "the body on which the child hangs",
    ),
    key(
        "joint.child",
        "the name of a body other than the first",
        REQUIRED,
        "the body that hangs on the parent; each is the child of one joint",
    ),
    key(
        "joint.at_parent",
        "an array of 3 finite numbers, in m",
        REQUIRED,
        "the joint from the parent's mass centre, in the parent's frame",
    ),
    key(
        "joint.at_child",
        "an array of 3 finite numbers, in m",
        REQUIRED,
        "the joint from the child's mass centre, in the child's frame",
    ),
    key(
        "joint.stiffness",
        "a finite number >= 0, in N m",
        "0: a free joint",
        "k of the potential k (1 - cos theta), theta the angle between the frames of parent and child: \
         the joint is at rest where they are aligned",
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

/// What is expected as the value of the key at `path`.
pub(super) fn expected(path: &str) -> Option<&'static str> {
    KEYS.iter()
        .find(|key| key.path == path)
        .map(|key| key.value)
}

/// The names of the keys in the table at `path`.
pub(super) fn below(path: &str) -> impl Iterator<Item = &'static str> {
    let name = move |key: &'static Key| match (path, key.path.rsplit_once('.')) {
        ("", None) => Some(key.path),
        (_, Some((table, name))) if table == path => Some(name),
        _ => None,
    };
    KEYS.iter().filter_map(name)
}
