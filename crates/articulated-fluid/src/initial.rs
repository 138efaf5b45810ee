//! From a scene to a model and its initial state.

use dvi::{Lagrangian, State};
use lie::{LieGroup, Mat3, Rn, SO3, Tangent, Vec3, VectorSpace};

use crate::scene::{SceneBody, SceneJoint};
use crate::{ArticulatedBody, Body, Configuration, Joint, ModelError, Scene};

impl Scene {
    /// The model of this scene.
    ///
    /// # Errors
    /// None for a scene that was parsed; [`ModelError`] for one that was made by hand and is not a model.
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
        ArticulatedBody::new(&bodies, &joints)
    }

    /// The state at t = 0: attitudes and velocities as given, the momentum by the Legendre transform (10).
    ///
    /// # Errors
    /// As [`model`](Self::model), and [`ModelError::NotFinite`] where a momentum overflows.
    pub fn initial_state(&self) -> Result<State<Configuration>, ModelError> {
        let model = self.model()?;
        let mut attitudes = self
            .bodies
            .iter()
            .map(|body| SO3::from_quaternion(body.attitude));
        let mut rates = self
            .bodies
            .iter()
            .map(|body| Tangent(body.angular_velocity));
        let (head, rate) = attitudes
            .next()
            .zip(rates.next())
            .ok_or(ModelError::NoBody)?;
        let g = (head, Rn(self.position), attitudes.collect());
        let xi = (rate, Tangent(self.velocity), rates.collect());
        let mu = Lagrangian::legendre(&model, 0.0, &g, &xi);
        if !g.is_finite() {
            return Err(ModelError::NotFinite {
                quantity: "configuration",
            });
        }
        if !mu.max_magnitude().is_finite() {
            return Err(ModelError::NotFinite {
                quantity: "momentum",
            });
        }
        Ok(State { t: 0.0, g, mu })
    }
}
