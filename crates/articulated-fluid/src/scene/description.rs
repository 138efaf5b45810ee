//! What a scene is once it is read.

use super::note::Note;

/// A scene that has been checked: every number is finite and every joint leads to a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What the scene shows, for people.
    pub title: Option<String>,
    /// Acceleration of gravity in the reference frame, m/s².
    pub gravity: [f64; 3],
    /// Density $\rho \ge 0$ of the fluid, kg/m³; 0 is a vacuum.
    pub density: f64,
    /// The bodies, at least one; the first is the head, and each comes after its parent.
    pub bodies: Vec<SceneBody>,
    /// The joints: one for each body but the head.
    pub joints: Vec<SceneJoint>,
    /// Initial position of the head's mass centre in the reference frame, m.
    pub position: [f64; 3],
    /// Initial velocity of the head's mass centre in the reference frame.
    pub velocity: StartVelocity,
    /// What was corrected in the file, in the order of its lines.
    pub notes: Vec<Note>,
}

/// The initial velocity of the head's mass centre in the reference frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartVelocity {
    /// As given, m/s.
    Given([f64; 3]),
    /// The one for which the total linear momentum vanishes.
    ZeroMomentum,
}

/// A rigid body of a [`Scene`].
#[derive(Clone, Debug, PartialEq)]
pub struct SceneBody {
    /// Name: unique in the scene, made of ASCII letters, digits, `-` and `_`.
    pub name: String,
    /// Semi-axes along the body's $x, y, z$, m, of the ellipsoid that the body is, or that it is given as its shape.
    pub semi_axes: Option<[f64; 3]>,
    /// Mass of the body plus added mass in the body frame, kg: symmetric, positive definite.
    pub total_mass: [[f64; 3]; 3],
    /// Inertia of the body plus added inertia about its mass centre in the body frame, kg m²:
    /// symmetric, positive definite.
    pub total_inertia: [[f64; 3]; 3],
    /// Mass of the body less that of the displaced fluid, kg; 0 where it is not known, as only without gravity.
    pub net_mass: f64,
    /// Initial attitude, body to reference frame: a quaternion $w, x, y, z$ of length 1.
    pub attitude: [f64; 4],
    /// Initial angular velocity in the body frame, rad/s.
    pub angular_velocity: [f64; 3],
}

/// A ball joint of a [`Scene`].
#[derive(Clone, Debug, PartialEq)]
pub struct SceneJoint {
    /// Index of the parent in [`Scene::bodies`], before the child.
    pub parent: usize,
    /// Index of the child in [`Scene::bodies`].
    pub child: usize,
    /// The joint from the parent's mass centre, in the parent's frame, m.
    pub at_parent: [f64; 3],
    /// The joint from the child's mass centre, in the child's frame, m.
    pub at_child: [f64; 3],
    /// Stiffness $k \ge 0$ against turns from where both bodies' frames are aligned, N m; 0 for a free joint.
    pub stiffness: f64,
}
