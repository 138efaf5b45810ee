//! What is seen of a run at one time.

use articulated_fluid::{
    ArticulatedBody, Configuration, Conserved, Drive, DriveKind, Evaluation, Kinematics, ModelError,
};
use dvi::State;
use lie::{LieGroup, Vec3};

/// A state of a scene, how its bodies move, and what the motion keeps of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Time, configuration and momentum.
    pub state: State<Configuration>,
    /// The velocity $\xi$ of what joints and base leave free, rad/s and m/s.
    pub velocity: <Configuration as LieGroup>::Algebra,
    /// The bodies, in the order of the scene.
    pub bodies: Kinematics,
    /// The conserved quantities.
    pub sample: Sample,
    /// The drives, in the order of the scene's bodies.
    pub drives: Vec<DriveSample>,
}

impl Frame {
    /// The frame of a state, before which no drive has done anything.
    ///
    /// # Errors
    /// [`ModelError::Shape`] where the state does not fit the model, [`ModelError::NotFinite`] where a quantity is not finite.
    pub fn new(model: &ArticulatedBody, state: State<Configuration>) -> Result<Self, ModelError> {
        let (velocity, kept) = model.velocity_and_conserved(&state)?;
        let bodies = model.kinematics(state.t, &state.g, &velocity)?;
        let quantity = "position";
        if !bodies.centres.iter().all(|centre| centre.is_finite()) {
            return Err(ModelError::NotFinite { quantity });
        }
        Ok(Self {
            velocity,
            bodies,
            sample: Sample::new(model, &state, kept),
            drives: model.drives().iter().map(DriveSample::idle).collect(),
            state,
        })
    }

    /// The time, s.
    pub fn t(&self) -> f64 {
        self.state.t
    }

    /// The mass centre of the first body, m, reference frame.
    pub fn position(&self) -> Vec3 {
        self.bodies.centres[0]
    }

    /// The angle, rad, and the rate, rad/s, of a free hinge, counted in the order of the scene.
    pub fn hinge(&self, k: usize) -> Option<[f64; 2]> {
        let (q, rate) = (self.state.g.2.get(k)?, self.velocity.2.get(k)?);
        Some([q.0[0], rate[0]])
    }

    /// The centre of the bodies with these masses, m, reference frame: $\sum_i m_i x_i / \sum_i m_i$.
    pub fn centre_of(&self, masses: &[f64]) -> Vec3 {
        // From the first body, so that a far origin takes no digits, and in parts of the whole, as masses may be of any size.
        let (first, total) = (self.position(), masses.iter().sum::<f64>());
        let bodies = self.bodies.centres.iter().zip(masses);
        bodies.fold(first, |centre, (x, mass)| {
            centre + (*x - first) * (mass / total)
        })
    }

    /// The angular momentum about the point $c$, kg m²/s, reference frame.
    pub fn angular_about(&self, c: Vec3) -> Vec3 {
        (self.bodies.base - c).cross(self.sample.linear) + self.bodies.spin
    }
}

/// What a drive or a load does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveSample {
    /// What it is.
    pub kind: DriveKind,
    /// Since the start, J.
    pub work: f64,
    /// The mean power since the frame before, W.
    pub power: f64,
    /// The mean torque on the body since the frame before, N m in the reference frame.
    pub torque: Vec3,
}

impl DriveSample {
    /// Of a drive that has done nothing.
    fn idle(drive: &Drive) -> Self {
        Self {
            kind: drive.kind,
            work: 0.0,
            power: 0.0,
            torque: Vec3::zero(),
        }
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
    /// What drives have done since the start, J.
    pub work: f64,
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

    /// The energy that no drive has done work for, J: what the motion keeps.
    pub fn balance(&self) -> f64 {
        self.energy - self.work
    }

    /// The sample of a state, or why there is none, with storage kept from call to call.
    pub(crate) fn of(
        model: &ArticulatedBody,
        state: &State<Configuration>,
        (work, xi): (&mut Evaluation, &mut <Configuration as LieGroup>::Algebra),
    ) -> Result<Self, ModelError> {
        let kept = model.conserved_in(state, work, xi)?;
        Ok(Self::new(model, state, kept))
    }

    fn new(model: &ArticulatedBody, state: &State<Configuration>, kept: Conserved) -> Self {
        Self {
            t: state.t,
            energy: kept.energy,
            kinetic: kept.kinetic,
            work: 0.0,
            linear: kept.linear,
            angular: kept.angular,
            orthogonality: model.orthogonality_error(&state.g),
        }
    }
}
