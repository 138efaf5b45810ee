//! The bodies of a scene: names, inertia and initial state.

use toml::Spanned;

use super::SceneBody;
use super::error::SceneError;
use super::raw::{Node, RawBody};
use super::source::Source;
use super::values::{array, attitude, definite, diagonal, positive, triple_or_zero};
use crate::ellipsoid::Ellipsoid;

/// Total mass and total inertia.
type Totals = [[[f64; 3]; 3]; 2];

/// The bodies, and their names with the place of each.
pub(super) fn check<'r>(
    raw: &'r [Node<RawBody>],
    density: f64,
    source: &Source,
) -> Result<(Vec<&'r Spanned<String>>, Vec<SceneBody>), SceneError> {
    if raw.is_empty() {
        return Err(source.absent("body"));
    }
    let mut names = Vec::with_capacity(raw.len());
    let mut bodies = Vec::with_capacity(raw.len());
    for node in raw {
        let name = name(node, &names, source)?;
        bodies.push(body(node, name.get_ref(), density, source)?);
        names.push(name);
    }
    Ok((names, bodies))
}

fn name<'r>(
    node: &'r Node<RawBody>,
    earlier: &[&Spanned<String>],
    source: &Source,
) -> Result<&'r Spanned<String>, SceneError> {
    let name = source.require(node, "name", &node.get_ref().0.name)?;
    let text = name.get_ref();
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if text.is_empty() || !text.chars().all(allowed) {
        return Err(source.wrong(name.span(), &format!("is {text:?}")));
    }
    match earlier.iter().find(|other| other.get_ref() == text) {
        Some(other) => {
            let what = format!("{text:?} is the body in line {}", source.line(other.span()));
            Err(source.wrong(name.span(), &what))
        }
        None => Ok(name),
    }
}

fn body(
    node: &Node<RawBody>,
    name: &str,
    density: f64,
    source: &Source,
) -> Result<SceneBody, SceneError> {
    let raw = &node.get_ref().0;
    let (semi_axes, [total_mass, total_inertia]) = match &raw.semi_axes {
        Some(axes) => {
            let (axes, totals) = from_semi_axes(node, axes, density, source)?;
            (Some(axes), totals)
        }
        None => (None, from_totals(node, source)?),
    };
    Ok(SceneBody {
        name: name.to_owned(),
        semi_axes,
        total_mass,
        total_inertia,
        attitude: attitude(&raw.attitude, source)?,
        angular_velocity: triple_or_zero(raw.angular_velocity.as_ref(), source)?,
    })
}

/// Total mass and inertia as given.
fn from_totals(node: &Node<RawBody>, source: &Source) -> Result<Totals, SceneError> {
    let raw = &node.get_ref().0;
    if let Some(mass) = &raw.mass {
        let message = "a mass without semi-axes; expected the key semi_axes as well, \
                       or total_mass and total_inertia instead";
        return Err(source.fail(mass.span(), message));
    }
    if raw.total_mass.is_none() && raw.total_inertia.is_none() {
        let message = "no inertia; expected the key semi_axes, or total_mass and total_inertia";
        return Err(source.fail(node.span(), message));
    }
    let mass = source.require(node, "total_mass", &raw.total_mass)?;
    let inertia = source.require(node, "total_inertia", &raw.total_inertia)?;
    Ok([definite(mass, source)?, definite(inertia, source)?])
}

/// Total mass and inertia of a uniform ellipsoid in the fluid.
fn from_semi_axes(
    node: &Node<RawBody>,
    field: &Spanned<Vec<f64>>,
    density: f64,
    source: &Source,
) -> Result<([f64; 3], Totals), SceneError> {
    refuse_totals(node, source)?;
    let axes = array(field, source)?;
    let shape = Ellipsoid::new(axes).map_err(|e| source.fail(field.span(), &e.to_string()))?;
    let mass = mass(node, &shape, density, source)?;
    let masses = shape.added_mass(density).map(|added| mass + added);
    let (dry, added) = (shape.dry_inertia(mass), shape.added_inertia(density));
    let inertias = [0, 1, 2].map(|i| dry[i] + added[i]);
    if masses.iter().chain(&inertias).all(|x| x.is_normal()) {
        Ok((axes, [diagonal(masses), diagonal(inertias)]))
    } else {
        let message = "the body's mass or inertia is out of range; expected less \
                       extreme numbers";
        Err(source.fail(field.span(), message))
    }
}

fn refuse_totals(node: &Node<RawBody>, source: &Source) -> Result<(), SceneError> {
    let raw = &node.get_ref().0;
    match raw.total_mass.as_ref().or(raw.total_inertia.as_ref()) {
        None => Ok(()),
        Some(field) => {
            let message = "given together with semi_axes; expected either semi_axes, \
                           or total_mass and total_inertia";
            Err(source.fail(field.span(), message))
        }
    }
}

/// The mass given, or that of the displaced fluid.
fn mass(
    node: &Node<RawBody>,
    shape: &Ellipsoid,
    density: f64,
    source: &Source,
) -> Result<f64, SceneError> {
    match &node.get_ref().0.mass {
        Some(mass) => positive(mass, source),
        None if density > 0.0 => Ok(shape.neutral_mass(density)),
        None => {
            let message = "no mass, and no neutral buoyancy at density 0; expected the key mass";
            Err(source.fail(node.span(), message))
        }
    }
}
