//! What a run is judged by: the conserved quantities, and how far they stray.
//!
//! ```
//! use articulated_fluid::{Scene, scene};
//! use sim::{Sample, Watch};
//!
//! let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
//! let (model, start) = (scene.model()?, scene.initial_state()?);
//! let sample = Sample::take(&model, &start).ok_or("a number is not finite")?;
//! assert_eq!(Watch::new(&model, sample).energy_relative(), Some(0.0));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

use articulated_fluid::ArticulatedBody;
use lie::Vec3;

use crate::frame::Sample;

/// What the symmetries of a model leave of the momenta to be kept.
#[derive(Clone, Copy, Debug)]
struct Symmetry {
    /// The rate of the linear momentum, N.
    weight: Vec3,
    /// Gravity's direction: the angular momentum is kept about it alone.
    vertical: Option<Vec3>,
}

impl Symmetry {
    fn of(model: &ArticulatedBody) -> Self {
        Self {
            weight: model.net_weight(),
            vertical: model.gravity().map(|g| g * (1.0 / g.norm())),
        }
    }

    /// How far the linear momentum is from where the weight has brought it.
    fn linear(&self, start: &Sample, now: &Sample) -> f64 {
        (now.linear - start.linear - self.weight * (now.t - start.t)).norm()
    }

    /// The change of what is kept of the angular momentum.
    fn angular(&self, start: &Sample, now: &Sample) -> f64 {
        self.kept(now.angular - start.angular)
    }

    fn kept(&self, angular: Vec3) -> f64 {
        match self.vertical {
            Some(vertical) => vertical.dot(angular).abs(),
            None => angular.norm(),
        }
    }
}

/// A momentum is no more than rounding below this part of what the kinetic energy may have.
const ROUNDING: f64 = 1e-12;

/// The worst of the samples so far, against the first.
#[derive(Clone, Copy, Debug)]
pub struct Watch {
    symmetry: Symmetry,
    start: Sample,
    count: u64,
    energy: f64,
    /// kg m², of all bodies about their mass centres.
    inertia: f64,
    /// The largest kinetic energy: unlike a potential, it does not depend on the origin.
    kinetic: f64,
    linear: f64,
    angular: f64,
    orthogonality: f64,
    trend: Trend,
}

impl Watch {
    /// Begins with the sample of a model at t = 0.
    pub fn new(model: &ArticulatedBody, start: Sample) -> Self {
        let mut watch = Self {
            symmetry: Symmetry::of(model),
            start,
            count: 0,
            energy: 0.0,
            inertia: model.bodies().map(|body| body.inertia.trace()).sum(),
            kinetic: 0.0,
            linear: 0.0,
            angular: 0.0,
            orthogonality: 0.0,
            trend: Trend::default(),
        };
        watch.add(&start);
        watch
    }

    /// Takes another sample into account.
    pub fn add(&mut self, sample: &Sample) {
        let [change, linear, angular] = self.departures(sample);
        self.count += 1;
        self.energy = self.energy.max(change.abs());
        self.kinetic = self.kinetic.max(sample.kinetic);
        self.linear = self.linear.max(linear);
        self.angular = self.angular.max(angular);
        self.orthogonality = self.orthogonality.max(sample.orthogonality);
        self.trend.add(sample.t, change);
    }

    /// Takes errors relative to a kinetic energy of at least this, J: one that the motion is known to come to.
    #[must_use]
    pub fn with_kinetic(mut self, kinetic: f64) -> Self {
        self.kinetic = self.kinetic.max(kinetic);
        self
    }

    /// How far a sample is from what the motion keeps since the start. These are the energy's balance, with its sign, J, the linear
    /// momentum, kg m/s, and the angular one, kg m²/s.
    pub fn departures(&self, sample: &Sample) -> [f64; 3] {
        let (symmetry, start) = (&self.symmetry, &self.start);
        [
            sample.balance() - start.balance(),
            symmetry.linear(start, sample),
            symmetry.angular(start, sample),
        ]
    }

    /// The number of samples.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The energy at the start, J.
    pub fn initial_energy(&self) -> f64 {
        self.start.energy
    }

    /// The largest error of the energy, J: of its balance with the work of drives.
    pub fn energy(&self) -> f64 {
        self.energy
    }

    /// The same relative to the largest kinetic energy; `None` where that is zero and the error is not.
    pub fn energy_relative(&self) -> Option<f64> {
        relative(self.energy, self.kinetic)
    }

    /// The slope of the energy's relative error by least squares, 1/s.
    pub fn energy_slope(&self) -> Option<f64> {
        relative(self.trend.slope(), self.kinetic)
    }

    /// The part, 0 to 1, of the energy error's variance that the line of [this slope](Self::energy_slope) explains: near zero where the
    /// error oscillates, near one where it drifts.
    pub fn energy_trend(&self) -> f64 {
        self.trend.explained()
    }

    /// The largest kinetic energy, J.
    pub fn kinetic(&self) -> f64 {
        self.kinetic
    }

    /// Whether gravity acts.
    pub fn has_weight(&self) -> bool {
        self.symmetry.vertical.is_some()
    }

    /// The largest deviation of the linear momentum from its start, and what the weight has added, kg m/s.
    pub fn linear(&self) -> f64 {
        self.linear
    }

    /// The largest deviation of the angular momentum, under gravity about the vertical, kg m²/s.
    pub fn angular(&self) -> f64 {
        self.angular
    }

    /// The same relative to the start; none where that is but rounding of what the kinetic energy may have.
    pub fn angular_relative(&self) -> Option<f64> {
        let start = self.start.angular.norm();
        let rounding = ROUNDING * (2.0 * self.kinetic * self.inertia).sqrt();
        relative(self.angular, start).filter(|_| start > rounding || self.angular == 0.0)
    }

    /// The largest orthogonality error.
    pub fn orthogonality(&self) -> f64 {
        self.orthogonality
    }
}

fn relative(change: f64, start: f64) -> Option<f64> {
    if change == 0.0 {
        return Some(0.0);
    }
    Some(change / start).filter(|ratio| ratio.is_finite())
}

/// A straight line through points, by least squares about their running means.
#[derive(Clone, Copy, Debug, Default)]
struct Trend {
    count: f64,
    mean_t: f64,
    mean_y: f64,
    tt: f64,
    ty: f64,
    yy: f64,
}

impl Trend {
    fn add(&mut self, t: f64, y: f64) {
        self.count += 1.0;
        let (dt, dy) = (t - self.mean_t, y - self.mean_y);
        self.mean_t += dt / self.count;
        self.mean_y += dy / self.count;
        self.tt += dt * (t - self.mean_t);
        self.ty += dt * (y - self.mean_y);
        self.yy += dy * (y - self.mean_y);
    }

    /// The square of the correlation of t and y.
    fn explained(&self) -> f64 {
        let square = self.ty / self.tt * (self.ty / self.yy);
        if square.is_finite() { square } else { 0.0 }
    }

    fn slope(&self) -> f64 {
        if self.tt > 0.0 {
            self.ty / self.tt
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_its_slope() {
        let mut trend = Trend::default();
        assert_eq!((trend.slope(), trend.explained()), (0.0, 0.0));
        for k in 0..1000 {
            let t = 100.0 + 0.1 * f64::from(k);
            trend.add(t, 7.0 - 0.25 * t);
        }
        assert!((trend.slope() + 0.25).abs() < 1e-12);
        assert!((trend.explained() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_line_explains_little_of_an_oscillation() {
        let mut trend = Trend::default();
        for k in 0..1000 {
            let t = 0.1 * f64::from(k);
            trend.add(t, t.sin() + 1e-3 * t);
        }
        assert!(trend.explained() < 0.01);
    }

    #[test]
    fn a_change_from_nothing_has_no_relative_size() {
        assert_eq!(relative(0.0, 0.0), Some(0.0));
        assert_eq!(relative(1e-18, 0.0), None);
        assert_eq!(relative(1.0, 4.0), Some(0.25));
    }
}
