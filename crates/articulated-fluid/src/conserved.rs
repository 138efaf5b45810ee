//! What the motion keeps, and where the joints are.

use dvi::{ContinuousSystem, State};
use lie::{LieGroup, SO3, Vec3};

use crate::elimination::of;
use crate::{ArticulatedBody, Configuration, Joint, ModelError};

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
    /// The velocity $\xi = (\Omega_0, \dot x, \Omega_1, \dots)$ of a state, the inverse of (10).
    ///
    /// # Errors
    /// [`ModelError::Shape`] where the state has another number of tails.
    pub fn velocity(
        &self,
        state: &State<Configuration>,
    ) -> Result<<Configuration as LieGroup>::Algebra, ModelError> {
        let expected = self.nodes.len() - 1;
        for found in [state.g.2.len(), state.mu.2.len()] {
            if found != expected {
                return Err(ModelError::Shape { expected, found });
            }
        }
        let (mut xi, mut tau) = (state.g.zero_algebra(), state.g.zero_dual());
        let mut workspace = ContinuousSystem::workspace::<f64>(self, &state.g);
        let State { t, g, mu } = state;
        self.velocity_and_force::<f64>(*t, g, mu, &mut workspace, &mut xi, &mut tau);
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
        let ((r0, x, r), (p0, px, p)) = (&state.g, &state.mu);
        let potential = self.potential((r0, r), x.vec3());
        let attitudes = core::iter::once(r0).chain(r.iter());
        let momenta = core::iter::once(p0).chain(p.iter());
        let spins = attitudes
            .zip(momenta)
            .map(|(r, p): (&SO3, _)| r.rotate(p.vec3()));
        let orbital = x.vec3().cross(px.vec3());
        let kinetic = 0.5 * Configuration::pair(&state.mu, &xi);
        let conserved = Conserved {
            energy: kinetic + potential,
            kinetic,
            linear: self.momenta(&state.g, &xi).1.vec3(),
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

    /// The largest $\lVert I - R_i^T R_i \rVert_F$ of the bodies.
    pub fn orthogonality_error(&self, g: &Configuration) -> f64 {
        let attitudes = core::iter::once(&g.0).chain(g.2.iter());
        attitudes.map(SO3::orthogonality_error).fold(0.0, f64::max)
    }

    /// Where the joints are, in the reference frame: $x_p + R_p d_{pi}$, m, in the order of the bodies that hang on them;
    /// as many as both the model and `g` have.
    pub fn joint_positions(&self, g: &Configuration) -> Vec<Vec3> {
        let centres = self.centre_positions(g);
        let known = self.joints().zip(g.2.iter());
        let position = |joint: Joint| {
            let r = of((&g.0, &g.2), joint.parent);
            centres[joint.parent] + r.rotate(joint.at_parent)
        };
        known.map(|(joint, _)| position(joint)).collect()
    }

    /// Where the mass centres are, in the reference frame: $x$, then $x_p + R_p d_{pi} - R_i d_{ip}$, m;
    /// as many as both the model and `g` have.
    pub fn centre_positions(&self, g: &Configuration) -> Vec<Vec3> {
        let mut centres = vec![g.1.vec3()];
        for (joint, r) in self.joints().zip(g.2.iter()) {
            let on = of((&g.0, &g.2), joint.parent);
            let at = centres[joint.parent] + on.rotate(joint.at_parent);
            centres.push(at - r.rotate(joint.at_child));
        }
        centres
    }
}
