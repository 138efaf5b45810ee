//! A scene's integrator for a wanted accuracy.

use articulated_fluid::{Configuration, Smallest};
use dvi::{Pilot, PilotError};

use crate::methods::{BoxedIntegrator, Method};

/// Stages, step and tolerance with which the smallest exact model of a scene is accurate for `duration` seconds from its start.
///
/// # Errors
/// [`PilotError`].
///
/// ```
/// use articulated_fluid::Scene;
/// use study::accuracy;
///
/// let scene = Scene::parse(include_str!("../../../scenes/fish-chain.toml"), "fish-chain.toml")?;
/// let smallest = scene.smallest()?;
/// let pilot = accuracy::pilot(&smallest, 1.0, 1e-6)?;
/// assert!(pilot.estimate <= 1e-6 && pilot.horizon == 1.0);
/// let integrator = accuracy::integrator(&smallest, &pilot);
/// assert_eq!(integrator.order() as usize, 2 * pilot.stages);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub fn pilot(smallest: &Smallest, duration: f64, accuracy: f64) -> Result<Pilot, PilotError> {
    let start = &smallest.start;
    match &smallest.plane {
        None => Pilot::run(&smallest.model, start, duration, accuracy),
        Some(plane) => Pilot::run(&plane.model(), &plane.project(start), duration, accuracy),
    }
}

/// The integrator that a [pilot run](pilot) has found; it gives the scene's own states.
pub fn integrator(smallest: &Smallest, pilot: &Pilot) -> BoxedIntegrator<Configuration> {
    smallest.integrator(
        |model| pilot.integrator(model),
        |model| pilot.integrator(model),
    )
}

/// What the method is called.
pub fn method(pilot: &Pilot) -> Method {
    match pilot.stages {
        ..=4 => Method::Gauss4,
        5 | 6 => Method::Gauss6,
        _ => Method::Gauss8,
    }
}
