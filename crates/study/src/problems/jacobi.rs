//! Jacobi's elliptic functions and Legendre's integrals of one modulus, over any number of periods.
//!
//! The parameter is $m = k^2$; it is given by its complement $m_1 = 1 - m$, which keeps its digits near a separatrix.
//! Source: [DLMF § 22.20(ii)](https://dlmf.nist.gov/22.20) for the functions, [§ 19.25(i)](https://dlmf.nist.gov/19.25) for the integrals.

use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of the arithmetic–geometric mean; $m_1 = 10^{-300}$ takes 14.
const MAX_STEPS: usize = 20;

/// The functions of the complementary parameter $m_1 \in (0, 1]$.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Jacobi {
    complement: f64,
    mean: f64,
    /// $c_n / a_n$.
    ratios: Vec<f64>,
}

/// An argument $u = 2 K j + r$ with $|r| \le K$, and the functions there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Phase {
    /// $j$.
    pub(super) half_turns: f64,
    /// $\mathrm{am}(r) = \mathrm{am}(u) - \pi j$.
    pub(super) amplitude: f64,
    pub(super) sn: f64,
    pub(super) cn: f64,
    pub(super) dn: f64,
}

impl Jacobi {
    pub(super) fn new(complement: f64) -> Self {
        let (mut a, mut b) = (1.0_f64, complement.sqrt());
        let mut ratios = Vec::new();
        while (a - b).abs() > f64::EPSILON * a && ratios.len() < MAX_STEPS {
            let (mean, half) = ((a + b) / 2.0, (a - b) / 2.0);
            b = (a * b).sqrt();
            a = mean;
            ratios.push(half / mean);
        }
        Self {
            complement,
            mean: a,
            ratios,
        }
    }

    /// The quarter period $K$.
    pub(super) fn quarter(&self) -> f64 {
        FRAC_PI_2 / self.mean
    }

    pub(super) fn at(&self, u: f64) -> Phase {
        let half_turns = (u / (2.0 * self.quarter())).round();
        let amplitude = self.amplitude(u - 2.0 * self.quarter() * half_turns);
        let sign = 1.0 - 2.0 * (half_turns % 2.0).abs();
        let (sin, cos) = amplitude.sin_cos();
        Phase {
            half_turns,
            amplitude,
            sn: sign * sin,
            cn: sign * cos,
            dn: self.delta_squared(sin, cos).sqrt(),
        }
    }

    fn amplitude(&self, u: f64) -> f64 {
        let doublings = self.ratios.iter().fold(1.0, |power, _| 2.0 * power);
        let largest = self.mean * u * doublings;
        let halve = |phi: f64, ratio: &f64| (phi + (ratio * phi.sin()).asin()) / 2.0;
        self.ratios.iter().rev().fold(largest, halve)
    }

    /// $1 - m \sin^2\varphi$.
    fn delta_squared(&self, sin: f64, cos: f64) -> f64 {
        cos * cos + self.complement * sin * sin
    }

    /// $F(\varphi)$, the argument whose amplitude is $\varphi$.
    pub(super) fn first_kind(&self, phi: f64) -> f64 {
        let half_turns = (phi / PI).round();
        let (sin, cos) = (phi - PI * half_turns).sin_cos();
        let integral = ellip::elliprf(cos * cos, self.delta_squared(sin, cos), 1.0);
        2.0 * self.quarter() * half_turns + sin * integral.unwrap_or(f64::NAN)
    }

    /// $\Pi(n; \varphi)$ for $|\varphi| \le \pi/2$, $n < 1$.
    fn third_kind(&self, n: f64, phi: f64) -> f64 {
        let (sin, cos) = phi.sin_cos();
        let (x, y, p) = (cos * cos, self.delta_squared(sin, cos), 1.0 - n * sin * sin);
        let first = ellip::elliprf(x, y, 1.0).unwrap_or(f64::NAN);
        let third = ellip::elliprj(x, y, 1.0, p).unwrap_or(f64::NAN);
        sin * (first + n / 3.0 * sin * sin * third)
    }
}

/// $\int_0^u \frac{dv}{1 - n\ \mathrm{sn}^2 v}$, whole half periods counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ThirdKind {
    n: f64,
    /// The integral over $2 K$.
    pub(super) half_turn: f64,
}

impl ThirdKind {
    pub(super) fn new(functions: &Jacobi, n: f64) -> Self {
        let half_turn = 2.0 * functions.third_kind(n, FRAC_PI_2);
        Self { n, half_turn }
    }

    pub(super) fn at(&self, functions: &Jacobi, phase: &Phase) -> f64 {
        phase.half_turns * self.half_turn + functions.third_kind(self.n, phase.amplitude)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Composite Simpson of `f` over `[0, phi]`.
    fn simpson(phi: f64, f: impl Fn(f64) -> f64) -> f64 {
        let n = 4000;
        let h = phi / f64::from(2 * n);
        let weight = |i: i32| match (i, i % 2) {
            (0, _) => 1.0,
            (i, _) if i == 2 * n => 1.0,
            (_, 1) => 4.0,
            _ => 2.0,
        };
        (0..=2 * n)
            .map(|i| weight(i) * f(h * f64::from(i)))
            .sum::<f64>()
            * h
            / 3.0
    }

    #[test]
    fn the_amplitude_inverts_the_first_integral() {
        for complement in [1.0, 0.7, 0.1, 1e-3] {
            let functions = Jacobi::new(complement);
            for phi in [-9.0, -3.0, -0.4, 0.0, 1e-6, 1.3, 2.0, 7.0] {
                let u = functions.first_kind(phi);
                let direct = simpson(phi, |x| {
                    1.0 / functions.delta_squared(x.sin(), x.cos()).sqrt()
                });
                assert!((u - direct).abs() < 1e-11 * (1.0 + u.abs()), "{u} {direct}");
                let phase = functions.at(u);
                let back = phase.amplitude + PI * phase.half_turns;
                assert!((back - phi).abs() < 1e-13, "{complement} {phi} {back}");
                assert!((phase.sn - phi.sin()).abs() < 1e-13);
                assert!((phase.cn - phi.cos()).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn the_third_integral_agrees_with_quadrature() {
        for complement in [1.0, 0.3, 1e-2] {
            let functions = Jacobi::new(complement);
            for n in [-20.0, -0.5, 0.0, 0.6, 0.97] {
                let third = ThirdKind::new(&functions, n);
                for phi in [-8.0_f64, -1.0, 0.3, 1.5, 5.0] {
                    let phase = functions.at(functions.first_kind(phi));
                    let direct = simpson(phi, |x| {
                        let (sin, cos) = x.sin_cos();
                        let delta = functions.delta_squared(sin, cos).sqrt();
                        1.0 / ((1.0 - n * sin * sin) * delta)
                    });
                    let value = third.at(&functions, &phase);
                    assert!(
                        (value - direct).abs() < 1e-9 * (1.0 + direct.abs()),
                        "{n} {phi} {value} {direct}"
                    );
                }
            }
        }
    }

    #[test]
    fn known_values() {
        // DLMF 22.5.1 with K(1/2) = Gamma(1/4)^2 / (4 sqrt(pi)).
        let functions = Jacobi::new(0.5);
        assert!((functions.quarter() - 1.854_074_677_301_372).abs() < 1e-15);
        let half = functions.at(functions.quarter() / 2.0);
        let sn = 1.0 / (1.0 + 0.5_f64.sqrt()).sqrt();
        assert!((half.sn - sn).abs() < 4e-16);
    }
}
