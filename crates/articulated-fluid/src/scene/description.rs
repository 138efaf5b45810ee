//! What a scene is once it is read.

use lie::{Mat3, Vec3};

use super::mobility::Mobility;
use super::note::Note;
use crate::ellipsoid::Ellipsoid;
use crate::loads::on_bodies::BodyLoad;
use crate::motion::{Law, Sinusoid};

/// A difference of mass and displaced mass that is the rounding of density times volume and of the numbers read, relative.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

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
    /// What the first body hangs on; without it, the body is free.
    pub mount: Option<SceneMount>,
    /// The joints: one for each body but the head.
    pub joints: Vec<SceneJoint>,
    /// Initial position of the head's mass centre in the reference frame, m.
    pub position: [f64; 3],
    /// Initial velocity of the head's mass centre in the reference frame.
    pub velocity: StartVelocity,
    /// What was corrected in the file, in the order of its lines.
    pub notes: Vec<Note>,
}

impl Scene {
    /// What each body counts in the centre of mass, kg: its own mass. Where that of a body is not known, as only
    /// [`total_mass`](SceneBody::total_mass) is given, all count by their total masses, in the mean of the three axes.
    pub fn centre_masses(&self) -> Vec<f64> {
        let own: Option<Vec<f64>> = self.bodies.iter().map(SceneBody::mass).collect();
        let total = |body: &SceneBody| [0, 1, 2].map(|i| body.total_mass[i][i] / 3.0).iter().sum();
        own.unwrap_or_else(|| self.bodies.iter().map(total).collect())
    }
}

/// The initial velocity of the head's mass centre in the reference frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartVelocity {
    /// As given, m/s.
    Given([f64; 3]),
    /// The one for which the total linear momentum vanishes.
    ZeroMomentum,
    /// Linear and angular momentum vanish: the head's angular velocity follows too, and the rates of the others are relative to it.
    NoMomentum,
}

/// A rigid body of a [`Scene`].
#[derive(Clone, Debug, PartialEq)]
pub struct SceneBody {
    /// Name: unique in the scene, made of ASCII letters, digits, `-`, `_`, `/` and `.`, as names of ROS have them.
    pub name: String,
    /// What the body is, as far as the file tells.
    pub form: Form,
    /// Mass of the body plus added mass in the body frame, kg: symmetric, positive definite.
    pub total_mass: [[f64; 3]; 3],
    /// Inertia of the body plus added inertia about its mass centre in the body frame, kg m²:
    /// symmetric, positive definite.
    pub total_inertia: [[f64; 3]; 3],
    /// How the fluid couples velocity and turning, $C$ of $V \cdot C \Omega$, kg m; zero of bodies with three planes of symmetry.
    pub coupling: [[f64; 3]; 3],
    /// Mass of the body less that of the displaced fluid, kg; 0 where it is not known, as only without gravity.
    pub net_mass: f64,
    /// Where its buoyancy acts, from the mass centre in the body's frame, m.
    pub buoyancy_at: [f64; 3],
    /// What acts on it beside weight.
    pub loads: Vec<BodyLoad>,
    /// Initial attitude, body to reference frame: a quaternion $w, x, y, z$ of length 1.
    pub attitude: [f64; 4],
    /// Initial angular velocity in the body frame, rad/s.
    pub angular_velocity: [f64; 3],
}

impl SceneBody {
    /// A uniform ellipsoid of this mass, kg, in a fluid of this density, kg/m³: at rest, and aligned with the reference frame.
    pub fn ellipsoid(name: &str, shape: &Ellipsoid, mass: f64, density: f64) -> Self {
        let (added, wet) = (shape.added_mass(density), shape.added_inertia(density));
        let dry = shape.dry_inertia(mass);
        Self {
            name: name.to_owned(),
            form: Form::Ellipsoid {
                semi_axes: shape.semi_axes(),
                mass,
            },
            total_mass: Mat3::diagonal(added.map(|added| mass + added)).0,
            total_inertia: Mat3::diagonal([0, 1, 2].map(|i| dry[i] + wet[i])).0,
            net_mass: net_mass(mass, shape.neutral_mass(density)),
            coupling: [[0.0; 3]; 3],
            buoyancy_at: [0.0; 3],
            loads: vec![],
            attitude: [1.0, 0.0, 0.0, 0.0],
            angular_velocity: [0.0; 3],
        }
    }

    /// A body at rest, aligned with the reference frame. It has this own mass, kg, and inertia, kg m², if they are known, and these totals:
    /// [`total_mass`](Self::total_mass), [`total_inertia`](Self::total_inertia) and [`net_mass`](Self::net_mass).
    pub fn given(
        name: &str,
        shape: Option<Ellipsoid>,
        own: Option<(f64, [[f64; 3]; 3])>,
        [total_mass, total_inertia]: [[[f64; 3]; 3]; 2],
        net_mass: f64,
    ) -> Self {
        Self {
            name: name.to_owned(),
            form: Form::Given {
                shape: shape.map(|shape| shape.semi_axes()),
                mass: own.map(|(mass, _)| mass),
                inertia: own.map(|(_, inertia)| inertia),
            },
            total_mass,
            total_inertia,
            net_mass,
            coupling: [[0.0; 3]; 3],
            buoyancy_at: [0.0; 3],
            loads: vec![],
            attitude: [1.0, 0.0, 0.0, 0.0],
            angular_velocity: [0.0; 3],
        }
    }

    /// Semi-axes along the body's $x, y, z$, m, of the ellipsoid that the body is, or that it is given as its shape.
    pub fn semi_axes(&self) -> Option<[f64; 3]> {
        match self.form {
            Form::Ellipsoid { semi_axes, .. } => Some(semi_axes),
            Form::Given { shape, .. } => shape,
        }
    }

    /// Whether a load of this name does anything to it.
    pub(crate) fn has_load(&self, name: &str) -> bool {
        let mut loads = self.loads.iter();
        loads.any(|load| load.name() == name && load.acts())
    }

    /// The mass of the displaced fluid times the point where its buoyancy acts, kg m; zero where the body's own mass is not known.
    pub(crate) fn buoyancy_moment(&self) -> Vec3 {
        let displaced = self.mass().map_or(0.0, |mass| mass - self.net_mass);
        Vec3(self.buoyancy_at) * displaced
    }

    /// The body's own mass, kg; `None` where only the total one is known, with the added mass in it.
    pub fn mass(&self) -> Option<f64> {
        match self.form {
            Form::Ellipsoid { mass, .. } => Some(mass),
            Form::Given { mass, .. } => mass,
        }
    }
}

/// The mass less the displaced one: zero where both are equal as the decimal numbers of the file are.
pub(super) fn net_mass(mass: f64, displaced: f64) -> f64 {
    match mass - displaced {
        net if net.abs() <= ROUNDING * mass => 0.0,
        net => net,
    }
}

/// What a body of a [`Scene`] is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// A uniform ellipsoid: mass and inertia, its own and the added ones, follow.
    Ellipsoid {
        /// Semi-axes along the body's $x, y, z$, m.
        semi_axes: [f64; 3],
        /// The body's own mass, kg.
        mass: f64,
    },
    /// A body of any shape, whose mass and inertia are given.
    Given {
        /// The semi-axes, m, of the ellipsoid that it is given as its shape, if any.
        shape: Option<[f64; 3]>,
        /// The body's own mass, kg, if it is known.
        mass: Option<f64>,
        /// Its own inertia about its mass centre in the body frame, kg m², if it is known.
        inertia: Option<[[f64; 3]; 3]>,
    },
}

/// A joint of a [`Scene`].
#[derive(Clone, Debug, PartialEq)]
pub struct SceneJoint {
    /// Name: that of the child where no other is given.
    pub name: String,
    /// Index of the parent in [`Scene::bodies`], before the child.
    pub parent: usize,
    /// Index of the child in [`Scene::bodies`].
    pub child: usize,
    /// The joint from the parent's mass centre, in the parent's frame, m.
    pub at_parent: [f64; 3],
    /// The joint from the child's mass centre, in the child's frame, m.
    pub at_child: [f64; 3],
    /// What it leaves free.
    pub mobility: Mobility,
}

/// The joint of the first body to the world.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMount {
    /// Name: that of the child where no other is given.
    pub name: String,
    /// Where the joint is, m in the reference frame.
    pub place: Sinusoid<3>,
    /// The joint from the body's mass centre, in its frame, m.
    pub at_child: [f64; 3],
    /// What it leaves free.
    pub mobility: Mobility,
}

impl Scene {
    /// The names of the joints that are free hinges, in the order of the model.
    pub fn free_hinges(&self) -> impl Iterator<Item = &str> {
        let hinges = self.on_joints().filter(|(.., on)| on.kind.has_angle());
        hinges.map(|(_, name, _)| name)
    }

    /// The names of the joints that move as told, or whose place does, or that have a load, in the order of the
    /// [drives](crate::ArticulatedBody::drives).
    pub fn driven_joints(&self) -> impl Iterator<Item = &str> {
        let mount = self.mount.as_ref();
        let carried = mount.is_some_and(|mount| !mount.place.is_constant());
        let driven = move |(i, _, on): &(usize, &str, &Mobility)| {
            on.kind.is_driven() || on.load.acts() || *i == 0 && carried
        };
        self.on_joints().filter(driven).map(|(_, name, _)| name)
    }

    /// The names of what acts on bodies beside weight, in the order of the [drives](crate::ArticulatedBody::drives).
    pub fn loads_on_bodies(&self) -> impl Iterator<Item = &'static str> {
        BodyLoad::names().filter(|name| self.bodies.iter().any(|body| body.has_load(name)))
    }

    /// The bodies on joints in their order, with the joint's name and what it leaves free.
    pub(crate) fn on_joints(&self) -> impl Iterator<Item = (usize, &str, &Mobility)> {
        let mut joints: Vec<&SceneJoint> = self.joints.iter().collect();
        joints.sort_by_key(|joint| joint.child);
        let mount = self.mount.iter();
        let mount = mount.map(|mount| (0, &mount.name[..], &mount.mobility));
        let joints = joints.into_iter();
        mount.chain(joints.map(|joint| (joint.child, &joint.name[..], &joint.mobility)))
    }
}
