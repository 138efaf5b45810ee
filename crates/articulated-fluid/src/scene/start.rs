//! The initial state of the first body's mass centre.

use super::description::{SceneMount, StartVelocity};
use super::entry::{Table, Value};
use super::error::SceneError;

/// Position and velocity.
pub(super) fn read(
    table: Option<&Table>,
    mount: Option<&SceneMount>,
) -> Result<([f64; 3], StartVelocity), SceneError> {
    let (mut position, mut velocity) = ([0.0; 3], StartVelocity::Given([0.0; 3]));
    let Some(table) = table else {
        return Ok((position, velocity));
    };
    if let Some(mount) = mount {
        let name = &mount.name;
        let mut keys = ["position", "velocity", "momentum"].iter();
        if let Some(value) = keys.find_map(|key| table.get(key)) {
            let what = format!(
                "the first body hangs on the world by the joint {name:?}; expected no such key"
            );
            return Err(value.fail(&what));
        }
    }
    position = table.read("position", position, Value::array)?;
    velocity = table.read("velocity", velocity, start_velocity)?;
    if let Some(momentum) = table.get("momentum") {
        if momentum.text()? != "zero" {
            return Err(momentum.unknown_word(momentum.text()?));
        }
        if table.get("velocity").is_some() {
            let what = "given together with velocity, which follows from it; expected one of them";
            return Err(momentum.fail(what));
        }
        velocity = StartVelocity::NoMomentum;
    }
    Ok((position, velocity))
}

fn start_velocity(value: &Value) -> Result<StartVelocity, SceneError> {
    match value.word() {
        Some("zero-momentum") => Ok(StartVelocity::ZeroMomentum),
        Some(word) => Err(value.unknown_word(word)),
        None => value.array().map(StartVelocity::Given),
    }
}
