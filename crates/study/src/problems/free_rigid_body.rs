//! The free rigid body on $SO(3)$.

use dvi::{Context, Lagrangian, State, System};
use lie::{Cotangent, LieGroup, Mat3, SO3, Scalar, Tangent, Vec3};

use super::jacobi::{Jacobi, Phase, ThirdKind};
use super::{Problem, ProblemError, Solution, checked, finite, left, positive};

/// A rigid body without torque, $L = \frac12 \sum_i I_i \Omega_i^2$, the axes of its frame principal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeRigidBody {
    moments: [f64; 3],
}

impl System for FreeRigidBody {
    type Group = SO3;
}

impl Lagrangian for FreeRigidBody {
    fn value<S: Scalar>(&self, _: Context<S>, _: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let [a, b, c] = self.moments.map(S::from_f64);
        let [p, q, r] = omega.0;
        (a * p * p + b * q * q + c * r * r) * S::from_f64(0.5)
    }
}

impl FreeRigidBody {
    /// The body with these principal moments of inertia, kg m², in any order.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`].
    pub fn new(moments: [f64; 3]) -> Result<Self, ProblemError> {
        for moment in moments {
            positive("moment of inertia", moment)?;
        }
        Ok(Self { moments })
    }

    /// The motion from `attitude` with the angular velocity `omega`, rad/s, in the body's frame, at time zero.
    ///
    /// # Errors
    /// [`ProblemError::NoPeriod`] at rest and on the separatrix, rotation about the middle axis among them.
    pub fn problem(
        self,
        attitude: SO3,
        omega: [f64; 3],
    ) -> Result<Problem<Self, FreeRotation>, ProblemError> {
        finite("angular velocity", &omega)?;
        let start = checked(self.state(0.0, attitude, &Tangent(omega))?)?;
        let exact = FreeRotation::new(self.moments, &start)?;
        let [x, y, z] = [0, 1, 2].map(|i| Tangent(unit(i).0));
        Ok(Problem {
            name: "free rigid body",
            lagrangian: self,
            start,
            time: exact.period(),
            exact,
            symmetries: vec![
                left("angular momentum about x", x),
                left("angular momentum about y", y),
                left("angular momentum about z", z),
            ],
        })
    }
}

/// The rotation of a free body, by Jacobi's elliptic functions.
///
/// Let 3 be the axis that the momentum $M$ circles, the one of the largest moment where $L^2 > 2 E I_2$ and of the smallest
/// where $L^2 < 2 E I_2$; 2 the middle axis. Then, with $D_3 = |2 E I_3 - L^2|$ and $D_1 = |2 E I_1 - L^2|$,
/// $$
/// M = (\hat M_1\ \mathrm{cn}\ u,\ \hat M_2\ \mathrm{sn}\ u,\ \hat M_3\ \mathrm{dn}\ u), \quad u = \omega t + u_0, \quad
/// \omega^2 = \frac{|I_3 - I_2| D_1}{I_1 I_2 I_3}, \quad 1 - m = \frac{|I_3 - I_1|\ |L^2 - 2 E I_2|}{|I_3 - I_2|\ D_1},
/// $$
/// and the axis 3 turns about the constant spatial momentum by
/// $$
/// \varphi = \frac{L t}{I_3} + \frac L\omega \left(\frac1{I_1} - \frac1{I_3}\right) \left[\Pi(n; \mathrm{am}\ v, m)\right]_{v = u_0}^{u},
/// \qquad n = -\frac{I_3 |I_2 - I_1|}{I_1 |I_3 - I_2|}.
/// $$
/// Differences of squares are taken as sums of terms of one sign, and whole periods are counted. So the error grows
/// with the number of periods by a few units of rounding each. Near the separatrix digits are lost as $1/(1 - m)$.
///
/// Source: L. D. Landau, E. M. Lifshitz, *Mechanics*, 3rd ed. (1976), § 37.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeRotation {
    /// The body's axes 1, 2, 3.
    axes: [usize; 3],
    /// $\hat M_i$, with signs.
    amplitudes: [f64; 3],
    /// $\hat M_2 / \hat M_1$, which stays when both vanish.
    aspect: f64,
    functions: Jacobi,
    turning: ThirdKind,
    /// $\omega$.
    rate: f64,
    /// $u_0$.
    phase: f64,
    /// $L / I_3$ and $L (1/I_1 - 1/I_3) / \omega$.
    precession: [f64; 2],
    /// From the frame whose third axis is the momentum, and in which $\varphi = 0$ at the start, to space.
    frame: SO3,
}

impl FreeRotation {
    fn new(moments: [f64; 3], start: &State<SO3>) -> Result<Self, ProblemError> {
        let (axes, excess) = label(moments, start.mu.vec3())?;
        let [i1, i2, i3] = axes.map(|axis| moments[axis]);
        let [m1, m2, m3] = axes.map(|axis| start.mu[axis]);
        let term = |m: f64, i: f64, j: f64| m * m * (j - i).abs() / i;
        let (d1, d3) = (
            term(m2, i2, i1) + term(m3, i3, i1),
            term(m1, i1, i3) + term(m2, i2, i3),
        );
        let (outer, inner) = ((i3 - i1).abs(), (i3 - i2).abs());
        let complement = (outer * excess / (inner * d1)).min(1.0);
        if !(complement > 0.0 && d1.is_normal()) {
            return Err(ProblemError::NoPeriod);
        }
        let rate = (inner * d1 / (i1 * i2 * i3)).sqrt();
        let sign = parity(axes) * (i3 - i1).signum() * m3.signum();
        let aspect = sign * (i2 * outer / (i1 * inner)).sqrt();
        let first = (i1 * d3 / outer).sqrt();
        let amplitudes = [
            first,
            aspect * first,
            m3.signum() * (i3 * d1 / outer).sqrt(),
        ];
        let functions = Jacobi::new(complement);
        let turning = ThirdKind::new(&functions, -i3 * (i2 - i1).abs() / (i1 * inner));
        let length = start.mu.vec3().norm();
        let mut rotation = Self {
            axes,
            amplitudes,
            aspect,
            phase: functions.first_kind((m2 / aspect).atan2(m1)),
            functions,
            turning,
            rate,
            precession: [length / i3, length * (i3 - i1) / (i1 * i3) / rate],
            frame: SO3::identity(),
        };
        let origin = rotation.functions.at(rotation.phase);
        rotation.frame = start.g.compose(&rotation.alignment(&origin).inverse());
        Ok(rotation)
    }

    /// The period of the momentum in the body's frame, s.
    pub fn period(&self) -> f64 {
        4.0 * self.functions.quarter() / self.rate
    }

    /// The mean rate, rad/s, at which the axis that the momentum circles turns about the spatial momentum.
    pub fn mean_precession_rate(&self) -> f64 {
        let [steady, wobble] = self.precession;
        steady + wobble * self.turning.half_turn * 2.0 / self.period()
    }

    fn momentum(&self, phase: &Phase) -> Vec3 {
        let functions = [phase.cn, phase.sn, phase.dn];
        let mut momentum = Vec3::zero();
        for ((axis, amplitude), value) in self.axes.into_iter().zip(self.amplitudes).zip(functions)
        {
            momentum[axis] = amplitude * value;
        }
        momentum
    }

    /// The rotation that takes the momentum in the body's frame to the third axis, and the axis 3 into the plane of the last two.
    fn alignment(&self, phase: &Phase) -> SO3 {
        let [axis, second, third] = self.axes.map(unit);
        let across = axis * phase.cn + second * (self.aspect * phase.sn);
        let across = across * (1.0 / across.norm());
        let momentum = self.momentum(phase);
        let z = momentum * (1.0 / momentum.norm());
        let x = third.cross(across);
        SO3::from_matrix_unchecked(Mat3([x.0, z.cross(x).0, z.0]))
    }

    /// $\varphi$ after the time `t`.
    fn precession(&self, t: f64, phase: &Phase) -> f64 {
        let [steady, wobble] = self.precession;
        let origin = self.functions.at(self.phase);
        let turned = |phase: &Phase| self.turning.at(&self.functions, phase);
        steady * t + wobble * (turned(phase) - turned(&origin))
    }
}

impl Solution<SO3> for FreeRotation {
    fn at(&self, t: f64) -> Result<State<SO3>, ProblemError> {
        finite("time", &[t])?;
        let phase = self.functions.at(self.phase + self.rate * t);
        let turn = SO3::exp(&Tangent([0.0, 0.0, self.precession(t, &phase)]));
        let g = self.frame.compose(&turn).compose(&self.alignment(&phase));
        let mu = Cotangent(self.momentum(&phase).0);
        checked(State { t, g, mu })
    }
}

/// The axes 1, 2, 3, and $|L^2 - 2 E I_2|$.
fn label(moments: [f64; 3], momentum: Vec3) -> Result<([usize; 3], f64), ProblemError> {
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| moments[i].total_cmp(&moments[j]));
    let middle = moments[order[1]];
    let [small, _, large] = order.map(|i| momentum[i].powi(2) * (moments[i] - middle) / moments[i]);
    let excess = small + large;
    if excess < 0.0 {
        order.reverse();
    }
    let periodic = excess != 0.0 && excess.is_finite();
    periodic
        .then_some((order, excess.abs()))
        .ok_or(ProblemError::NoPeriod)
}

/// The sign of a permutation of the axes.
fn parity([i, j, _]: [usize; 3]) -> f64 {
    if (i + 1) % 3 == j { 1.0 } else { -1.0 }
}

fn unit(axis: usize) -> Vec3 {
    let mut e = Vec3::zero();
    e[axis] = 1.0;
    e
}
