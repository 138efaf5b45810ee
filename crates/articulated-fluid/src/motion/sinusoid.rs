//! Sinusoids with a bias, harmonics, and a ramp at the start.

use core::f64::consts::{FRAC_PI_2, TAU};

use super::law::Law;

/// $b + \rho(t) \left(a \sin(2 \pi f t + \varphi) + \sum_k a_k \sin(2 \pi (k + 1) f t + \varphi_k)\right)$, the harmonics from $k = 0$ on.
///
/// The ramp $\rho = 10 s^3 - 15 s^4 + 6 s^5$ with $s = t / T$ leads from rest to the full motion in $T$ seconds, with a continuous acceleration.
///
/// ```
/// use articulated_fluid::motion::{Law, Sinusoid};
///
/// let flap = Sinusoid { amplitude: [0.5], frequency: 2.0, ..Sinusoid::constant([0.1]) };
/// assert!((flap.derivative(0.125, 0)[0] - 0.6).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Sinusoid<const N: usize> {
    /// $b$.
    pub bias: [f64; N],
    /// $a$.
    pub amplitude: [f64; N],
    /// $f$, Hz.
    pub frequency: f64,
    /// $\varphi$, rad.
    pub phase: [f64; N],
    /// $[a_k, \varphi_k]$.
    pub harmonics: Vec<[[f64; N]; 2]>,
    /// $T \ge 0$, s; without a ramp, 0.
    pub ramp: f64,
}

impl<const N: usize> Sinusoid<N> {
    /// The law that stays at `bias`.
    pub fn constant(bias: [f64; N]) -> Self {
        Self {
            bias,
            amplitude: [0.0; N],
            frequency: 0.0,
            phase: [0.0; N],
            harmonics: vec![],
            ramp: 0.0,
        }
    }

    /// The `j`-th derivative of the sum of the waves.
    fn waves(&self, t: f64, j: u32) -> [f64; N] {
        let mut sum = [0.0; N];
        let first = [self.amplitude, self.phase];
        let multiples = core::iter::once(1_u32).chain(1..);
        for (multiple, wave) in multiples.zip(core::iter::once(&first).chain(&self.harmonics)) {
            let omega = TAU * f64::from(multiple) * self.frequency;
            let quarter_turns = FRAC_PI_2 * f64::from(j % 4);
            for (i, sum) in sum.iter_mut().enumerate() {
                let angle = omega * t + wave[1][i] + quarter_turns;
                *sum += wave[0][i] * omega.powi(j as i32) * angle.sin();
            }
        }
        sum
    }

    /// The `j`-th derivative of the ramp.
    fn ramp(&self, t: f64, j: u32) -> f64 {
        if self.ramp <= 0.0 || t >= self.ramp {
            return if j == 0 { 1.0 } else { 0.0 };
        }
        if t <= 0.0 {
            return 0.0;
        }
        let s = t / self.ramp;
        let value = match j {
            0 => s.powi(3) * (10.0 + s * (6.0 * s - 15.0)),
            1 => 30.0 * (s * (1.0 - s)).powi(2),
            2 => 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s),
            3 => 60.0 * (1.0 - 6.0 * s * (1.0 - s)),
            4 => 360.0 * (2.0 * s - 1.0),
            5 => 720.0,
            _ => 0.0,
        };
        value / self.ramp.powi(j as i32)
    }
}

impl<const N: usize> Law<N> for Sinusoid<N> {
    fn is_constant(&self) -> bool {
        let zero = |wave: &[f64; N]| *wave == [0.0; N];
        let silent = zero(&self.amplitude) && self.harmonics.iter().all(|[a, _]| zero(a));
        silent || self.frequency == 0.0 && self.ramp == 0.0
    }

    fn repeats(&self) -> Option<[f64; 2]> {
        let still = self.is_constant() || self.frequency == 0.0;
        Some([
            self.ramp,
            if still {
                0.0
            } else {
                1.0 / self.frequency.abs()
            },
        ])
    }

    /// By the rule of Leibniz.
    fn derivative(&self, t: f64, k: u32) -> [f64; N] {
        let mut sum = if k == 0 { self.bias } else { [0.0; N] };
        let mut binomial = 1.0;
        for j in 0..=k {
            let ramp = binomial * self.ramp(t, j);
            if ramp != 0.0 {
                let waves = self.waves(t, k - j);
                (0..N).for_each(|i| sum[i] += ramp * waves[i]);
            }
            binomial *= f64::from(k - j) / f64::from(j + 1);
        }
        sum
    }
}
