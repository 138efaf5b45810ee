//! Lagrange's top on $SO(3)$.

use dvi::{Context, Lagrangian, State, System};
use lie::{Cotangent, LieGroup, SO3, Scalar, Tangent, Vec3};

use super::jacobi::{Jacobi, Phase, ThirdKind};
use super::{Problem, ProblemError, Solution, checked, finite, left, positive, right};

/// Closer to the vertical, as $1 - |\cos\theta|$, the azimuth has lost half its digits.
const VERTICAL: f64 = 1e-10;

/// A symmetric top with a fixed point, $L = \frac12 (A \Omega_1^2 + A \Omega_2^2 + C \Omega_3^2) - W (R e_3) \cdot e_3$.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeavyTop {
    transverse: f64,
    axial: f64,
    weight: f64,
}

impl System for HeavyTop {
    type Group = SO3;
}

impl Lagrangian for HeavyTop {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let [a, c, w] = [self.transverse, self.axial, self.weight].map(S::from_f64);
        let [p, q, s] = omega.0;
        (a * (p * p + q * q) + c * s * s) * S::from_f64(0.5) - w * r.matrix()[(2, 2)]
    }
}

impl HeavyTop {
    /// The top with moments of inertia `transverse`, $A$, and `axial`, $C$, about the fixed point, kg m², and `weight`
    /// $W = m g l$ (N m). That is the weight times the distance of the mass centre, which lies on the axis of symmetry $e_3$ of the body.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`].
    pub fn new(transverse: f64, axial: f64, weight: f64) -> Result<Self, ProblemError> {
        Ok(Self {
            transverse: positive("transverse moment of inertia", transverse)?,
            axial: positive("axial moment of inertia", axial)?,
            weight: positive("moment of the weight", weight)?,
        })
    }

    /// The motion from `attitude` with the angular velocity `omega`, rad/s, in the body's frame, at time zero.
    ///
    /// # Errors
    /// [`ProblemError::Vertical`] where the axis passes through the vertical; [`ProblemError::NoPeriod`] on the separatrix.
    pub fn problem(
        self,
        attitude: SO3,
        omega: [f64; 3],
    ) -> Result<Problem<Self, Nutation>, ProblemError> {
        finite("angular velocity", &omega)?;
        let start = checked(self.state(0.0, attitude, &Tangent(omega))?)?;
        let exact = Nutation::new(self, &start, omega)?;
        let axis = Tangent([0.0, 0.0, 1.0]);
        Ok(Problem {
            name: "Lagrange's top",
            lagrangian: self,
            start,
            time: exact.period(),
            exact,
            symmetries: vec![
                left("angular momentum about the vertical", axis),
                right("angular momentum about the axis", axis),
            ],
        })
    }
}

/// The motion of Lagrange's top, by Jacobi's elliptic functions.
///
/// With $u = \cos\theta$ the height of the axis, $p_\psi = \mu_3$ and $p_\varphi = (R \mu) \cdot e_3$,
/// $\dot u^2 = \frac{2 W}A (u - u_1)(u_2 - u)(u_3 - u)$, so that
/// $$
/// u = u_1 + (u_2 - u_1)\ \mathrm{sn}^2(\kappa t + v_0, m), \qquad \kappa^2 = \frac{W (u_3 - u_1)}{2 A}, \qquad
/// 1 - m = \frac{u_3 - u_2}{u_3 - u_1},
/// $$
/// and the angles in $R = R_z(\varphi) R_y(\theta) R_z(\psi)$ are sums of two integrals of the third kind,
/// $$
/// \dot\varphi = P_- + P_+, \quad \dot\psi = p_\psi \left(\frac1C - \frac1A\right) + P_+ - P_-, \quad
/// P_\mp = \frac{p_\varphi \mp p_\psi}{2 A (1 \mp u)},
/// $$
/// with $1 \mp u = (1 \mp u_1)(1 - n_\mp \mathrm{sn}^2)$, $n_\mp = \pm (u_2 - u_1) / (1 \mp u_1)$. Whole periods are counted.
///
/// Source: E. T. Whittaker, *Analytical Dynamics*, 4th ed. (1937), § 71; roots relative to the start, so that they keep
/// their digits also near steady precession.
#[derive(Clone, Debug, PartialEq)]
pub struct Nutation {
    top: HeavyTop,
    /// $u_1$ and $u_2 - u_1$.
    range: [f64; 2],
    functions: Jacobi,
    /// $\kappa$.
    rate: f64,
    /// $v_0$.
    phase: f64,
    /// $p_\varphi$, $p_\psi$.
    momenta: [f64; 2],
    /// $P_-$ and $P_+$ as factors of their integrals.
    terms: [(f64, ThirdKind); 2],
    /// $\varphi$, $\psi$ at time zero.
    angles: [f64; 2],
}

impl Nutation {
    fn new(top: HeavyTop, start: &State<SO3>, omega: [f64; 3]) -> Result<Self, ProblemError> {
        let (a, m) = (top.transverse, *start.g.matrix());
        let (height, vertical) = (m[(2, 2)], m.row(2));
        let spin = start.mu[2];
        let speed = omega[1] * vertical[0] - omega[0] * vertical[1];
        let [lowest, highest, outer] = turning_points(top, vertical, omega, spin, speed);
        let range = [height + lowest, highest - lowest];
        above_and_below(range)?;
        let complement = (outer - highest) / (outer - lowest);
        if !(complement > 0.0 && complement <= 1.0) {
            return Err(ProblemError::NoPeriod);
        }
        let functions = Jacobi::new(complement);
        let rate = (top.weight * (outer - lowest) / (2.0 * a)).sqrt();
        let amplitude = (-lowest).max(0.0).sqrt().atan2(highest.max(0.0).sqrt());
        let momentum = vertical.dot(start.mu.vec3());
        let term = |sign: f64| {
            let distance = 1.0 - sign * range[0];
            let third = ThirdKind::new(&functions, sign * range[1] / distance);
            (
                (momentum - sign * spin) / (2.0 * a * distance * rate),
                third,
            )
        };
        Ok(Self {
            top,
            range,
            rate,
            phase: functions.first_kind(amplitude.copysign(speed)),
            momenta: [momentum, spin],
            terms: [term(1.0), term(-1.0)],
            angles: [m[(1, 2)].atan2(m[(0, 2)]), vertical[1].atan2(-vertical[0])],
            functions,
        })
    }

    /// The period of the nutation $\theta(t)$, s.
    pub fn period(&self) -> f64 {
        2.0 * self.functions.quarter() / self.rate
    }

    /// The least and the greatest height $\cos\theta$ of the axis.
    pub fn heights(&self) -> [f64; 2] {
        let [lowest, width] = self.range;
        [lowest, lowest + width]
    }

    /// The mean rate of $\varphi$, rad/s.
    pub fn mean_precession_rate(&self) -> f64 {
        let turns = self
            .terms
            .iter()
            .map(|(factor, third)| factor * third.half_turn);
        turns.sum::<f64>() / self.period()
    }

    /// $\varphi$ and $\psi$ at time `t`.
    fn angles(&self, t: f64, phase: &Phase) -> [f64; 2] {
        let origin = self.functions.at(self.phase);
        let [minus, plus] = self.terms.map(|(factor, third)| {
            let integral = |phase: &Phase| third.at(&self.functions, phase);
            factor * (integral(phase) - integral(&origin))
        });
        let [precession, spin] = self.angles;
        let steady = self.momenta[1] * (1.0 / self.top.axial - 1.0 / self.top.transverse);
        [precession + minus + plus, spin + steady * t + plus - minus]
    }
}

impl Solution<SO3> for Nutation {
    fn at(&self, t: f64) -> Result<State<SO3>, ProblemError> {
        finite("time", &[t])?;
        let phase = self.functions.at(self.phase + self.rate * t);
        let [precession, spin] = self.angles(t, &phase);
        let ([lowest, width], [vertical, axial]) = (self.range, self.momenta);
        let height = lowest + width * phase.sn * phase.sn;
        let sine = ((1.0 - height) * (1.0 + height)).sqrt();
        let climb = 2.0 * self.rate * width * phase.sn * phase.cn * phase.dn;
        let turn = |angle: f64| SO3::exp(&Tangent([0.0, 0.0, angle]));
        let tilt = SO3::exp(&Tangent([0.0, sine.atan2(height), 0.0]));
        let g = turn(precession).compose(&tilt).compose(&turn(spin));
        let before_spin = Vec3([
            -(vertical - axial * height) / sine,
            -self.top.transverse * climb / sine,
            axial,
        ]);
        let mu = Cotangent::from(turn(spin).inverse_rotate(before_spin));
        checked(State { t, g, mu })
    }
}

/// The roots of $\dot u^2$ as a cubic in $u - u_0$, the inner two first.
fn turning_points(
    top: HeavyTop,
    vertical: Vec3,
    omega: [f64; 3],
    spin: f64,
    speed: f64,
) -> [f64; 3] {
    let (a, w, height) = (top.transverse, top.weight, vertical[2]);
    let [x, y, _] = omega;
    let (square, along) = (x * x + y * y, x * vertical[0] + y * vertical[1]);
    let sine_squared = vertical[0].powi(2) + vertical[1].powi(2);
    let cubic = 2.0 * w / a;
    let quadratic = -square + 2.0 * cubic * height - (spin / a).powi(2);
    let linear = -2.0 * height * square - cubic * sine_squared + 2.0 * spin * along / a;
    let [c, b, d] = [quadratic, linear, speed * speed].map(|x| x / cubic);
    let outer = largest_root([c, b, d]);
    // What is left is e^2 + sum e + product: both from the low end, where the digits are.
    let product = -d / outer;
    let sum = (product - b) / outer;
    let root = (sum * sum / 4.0 - product).max(0.0).sqrt();
    let far = -sum / 2.0 - root.copysign(sum);
    let near = if far == 0.0 { 0.0 } else { product / far };
    [far.min(near).min(0.0), far.max(near).max(0.0), outer]
}

/// The largest root of $x^3 + c x^2 + b x + d$ with three real ones, by Newton's method from above.
fn largest_root([c, b, d]: [f64; 3]) -> f64 {
    const MAX_ITERATIONS: usize = 200;
    let bound = c.abs().max(b.abs().sqrt()).max(d.abs().cbrt());
    let mut x = 2.0 * bound;
    for _ in 0..MAX_ITERATIONS {
        let value = ((x + c) * x + b) * x + d;
        let next = x - value / ((3.0 * x + 2.0 * c) * x + b);
        // From above the sequence falls, until rounding stops it.
        if next >= x || next.is_nan() {
            break;
        }
        x = next;
    }
    x
}

fn above_and_below([lowest, width]: [f64; 2]) -> Result<(), ProblemError> {
    let distance = (1.0 - lowest - width).min(1.0 + lowest);
    let tilted = distance > VERTICAL;
    tilted
        .then_some(())
        .ok_or(ProblemError::Vertical { distance })
}
