//! A scene's integrator for a wanted accuracy.

use articulated_fluid::planar::InPlane;
use articulated_fluid::{Configuration, SmallestModel};
use dvi::{Pilot, PilotError, State};

use crate::methods::{BoxedIntegrator, Method};

/// Stages, step and tolerance with which the smallest exact model of a scene is accurate for `duration` seconds from `start`.
///
/// # Errors
/// [`PilotError`].
///
/// ```
/// use articulated_fluid::Scene;
/// use study::accuracy;
///
/// let scene = Scene::parse(include_str!("../../../scenes/fish-chain.toml"), "fish-chain.toml")?;
/// let (model, start) = (scene.smallest()?.model, scene.initial_state()?);
/// let pilot = accuracy::pilot(&model, &start, 1.0, 1e-6)?;
/// assert!(pilot.estimate <= 1e-6 && pilot.horizon == 1.0);
/// let integrator = accuracy::integrator(model, &pilot);
/// assert_eq!(integrator.order() as usize, 2 * pilot.stages);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub fn pilot(
    model: &SmallestModel,
    start: &State<Configuration>,
    duration: f64,
    accuracy: f64,
) -> Result<Pilot, PilotError> {
    match model {
        SmallestModel::Fluid(model) => Pilot::run(model, start, duration, accuracy),
        SmallestModel::Dry(model) => Pilot::run(model, start, duration, accuracy),
        SmallestModel::Planar(model, plane) => {
            Pilot::run(model, &plane.project(start), duration, accuracy)
        }
    }
}

/// The integrator that a [pilot run](pilot) has found; it gives the scene's own configuration.
pub fn integrator(model: SmallestModel, pilot: &Pilot) -> BoxedIntegrator<Configuration> {
    match model {
        SmallestModel::Fluid(model) => pilot.integrator(model),
        SmallestModel::Dry(model) => pilot.integrator(model),
        SmallestModel::Planar(model, plane) => {
            Box::new(InPlane::new(plane, pilot.integrator(model)))
        }
    }
}

/// What the method is called.
pub fn method(pilot: &Pilot) -> Method {
    match pilot.stages {
        ..=4 => Method::Gauss4,
        5 | 6 => Method::Gauss6,
        _ => Method::Gauss8,
    }
}
