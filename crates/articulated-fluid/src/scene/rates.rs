//! Angular velocities: absolute, or relative to the parent.

use lie::{SO3, Vec3};
use toml::Spanned;

use super::description::{SceneBody, SceneJoint};
use super::error::SceneError;
use super::raw::{Node, RawBody};
use super::source::Source;
use super::values::{array, triple_or_zero};

/// Sets the absolute rates of the `bodies`, each of which comes after its parent.
pub(super) fn set(
    raw: &[Node<RawBody>],
    joints: &[SceneJoint],
    bodies: &mut [SceneBody],
    source: &Source,
) -> Result<(), SceneError> {
    let mut parents = vec![None; bodies.len()];
    for joint in joints {
        parents[joint.child] = Some(joint.parent);
    }
    for (index, node) in raw.iter().enumerate() {
        let raw = &node.get_ref().0;
        bodies[index].angular_velocity = match &raw.joint_rate {
            None => triple_or_zero(raw.angular_velocity.as_ref(), source)?,
            Some(field) => {
                refuse_both(raw, field, source)?;
                let parent = parents[index].map(|parent: usize| &bodies[parent]);
                absolute(field, &bodies[index], parent, source)?
            }
        };
    }
    Ok(())
}

fn refuse_both(
    raw: &RawBody,
    field: &Spanned<Vec<f64>>,
    source: &Source,
) -> Result<(), SceneError> {
    match raw.angular_velocity {
        None => Ok(()),
        Some(_) => {
            let message = "given together with angular_velocity; expected one of them";
            Err(source.fail(field.span(), message))
        }
    }
}

/// $\Omega = \omega + R^T R_p \Omega_p$ of a body that turns at $\omega$ relative to its parent.
fn absolute(
    field: &Spanned<Vec<f64>>,
    body: &SceneBody,
    parent: Option<&SceneBody>,
    source: &Source,
) -> Result<[f64; 3], SceneError> {
    let Some(parent) = parent else {
        let message = "the first body hangs on no joint; expected the key angular_velocity";
        return Err(source.fail(field.span(), message));
    };
    let carried = SO3::from_quaternion(parent.attitude).rotate(Vec3(parent.angular_velocity));
    let rate =
        Vec3(array(field, source)?) + SO3::from_quaternion(body.attitude).inverse_rotate(carried);
    match rate.is_finite() {
        true => Ok(rate.0),
        false => {
            let message = "with the parent's, the rate overflows; expected less extreme numbers";
            Err(source.fail(field.span(), message))
        }
    }
}
