//! What is seen of a run at one time.

use articulated_fluid::{ArticulatedBody, Configuration, Conserved};
use dvi::State;
use lie::{LieGroup, SO3, Vec3};

/// A state of a scene, its velocity, and what the motion keeps of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Time, configuration and momentum.
    pub state: State<Configuration>,
    /// The velocity $\xi = ((\Omega_0, \dots, \Omega_n), \dot x)$, rad/s and m/s.
    pub velocity: <Configuration as LieGroup>::Algebra,
    /// The conserved quantities.
    pub sample: Sample,
}

impl Frame {
    /// The frame of a state; `None` where it does not fit the model, or a quantity is not finite.
    pub fn new(model: &ArticulatedBody, state: State<Configuration>) -> Option<Self> {
        let (velocity, kept) = model.velocity_and_conserved(&state).ok()?;
        Some(Self {
            velocity,
            sample: Sample::new(model, &state, kept),
            state,
        })
    }

    /// The time, s.
    pub fn t(&self) -> f64 {
        self.state.t
    }

    /// The number of bodies.
    pub fn bodies(&self) -> usize {
        self.state.g.0.len()
    }

    /// The mass centre of the first body, m, reference frame.
    pub fn position(&self) -> Vec3 {
        self.state.g.1[0].vec3()
    }

    /// The bodies' attitudes, body to reference frame, in the order of the scene.
    pub fn attitudes(&self) -> &[SO3] {
        &self.state.g.0
    }

    /// The bodies' angular velocities, rad/s, each in its body's frame.
    pub fn rates(&self) -> impl Iterator<Item = Vec3> {
        self.velocity.0.iter().map(|omega| omega.vec3())
    }
}

/// What the motion keeps, at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// s.
    pub t: f64,
    /// J.
    pub energy: f64,
    /// Its kinetic part, J.
    pub kinetic: f64,
    /// kg m/s.
    pub linear: Vec3,
    /// kg m²/s.
    pub angular: Vec3,
    /// The largest $\lVert I - R^T R \rVert_F$ over the bodies.
    pub orthogonality: f64,
}

impl Sample {
    /// The sample of a state; `None` where a quantity is not finite.
    pub fn take(model: &ArticulatedBody, state: &State<Configuration>) -> Option<Self> {
        let kept = model.conserved(state).ok()?;
        Some(Self::new(model, state, kept))
    }

    fn new(model: &ArticulatedBody, state: &State<Configuration>, kept: Conserved) -> Self {
        Self {
            t: state.t,
            energy: kept.energy,
            kinetic: kept.kinetic,
            linear: kept.linear,
            angular: kept.angular,
            orthogonality: model.orthogonality_error(&state.g),
        }
    }
}
