//! The three ways to give a body's inertia: an ellipsoid, the body and the added inertia, or the totals.

use lie::Mat3;

use super::description::{SceneBody, net_mass};
use super::entry::{Table, Value};
use super::error::SceneError;
use super::matrices::{Matrix, is_of_a_rigid_body, sum};
use crate::ellipsoid::Ellipsoid;

const FORMS: &str = "either semi_axes, or mass and inertia, or total_mass and total_inertia";

/// What acts on every body.
pub(super) struct Surroundings {
    /// Density of the fluid, kg/m³.
    pub density: f64,
    /// Whether the scene has gravity.
    pub gravity: bool,
}

/// The body of this name, at rest and aligned with the reference frame.
pub(super) fn check(
    table: &Table,
    name: &str,
    around: &Surroundings,
) -> Result<SceneBody, SceneError> {
    let telling = [
        "semi_axes",
        "total_mass",
        "total_inertia",
        "mass",
        "inertia",
    ];
    match telling.into_iter().find(|key| table.get(key).is_some()) {
        Some("semi_axes") => {
            refuse_others(table, "semi_axes", &["semi_axes", "mass"])?;
            from_semi_axes(table, name, around)
        }
        Some(key) if key.starts_with("total") => {
            refuse_others(table, key, &["total_mass", "total_inertia", "shape"])?;
            from_totals(table, name, around)
        }
        Some(_) => explicit(table, name, around),
        None => Err(table.fail(&format!("no inertia; expected {FORMS}"))),
    }
}

/// Refuses the keys that do not go with `given`, the key that tells the form.
fn refuse_others(table: &Table, given: &str, allowed: &[&str]) -> Result<(), SceneError> {
    let keys = [
        "semi_axes",
        "mass",
        "inertia",
        "added_mass",
        "added_inertia",
        "volume",
        "total_mass",
        "total_inertia",
        "shape",
    ];
    let others = keys.into_iter().filter(|key| !allowed.contains(key));
    match others.into_iter().find_map(|key| table.get(key)) {
        None => Ok(()),
        Some(other) => {
            let message = format!("given together with {given}; expected {FORMS}");
            Err(other.fail(&message))
        }
    }
}

/// A uniform ellipsoid in the fluid.
fn from_semi_axes(
    table: &Table,
    name: &str,
    around: &Surroundings,
) -> Result<SceneBody, SceneError> {
    let axes = table.require("semi_axes")?;
    let shape = ellipsoid(&axes)?;
    let mass = match table.get("mass") {
        Some(mass) => mass.positive()?,
        None if around.density > 0.0 => shape.neutral_mass(around.density),
        None => {
            let message = "no mass, and no neutral buoyancy at density 0; expected the key mass";
            return Err(table.fail(message));
        }
    };
    let body = SceneBody::ellipsoid(name, &shape, mass, around.density);
    let moments = [body.total_mass, body.total_inertia];
    let mut moments = moments.iter().flat_map(|m| [m[0][0], m[1][1], m[2][2]]);
    match moments.all(f64::is_normal) {
        true => Ok(body),
        false => Err(out_of_range(&axes)),
    }
}

/// The body's own mass and inertia, and the added ones.
fn explicit(table: &Table, name: &str, around: &Surroundings) -> Result<SceneBody, SceneError> {
    let field = table.require("mass")?;
    let mass = field.positive()?;
    let inertia = own_inertia(table, &field)?;
    let [added_mass, coupling, added_inertia] = all_added(table, around)?;
    let shape = shape(table)?;
    let displaced = displaced(table, shape.as_ref(), around)?;
    let net = displaced.map_or(0.0, |displaced| net_mass(mass, displaced));
    let total_mass = sum(Mat3::diagonal([mass; 3]).0, added_mass);
    let total_inertia = sum(inertia, added_inertia);
    match (total_mass, total_inertia, net.is_finite()) {
        (Some(total_mass), Some(total_inertia), true) => {
            let totals = [total_mass, total_inertia];
            let body = SceneBody::given(name, shape, Some((mass, inertia)), totals, net);
            Ok(SceneBody { coupling, ..body })
        }
        _ => Err(out_of_range(&field)),
    }
}

/// What the fluid adds to the mass and the inertia, and how it couples them.
fn all_added(table: &Table, around: &Surroundings) -> Result<[Matrix; 3], SceneError> {
    let mass = table.get("added_mass");
    let rows = mass.as_ref().and_then(|mass| mass.elements().ok());
    let (Some(field), Some(6)) = (&mass, rows.map(|rows| rows.len())) else {
        let inertia = added(table.get("added_inertia"), around)?;
        return Ok([added(mass, around)?, [[0.0; 3]; 3], inertia]);
    };
    if let Some(inertia) = table.get("added_inertia") {
        let message = "given together with an added_mass of 6 rows, which has it in it; expected \
                       one of the two";
        return Err(inertia.fail(message));
    }
    let whole = field.semidefinite_of_six()?;
    in_fluid(field, around, whole.as_flattened())?;
    let part = |i: usize, j: usize| [0, 1, 2].map(|k| [0, 1, 2].map(|l| whole[i + k][j + l]));
    Ok([part(0, 0), part(0, 3), part(3, 3)])
}

/// What the fluid adds to the mass or the inertia.
fn added(field: Option<Value>, around: &Surroundings) -> Result<Matrix, SceneError> {
    let Some(field) = field else {
        return Ok([[0.0; 3]; 3]);
    };
    let added = field.semidefinite()?;
    in_fluid(&field, around, added.as_flattened())?;
    Ok(added)
}

/// Refuses what a fluid adds where there is none.
fn in_fluid(field: &Value, around: &Surroundings, added: &[f64]) -> Result<(), SceneError> {
    if around.density == 0.0 && added.iter().any(|x| *x != 0.0) {
        let message = "not zero, but without a fluid (fluid.density = 0) nothing is added; \
                       expected zero or no such key, or a density > 0";
        return Err(field.fail(message));
    }
    Ok(())
}

/// The inertia of a body without fluid.
fn own_inertia(table: &Table, mass: &Value) -> Result<Matrix, SceneError> {
    let Some(field) = table.get("inertia") else {
        let message = "a mass alone; expected semi_axes or inertia as well";
        return Err(mass.fail(message));
    };
    let inertia = field.definite()?;
    match is_of_a_rigid_body(inertia) {
        true => Ok(inertia),
        false => {
            let message = "a principal moment exceeds the sum of the two others; expected the \
                           inertia of the body alone, and what the fluid adds as added_inertia; \
                           an inertia with the added one in it is total_inertia, with total_mass";
            Err(field.fail(message))
        }
    }
}

/// The displaced mass, kg; `None` where it is neither known nor needed.
fn displaced(
    table: &Table,
    shape: Option<&Ellipsoid>,
    around: &Surroundings,
) -> Result<Option<f64>, SceneError> {
    match volume(table)?.or_else(|| shape.map(Ellipsoid::volume)) {
        Some(volume) => Ok(Some(around.density * volume)),
        None if around.density == 0.0 => Ok(Some(0.0)),
        None if !around.gravity => Ok(None),
        None => {
            let message = "no volume, on which buoyancy depends; expected the key volume or \
                           shape in a scene with gravity";
            Err(table.fail(message))
        }
    }
}

/// The volume as given: with a shape it may be another than the ellipsoid's, but not none.
fn volume(table: &Table) -> Result<Option<f64>, SceneError> {
    let Some(field) = table.get("volume") else {
        return Ok(None);
    };
    let volume = field.not_negative()?;
    if volume == 0.0 && table.get("shape").is_some() {
        let message = "volume is 0, but the key shape gives the body an extent; expected a \
                       volume > 0 or no such key, or no shape";
        return Err(field.fail(message));
    }
    Ok(Some(volume))
}

/// Totals as given: what of them is the body's own is not known.
fn from_totals(table: &Table, name: &str, around: &Surroundings) -> Result<SceneBody, SceneError> {
    let (mass, inertia) = (
        table.require("total_mass")?,
        table.require("total_inertia")?,
    );
    if around.gravity {
        let message = "the body's own mass is not known, so its weight is not; expected \
                       semi_axes, or mass and inertia, in a scene with gravity";
        return Err(mass.fail(message));
    }
    let shape = shape(table)?;
    let totals = [mass.definite()?, inertia.definite()?];
    Ok(SceneBody::given(name, shape, None, totals, 0.0))
}

fn shape(table: &Table) -> Result<Option<Ellipsoid>, SceneError> {
    table.read("shape", None, |field| ellipsoid(field).map(Some))
}

fn ellipsoid(field: &Value) -> Result<Ellipsoid, SceneError> {
    Ellipsoid::new(field.array()?).map_err(|error| field.fail(&error.to_string()))
}

fn out_of_range(field: &Value) -> SceneError {
    field.fail("the body's mass or inertia is out of range; expected less extreme numbers")
}
