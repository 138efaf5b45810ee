//! What is run, with what setting, and at what price.

use core::fmt;
use std::time::Duration;

use articulated_fluid::{ArticulatedBody, Configuration, ModelError, Scene};
use dvi::State;
use serde::{Serialize, Serializer};

use super::Control;

/// A model, where it starts and how long it runs: the same for every contender.
///
/// Of a scene it is the [smallest](articulated_fluid::Smallest) model in space: on the heaviest body, and in a frame that moves with
/// the mass centre where that is exact. Attitudes and their errors are the scene's own; places are relative to that frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// The model in space.
    pub model: ArticulatedBody,
    /// At $t = 0$.
    pub start: State<Configuration>,
    /// s.
    pub until: f64,
}

/// How a contender is asked to run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// In so many equal steps.
    Steps(u64),
    /// To this relative and absolute tolerance.
    Tolerance(f64),
    /// To this error over the run, rad and m.
    Accuracy(f64),
}

impl Setting {
    /// What it controls.
    pub fn control(self) -> Control {
        match self {
            Self::Steps(_) => Control::Step,
            Self::Tolerance(_) => Control::Tolerance,
            Self::Accuracy(_) => Control::Accuracy,
        }
    }

    /// The step, s, the tolerance or the accuracy.
    pub fn value(self, until: f64) -> f64 {
        match self {
            Self::Steps(steps) => until / steps as f64,
            Self::Tolerance(error) | Self::Accuracy(error) => error,
        }
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Steps(steps) => write!(f, "{steps} steps"),
            Self::Tolerance(tolerance) => write!(f, "a tolerance of {tolerance:e}"),
            Self::Accuracy(accuracy) => write!(f, "an accuracy of {accuracy:e}"),
        }
    }
}

/// What a run cost; counts do not depend on the machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Cost {
    /// Of stepping alone.
    #[serde(rename = "seconds", serialize_with = "seconds")]
    pub time: Duration,
    /// Steps taken, of an adaptive method those accepted.
    pub steps: u64,
    /// Evaluations of the continuous model's velocity and force, or of the discrete Lagrangian's derivatives, those of Newton's matrices
    /// included; see [`dvi::StepReport::evaluations`].
    pub evaluations: u64,
    /// Of the solver; none of an explicit method.
    pub iterations: u64,
}

fn seconds<S: Serializer>(time: &Duration, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(time.as_secs_f64())
}

impl Problem {
    /// The problem of a scene.
    ///
    /// # Errors
    /// As [`Scene::initial_state`].
    pub fn of(scene: &Scene, until: f64) -> Result<Self, ModelError> {
        let smallest = scene.smallest()?;
        let (model, start) = (smallest.model, smallest.start);
        Ok(Self {
            model,
            start,
            until,
        })
    }

    /// The times $k T / n$, $k = 0, \dots, n$, with $T$ the end and $n$ = `samples`.
    pub fn times(&self, samples: u64) -> Vec<f64> {
        let n = samples.max(1);
        (0..=samples).map(|k| self.time(k, n)).collect()
    }

    /// The time $k T / n$; of $k = n$ the end itself.
    pub(super) fn time(&self, k: u64, n: u64) -> f64 {
        if k == n {
            return self.until;
        }
        self.until * k as f64 / n as f64
    }
}
