//! How a robot becomes a scene.

use crate::base::Base;
use crate::shape::ShapeFrom;

/// How a robot becomes a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Density of the fluid, kg/m³; 0 is a vacuum.
    pub density: f64,
    /// What holds the root link. Unless given, the world holds it where it is named `world` or has, with what is fixed to it, no mass; else nothing does.
    pub base: Option<Base>,
    /// What the ellipsoids in the fluid are made from.
    pub shape_from: ShapeFrom,
}
