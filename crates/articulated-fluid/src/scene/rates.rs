//! Angular velocities: absolute, or relative to the parent.

use lie::{SO3, Vec3};

use super::description::{SceneBody, SceneJoint};
use super::entry::{Table, Value};
use super::error::SceneError;

/// Sets the absolute rates of the `bodies`, each of which comes after its parent.
pub(super) fn set(
    tables: &[Table],
    joints: &[SceneJoint],
    bodies: &mut [SceneBody],
) -> Result<(), SceneError> {
    let mut parents = vec![None; bodies.len()];
    for joint in joints {
        parents[joint.child] = Some(joint.parent);
    }
    for (index, table) in tables.iter().enumerate() {
        let given = table.get("angular_velocity");
        bodies[index].angular_velocity = match (table.get("joint_rate"), given) {
            (None, None) => [0.0; 3],
            (None, Some(given)) => given.array()?,
            (Some(rate), Some(_)) => {
                let message = "given together with angular_velocity; expected one of them";
                return Err(rate.fail(message));
            }
            (Some(rate), None) => {
                let parent = parents[index].map(|parent: usize| &bodies[parent]);
                absolute(&rate, &bodies[index], parent)?
            }
        };
    }
    Ok(())
}

/// $\Omega = \omega + R^T R_p \Omega_p$ of a body that turns at $\omega$ relative to its parent.
fn absolute(
    rate: &Value,
    body: &SceneBody,
    parent: Option<&SceneBody>,
) -> Result<[f64; 3], SceneError> {
    let Some(parent) = parent else {
        let message = "the first body hangs on no joint; expected the key angular_velocity";
        return Err(rate.fail(message));
    };
    let carried = SO3::from_quaternion(parent.attitude).rotate(Vec3(parent.angular_velocity));
    let turned = SO3::from_quaternion(body.attitude).inverse_rotate(carried);
    let absolute = Vec3(rate.array()?) + turned;
    match absolute.is_finite() {
        true => Ok(absolute.0),
        false => {
            let message = "with the parent's, the rate overflows; expected less extreme numbers";
            Err(rate.fail(message))
        }
    }
}
