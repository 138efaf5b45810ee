//! Why a motion is not planar.

use core::fmt::{Display, Formatter, Result};

use lie::Vec3;
use thiserror::Error;

/// No coordinate plane is a mirror of the model and its motion, exactly.
///
/// It speaks of the plane that the fewest parts of the model and the state violate.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub struct NotPlanar {
    /// The largest violation, relative to the size of quantities of its kind; infinite for what is no state.
    pub defect: f64,
    /// What violates the plane most.
    pub what: NotPlanarCause,
    /// Index of the body that it is of; of what is the whole's, 0.
    pub body: usize,
    /// The largest part of a $\dot p_i$ out of the plane, $\dot\mu = \mathrm{ad}^\ast_\xi \mu + \tau$ at the state, N m.
    pub torque: f64,
    /// The part of $\dot p_x$ out of the plane, N.
    pub force: f64,
    /// The plane's normal, a coordinate axis of the reference frame.
    pub normal: Vec3,
}

/// A direction to six digits, as people read it.
pub(crate) fn rounded(direction: Vec3) -> String {
    // Adding zero takes the sign off a zero.
    let [x, y, z] = direction.0.map(|x| (1e6 * x).round() / 1e6 + 0.0);
    format!("({x}, {y}, {z})")
}

impl Display for NotPlanar {
    fn fmt(&self, f: &mut Formatter) -> Result {
        f.write_str(&self.of(format_args!("body {}", self.body)))
    }
}

impl NotPlanar {
    /// The message, in which the body is called so.
    pub(crate) fn of(&self, body: impl Display) -> String {
        let Self {
            defect,
            what,
            torque,
            force,
            ..
        } = self;
        let of = match what {
            NotPlanarCause::State | NotPlanarCause::Joint => {
                return format!("no motion in a coordinate plane: {what}");
            }
            NotPlanarCause::VelocityOffPlane | NotPlanarCause::GravityOffPlane => String::new(),
            _ => format!(" ({body})"),
        };
        let normal = rounded(self.normal);
        format!(
            "no motion in a coordinate plane; best candidate: normal {normal}. But {what}{of}, by {defect:.1e} of the largest of its kind; the momenta leave the plane at {torque:.1e} N m and {force:.1e} N"
        )
    }
}

/// What violates a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Error)]
#[non_exhaustive]
pub enum NotPlanarCause {
    /// The plane's normal is no principal direction of $M_i$.
    #[error("a mass couples the plane and its normal")]
    MassCoupling,
    /// The plane's normal is no principal direction of $J_i$.
    #[error("an inertia couples the plane and its normal")]
    InertiaCoupling,
    /// No coordinate axis of the body is along the plane's normal, exactly.
    #[error("no axis of a body's frame is along the normal")]
    AttitudeOffPlane,
    /// A joint does not lie in the plane through the mass centre of a body that it is on.
    #[error("a joint is off the plane of the mass centre")]
    JointOffPlane,
    /// A body does not spin about the normal alone.
    #[error("an angular velocity is not along the normal")]
    SpinOffPlane,
    /// The first body's velocity has a part along the normal.
    #[error("the velocity is not in the plane")]
    VelocityOffPlane,
    /// Gravity has a part along the normal.
    #[error("gravity is not in the plane")]
    GravityOffPlane,
    /// The normal has not one direction in the frames of both bodies of an elastic joint, which aligns these at rest.
    #[error("an elastic joint turns a body out of the plane")]
    SpringOffPlane,
    /// A joint is not a ball, or the base is held.
    #[error("only a free tree on ball joints is stepped in a plane")]
    Joint,
    /// The state is not one of the model, or has a number that is not finite.
    #[error("the state does not fit the model (another number of bodies?) or is not finite")]
    State,
}
