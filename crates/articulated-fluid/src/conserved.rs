//! What the motion keeps.

use dvi::{Context, State};
use lie::{LieGroup, SO3, Vec3};

use crate::error::ModelError;
use crate::lagrangian::Evaluation;
use crate::pose::Pose;
use crate::tree::{ArticulatedBody, Configuration, Velocity};

/// Energy and the momentum maps of a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conserved {
    /// Total energy of bodies and fluid, J: the kinetic one, and the potential ones of the weight and of elastic joints.
    pub energy: f64,
    /// The kinetic part of it, J: what an error of the energy is to be compared with, wherever the origin is.
    pub kinetic: f64,
    /// Total linear momentum $\sum_i R_i M_i V_i$ from the velocities, kg m/s, reference frame: the carried $p_x$ proves nothing.
    pub linear: Vec3,
    /// Total angular momentum about the origin, $x \times p_x + \sum_i R_i p_i$ over the roots, kg m²/s, reference frame; a held base does not keep it.
    pub angular: Vec3,
}

impl ArticulatedBody {
    /// The velocity $\xi = ((\Omega_0, \dots, \Omega_n), \dot x)$ of a state, the inverse of (10).
    ///
    /// # Errors
    /// [`ModelError::Shape`] where the state has another number of bodies.
    pub fn velocity(&self, state: &State<Configuration>) -> Result<Velocity, ModelError> {
        self.check_state(state)?;
        let State { t, g, mu } = state;
        let mut xi = g.zero_algebra();
        let (at, mut work) = (Context::new(*t, &[]), Evaluation::default());
        self.velocity_into(at, (g, mu), &mut work, &mut xi);
        Ok(xi)
    }

    fn check_state(&self, State { g, mu, .. }: &State<Configuration>) -> Result<(), ModelError> {
        match (self.has_shape_of(g), self.has_shape_of(mu)) {
            (true, true) => Ok(()),
            (true, false) => Err(self.shape_error(mu)),
            (false, _) => Err(self.shape_error(g)),
        }
    }

    /// The conserved quantities of a state.
    ///
    /// # Errors
    /// As [`velocity`](Self::velocity); [`ModelError::NotFinite`] where one of them is not finite.
    pub fn conserved(&self, state: &State<Configuration>) -> Result<Conserved, ModelError> {
        Ok(self.velocity_and_conserved(state)?.1)
    }

    /// Both at the price of one.
    ///
    /// # Errors
    /// As [`conserved`](Self::conserved).
    pub fn velocity_and_conserved(
        &self,
        state: &State<Configuration>,
    ) -> Result<(<Configuration as LieGroup>::Algebra, Conserved), ModelError> {
        let mut xi = state.g.zero_algebra();
        let kept = self.conserved_in(state, &mut Evaluation::default(), &mut xi)?;
        Ok((xi, kept))
    }

    /// Both, the velocity into `xi`, with storage that is kept from call to call.
    ///
    /// # Errors
    /// As [`conserved`](Self::conserved).
    pub fn conserved_in(
        &self,
        state: &State<Configuration>,
        work: &mut Evaluation,
        xi: &mut <Configuration as LieGroup>::Algebra,
    ) -> Result<Conserved, ModelError> {
        self.check_state(state)?;
        let State { t, g, mu } = state;
        self.velocity_into(Context::new(*t, &[]), (g, mu), work, xi);
        let xi = &*xi;
        let mut pose = Pose::default();
        let (r, pose) = self.pose(*t, g, &mut pose);
        let (momenta, linear) = self.body_momenta((r, pose), xi);
        let x = self.base_position(pose, g);
        let spins: Vec<Vec3> = match self.is_free() {
            true => {
                let roots = self.joints.roots.iter().zip(mu.0.iter());
                roots.map(|(i, p)| r[*i].rotate(p.vec3())).collect()
            }
            false => r.iter().zip(&momenta).map(|(r, p)| r.rotate(*p)).collect(),
        };
        let carried = mu.1.first().map_or(linear, |px| px.vec3());
        let kinetic = match self.moves_as_told() {
            false => 0.5 * Configuration::pair(mu, xi),
            true => self.kinetic((r, pose), xi),
        };
        let conserved = Conserved {
            energy: kinetic + self.potential((r, pose), g),
            kinetic,
            linear,
            angular: spins.iter().fold(x.cross(carried), |sum, spin| sum + *spin),
        };
        let Conserved {
            energy,
            linear,
            angular,
            ..
        } = conserved;
        let checks = [
            (energy.is_finite(), "energy"),
            (linear.is_finite(), "linear momentum"),
            (angular.is_finite(), "angular momentum"),
        ];
        match checks.iter().find(|(finite, _)| !finite) {
            Some((_, quantity)) => Err(ModelError::NotFinite { quantity }),
            None => Ok(conserved),
        }
    }

    /// From the velocities of the bodies: of driven ones, half of $\langle \mu, \xi \rangle$ is not the kinetic energy, (S15).
    fn kinetic(&self, at: (&[SO3], &Pose<f64>), xi: &Velocity) -> f64 {
        let (rates, velocities) = self.body_velocities(at, xi);
        0.5 * self.twice_kinetic(&rates, &velocities)
    }
}
