//! From a scene to a model and its initial state.

use std::sync::Arc;

use dvi::State;
use lie::{Cotangent, LieGroup, Mat3, Power, Rn, SO3, Tangent, Vec3, VectorSpace};

use crate::error::ModelError;
use crate::node::{Body, Joint};
use crate::scene::{Mobility, Scene, SceneBody, SceneJoint, StartVelocity};
use crate::tree::{ArticulatedBody, Configuration, Velocity};
use crate::views::Rerooted;

impl Scene {
    /// The model of this scene.
    ///
    /// # Errors
    /// [`ModelError`] where numbers are too large or small for each other, or a scene made by hand is not a model.
    pub fn model(&self) -> Result<ArticulatedBody, ModelError> {
        let body = |body: &SceneBody| Body {
            mass: Mat3(body.total_mass),
            inertia: Mat3(body.total_inertia),
            coupling: Mat3(body.coupling),
        };
        let joint = |joint: &SceneJoint| {
            let points = [Vec3(joint.at_parent), Vec3(joint.at_child)];
            let kind = joint.mobility.kind.clone();
            Joint::new([joint.parent, joint.child], points, kind)
        };
        let bodies: Vec<_> = self.bodies.iter().map(body).collect();
        let joints: Vec<_> = self.joints.iter().map(joint).collect();
        let model = match &self.mount {
            None => ArticulatedBody::new(&bodies, &joints)?,
            Some(mount) => {
                let on = (Vec3(mount.at_child), mount.mobility.kind.clone());
                ArticulatedBody::held(&bodies, &joints, on, Arc::new(mount.place.clone()))?
            }
        };
        let mobilities = self.on_joints().map(|(.., mobility)| mobility);
        let model = Mobility::load(mobilities, model)?;
        let bodies = self.bodies.iter().enumerate();
        let loads =
            bodies.flat_map(|(i, body)| body.loads.iter().map(move |load| (i, load.clone())));
        let model = model.with_loads_on_bodies(&loads.collect::<Vec<_>>())?;
        if !self.has_weight() {
            return Ok(model);
        }
        let net_masses: Vec<f64> = self.bodies.iter().map(|body| body.net_mass).collect();
        let model = model.with_gravity(Vec3(self.gravity), &net_masses)?;
        let buoyancy = self.bodies.iter().map(SceneBody::buoyancy_moment);
        model.with_buoyancy(&buoyancy.collect::<Vec<_>>())
    }

    /// Whether gravity acts on a body: one that is heavier or lighter than what it displaces, or has its buoyancy elsewhere.
    pub(crate) fn has_weight(&self) -> bool {
        let acts =
            |body: &SceneBody| body.net_mass != 0.0 || body.buoyancy_moment() != Vec3::zero();
        self.gravity != [0.0; 3] && self.bodies.iter().any(acts)
    }

    /// The state at t = 0: attitudes and velocities as given, the momentum by the Legendre transform (10).
    ///
    /// # Errors
    /// As [`model`](Self::model), and [`ModelError::NotFinite`] where a velocity or a momentum overflows.
    pub fn initial_state(&self) -> Result<State<Configuration>, ModelError> {
        self.start(&self.model()?, None, self.velocity)
    }

    /// The state at t = 0 with this velocity, in the coordinates of `root`, if any, whose model it is then.
    pub(crate) fn start(
        &self,
        model: &ArticulatedBody,
        root: Option<&Rerooted>,
        velocity: StartVelocity,
    ) -> Result<State<Configuration>, ModelError> {
        let (mut g, mut xi) = (self.configuration(), self.rates());
        if let (StartVelocity::Given(velocity), None) = (velocity, &self.mount) {
            xi.1[0] = Tangent(velocity);
        }
        if let Some(root) = root {
            (g, xi) = root.motion(&g, &xi);
        }
        // A held base has no velocity to choose.
        let velocity = match self.mount {
            Some(_) => StartVelocity::Given([0.0; 3]),
            None => velocity,
        };
        match velocity {
            StartVelocity::Given(_) => {}
            StartVelocity::ZeroMomentum => stop(model, &g, &mut xi),
            StartVelocity::NoMomentum => stop_turning(model, &g, &mut xi),
        }
        let velocities = xi.1.iter().all(|v| v.vec3().is_finite());
        require(velocities, "velocity")?;
        let mut mu = model.momenta(0.0, &g, &xi);
        if !matches!(velocity, StartVelocity::Given(_)) {
            // The velocity is rounded, and the momentum is not.
            mu.1.fill(Cotangent::zero());
        }
        require(g.is_finite(), "configuration")?;
        require(mu.max_magnitude().is_finite(), "momentum")?;
        Ok(State { t: 0.0, g, mu })
    }

    /// The bodies whose attitudes are unknowns: free, or on balls.
    fn roots(&self) -> impl Iterator<Item = &SceneBody> {
        let mut are_roots = vec![true; self.bodies.len()];
        for (i, _, mobility) in self.on_joints() {
            if let Some(is_root) = are_roots.get_mut(i) {
                *is_root = mobility.kind.is_root();
            }
        }
        let bodies = self.bodies.iter().zip(are_roots);
        bodies.filter_map(|(body, is_root)| is_root.then_some(body))
    }

    /// What the hinges start with.
    fn hinges(&self) -> impl Iterator<Item = &Mobility> {
        let all = self.on_joints().map(|(.., mobility)| mobility);
        all.filter(|mobility| mobility.kind.has_angle())
    }

    fn configuration(&self) -> Configuration {
        let attitude = |body: &SceneBody| SO3::from_quaternion(body.attitude);
        let free = usize::from(self.mount.is_none());
        (
            self.roots().map(attitude).collect(),
            Power::new(vec![Rn(self.position); free]),
            self.hinges().map(|hinge| Rn([hinge.angle])).collect(),
        )
    }

    /// The angular velocities, and the rates of the hinges.
    fn rates(&self) -> Velocity {
        let rate = |body: &SceneBody| Tangent(body.angular_velocity);
        let free = usize::from(self.mount.is_none());
        (
            self.roots().map(rate).collect(),
            Power::new(vec![Tangent::zero(); free]),
            self.hinges().map(|hinge| Tangent([hinge.rate])).collect(),
        )
    }
}

/// Sets the velocity to the one of no linear momentum.
fn stop(model: &ArticulatedBody, g: &Configuration, xi: &mut Velocity) {
    let total = model.total_mass_of(g).ldl();
    // The second time for the rounding of the first.
    for _ in 0..2 {
        let linear = model.total_momentum(g, xi)[0];
        xi.1[0] = Tangent((xi.1[0].vec3() - total.solve(linear)).0);
    }
}

/// Adds the velocity of a rigid whole for which neither linear nor angular momentum is left.
fn stop_turning(model: &ArticulatedBody, g: &Configuration, xi: &mut Velocity) {
    let zero = Vec3::zero();
    let axes = Mat3::identity().0.map(Vec3);
    // The momentum is affine in the velocity: what moves as told has its own. The second time for the rounding of the first.
    for _ in 0..2 {
        let [p, l] = model.total_momentum(g, xi);
        let gained = |v: Vec3, w: Vec3| {
            let [q, k] = model.total_momentum(g, &model.carried(g, xi, [v, w]));
            [q - p, k - l]
        };
        let (along, about) = (axes.map(|v| gained(v, zero)), axes.map(|w| gained(zero, w)));
        let columns = |of: [[Vec3; 2]; 3], part: usize| Mat3(of.map(|c| c[part].0)).transpose();
        let (mass, coupling, inertia) = (columns(along, 0), columns(about, 0), columns(about, 1));
        let by_mass = mass.inverse() * coupling;
        let schur = inertia - coupling.transpose() * by_mass;
        let w = schur.inverse() * (coupling.transpose_mul(mass.inverse() * p) - l);
        let v = -(mass.inverse() * p) - by_mass * w;
        *xi = model.carried(g, xi, [v, w]);
    }
}

fn require(finite: bool, quantity: &'static str) -> Result<(), ModelError> {
    match finite {
        true => Ok(()),
        false => Err(ModelError::NotFinite { quantity }),
    }
}
