//! The pendulum in space, on $SO(3)$.

use std::f64::consts::PI;

use dvi::{Context, HamiltonianSystem, Lagrangian, State, System};
use lie::{Cotangent, LieGroup, Mat3, SO3, Scalar, Tangent, Vec3};

use super::jacobi::Jacobi;
use super::{Problem, ProblemError, Reference, Solution, checked, finite, left, positive};
use crate::baseline::Tolerance;

/// A rigid body on a frictionless pivot, $L = \frac12 \sum_i J_i \Omega_i^2 - m g\ (R \rho) \cdot e_3$.
///
/// Source: N. A. Chaturvedi, T. Lee, M. Leok, N. H. McClamroch, *Nonlinear dynamics of the 3D pendulum*, J. Nonlinear
/// Sci. 21 (2011); there $e_3$ points down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pendulum {
    moments: [f64; 3],
    weight: f64,
    centre: [f64; 3],
}

impl System for Pendulum {
    type Group = SO3;
}

impl Lagrangian for Pendulum {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let [a, b, c] = self.moments.map(S::from_f64);
        let [p, q, s] = omega.0;
        let height = r.matrix().row(2).dot(Vec3(self.centre).lift());
        (a * p * p + b * q * q + c * s * s) * S::from_f64(0.5) - height * S::from_f64(self.weight)
    }
}

impl Pendulum {
    /// The pendulum with principal moments of inertia `moments` about the pivot, kg m², and `weight` $m g$ (N). Its mass
    /// centre $\rho$ is at `centre`, m, from the pivot in the body's principal axes.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`], for a mass centre at the pivot too; [`ProblemError::NotFinite`].
    pub fn new(moments: [f64; 3], weight: f64, centre: [f64; 3]) -> Result<Self, ProblemError> {
        for moment in moments {
            positive("moment of inertia", moment)?;
        }
        finite("mass centre", &centre)?;
        positive("distance of the mass centre", Vec3(centre).norm())?;
        Ok(Self {
            moments,
            weight: positive("weight", weight)?,
            centre,
        })
    }

    /// The swing in a vertical plane about the principal axis `axis`, which lies along $e_1$ of space. It starts at the angle
    /// `angle`, rad, to the hanging position, with the rate `rate`, rad/s.
    ///
    /// # Errors
    /// [`ProblemError::NotPlanar`] where the mass centre has a part along the axis, so that there is no such motion;
    /// [`ProblemError::NoPeriod`] on the separatrix.
    pub fn swing(
        self,
        axis: usize,
        angle: f64,
        rate: f64,
    ) -> Result<Problem<Self, Swing>, ProblemError> {
        finite("angle or rate", &[angle, rate])?;
        let exact = Swing::new(self, axis, angle, rate)?;
        let start = checked(exact.state(0.0, angle, rate))?;
        Ok(self.posed("planar pendulum", start, exact.period(), exact))
    }

    /// The motion from `attitude` with the angular velocity `omega`, rad/s, in the body's frame, at time zero. There is
    /// no closed form: the solution is integrated on its own to `tolerance`.
    ///
    /// # Errors
    /// [`ProblemError::NotFinite`].
    pub fn problem(
        self,
        attitude: SO3,
        omega: [f64; 3],
        tolerance: Tolerance,
    ) -> Result<Problem<Self, Reference<HamiltonianSystem<Self>>>, ProblemError> {
        let start = checked(self.state(0.0, attitude, &Tangent(omega))?)?;
        let exact = Reference {
            system: self.hamiltonian(),
            start: start.clone(),
            tolerance,
        };
        let slowest = self.moments.into_iter().fold(0.0, f64::max);
        let time = 2.0 * PI * (slowest / (self.weight * Vec3(self.centre).norm())).sqrt();
        Ok(self.posed("pendulum in space", start, time, exact))
    }

    fn posed<X>(
        self,
        name: &'static str,
        start: State<SO3>,
        time: f64,
        exact: X,
    ) -> Problem<Self, X> {
        let vertical = Tangent([0.0, 0.0, 1.0]);
        Problem {
            name,
            lagrangian: self,
            start,
            exact,
            time,
            symmetries: vec![left("angular momentum about the vertical", vertical)],
        }
    }
}

/// A planar swing, by Jacobi's elliptic functions.
///
/// $\ddot q = -\omega_0^2 \sin q$ with $\omega_0^2 = m g |\rho| / J$ and $k^2 = \sin^2\frac{q_0}2 + \dot q_0^2 / (4 \omega_0^2)$:
/// to and fro where $k < 1$, $\sin\frac q2 = k\ \mathrm{sn}(\omega_0 t + u_0, k^2)$; over the top where $k > 1$,
/// $\frac q2 = \pm \mathrm{am}(k \omega_0 t + u_0, k^{-2})$.
///
/// Source: E. T. Whittaker, *Analytical Dynamics*, 4th ed. (1937), § 44.
#[derive(Clone, Debug, PartialEq)]
pub struct Swing {
    axis: usize,
    moment: f64,
    hanging: SO3,
    functions: Jacobi,
    /// $k$.
    modulus: f64,
    /// $\omega_0$.
    natural: f64,
    /// $u_0$.
    phase: f64,
    /// The sense of a rotation, zero for a libration.
    sense: f64,
}

impl Swing {
    fn new(pendulum: Pendulum, axis: usize, angle: f64, rate: f64) -> Result<Self, ProblemError> {
        let moment = pendulum.moments.get(axis);
        let moment = *moment.ok_or(ProblemError::NoSuchAxis { axis })?;
        let offset = pendulum.centre[axis];
        if offset != 0.0 {
            return Err(ProblemError::NotPlanar { offset });
        }
        let natural = (pendulum.weight * Vec3(pendulum.centre).norm() / moment).sqrt();
        let half = (angle - 2.0 * PI * (angle / (2.0 * PI)).round()) / 2.0;
        let ((sin, cos), speed) = (half.sin_cos(), rate / (2.0 * natural));
        let excess = (speed - cos) * (speed + cos);
        if excess == 0.0 {
            return Err(ProblemError::NoPeriod);
        }
        let rotates = excess > 0.0;
        let square = sin * sin + speed * speed;
        let (complement, amplitude, sense) = match rotates {
            true => (excess / square, half * rate.signum(), rate.signum()),
            false => (-excess, sin.atan2(speed), 0.0),
        };
        let functions = Jacobi::new(complement.min(1.0));
        Ok(Self {
            axis,
            moment,
            hanging: hanging(pendulum.centre, axis),
            phase: functions.first_kind(amplitude),
            functions,
            modulus: square.sqrt(),
            natural,
            sense,
        })
    }

    /// The period of the swing, or of a turn over the top, s.
    pub fn period(&self) -> f64 {
        let quarters = if self.sense == 0.0 { 4.0 } else { 2.0 };
        quarters * self.functions.quarter() / self.pace()
    }

    /// Whether the pendulum goes over the top.
    pub fn rotates(&self) -> bool {
        self.sense != 0.0
    }

    /// The angle from the hanging position, in $[-\pi, \pi]$, rad, and its rate, rad/s.
    pub fn angle_and_rate(&self, t: f64) -> [f64; 2] {
        let phase = self.functions.at(self.phase + self.pace() * t);
        let pace = 2.0 * self.modulus * self.natural;
        if self.rotates() {
            [
                2.0 * self.sense * phase.amplitude,
                self.sense * pace * phase.dn,
            ]
        } else {
            [
                2.0 * (self.modulus * phase.sn).atan2(phase.dn),
                pace * phase.cn,
            ]
        }
    }

    /// The rate of the argument of the elliptic functions.
    fn pace(&self) -> f64 {
        let factor = if self.rotates() { self.modulus } else { 1.0 };
        factor * self.natural
    }

    fn state(&self, t: f64, angle: f64, rate: f64) -> State<SO3> {
        let (mut turn, mut mu) = (Tangent::zero(), Cotangent::zero());
        turn[self.axis] = angle;
        mu[self.axis] = self.moment * rate;
        let g = self.hanging.compose(&SO3::exp(&turn));
        State { t, g, mu }
    }
}

impl Solution<SO3> for Swing {
    fn at(&self, t: f64) -> Result<State<SO3>, ProblemError> {
        finite("time", &[t])?;
        let [angle, rate] = self.angle_and_rate(t);
        checked(self.state(t, angle, rate))
    }
}

/// The attitude with the axis along $e_1$ and the mass centre straight down.
fn hanging(centre: [f64; 3], axis: usize) -> SO3 {
    let mut e = Vec3::zero();
    e[axis] = 1.0;
    let down = Vec3(centre) * (1.0 / Vec3(centre).norm());
    SO3::from_matrix_unchecked(Mat3([e.0, e.cross(down).0, (-down).0]))
}
