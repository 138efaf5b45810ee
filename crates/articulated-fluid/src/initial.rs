//! From a scene to a model and its initial state.

use dvi::State;
use lie::{Cotangent, LieGroup, Mat3, Power, Rn, SO3, Tangent, Vec3, VectorSpace};

use crate::error::ModelError;
use crate::node::{Body, Joint};
use crate::scene::{Scene, SceneBody, SceneJoint, StartVelocity};
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
        };
        let joint = |joint: &SceneJoint| Joint {
            parent: joint.parent,
            child: joint.child,
            at_parent: Vec3(joint.at_parent),
            at_child: Vec3(joint.at_child),
        };
        let bodies: Vec<_> = self.bodies.iter().map(body).collect();
        let joints: Vec<_> = self.joints.iter().map(joint).collect();
        let model = ArticulatedBody::new(&bodies, &joints)?;
        let model = model.with_stiffness(&self.stiffnesses())?;
        if !self.has_weight() {
            return Ok(model);
        }
        let net_masses: Vec<f64> = self.bodies.iter().map(|body| body.net_mass).collect();
        model.with_gravity(Vec3(self.gravity), &net_masses)
    }

    /// In the order of the bodies that hang on the joints.
    fn stiffnesses(&self) -> Vec<f64> {
        let mut joints: Vec<&SceneJoint> = self.joints.iter().collect();
        joints.sort_by_key(|joint| joint.child);
        joints.into_iter().map(|joint| joint.stiffness).collect()
    }

    /// Whether gravity acts on a body that is heavier or lighter than what it displaces.
    pub(crate) fn has_weight(&self) -> bool {
        self.gravity != [0.0; 3] && self.bodies.iter().any(|body| body.net_mass != 0.0)
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
        if let StartVelocity::Given(velocity) = velocity {
            xi.1[0] = Tangent(velocity);
        }
        if let Some(root) = root {
            (g, xi) = root.motion(&g, &xi);
        }
        let floats = velocity == StartVelocity::ZeroMomentum;
        if floats {
            stop(model, &g, &mut xi);
        }
        require(xi.1[0].vec3().is_finite(), "velocity")?;
        let mut mu = model.momenta(&g, &xi);
        if floats {
            // The velocity is rounded, and the momentum is not.
            mu.1[0] = Cotangent::zero();
        }
        require(g.is_finite(), "configuration")?;
        require(mu.max_magnitude().is_finite(), "momentum")?;
        Ok(State { t: 0.0, g, mu })
    }

    fn configuration(&self) -> Configuration {
        let attitude = |body: &SceneBody| SO3::from_quaternion(body.attitude);
        let attitudes = self.bodies.iter().map(attitude).collect();
        (attitudes, Power::new(vec![Rn(self.position)]))
    }

    /// The angular velocities.
    fn rates(&self) -> Velocity {
        let rate = |body: &SceneBody| Tangent(body.angular_velocity);
        let rates = self.bodies.iter().map(rate).collect();
        (rates, Power::new(vec![Tangent::zero()]))
    }
}

/// Sets the velocity to the one of no linear momentum.
fn stop(model: &ArticulatedBody, g: &Configuration, xi: &mut Velocity) {
    let total = model.total_mass(&g.0).ldl();
    // The second time for the rounding of the first.
    for _ in 0..2 {
        let linear = model.momenta(g, xi).1[0].vec3();
        xi.1[0] = Tangent((xi.1[0].vec3() - total.solve(linear)).0);
    }
}

fn require(finite: bool, quantity: &'static str) -> Result<(), ModelError> {
    match finite {
        true => Ok(()),
        false => Err(ModelError::NotFinite { quantity }),
    }
}
