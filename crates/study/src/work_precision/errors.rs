//! How far a run is off, at its worst.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::State;
use lie::SO3;
use serde::Serialize;
use sim::{Sample, Watch};

use crate::contender::Failure;

/// The largest errors over a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Errors {
    /// The largest angle between a body's attitude and the reference's, rad.
    #[serde(rename = "attitude_error_radians")]
    pub attitude: f64,
    /// The largest distance of a mass centre from the reference's, m.
    #[serde(rename = "position_error_metres")]
    pub position: f64,
    /// Of the energy, relative to the largest kinetic one; `None` where that is zero, or where what moves as told does work.
    #[serde(rename = "energy_error_relative")]
    pub energy: Option<f64>,
    /// The slope of that error by least squares, 1/s.
    #[serde(rename = "energy_slope_per_second")]
    pub energy_slope: Option<f64>,
    /// Of the linear momentum, less what the weight adds, kg m/s.
    #[serde(rename = "linear_momentum_deviation")]
    pub linear_momentum: f64,
    /// Of the angular momentum, under gravity about the vertical, kg m²/s.
    #[serde(rename = "angular_momentum_deviation")]
    pub angular_momentum: f64,
    /// The largest $\lVert I - R^T R \rVert_F$.
    #[serde(rename = "orthogonality_error")]
    pub orthogonality: f64,
}

impl Errors {
    /// The errors of a run against another one at the same times.
    ///
    /// # Errors
    /// [`Failure::NotFinite`] at the first state whose errors are not numbers.
    pub fn new(
        model: &ArticulatedBody,
        states: &[State<Configuration>],
        reference: &[State<Configuration>],
    ) -> Result<Self, Failure> {
        debug_assert_eq!(states.len(), reference.len(), "at the same times");
        let mut watch: Option<Watch> = None;
        let (mut attitude, mut position) = (0.0, 0.0);
        for (state, exact) in states.iter().zip(reference) {
            let failure = Failure::NotFinite { t: state.t };
            let sample = Sample::take(model, state).ok_or(failure.clone())?;
            watch
                .get_or_insert_with(|| Watch::new(model, sample))
                .add(&sample);
            let apart = distance(model, state, exact).ok_or(failure)?;
            attitude = apart.0.max(attitude);
            position = apart.1.max(position);
        }
        let watch = watch.ok_or(Failure::NotFinite { t: 0.0 })?;
        Ok(Self {
            attitude,
            position,
            energy: watch.energy_relative().filter(|_| model.keeps_energy()),
            energy_slope: watch.energy_slope().filter(|_| model.keeps_energy()),
            linear_momentum: watch.linear(),
            angular_momentum: watch.angular(),
            orthogonality: watch.orthogonality(),
        })
    }
}

/// The largest angle, rad, and the largest distance, m, between bodies of two configurations; `None` where one is not a number.
pub(super) fn distance(
    model: &ArticulatedBody,
    a: &State<Configuration>,
    b: &State<Configuration>,
) -> Option<(f64, f64)> {
    let attitudes = |s: &State<Configuration>| model.attitudes(s.t, &s.g).ok();
    let angles = attitudes(a)?.into_iter().zip(attitudes(b)?);
    let angles = angles.map(|(a, b)| angle(&a, &b));
    let centres = |s: &State<Configuration>| model.centre_positions(s.t, &s.g).ok();
    let gaps = centres(a)?.into_iter().zip(centres(b)?);
    let gaps = gaps.map(|(a, b)| (a - b).norm());
    Some((largest(angles)?, largest(gaps)?))
}

fn largest(mut values: impl Iterator<Item = f64>) -> Option<f64> {
    values.try_fold(0.0, |a: f64, b| b.is_finite().then(|| a.max(b)))
}

/// The angle from one attitude to another, by $\lVert R_a - R_b \rVert_F = 2 \sqrt 2 \sin(\theta / 2)$; it has a value for matrices that
/// have left the group too, at most $\pi$.
fn angle(a: &SO3, b: &SO3) -> f64 {
    let chord = (*a.matrix() - *b.matrix()).frobenius();
    // `min` would make a number of NaN.
    let sine = chord / 8.0_f64.sqrt();
    2.0 * if sine > 1.0 { 1.0 } else { sine }.asin()
}

/// The largest angle, rad, between bodies of two states; infinite where one is not a number.
pub(crate) fn apart(
    model: &ArticulatedBody,
    a: &State<Configuration>,
    b: &State<Configuration>,
) -> f64 {
    distance(model, a, b).map_or(f64::INFINITY, |(angle, _)| angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lie::{LieGroup, Mat3, Tangent};

    #[test]
    fn an_angle_is_the_geodesic_one() {
        let a = SO3::exp(&Tangent([0.3, -1.0, 0.4]));
        for theta in [1e-12, 1e-3, 1.0, 3.0] {
            let b = a.compose(&SO3::exp(&Tangent([0.0, theta, 0.0])));
            assert!((angle(&a, &b) - theta).abs() < 1e-14 + 1e-3 * theta * theta * 1e-9);
        }
        let lost = SO3::from_matrix_unchecked(Mat3::diagonal([9.0; 3]));
        assert_eq!(angle(&a, &lost), core::f64::consts::PI);
        let nowhere = SO3::from_matrix_unchecked(Mat3::diagonal([f64::NAN; 3]));
        assert!(angle(&a, &nowhere).is_nan());
    }
}
