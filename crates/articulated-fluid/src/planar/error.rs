//! Why a motion is not planar.

use thiserror::Error;

/// No plane is a mirror of the model and its motion.
///
/// It speaks of the plane that the fewest parts of the model and the state violate.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "no motion in a plane: {what} of body {body} by {defect:.1e} of its size (rounding makes 1e-12 at most); the momenta change out of the plane by {torque:.1e} N m"
)]
pub struct NotPlanar {
    /// The largest violation, relative to the size of quantities of its kind.
    pub defect: f64,
    /// What violates the plane most.
    pub what: NotPlanarCause,
    /// Index of the body that it is of.
    pub body: usize,
    /// The largest part of a $\dot p_i$ out of the plane, $\dot\mu = \mathrm{ad}^\ast_\xi \mu + \tau$ at the state, N m.
    pub torque: f64,
}

/// What violates a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Error)]
#[non_exhaustive]
pub enum NotPlanarCause {
    /// The plane's normal is no principal direction of $M_i$.
    #[error("the mass couples the plane and its normal, in the frame")]
    MassCoupling,
    /// The plane's normal is no principal direction of $J_i$.
    #[error("the inertia couples the plane and its normal, in the frame")]
    InertiaCoupling,
    /// A joint does not lie in the plane of the mass centre of a body it is on.
    #[error("a joint is off the plane, in the frame")]
    JointOffPlane,
    /// A body does not spin about the normal.
    #[error("the angular velocity leaves the normal, that")]
    SpinOffPlane,
    /// The first body's velocity has a part along the normal.
    #[error("the velocity leaves the plane, that")]
    VelocityOffPlane,
    /// Gravity has a part along the normal.
    #[error("the weight leaves the plane, that")]
    GravityOffPlane,
    /// The state is not one of the model, or has a number that is not finite.
    #[error("the state does not fit the model or is not finite, first that")]
    State,
}
