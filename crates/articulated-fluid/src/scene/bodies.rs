//! The bodies of a scene: names, inertia and attitudes.

use std::collections::HashMap;

use super::description::SceneBody;
use super::entry::{Table, Value};
use super::error::SceneError;
use super::forms::{self, Surroundings};
use crate::loads::on_bodies::BodyLoad;

/// The parent of a first body that is not free.
pub(super) const WORLD: &str = "world";

/// A name of a body, and its place.
pub(super) struct Name<'a> {
    pub text: &'a str,
    pub value: Value<'a>,
}

/// The names of the bodies.
#[derive(Default)]
pub(super) struct Names<'a> {
    /// In the order of the bodies.
    pub listed: Vec<Name<'a>>,
    /// The bodies by their names.
    pub index: HashMap<&'a str, usize>,
}

/// The bodies, still at rest, and their names.
pub(super) fn check<'a>(
    tables: &[Table<'a>],
    around: &Surroundings,
) -> Result<(Names<'a>, Vec<SceneBody>), SceneError> {
    let mut names = Names::default();
    let mut bodies = Vec::with_capacity(tables.len());
    for table in tables {
        let name = name(table, &names)?;
        let table = table.clone().of_body(name.text);
        let body = forms::check(&table, name.text, around)?;
        bodies.push(SceneBody {
            attitude: table.read("attitude", body.attitude, Value::attitude)?,
            buoyancy_at: buoyancy_at(&table, body.mass().is_some())?,
            loads: BodyLoad::read_all(&table)?,
            ..body
        });
        names.index.insert(name.text, names.listed.len());
        names.listed.push(name);
    }
    Ok((names, bodies))
}

/// Where the buoyancy of a body acts.
fn buoyancy_at(table: &Table, has_mass: bool) -> Result<[f64; 3], SceneError> {
    match table.get("buoyancy_at") {
        Some(value) if !has_mass => {
            let what = "the mass of the displaced fluid is not known; expected mass and volume, or semi_axes";
            Err(value.fail(what))
        }
        Some(value) => value.array(),
        None => Ok([0.0; 3]),
    }
}

fn name<'a>(table: &Table<'a>, earlier: &Names) -> Result<Name<'a>, SceneError> {
    let value = table.require("name")?;
    let text = value.text()?;
    if !is_name(text) {
        return Err(value.wrong(&format!("is {text:?}")));
    }
    if text == WORLD {
        return Err(value.wrong("\"world\" is what the first body may hang on"));
    }
    match earlier.index.get(text) {
        Some(other) => {
            let line = earlier.listed[*other].value.line();
            Err(value.wrong(&format!("{text:?} is the body in line {line}")))
        }
        None => Ok(Name { text, value }),
    }
}

/// Whether a text may name a body or a joint.
pub(super) fn is_name(text: &str) -> bool {
    let allowed = |c: char| c.is_ascii_alphanumeric() || "-_/.".contains(c);
    !text.is_empty() && text.chars().all(allowed)
}
