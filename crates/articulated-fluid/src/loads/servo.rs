//! A motor that follows a motion, (S22).

use lie::{Mat3, SO3, Scalar, Vec3};

use super::size::is_size;
use crate::joints::JointKind;
use crate::motion::Motion;
use crate::scene::entry::{Table, Value};
use crate::scene::error::SceneError;
use crate::scene::laws;

/// What a servo follows at a time.
#[derive(Clone, Copy, Debug)]
pub(super) enum Aim<S> {
    /// Nothing: there is none.
    None,
    /// $Q$ and $a$.
    Ball(Mat3<S>, Vec3<S>),
    /// $q_d$ and $\dot q_d$.
    Hinge([S; 2]),
}

/// A motor in a joint that pulls it towards a told attitude, and brakes what moves otherwise.
///
/// With the attitude $C$ on the parent, its rate $\omega$, the target $Q$ and its rate $a$, the torque on the child is
/// $-k_p (E - E^T)^\vee / 2 - k_d (\omega - E^T a)$ with $E = Q^T C$. Of a ball it vanishes where $E$ is half a turn.
/// Of a hinge it is $-k_p (q - q_d) - k_d (\dot q - \dot q_d)$ about the axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Servo {
    /// $k_p \ge 0$, N m, of a hinge N m/rad.
    pub stiffness: f64,
    /// $k_d \ge 0$, N m s/rad.
    pub damping: f64,
    /// What it follows: of a hinge, a [`Motion::Hinge`].
    pub target: Motion,
}

impl Servo {
    /// By its keys in a scene, in a joint of this kind.
    pub(super) fn read(table: &Table, kind: &JointKind) -> Result<Self, SceneError> {
        let target = table.require("target")?.table()?;
        let target = match kind {
            JointKind::Hinge(hinge) => Motion::Hinge {
                axis: hinge.axis,
                rest: hinge.rest,
                angle: laws::law::<1>(&target)?,
            },
            _ => Motion::Ball {
                rest: SO3::identity(),
                turn: laws::law::<3>(&target)?,
            },
        };
        Ok(Self {
            stiffness: table.require("kp")?.not_negative()?,
            damping: table.read("kd", 0.0, Value::not_negative)?,
            target,
        })
    }

    /// Whether it is one of a hinge, or of a ball, and its numbers are sound.
    pub(super) fn suits(&self, is_hinge: bool) -> bool {
        let of_hinge = matches!(self.target, Motion::Hinge { .. });
        of_hinge == is_hinge && is_size(self.stiffness) && is_size(self.damping)
    }

    /// What it follows at the time `t`.
    pub(super) fn aim<S: Scalar>(&self, t: S) -> Aim<S> {
        match &self.target {
            Motion::Hinge { .. } => Aim::Hinge(self.target.angle(t)),
            _ => {
                let (target, rate) = self.target.at(t);
                Aim::Ball(*target.matrix(), rate)
            }
        }
    }

    /// The torque on the child of a ball, in its frame.
    #[inline(always)]
    pub(super) fn on_ball<S: Scalar>(
        &self,
        (target, rate): (&Mat3<S>, Vec3<S>),
        c: &Mat3<S>,
        omega: Vec3<S>,
    ) -> Vec3<S> {
        let e = target.transpose() * *c;
        let pull = e.skew_vee() * S::from_f64(0.5 * self.stiffness);
        let slip = omega - e.transpose_mul(rate);
        -(pull + slip * S::from_f64(self.damping))
    }

    /// The torque about the axis of a hinge at this angle and rate.
    #[inline(always)]
    pub(super) fn on_hinge<S: Scalar>(&self, [angle, turning]: [S; 2], [q, rate]: [S; 2]) -> S {
        -((q - angle).times(self.stiffness) + (rate - turning).times(self.damping))
    }
}
