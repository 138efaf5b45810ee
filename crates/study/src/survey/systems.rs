//! Four motions worth measuring, none of them steady.

use articulated_fluid::Ellipsoid;
use dvi::{HamiltonianSystem, Lagrangian};
use lie::{LieGroup, SE3, SO3, Tangent};

use crate::baseline::Tolerance;
use crate::problems::{
    FreeRigidBody, FreeRotation, HeavyTop, Kirchhoff, Nutation, Pendulum, Problem, ProblemError,
    Reference, Steady,
};

/// Of the motions without a closed form.
const TIGHT: Tolerance = Tolerance::uniform(1e-14);
/// Semi-axes, m: of an ellipsoid of revolution, and of one whose third axis is the shortest.
const PROLATE: [f64; 3] = [1.0, 0.5, 0.5];
const FLAT: [f64; 3] = [1.6, 1.0, 0.6];
/// Of the ellipsoids and of the fluid, kg/m³.
const DENSITY: f64 = 1.0;

/// Moments of inertia, kg m², and weight times lever, N m, of the top.
pub(super) const TOP: [f64; 3] = [1.0, 0.5, 1.0];

/// A free body that tumbles: it turns over about its middle axis.
///
/// # Errors
/// None with these numbers.
pub fn free_rigid_body() -> Result<Problem<FreeRigidBody, FreeRotation>, ProblemError> {
    let tilt = SO3::exp(&Tangent([0.3, -0.4, 0.2]));
    FreeRigidBody::new([1.0, 2.0, 3.0])?.problem(tilt, [0.5, 1.0, 0.1])
}

/// A top that nutates in loops.
///
/// # Errors
/// None with these numbers.
pub fn heavy_top() -> Result<Problem<HeavyTop, Nutation>, ProblemError> {
    let [a, c, w] = TOP;
    let tilt = SO3::exp(&Tangent([0.0, 0.9, 0.0]));
    HeavyTop::new(a, c, w)?.problem(tilt, [0.35, 0.0, 4.0])
}

/// A pendulum with three different moments of inertia that is pushed sideways: its mass centre goes round on no closed path.
///
/// # Errors
/// None with these numbers.
pub fn pendulum() -> Result<Problem<Pendulum, Reference<HamiltonianSystem<Pendulum>>>, ProblemError>
{
    let pendulum = Pendulum::new([0.9, 1.3, 0.7], 9.0, [0.0, 0.0, -0.5])?;
    pendulum.problem(SO3::exp(&Tangent([1.2, 0.0, 0.0])), [0.0, 2.5, 0.6], TIGHT)
}

/// An ellipsoid of the density of the fluid.
fn ellipsoid(semi_axes: [f64; 3]) -> Result<Kirchhoff, ProblemError> {
    let value = semi_axes.into_iter().fold(f64::INFINITY, f64::min);
    let what = "semi-axis";
    let body = Ellipsoid::new(semi_axes).map_err(|_| ProblemError::NotPositive { what, value })?;
    Kirchhoff::new(&body, body.neutral_mass(DENSITY), DENSITY)
}

/// The ellipsoid thrown nearly end on, which is unstable, with a slow spin: it flutters along its way.
///
/// # Errors
/// None with these numbers.
pub fn flutter() -> Result<Problem<Kirchhoff, Reference<HamiltonianSystem<Kirchhoff>>>, ProblemError>
{
    let body = ellipsoid(PROLATE)?;
    let posed = body.steady(SE3::identity(), 0, 1.0, 0.0)?;
    let start = body.state(
        0.0,
        SE3::identity(),
        &Tangent([0.4, 0.15, 0.5, 1.0, 0.1, 0.0]),
    )?;
    let exact = Reference {
        system: body.hamiltonian(),
        start: start.clone(),
        tolerance: TIGHT,
    };
    Ok(Problem {
        name: posed.name,
        lagrangian: body,
        start,
        exact,
        time: 2.0 * core::f64::consts::PI / body.growth_rate(0, 1.0)?,
        symmetries: posed.symmetries,
    })
}

/// An ellipsoid broadside on, which is stable, turning about its way: a motion of constant velocity.
///
/// # Errors
/// None with these numbers.
pub fn screw() -> Result<Problem<Kirchhoff, Steady<SE3>>, ProblemError> {
    let pose = SE3::exp(&Tangent([0.4, -1.1, 0.7, 0.3, 2.0, -1.0]));
    ellipsoid(FLAT)?.steady(pose, 2, 0.8, 1.5)
}
