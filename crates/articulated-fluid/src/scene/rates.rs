//! Attitudes that follow from joints, and angular velocities: absolute, or relative to the parent.

use lie::{SO3, Vec3};

use super::description::{SceneBody, SceneJoint, SceneMount};
use super::entry::{Table, Value};
use super::error::SceneError;
use super::mobility::Mobility;

/// How a body turns: its attitude and its rate, rad/s in its frame.
#[derive(Clone, Copy)]
struct Turning {
    r: SO3,
    omega: Vec3,
}

impl Turning {
    /// That of the world.
    fn world() -> Self {
        Self {
            r: SO3::identity(),
            omega: Vec3::zero(),
        }
    }
}

/// Sets the attitudes of the `bodies` that follow from their joints, and the absolute rates of all; each body comes after its parent.
///
/// Where the whole `floats`, the rates are those beside a head that does not turn.
pub(super) fn set(
    tables: &[Table],
    (mount, joints): (Option<&SceneMount>, &[SceneJoint]),
    floats: bool,
    bodies: &mut [SceneBody],
) -> Result<(), SceneError> {
    let mut on: Vec<Option<(Option<usize>, &Mobility)>> = vec![None; bodies.len()];
    on[0] = mount.map(|mount| (None, &mount.mobility));
    for joint in joints {
        on[joint.child] = Some((Some(joint.parent), &joint.mobility));
    }
    for (index, (table, on)) in tables.iter().zip(on).enumerate() {
        let parent =
            on.map(|(parent, _)| parent.map_or_else(Turning::world, |p| turning(&bodies[p])));
        let follows = on.map(|(_, mobility)| mobility).and_then(relative);
        let turning = match follows {
            Some((c, rate)) => {
                refuse_own(table)?;
                let Turning { r, omega } = parent.unwrap_or_else(Turning::world);
                let r = SO3::from_matrix_unchecked(*r.matrix() * *c.matrix());
                bodies[index].attitude = r.to_quaternion();
                c.inverse_rotate(omega) + rate
            }
            None => free(table, &bodies[index], parent, floats)?,
        };
        bodies[index].angular_velocity = turning.0;
    }
    Ok(())
}

fn turning(body: &SceneBody) -> Turning {
    Turning {
        r: SO3::from_quaternion(body.attitude),
        omega: Vec3(body.angular_velocity),
    }
}

/// The attitude and the rate relative to the parent, where the joint gives them.
fn relative(mobility: &Mobility) -> Option<(SO3, Vec3)> {
    mobility.kind.relative([mobility.angle, mobility.rate])
}

/// Refuses attitudes and rates of a body whose joint gives them.
fn refuse_own(table: &Table) -> Result<(), SceneError> {
    let mut keys = ["attitude", "angular_velocity", "joint_rate"].iter();
    match keys.find_map(|key| table.get(key)) {
        None => Ok(()),
        Some(value) => Err(value.fail(
            "the body's joint gives it; expected no such key, and rest, angle, rate or motion in [[joint]]",
        )),
    }
}

/// The rate of a body that is free or on a ball.
fn free(
    table: &Table,
    body: &SceneBody,
    parent: Option<Turning>,
    floats: bool,
) -> Result<Vec3, SceneError> {
    match (table.get("joint_rate"), table.get("angular_velocity")) {
        (Some(rate), Some(_)) => {
            let message = "given together with angular_velocity; expected one of them";
            Err(rate.fail(message))
        }
        (None, Some(given)) if floats => {
            let message =
                "it follows from momentum = \"zero\"; expected joint_rate, or no such key";
            Err(given.fail(message))
        }
        (None, Some(given)) => Ok(Vec3(given.array()?)),
        (None, None) if floats => Ok(carried(body, parent)),
        (None, None) => Ok(Vec3::zero()),
        (Some(rate), None) => absolute(&rate, body, parent),
    }
}

/// $R^T R_p \Omega_p$.
fn carried(body: &SceneBody, parent: Option<Turning>) -> Vec3 {
    let Some(Turning { r, omega }) = parent else {
        return Vec3::zero();
    };
    SO3::from_quaternion(body.attitude).inverse_rotate(r.rotate(omega))
}

/// $\Omega = \omega + R^T R_p \Omega_p$ of a body that turns at $\omega$ relative to its parent.
fn absolute(rate: &Value, body: &SceneBody, parent: Option<Turning>) -> Result<Vec3, SceneError> {
    if parent.is_none() {
        let message = "the first body hangs on no joint; expected the key angular_velocity";
        return Err(rate.fail(message));
    }
    let absolute = Vec3(rate.array()?) + carried(body, parent);
    match absolute.is_finite() {
        true => Ok(absolute),
        false => {
            let message = "with the parent's, the rate overflows; expected less extreme numbers";
            Err(rate.fail(message))
        }
    }
}
