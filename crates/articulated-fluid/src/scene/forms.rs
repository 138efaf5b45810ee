//! The three ways to give a body's inertia: an ellipsoid, the body and the added inertia, or the totals.

use std::ops::Range;

use toml::Spanned;

use super::error::SceneError;
use super::matrices::{Matrix, definite, diagonal, is_of_a_rigid_body, semidefinite, sum};
use super::raw::{Entry, Field, Node, RawBody};
use super::source::Source;
use super::values::{array, not_negative, positive};
use crate::ellipsoid::Ellipsoid;

const FORMS: &str = "either semi_axes, or mass and inertia, or total_mass and total_inertia";

/// A difference of mass and displaced mass that is the rounding of density times volume and of the numbers read, relative.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// What acts on every body.
pub(super) struct Surroundings {
    /// Density of the fluid, kg/m³.
    pub density: f64,
    /// Whether the scene has gravity.
    pub gravity: bool,
}

/// What follows from the keys of any of the forms; as in [`SceneBody`](super::SceneBody).
pub(super) struct Inertial {
    pub semi_axes: Option<[f64; 3]>,
    pub total_mass: Matrix,
    pub total_inertia: Matrix,
    pub net_mass: f64,
}

pub(super) fn check(
    node: &Node<RawBody>,
    around: &Surroundings,
    source: &Source,
) -> Result<Inertial, SceneError> {
    let raw = &node.get_ref().0;
    if let Some(axes) = &raw.semi_axes {
        refuse_others(raw, "semi_axes", &["semi_axes", "mass"], source)?;
        from_semi_axes(node, axes, around, source)
    } else if raw.total_mass.is_some() || raw.total_inertia.is_some() {
        let given = ["total_inertia", "total_mass"][usize::from(raw.total_mass.is_some())];
        refuse_others(
            raw,
            given,
            &["total_mass", "total_inertia", "shape"],
            source,
        )?;
        from_totals(node, around, source)
    } else if raw.mass.is_some() || raw.inertia.is_some() {
        explicit(node, around, source)
    } else {
        let message = format!("no inertia; expected {FORMS}");
        Err(source.fail(node.span(), &message))
    }
}

/// Refuses the keys that do not go with `given`, the key that tells the form.
fn refuse_others(
    raw: &RawBody,
    given: &str,
    allowed: &[&str],
    source: &Source,
) -> Result<(), SceneError> {
    let keys = [
        ("semi_axes", span(&raw.semi_axes)),
        ("mass", span(&raw.mass)),
        ("inertia", span(&raw.inertia)),
        ("added_mass", span(&raw.added_mass)),
        ("added_inertia", span(&raw.added_inertia)),
        ("volume", span(&raw.volume)),
        ("total_mass", span(&raw.total_mass)),
        ("total_inertia", span(&raw.total_inertia)),
        ("shape", span(&raw.shape)),
    ];
    let other = |(key, span): (&str, Option<_>)| span.filter(|_| !allowed.contains(&key));
    match keys.into_iter().find_map(other) {
        None => Ok(()),
        Some(span) => {
            let message = format!("given together with {given}; expected {FORMS}");
            Err(source.fail(span, &message))
        }
    }
}

fn span<T>(field: &Field<T>) -> Option<Range<usize>> {
    field.as_ref().map(Spanned::span)
}

/// A uniform ellipsoid in the fluid.
fn from_semi_axes(
    node: &Node<RawBody>,
    field: &Spanned<Vec<f64>>,
    around: &Surroundings,
    source: &Source,
) -> Result<Inertial, SceneError> {
    let shape = ellipsoid(field, source)?;
    let density = around.density;
    let mass = mass_of(node, &shape, density, source)?;
    let masses = shape.added_mass(density).map(|added| mass + added);
    let (dry, added) = (shape.dry_inertia(mass), shape.added_inertia(density));
    let inertias = [0, 1, 2].map(|i| dry[i] + added[i]);
    if !masses.iter().chain(&inertias).all(|x| x.is_normal()) {
        return Err(out_of_range(field.span(), source));
    }
    Ok(Inertial {
        semi_axes: Some(shape.semi_axes()),
        total_mass: diagonal(masses),
        total_inertia: diagonal(inertias),
        net_mass: net(mass, shape.neutral_mass(density)),
    })
}

/// The mass given, or that of the displaced fluid.
fn mass_of(
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

/// The body's own mass and inertia, and the added ones.
fn explicit(
    node: &Node<RawBody>,
    around: &Surroundings,
    source: &Source,
) -> Result<Inertial, SceneError> {
    let raw = &node.get_ref().0;
    let field = source.require(node, "mass", &raw.mass)?;
    let mass = positive(field, source)?;
    let inertia = own_inertia(raw, field, source)?;
    let added_mass = added(&raw.added_mass, around, source)?;
    let added_inertia = added(&raw.added_inertia, around, source)?;
    let shape = shape(raw, source)?;
    let displaced = displaced(node, shape.as_ref(), around, source)?;
    let net_mass = displaced.map_or(0.0, |displaced| net(mass, displaced));
    let total_mass = sum(diagonal([mass; 3]), added_mass);
    let total_inertia = sum(inertia, added_inertia);
    match (total_mass, total_inertia, net_mass.is_finite()) {
        (Some(total_mass), Some(total_inertia), true) => Ok(Inertial {
            semi_axes: shape.map(|shape| shape.semi_axes()),
            total_mass,
            total_inertia,
            net_mass,
        }),
        _ => Err(out_of_range(field.span(), source)),
    }
}

/// What the fluid adds to the mass or the inertia.
fn added(
    field: &Field<Vec<Entry>>,
    around: &Surroundings,
    source: &Source,
) -> Result<Matrix, SceneError> {
    let added = semidefinite(field.as_ref(), source)?;
    let is_zero = added.iter().flatten().all(|x| *x == 0.0);
    match field {
        Some(field) if around.density == 0.0 && !is_zero => {
            let message = "not zero, but without a fluid (fluid.density = 0) nothing is added; \
                           expected zero or no such key, or a density > 0";
            Err(source.fail(field.span(), message))
        }
        _ => Ok(added),
    }
}

/// The inertia of a body without fluid.
fn own_inertia(raw: &RawBody, mass: &Spanned<f64>, source: &Source) -> Result<Matrix, SceneError> {
    let Some(field) = &raw.inertia else {
        let message = "a mass alone; expected semi_axes or inertia as well";
        return Err(source.fail(mass.span(), message));
    };
    let inertia = definite(field, source)?;
    match is_of_a_rigid_body(inertia) {
        true => Ok(inertia),
        false => {
            let message = "a principal moment exceeds the sum of the two others; expected the \
                           inertia of the body alone, and what the fluid adds as added_inertia; \
                           an inertia with the added one in it is total_inertia, with total_mass";
            Err(source.fail(field.span(), message))
        }
    }
}

/// The displaced mass, kg; `None` where it is neither known nor needed.
fn displaced(
    node: &Node<RawBody>,
    shape: Option<&Ellipsoid>,
    around: &Surroundings,
    source: &Source,
) -> Result<Option<f64>, SceneError> {
    let given = volume(&node.get_ref().0, source)?;
    match given.or_else(|| shape.map(Ellipsoid::volume)) {
        Some(volume) => Ok(Some(around.density * volume)),
        None if around.density == 0.0 => Ok(Some(0.0)),
        None if !around.gravity => Ok(None),
        None => {
            let message = "no volume, on which buoyancy depends; expected the key volume or \
                           shape in a scene with gravity";
            Err(source.fail(node.span(), message))
        }
    }
}

/// The volume as given: with a shape it may be another than the ellipsoid's, but not none.
fn volume(raw: &RawBody, source: &Source) -> Result<Option<f64>, SceneError> {
    let Some(field) = &raw.volume else {
        return Ok(None);
    };
    let volume = not_negative(field, source)?;
    if volume == 0.0 && raw.shape.is_some() {
        let message = "volume is 0, but the key shape gives the body an extent; expected a \
                       volume > 0 or no such key, or no shape";
        return Err(source.fail(field.span(), message));
    }
    Ok(Some(volume))
}

/// Totals as given: what of them is the body's own is not known.
fn from_totals(
    node: &Node<RawBody>,
    around: &Surroundings,
    source: &Source,
) -> Result<Inertial, SceneError> {
    let raw = &node.get_ref().0;
    let mass = source.require(node, "total_mass", &raw.total_mass)?;
    let inertia = source.require(node, "total_inertia", &raw.total_inertia)?;
    if around.gravity {
        let message = "the body's own mass is not known, so its weight is not; expected \
                       semi_axes, or mass and inertia, in a scene with gravity";
        return Err(source.fail(mass.span(), message));
    }
    Ok(Inertial {
        semi_axes: shape(raw, source)?.map(|shape| shape.semi_axes()),
        total_mass: definite(mass, source)?,
        total_inertia: definite(inertia, source)?,
        net_mass: 0.0,
    })
}

fn shape(raw: &RawBody, source: &Source) -> Result<Option<Ellipsoid>, SceneError> {
    let shape = raw.shape.as_ref();
    shape.map(|field| ellipsoid(field, source)).transpose()
}

fn ellipsoid(field: &Spanned<Vec<f64>>, source: &Source) -> Result<Ellipsoid, SceneError> {
    let axes = array(field, source)?;
    Ellipsoid::new(axes).map_err(|error| source.fail(field.span(), &error.to_string()))
}

/// The net mass: zero where both are equal as the decimal numbers of the file are.
fn net(mass: f64, displaced: f64) -> f64 {
    match mass - displaced {
        net if net.abs() <= ROUNDING * mass => 0.0,
        net => net,
    }
}

fn out_of_range(span: Range<usize>, source: &Source) -> SceneError {
    let message = "the body's mass or inertia is out of range; expected less extreme numbers";
    source.fail(span, message)
}
