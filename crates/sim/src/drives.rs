//! The account of what drives do, from step to step.

use articulated_fluid::{ArticulatedBody, Configuration, Drive, DriveKind, Evaluation};
use dvi::{State, StepError};
use serde::Serialize;

use crate::frame::DriveSample;
use crate::method::BoxedIntegrator;
use crate::run::Run;
use crate::schedule::Due;

/// What a drive or a load has done in a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DriveReport {
    /// The joint's name; that of the loads on bodies, as `drag`, of all together.
    pub name: String,
    /// From the start on.
    pub work_joules: f64,
    /// The largest power, of means over a step.
    pub power_max_watts: f64,
    /// The largest torque on the body, of means over a step.
    pub torque_max_newton_metres: f64,
}

/// The drives of a run.
pub(crate) struct Drives {
    now: Vec<Drive>,
    /// At the step or the place that is looked at.
    ahead: Vec<Drive>,
    /// The time of the frame before, and the drives there.
    frame: (f64, Vec<Drive>),
    /// Power and torque.
    largest: Vec<[f64; 2]>,
    work: Evaluation,
}

impl Drives {
    pub(crate) fn new(model: &ArticulatedBody) -> Self {
        let now = model.drives();
        Self {
            ahead: now.clone(),
            frame: (0.0, now.clone()),
            largest: vec![[0.0; 2]; now.len()],
            work: Evaluation::default(),
            now,
        }
    }

    /// Whether nothing moves as told.
    pub(crate) fn are_none(&self) -> bool {
        self.now.is_empty()
    }

    /// The work of all, J.
    pub(crate) fn work(&self) -> f64 {
        self.now.iter().map(|drive| drive.work).sum()
    }

    /// Takes a step.
    pub(crate) fn step(
        &mut self,
        model: &ArticulatedBody,
        run: &mut Run<BoxedIntegrator<Configuration>>,
    ) -> Result<(), StepError> {
        if self.now.is_empty() {
            return run.advance(run.cost().steps + 1);
        }
        let Self { ahead, work, .. } = self;
        ahead.copy_from_slice(&self.now);
        let before = run.state().t;
        run.advance_along(&mut |path| model.add_drives(path, work, ahead))?;
        let h = run.state().t - before;
        for ((largest, from), to) in self.largest.iter_mut().zip(&self.now).zip(&self.ahead) {
            let mean = mean([from, to], h);
            largest[0] = largest[0].max(mean.power.abs());
            largest[1] = largest[1].max(mean.torque.norm());
        }
        core::mem::swap(&mut self.now, &mut self.ahead);
        Ok(())
    }

    /// The state that is due, and what the drives have done until then and since the frame before.
    pub(crate) fn look(
        &mut self,
        model: &ArticulatedBody,
        run: &mut Run<BoxedIntegrator<Configuration>>,
        due: &Due,
    ) -> Result<(State<Configuration>, Vec<DriveSample>), StepError> {
        if self.now.is_empty() {
            return Ok((run.look(due)?, vec![]));
        }
        let Self { ahead, work, .. } = self;
        ahead.copy_from_slice(&self.now);
        let state = run.look_along(due, &mut |path| model.add_drives(path, work, ahead))?;
        let (since, before) = &self.frame;
        let pairs = before.iter().zip(&self.ahead);
        let samples = pairs.map(|(from, to)| mean([from, to], state.t - since));
        let samples = samples.collect();
        self.frame = (state.t, self.ahead.clone());
        Ok((state, samples))
    }

    /// What each has done, with the names of their joints.
    pub(crate) fn report(&self, joints: &[String]) -> Vec<DriveReport> {
        let mut joints = joints.iter();
        let report = |(drive, largest): (&Drive, &[f64; 2])| DriveReport {
            name: match drive.kind {
                DriveKind::Joint { .. } => joints.next().cloned().unwrap_or_default(),
                DriveKind::Loads(name) => name.to_owned(),
            },
            work_joules: drive.work,
            power_max_watts: largest[0],
            torque_max_newton_metres: largest[1],
        };
        self.now.iter().zip(&self.largest).map(report).collect()
    }
}

/// The work of a drive, and the means over the time between.
fn mean([from, to]: [&Drive; 2], time: f64) -> DriveSample {
    DriveSample {
        kind: to.kind,
        work: to.work,
        power: (to.work - from.work) / time,
        torque: (to.impulse - from.impulse) * (1.0 / time),
    }
}
