//! A rigid motion as a screw.

use core::f64::consts::TAU;

use lie::{LieGroup, SE3, Vec3};

/// Below this turn, rad, a motion counts as a straight one.
const STRAIGHT: f64 = 1e-9;

/// The net motion of a stroke: a turn about an axis and an advance along it, by Chasles' theorem.
///
/// Repeated, it leads along a helix.
///
/// ```
/// use gait::Screw;
/// use lie::{SE3, SO3, LieGroup, Tangent, Vec3};
///
/// let turn = SO3::exp(&Tangent([0.0, 0.0, 0.5]));
/// let screw = Screw::of(&SE3::new(turn, Vec3([0.0, 1.0, 0.2])));
/// assert!((screw.turn - 0.5).abs() < 1e-15 && (screw.advance - 0.2).abs() < 1e-15);
/// assert!((screw.radius - 0.5 / 0.25_f64.sin()).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// The turn, rad, from 0 to $\pi$.
    pub turn: f64,
    /// The unit vector of the axis; without a turn, the direction of the displacement.
    pub axis: Vec3,
    /// The displacement along the axis, m: negative where it is a left-handed screw.
    pub advance: f64,
    /// The distance of the first body's mass centre from the axis, m; 0 without a turn.
    pub radius: f64,
}

impl Screw {
    /// The screw of a motion $(R, d)$.
    pub fn of(g: &SE3) -> Self {
        let turning = g.rotation.log().unwrap_or_else(|e| e.representative).vec3();
        let (turn, d) = (turning.norm(), g.translation);
        if turn < STRAIGHT {
            let advance = d.norm();
            let axis = match advance > 0.0 {
                true => d * (1.0 / advance),
                false => Vec3([1.0, 0.0, 0.0]),
            };
            return Self {
                turn,
                axis,
                advance,
                radius: 0.0,
            };
        }
        let axis = turning * (1.0 / turn);
        let advance = d.dot(axis);
        let chord = (d - axis * advance).norm();
        Self {
            turn,
            axis,
            advance,
            radius: 0.5 * chord / (0.5 * turn).sin(),
        }
    }

    /// The advance in a whole turn, m; infinite without a turn.
    pub fn pitch(&self) -> f64 {
        match self.turn < STRAIGHT {
            true => f64::INFINITY,
            false => self.advance * TAU / self.turn,
        }
    }
}
