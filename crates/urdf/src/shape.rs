//! The ellipsoids that stand for a link in the fluid.

use std::f64::consts::PI;

use articulated_fluid::Ellipsoid;
use urdf_rs::{Collision, Geometry, Link};

use crate::error::UrdfError;
use crate::mass::Mass;
use crate::pose::Pose;
use crate::principal::principal;

/// What the ellipsoids of links are made from.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum ShapeFrom {
    /// The collision shapes: an ellipsoid for each box, cylinder, sphere and capsule. A link without has that of its inertia.
    #[default]
    Collision,
    /// The inertia: the uniform ellipsoid that has it.
    Inertia,
}

/// An ellipsoid, and its frame in that of the link.
#[derive(Clone, Debug)]
pub(crate) struct Solid {
    pub ellipsoid: Ellipsoid,
    pub frame: Pose,
    /// What it is made from.
    pub origin: Origin,
}

/// What an ellipsoid is made from.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(crate) enum Origin {
    /// A collision shape, by its kind.
    Collision(&'static str),
    /// The inertia; whether the ellipsoid is thicker than that says.
    Inertia { is_thin: bool },
}

/// The thinnest ellipsoid of an inertia, as a part of its length: sheets and rods have none.
const THINNEST: f64 = 0.01;

/// The ellipsoids of a link, none where it has no shape.
pub(crate) fn solids(link: &Link, from: ShapeFrom) -> Result<Vec<Solid>, UrdfError> {
    let of_collision = match from {
        ShapeFrom::Collision => link.collision.iter().filter_map(of_collision).collect(),
        ShapeFrom::Inertia => vec![],
    };
    let axes = match of_collision.is_empty() {
        true => of_inertia(&Mass::of(link)?).into_iter().collect(),
        false => of_collision,
    };
    let solid = |(axes, frame, origin)| match Ellipsoid::new(axes) {
        Ok(ellipsoid) => Ok(Solid {
            ellipsoid,
            frame,
            origin,
        }),
        Err(source) => Err(UrdfError::Shape {
            link: link.name.clone(),
            source,
        }),
    };
    axes.into_iter().map(solid).collect()
}

/// Semi-axes, their frame, and where they are from.
type Axes = ([f64; 3], Pose, Origin);

/// The ellipsoid of a collision shape that is no mesh.
fn of_collision(collision: &Collision) -> Option<Axes> {
    let square = |x: f64| x * x;
    let (kind, volume, spread) = match &collision.geometry {
        Geometry::Box { size } => {
            let [x, y, z] = size.0;
            ("box", x * y * z, size.0.map(|x| square(x) / 12.0))
        }
        Geometry::Cylinder { radius, length } => {
            let round = square(*radius);
            let spread = [round / 4.0, round / 4.0, square(*length) / 12.0];
            ("cylinder", PI * round * length, spread)
        }
        Geometry::Capsule { radius, length } => {
            let (round, half) = (square(*radius), 0.5 * length);
            let (tube, ends) = (PI * round * length, 4.0 / 3.0 * PI * round * radius);
            let along = tube * square(half) / 3.0
                + ends * (round / 5.0 + square(half) + 0.75 * half * radius);
            let across = tube * round / 4.0 + ends * round / 5.0;
            let volume = tube + ends;
            (
                "capsule",
                volume,
                [across, across, along].map(|x| x / volume),
            )
        }
        Geometry::Sphere { radius } => {
            let volume = 4.0 / 3.0 * PI * square(*radius) * radius;
            ("sphere", volume, [square(*radius) / 5.0; 3])
        }
        Geometry::Mesh { .. } => return None,
    };
    let frame = Pose::of(&collision.origin);
    Some((semi_axes(volume, spread), frame, Origin::Collision(kind)))
}

/// The semi-axes of the ellipsoid with this volume and the proportions of these mean squares of $x, y, z$.
fn semi_axes(volume: f64, spread: [f64; 3]) -> [f64; 3] {
    let axes = spread.map(f64::sqrt);
    let own = 4.0 / 3.0 * PI * axes.iter().product::<f64>();
    axes.map(|axis| axis * (volume / own).cbrt())
}

/// The uniform ellipsoid of a mass and an inertia, $a_x^2 = \frac{5}{2m} (J_y + J_z - J_x)$.
fn of_inertia(mass: &Mass) -> Option<Axes> {
    let (turn, [x, y, z]) = principal(mass.inertia);
    let squares = [y + z - x, z + x - y, x + y - z].map(|square| square * 2.5 / mass.mass);
    let longest = squares.into_iter().fold(0.0, f64::max).sqrt();
    if mass.mass == 0.0 || longest == 0.0 {
        return None;
    }
    let axes = squares.map(|square| square.max(0.0).sqrt());
    let is_thin = axes.iter().any(|axis| *axis < THINNEST * longest);
    let at = mass.centre;
    let frame = Pose { turn, at };
    let axes = axes.map(|axis| axis.max(THINNEST * longest));
    Some((axes, frame, Origin::Inertia { is_thin }))
}

/// Whether a link has a collision mesh, and no other shape.
pub(crate) fn has_meshes_alone(link: &Link) -> bool {
    let is_mesh = |c: &Collision| matches!(c.geometry, Geometry::Mesh { .. });
    !link.collision.is_empty() && link.collision.iter().all(is_mesh)
}

impl Solid {
    /// The same, seen from where the link's frame is `pose`.
    pub fn seen_from(self, pose: &Pose) -> Self {
        let frame = pose.then(&self.frame);
        Self { frame, ..self }
    }
}
