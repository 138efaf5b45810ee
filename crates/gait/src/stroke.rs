//! Closed paths in the space of shapes.

use core::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use articulated_fluid::motion::Law;
use articulated_fluid::{ArticulatedBody, JointKind, Motion};
use lie::Scalar;

use crate::error::GaitError;

/// A shape that repeats itself.
pub trait Stroke {
    /// The period $T$, s.
    fn period(&self) -> f64;

    /// The `k`-th derivatives of the shape at a time, rad and s.
    fn derivative(&self, t: f64, k: u32) -> Vec<f64>;
}

/// The stroke that the joints of a scene are told.
#[derive(Clone, Debug)]
pub struct Told {
    laws: Vec<JointLaw>,
    /// The time that it repeats from.
    from: f64,
    period: f64,
}

#[derive(Clone, Debug)]
enum JointLaw {
    Hinge(Arc<dyn Law<1>>),
    Ball(Arc<dyn Law<3>>),
}

impl Told {
    /// The stroke of a model, from when on it repeats itself.
    ///
    /// # Errors
    /// [`GaitError::NotPeriodic`], and [`GaitError::Still`] where nothing moves.
    pub fn new(model: &ArticulatedBody) -> Result<Self, GaitError> {
        let [from, period] = model.repeats().ok_or(GaitError::NotPeriodic)?;
        if period == 0.0 {
            return Err(GaitError::Still);
        }
        let laws = model.joints().filter_map(|joint| match joint.kind {
            JointKind::Prescribed(Motion::Hinge { angle, .. }) => Some(JointLaw::Hinge(angle)),
            JointKind::Prescribed(Motion::Ball { turn, .. }) => Some(JointLaw::Ball(turn)),
            _ => None,
        });
        Ok(Self {
            laws: laws.collect(),
            from,
            period,
        })
    }

    /// From when on it repeats itself, s.
    pub fn from(&self) -> f64 {
        self.from
    }
}

impl Stroke for Told {
    fn period(&self) -> f64 {
        self.period
    }

    /// From the time on that it repeats from.
    fn derivative(&self, t: f64, k: u32) -> Vec<f64> {
        let t = self.from + t;
        let mut all = Vec::with_capacity(self.laws.len());
        for law in &self.laws {
            match law {
                JointLaw::Hinge(law) => all.extend(law.derivative(t, k)),
                JointLaw::Ball(law) => all.extend(law.derivative(t, k)),
            }
        }
        all
    }
}

/// A stroke by its Fourier coefficients:
/// $q_j = c_j + \sum_{k=1}^K a_{jk} \cos k \omega t + b_{jk} \sin k \omega t$ with $\omega = 2 \pi / T$.
#[derive(Clone, Debug, PartialEq)]
pub struct Fourier {
    period: f64,
    order: usize,
    /// Of each coordinate $c, a_1, b_1, a_2, b_2, \dots$, rad.
    coefficients: Vec<f64>,
}

impl Fourier {
    /// The most harmonics.
    pub const MOST: usize = 32;

    /// The stroke of these coefficients: of each coordinate $c, a_1, b_1, \dots, a_K, b_K$, rad.
    ///
    /// # Errors
    /// [`GaitError::Coefficients`] where they are no multiple of $2 K + 1$, or one is not finite;
    /// [`GaitError::Period`] where the period is not positive; [`GaitError::Order`] above [`MOST`](Self::MOST).
    pub fn new(period: f64, order: usize, coefficients: Vec<f64>) -> Result<Self, GaitError> {
        let finite = coefficients.iter().all(|x| x.is_finite());
        if !(period > 0.0 && period.is_finite()) {
            return Err(GaitError::Period { period });
        }
        check_order(order)?;
        match finite && !coefficients.is_empty() && coefficients.len().is_multiple_of(2 * order + 1)
        {
            true => Ok(Self {
                period,
                order,
                coefficients,
            }),
            false => Err(GaitError::Coefficients {
                found: coefficients.len(),
                order,
            }),
        }
    }

    /// The nearest stroke of order `order` to another one, in the mean of the squares.
    ///
    /// # Errors
    /// [`GaitError::Period`], [`GaitError::Order`], [`GaitError::Coefficients`] where the other is not finite.
    pub fn fit(stroke: &dyn Stroke, order: usize) -> Result<Self, GaitError> {
        const SAMPLES: u32 = 512;
        check_order(order)?;
        let period = stroke.period();
        let basis = |t: f64| waves(order, TAU / period, t, 0);
        let times = (0..SAMPLES).map(|i| period * f64::from(i) / f64::from(SAMPLES));
        let mut coefficients = Vec::new();
        for t in times {
            let (shape, basis) = (stroke.derivative(t, 0), basis(t));
            coefficients.resize(shape.len() * basis.len(), 0.0);
            for (j, q) in shape.iter().enumerate() {
                for (k, phi) in basis.iter().enumerate() {
                    let weight = if k == 0 { 1.0 } else { 2.0 } / f64::from(SAMPLES);
                    coefficients[j * basis.len() + k] += weight * phi * q;
                }
            }
        }
        Self::new(period, order, coefficients)
    }

    /// The largest difference to another stroke, over the largest angle of that.
    pub(crate) fn misses(&self, stroke: &dyn Stroke) -> f64 {
        const SAMPLES: u32 = 97;
        let times = (0..SAMPLES).map(|i| self.period * f64::from(i) / f64::from(SAMPLES));
        let (mut off, mut largest) = (0.0_f64, 0.0_f64);
        for t in times {
            let shapes = self
                .derivative(t, 0)
                .into_iter()
                .zip(stroke.derivative(t, 0));
            for (own, other) in shapes {
                off = off.max((own - other).abs());
                largest = largest.max(other.abs());
            }
        }
        off / largest.max(f64::MIN_POSITIVE)
    }

    /// The same with other coefficients.
    pub(crate) fn with(&self, coefficients: &[f64]) -> Self {
        Self {
            coefficients: coefficients.to_vec(),
            ..self.clone()
        }
    }

    /// $K$.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Of each coordinate $c, a_1, b_1, a_2, b_2, \dots$, rad.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The coefficients of each coordinate.
    pub fn coordinates(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.coefficients.chunks_exact(self.of_one())
    }

    /// How many coefficients a coordinate has.
    pub(crate) fn of_one(&self) -> usize {
        2 * self.order + 1
    }

    /// The `k`-th derivatives of $1, \cos \omega t, \sin \omega t, \cos 2 \omega t, \dots$.
    pub(crate) fn basis<S: Scalar>(&self, t: S, k: u32) -> Vec<S> {
        waves(self.order, TAU / self.period, t, k)
    }
}

fn check_order(order: usize) -> Result<(), GaitError> {
    match order <= Fourier::MOST {
        true => Ok(()),
        false => Err(GaitError::Order {
            order,
            most: Fourier::MOST,
        }),
    }
}

/// The `k`-th derivatives of $1, \cos \omega t, \sin \omega t, \cos 2 \omega t, \dots$.
fn waves<S: Scalar>(order: usize, omega: f64, t: S, k: u32) -> Vec<S> {
    let mut all = vec![S::from_f64(if k == 0 { 1.0 } else { 0.0 })];
    let quarters = S::from_f64(f64::from(k % 4) * FRAC_PI_2);
    for multiple in (1..=order).map(|multiple| multiple as f64 * omega) {
        let (sin, cos) = (t.times(multiple) + quarters).sin_cos();
        let scale = multiple.powi(k as i32);
        all.extend([cos.times(scale), sin.times(scale)]);
    }
    all
}

impl Stroke for Fourier {
    fn period(&self) -> f64 {
        self.period
    }

    fn derivative(&self, t: f64, k: u32) -> Vec<f64> {
        let basis = self.basis(t, k);
        let of = |own: &[f64]| own.iter().zip(&basis).map(|(c, phi)| c * phi).sum();
        self.coordinates().map(of).collect()
    }
}
