//! The bodies of a scene: names, inertia and attitudes.

use std::collections::HashMap;

use toml::Spanned;

use super::description::SceneBody;
use super::error::SceneError;
use super::forms::{self, Inertial, Surroundings};
use super::raw::{Node, RawBody};
use super::source::Source;
use super::values::attitude;

/// The names of the bodies, with the place of each.
#[derive(Default)]
pub(super) struct Names<'r> {
    /// In the order of the bodies.
    pub listed: Vec<&'r Spanned<String>>,
    /// The bodies by their names.
    pub index: HashMap<&'r str, usize>,
}

/// The bodies, still at rest, and their names.
pub(super) fn check<'r>(
    raw: &'r [Node<RawBody>],
    around: &Surroundings,
    source: &Source,
) -> Result<(Names<'r>, Vec<SceneBody>), SceneError> {
    if raw.is_empty() {
        return Err(source.absent("body"));
    }
    let mut names = Names::default();
    let mut bodies = Vec::with_capacity(raw.len());
    for node in raw {
        let name = name(node, &names, source)?;
        bodies.push(body(node, name.get_ref(), around, source)?);
        names.index.insert(name.get_ref(), names.listed.len());
        names.listed.push(name);
    }
    Ok((names, bodies))
}

fn name<'r>(
    node: &'r Node<RawBody>,
    earlier: &Names,
    source: &Source,
) -> Result<&'r Spanned<String>, SceneError> {
    let name = source.require(node, "name", &node.get_ref().0.name)?;
    let text = name.get_ref();
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if text.is_empty() || !text.chars().all(allowed) {
        return Err(source.wrong(name.span(), &format!("is {text:?}")));
    }
    match earlier.index.get(text.as_str()) {
        Some(other) => {
            let line = source.line(earlier.listed[*other].span());
            let what = format!("{text:?} is the body in line {line}");
            Err(source.wrong(name.span(), &what))
        }
        None => Ok(name),
    }
}

fn body(
    node: &Node<RawBody>,
    name: &str,
    around: &Surroundings,
    source: &Source,
) -> Result<SceneBody, SceneError> {
    let Inertial {
        semi_axes,
        total_mass,
        total_inertia,
        net_mass,
    } = forms::check(node, around, source)?;
    Ok(SceneBody {
        name: name.to_owned(),
        semi_axes,
        total_mass,
        total_inertia,
        net_mass,
        attitude: attitude(&node.get_ref().0.attitude, source)?,
        angular_velocity: [0.0; 3],
    })
}
