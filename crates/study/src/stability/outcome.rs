//! What a run came to.

use core::fmt;

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{Cause, State, StepError};
use serde::{Serialize, Serializer};
use sim::{Sample, Watch};

use crate::contender::Failure;

/// The energy may stray by this part of the largest kinetic energy so far, that of the motion's first half radian included; a run that
/// strays further ends there.
pub const ENERGY_BAND: f64 = 0.1;
/// The line through the energy's error may move by this part of the largest kinetic energy over the run …
pub const ENERGY_DRIFT: f64 = 0.01;
/// … where it explains at least this part of the error's variance; it explains hardly anything of an oscillation.
pub const ENERGY_TREND: f64 = 0.5;
/// A momentum may stray by this part of the one that the largest kinetic energy would have in a single translation, or a single turn.
/// Rounding adds 2e-12 in a quarter of a million steps of `lgvi`.
pub const MOMENTUM: f64 = 1e-6;
/// The largest $\lVert I - R^T R \rVert_F$ of an attitude that is on the group.
pub const GROUP: f64 = 1e-6;
/// The largest angle, rad, between an attitude and the reference's at the end of a [window](super#silently-wrong): as large
/// as the motion itself.
pub const WRONG: f64 = 1.0;

/// What a run came to; of several that hold, the first of this list.
///
/// The first three end a run when they happen; the others are judged at its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Class {
    /// A number of the state, of a momentum or of the energy was not finite.
    NonFinite,
    /// The method refused a step with a typed error.
    Refused,
    /// The energy strayed by more than [`ENERGY_BAND`].
    EnergyBand,
    /// The energy drifted by more than [`ENERGY_DRIFT`], and not by chance.
    EnergyDrift,
    /// An attitude is no rotation, by more than [`GROUP`].
    GroupLeft,
    /// A momentum strayed by more than [`MOMENTUM`].
    MomentumLost,
    /// Every kept quantity is as it should be, and attitudes were off by more than [`WRONG`] all the same.
    SilentlyWrong,
    /// None of these.
    Good,
    /// Not judged: the time was over before its turn or its end, or there was no reference to compare with.
    NotRun,
}

impl Class {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Good,
        Self::EnergyBand,
        Self::EnergyDrift,
        Self::MomentumLost,
        Self::GroupLeft,
        Self::Refused,
        Self::NonFinite,
        Self::SilentlyWrong,
        Self::NotRun,
    ];

    /// For tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::EnergyBand => "energy-band",
            Self::EnergyDrift => "energy-drift",
            Self::MomentumLost => "momentum-lost",
            Self::GroupLeft => "group-left",
            Self::Refused => "refused",
            Self::NonFinite => "non-finite",
            Self::SilentlyWrong => "silently-wrong",
            Self::NotRun => "not-run",
        }
    }

    /// For legends.
    pub fn description(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::EnergyBand => "energy off by 10 %",
            Self::EnergyDrift => "energy drifts",
            Self::MomentumLost => "momentum lost",
            Self::GroupLeft => "group left",
            Self::Refused => "step refused",
            Self::NonFinite => "not finite",
            Self::SilentlyWrong => "silently wrong",
            Self::NotRun => "not run",
        }
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The class of a run, and what it was judged by.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Outcome {
    /// What it came to.
    pub class: Class,
    /// How far the run came, s.
    #[serde(rename = "time_seconds")]
    pub t: f64,
    /// The largest error of the energy, relative to the largest kinetic energy; none where what moves as told does work.
    #[serde(rename = "energy_error_relative")]
    pub energy: Option<f64>,
    /// By how much the line through that error moved, over the time that was run.
    #[serde(rename = "energy_drift_relative")]
    pub drift: Option<f64>,
    /// The part of that error's variance that the line explains.
    #[serde(rename = "energy_trend")]
    pub trend: f64,
    /// The largest error of a momentum, relative as [`MOMENTUM`] says; none where the first body hangs on the world.
    #[serde(rename = "momentum_error_relative")]
    pub momentum: Option<f64>,
    /// The largest orthogonality error.
    #[serde(rename = "orthogonality_error")]
    pub orthogonality: f64,
    /// The largest angle from the reference, rad; none where the run ended before the first comparison.
    #[serde(rename = "attitude_error_radians")]
    pub attitude: Option<f64>,
    /// Why a step was not taken.
    #[serde(serialize_with = "told")]
    pub failure: Option<Failure>,
    /// The state from which a step was refused.
    #[serde(skip)]
    pub refused_at: Option<State<Configuration>>,
    /// Whether the time was over before the run was.
    #[serde(skip)]
    pub(super) is_cut_off: bool,
}

fn told<S: Serializer>(failure: &Option<Failure>, serializer: S) -> Result<S::Ok, S::Error> {
    failure
        .as_ref()
        .map(Failure::to_string)
        .serialize(serializer)
}

impl Outcome {
    /// Whether its time was over before its turn or its end.
    pub fn had_no_time(&self) -> bool {
        self.class == Class::NotRun && self.is_cut_off
    }

    /// A run that was not begun.
    pub(super) const NOT_RUN: Self = Self {
        class: Class::NotRun,
        t: 0.0,
        energy: None,
        drift: None,
        trend: 0.0,
        momentum: None,
        orthogonality: 0.0,
        attitude: None,
        failure: None,
        refused_at: None,
        is_cut_off: true,
    };

    /// A start whose energy or momentum is not finite.
    pub(super) fn not_finite(t: f64) -> Self {
        Self {
            class: Class::NonFinite,
            failure: Some(Failure::NotFinite { t }),
            is_cut_off: false,
            ..Self::NOT_RUN
        }
    }
}

/// How a run has ended.
pub(super) enum End {
    Reached,
    /// A step was not taken from the state.
    Stopped(StepError, Box<State<Configuration>>),
    /// A number was not finite at this time.
    NotFinite(f64),
    /// The energy is out of its band.
    OffBand,
    /// The time is over.
    OutOfTime,
}

/// What of a run is judged by.
pub(super) struct Judge {
    watch: Watch,
    /// Whether the motion keeps them.
    keeps_energy: bool,
    keeps_momentum: bool,
    /// kg, kg m²: of all bodies, the mean over the directions.
    mass: f64,
    inertia: f64,
    /// The largest angle from the reference so far, rad.
    attitude: Option<f64>,
    t: f64,
}

impl Judge {
    /// Judges a run from `start`, whose motion is known to come to this kinetic energy, J.
    pub(super) fn new(model: &ArticulatedBody, start: Sample, kinetic: f64) -> Self {
        let bodies = || model.bodies();
        Self {
            watch: Watch::new(model, start).with_kinetic(kinetic),
            keeps_energy: model.keeps_energy(),
            keeps_momentum: model.keeps_momentum(),
            mass: bodies().map(|body| body.mass.trace() / 3.0).sum(),
            inertia: bodies().map(|body| body.inertia.trace() / 3.0).sum(),
            attitude: None,
            t: start.t,
        }
    }

    /// Takes a sample into account; false where the run can end here.
    pub(super) fn add(&mut self, sample: &Sample) -> bool {
        self.watch.add(sample);
        self.t = sample.t;
        !self.is_off_band()
    }

    fn is_off_band(&self) -> bool {
        // Without a kinetic energy there is nothing to compare with, and any error is out of the band.
        let is_off = || self.watch.energy_relative().is_none_or(|e| e > ENERGY_BAND);
        self.keeps_energy && is_off()
    }

    /// Takes an angle from the reference into account, rad.
    pub(super) fn compare(&mut self, angle: f64) {
        self.attitude = Some(self.attitude.unwrap_or(0.0).max(angle));
    }

    /// The larger of the two momenta's errors, in parts of those of the largest kinetic energy.
    fn momentum(&self) -> Option<f64> {
        let of = |error: f64, inertia: f64| match error == 0.0 {
            true => Some(0.0),
            false => {
                let ratio = error / (2.0 * self.watch.kinetic() * inertia).sqrt();
                ratio.is_finite().then_some(ratio)
            }
        };
        let linear = of(self.watch.linear(), self.mass)?;
        Some(linear.max(of(self.watch.angular(), self.inertia)?))
    }

    fn drift(&self) -> Option<f64> {
        self.watch
            .energy_slope()
            .map(|slope| (slope * self.t).abs())
    }

    fn class_at_end(&self) -> Class {
        let moved = || self.drift().is_none_or(|drift| drift > ENERGY_DRIFT);
        let drifts = self.keeps_energy && moved();
        let strayed = || self.momentum().is_none_or(|error| error > MOMENTUM);
        if self.is_off_band() {
            Class::EnergyBand
        } else if drifts && self.watch.energy_trend() >= ENERGY_TREND {
            Class::EnergyDrift
        } else if self.watch.orthogonality() > GROUP {
            Class::GroupLeft
        } else if self.keeps_momentum && strayed() {
            Class::MomentumLost
        } else {
            match self.attitude {
                // What was never compared is not good.
                None => Class::NotRun,
                Some(angle) if angle > WRONG => Class::SilentlyWrong,
                Some(_) => Class::Good,
            }
        }
    }

    pub(super) fn judge(&self, end: End) -> Outcome {
        let is_cut_off = matches!(end, End::OutOfTime);
        let (class, failure, refused_at) = match end {
            End::Reached | End::OffBand => (self.class_at_end(), None, None),
            End::Stopped(error, _) if error.cause == Cause::NotFinite => {
                (Class::NonFinite, Some(error.into()), None)
            }
            End::Stopped(error, state) => (Class::Refused, Some(error.into()), Some(*state)),
            End::NotFinite(t) => (Class::NonFinite, Some(Failure::NotFinite { t }), None),
            End::OutOfTime => (Class::NotRun, None, None),
        };
        Outcome {
            class,
            t: refused_at.as_ref().map_or(self.t, |state| state.t),
            energy: self.watch.energy_relative().filter(|_| self.keeps_energy),
            drift: self.drift().filter(|_| self.keeps_energy),
            trend: self.watch.energy_trend(),
            momentum: self.momentum().filter(|_| self.keeps_momentum),
            orthogonality: self.watch.orthogonality(),
            attitude: self.attitude,
            failure,
            refused_at,
            is_cut_off,
        }
    }
}

#[cfg(test)]
mod tests {
    use articulated_fluid::{Scene, scene};
    use lie::Vec3;

    use super::*;

    /// Samples over a run of 1000 s, the energy's error and the other quantities as functions of the time in parts of the run.
    fn judged(change: impl Fn(f64, &mut Sample)) -> Outcome {
        let scene = Scene::parse(scene::EXAMPLE, "example.toml").unwrap();
        let model = scene.model().unwrap();
        let start = Sample::take(&model, &scene.initial_state().unwrap()).unwrap();
        let mut judge = Judge::new(&model, start, 0.0);
        judge.compare(0.1);
        for k in 1..=1000 {
            let part = f64::from(k) / 1000.0;
            let mut sample = start;
            sample.t = 1000.0 * part;
            change(part, &mut sample);
            if !judge.add(&sample) {
                return judge.judge(End::OffBand);
            }
        }
        judge.judge(End::Reached)
    }

    #[test]
    fn an_oscillation_within_the_band_is_good_and_beyond_it_ends_the_run() {
        let wave = |size: f64| {
            move |part: f64, sample: &mut Sample| {
                sample.energy += size * sample.kinetic * (1000.0 * part).sin();
            }
        };
        assert_eq!(judged(wave(0.09)).class, Class::Good);
        let off = judged(wave(0.12));
        assert_eq!(off.class, Class::EnergyBand);
        assert!(off.t < 10.0, "{off:?}");
    }

    #[test]
    fn a_drift_is_one_that_moves_far_enough_and_is_no_oscillation() {
        let drift = |by: f64, wave: f64| {
            move |part: f64, sample: &mut Sample| {
                let error = by * part + wave * (1000.0 * part).sin();
                sample.energy += error * sample.kinetic;
            }
        };
        let drifts = judged(drift(-0.02, 0.0));
        assert_eq!(drifts.class, Class::EnergyDrift);
        assert!((drifts.drift.unwrap() - 0.02).abs() < 1e-6 && drifts.trend > 0.99);
        assert_eq!(judged(drift(0.005, 0.0)).class, Class::Good);
        assert_eq!(judged(drift(0.02, 0.05)).class, Class::Good);
    }

    #[test]
    fn the_group_comes_before_the_momenta_and_the_energy_before_both() {
        let group = |_: f64, sample: &mut Sample| sample.orthogonality = 2.0 * GROUP;
        let momentum = |part: f64, sample: &mut Sample| {
            sample.angular += Vec3([0.0, 0.0, 1e-3 * part]);
        };
        assert_eq!(judged(group).class, Class::GroupLeft);
        let lost = judged(momentum);
        assert_eq!(lost.class, Class::MomentumLost);
        assert!(lost.momentum.is_some_and(|error| error > MOMENTUM));
        let both = |part: f64, sample: &mut Sample| {
            group(part, sample);
            momentum(part, sample);
        };
        assert_eq!(judged(both).class, Class::GroupLeft);
        let all = |part: f64, sample: &mut Sample| {
            both(part, sample);
            sample.energy += 0.05 * part * sample.kinetic;
        };
        assert_eq!(judged(all).class, Class::EnergyDrift);
    }

    #[test]
    fn what_is_kept_and_wrong_is_wrong_and_what_was_not_compared_is_not_good() {
        let scene = Scene::parse(scene::EXAMPLE, "example.toml").unwrap();
        let model = scene.model().unwrap();
        let start = Sample::take(&model, &scene.initial_state().unwrap()).unwrap();
        let mut judge = Judge::new(&model, start, 0.0);
        assert_eq!(judge.judge(End::Reached).class, Class::NotRun);
        judge.compare(0.9 * WRONG);
        assert_eq!(judge.judge(End::Reached).class, Class::Good);
        judge.compare(1.1 * WRONG);
        judge.compare(0.1);
        assert_eq!(judge.judge(End::Reached).class, Class::SilentlyWrong);
        assert_eq!(judge.judge(End::NotFinite(3.0)).class, Class::NonFinite);
        assert_eq!(judge.judge(End::OutOfTime).class, Class::NotRun);
    }
}
