//! What the motion keeps.

use dvi::{Context, ContinuousSystem, State};
use lie::{LieGroup, Vec3};

use crate::error::ModelError;
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
    /// Total angular momentum about the origin, $x \times p_x + \sum_i R_i p_i$, kg m²/s, reference frame.
    pub angular: Vec3,
}

impl ArticulatedBody {
    /// The velocity $\xi = ((\Omega_0, \dots, \Omega_n), \dot x)$ of a state, the inverse of (10).
    ///
    /// # Errors
    /// [`ModelError::Shape`] where the state has another number of bodies.
    pub fn velocity(&self, state: &State<Configuration>) -> Result<Velocity, ModelError> {
        let State { t, g, mu } = state;
        if !(self.has_shape_of(g) && self.has_shape_of(mu)) {
            let (expected, found) = (self.nodes.len(), g.0.len().max(mu.0.len()));
            return Err(ModelError::Shape { expected, found });
        }
        let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
        let (at, mut work) = (Context::new(*t, &[]), Default::default());
        self.velocity_and_force::<f64>(at, g, mu, &mut work, &mut xi, &mut tau);
        Ok(xi)
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
        let xi = self.velocity(state)?;
        let ((r, x), (p, px)) = (&state.g, &state.mu);
        let potential = self.loads.potential(r, x[0].vec3());
        let spins = r.iter().zip(p.iter()).map(|(r, p)| r.rotate(p.vec3()));
        let orbital = x[0].vec3().cross(px[0].vec3());
        let kinetic = 0.5 * Configuration::pair(&state.mu, &xi);
        let conserved = Conserved {
            energy: kinetic + potential,
            kinetic,
            linear: self.momenta(&state.g, &xi).1[0].vec3(),
            angular: spins.fold(orbital, |sum, spin| sum + spin),
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
            None => Ok((xi, conserved)),
        }
    }
}
