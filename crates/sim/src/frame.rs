//! What is seen of a run at one time.

use articulated_fluid::{ArticulatedBody, Configuration, Conserved, ModelError};
use dvi::State;
use lie::{LieGroup, SO3, Vec3};

/// A state of a scene, its velocity, and what the motion keeps of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Time, configuration and momentum.
    pub state: State<Configuration>,
    /// The velocity $\xi = ((\Omega_0, \dots, \Omega_n), \dot x)$, rad/s and m/s.
    pub velocity: <Configuration as LieGroup>::Algebra,
    /// The bodies' mass centres, m, reference frame, in the order of the scene.
    pub centres: Vec<Vec3>,
    /// The conserved quantities.
    pub sample: Sample,
}

impl Frame {
    /// The frame of a state.
    ///
    /// # Errors
    /// [`ModelError::Shape`] where the state does not fit the model, [`ModelError::NotFinite`] where a quantity is not finite.
    pub fn new(model: &ArticulatedBody, state: State<Configuration>) -> Result<Self, ModelError> {
        let (velocity, kept) = model.velocity_and_conserved(&state)?;
        let centres = model.centre_positions(&state.g);
        let quantity = "position";
        if !centres.iter().all(|centre| centre.is_finite()) {
            return Err(ModelError::NotFinite { quantity });
        }
        Ok(Self {
            velocity,
            centres,
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

    /// The velocity of the mass centre of the first body, m/s, reference frame.
    pub fn velocity_of_first(&self) -> Vec3 {
        self.velocity.1[0].vec3()
    }

    /// The bodies' attitudes, body to reference frame, in the order of the scene.
    pub fn attitudes(&self) -> &[SO3] {
        &self.state.g.0
    }

    /// The bodies' angular velocities, rad/s, each in its body's frame.
    pub fn rates(&self) -> impl Iterator<Item = Vec3> {
        self.velocity.0.iter().map(|omega| omega.vec3())
    }

    /// The centre of the bodies with these masses, m, reference frame: $\sum_i m_i x_i / \sum_i m_i$.
    pub fn centre_of(&self, masses: &[f64]) -> Vec3 {
        // From the first body, so that a far origin takes no digits, and in parts of the whole, as masses may be of any size.
        let (first, total) = (self.position(), masses.iter().sum::<f64>());
        let bodies = self.centres.iter().zip(masses);
        bodies.fold(first, |centre, (x, mass)| {
            centre + (*x - first) * (mass / total)
        })
    }

    /// The angular momentum about the point $c$, $(x - c) \times p_x + \sum_i R_i p_i$, kg m²/s, reference frame.
    pub fn angular_about(&self, c: Vec3) -> Vec3 {
        let (p, linear) = &self.state.mu;
        let spins = self.attitudes().iter().zip(p.iter());
        let orbital = (self.position() - c).cross(linear[0].vec3());
        spins.fold(orbital, |sum, (r, p)| sum + r.rotate(p.vec3()))
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
