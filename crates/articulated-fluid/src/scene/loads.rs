//! What acts on bodies and in joints of a scene beside weight and springs.

use std::sync::Arc;

use lie::{SO3, Vec3};

use super::entry::{Table, Value};
use super::error::SceneError;
use super::laws;
use crate::joints::JointKind;
use crate::loads::{Drag, JointLoad, Servo, Thrust, Torque};
use crate::motion::{Motion, Sinusoid};

/// The load of a joint of this kind, which is free.
pub(super) fn in_joint(table: &Table, kind: &JointKind) -> Result<JointLoad, SceneError> {
    let law = |value: &Value| match kind {
        JointKind::Hinge(_) => Ok(Torque::Hinge(laws::law::<1>(&value.table()?)?)),
        _ => Ok(Torque::Ball(laws::law::<3>(&value.table()?)?)),
    };
    Ok(JointLoad {
        damping: table.read("damping", 0.0, Value::not_negative)?,
        torque: table.read("torque", None, |value| law(value).map(Some))?,
        servo: table.read("servo", None, |value| {
            servo(&value.table()?, kind).map(Some)
        })?,
    })
}

fn servo(table: &Table, kind: &JointKind) -> Result<Servo, SceneError> {
    let target = table.require("target")?.table()?;
    let target = match kind {
        JointKind::Hinge(hinge) => Motion::Hinge {
            axis: hinge.axis,
            rest: hinge.rest,
            angle: laws::law::<1>(&target)?,
        },
        _ => Motion::Ball {
            rest: SO3::identity(),
            turn: laws::law::<3>(&target)?,
        },
    };
    Ok(Servo {
        stiffness: table.require("kp")?.not_negative()?,
        damping: table.read("kd", 0.0, Value::not_negative)?,
        target,
    })
}

/// Where the buoyancy of a body acts.
pub(super) fn buoyancy_at(table: &Table, has_mass: bool) -> Result<[f64; 3], SceneError> {
    match table.get("buoyancy_at") {
        Some(value) if !has_mass => {
            let what = "the mass of the displaced fluid is not known; expected mass and volume, or semi_axes";
            Err(value.fail(what))
        }
        Some(value) => value.array(),
        None => Ok([0.0; 3]),
    }
}

/// The drag of a body.
pub(super) fn drag(table: &Table) -> Result<Option<Drag>, SceneError> {
    let Some(value) = table.get("drag") else {
        return Ok(None);
    };
    let drag = value.table()?;
    let numbers = |key: &str| drag.read(key, [0.0; 3], Value::not_negative_array);
    Ok(Some(Drag {
        linear: numbers("linear")?,
        quadratic: numbers("quadratic")?,
        angular_linear: numbers("angular_linear")?,
        angular_quadratic: numbers("angular_quadratic")?,
        smooth_below: drag.read("smooth_below", 0.0, Value::not_negative)?,
    }))
}

/// The thrust on a body.
pub(super) fn thrust(table: &Table) -> Result<Option<Thrust>, SceneError> {
    let Some(value) = table.get("thrust") else {
        return Ok(None);
    };
    let thrust = value.table()?;
    let force = thrust.require("force")?;
    let force = match force.is_table() {
        true => laws::law::<3>(&force.table()?)?,
        false => Arc::new(Sinusoid::constant(force.array()?)),
    };
    let at = Vec3(thrust.read("at", [0.0; 3], Value::array)?);
    Ok(Some(Thrust { force, at }))
}
