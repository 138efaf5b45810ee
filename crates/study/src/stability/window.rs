//! Whether a method goes where the motion goes, over so short a time that chaos plays no part.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::State;

use super::outcome::WRONG;
use crate::baseline::Tolerance;
use crate::contender::{Contender, Problem, Setting};
use crate::methods::Method;
use crate::on_group;
use crate::watch::fastest_rate;
use crate::work_precision::apart;

/// Of the reference's steps: it is to tell a radian.
const TOLERANCE: f64 = 1e-9;
/// The method of another family that must agree with it where it contradicts.
const CHECK: Contender = Contender::Structure(Method::Gauss8);
/// Steps of the check in a radian.
const CHECK_STEPS: f64 = 8.0;
/// To this part of the angle in question.
const AGREES: f64 = 0.1;

/// A state on a method's way, and where the motion goes from there.
pub(super) struct Window {
    start: State<Configuration>,
    end: State<Configuration>,
    /// How many of the method's steps lie between.
    pub(super) steps: u64,
    radian: f64,
}

impl Window {
    /// The time in which the fastest body turns by a radian, in whole steps of `h` and at least one; none where there is no reference.
    pub(super) fn open(problem: &Problem, start: &State<Configuration>, h: f64) -> Option<Self> {
        let radian = 1.0 / fastest_rate(&problem.model, start)?;
        let steps = (radian.min(problem.until) / h).floor().max(1.0);
        Self::of(&problem.model, start, (h, steps), radian)
    }

    /// A single step of `h`; none where there is no reference.
    pub(super) fn of_step(
        model: &ArticulatedBody,
        start: &State<Configuration>,
        h: f64,
    ) -> Option<Self> {
        let radian = 1.0 / fastest_rate(model, start)?;
        Self::of(model, start, (h, 1.0), radian)
    }

    fn of(
        model: &ArticulatedBody,
        start: &State<Configuration>,
        (h, steps): (f64, f64),
        radian: f64,
    ) -> Option<Self> {
        let until = start.t + steps * h;
        let tolerance = Tolerance::uniform(TOLERANCE);
        let end = on_group::integrate(model, start, until, tolerance).ok()?;
        Some(Self {
            start: start.clone(),
            end,
            steps: steps as u64,
            radian,
        })
    }

    /// The largest angle between the attitudes of a state and the reference's, rad; none where a contradiction is not confirmed.
    pub(super) fn angle(
        &self,
        model: &ArticulatedBody,
        state: &State<Configuration>,
    ) -> Option<f64> {
        let angle = apart(model, state, &self.end);
        (angle <= WRONG || self.is_confirmed(model)).then_some(angle)
    }

    /// Whether an independent method goes where the reference goes.
    fn is_confirmed(&self, model: &ArticulatedBody) -> bool {
        let until = self.end.t - self.start.t;
        let mut start = self.start.clone();
        start.t = 0.0;
        let problem = Problem {
            model: model.clone(),
            start,
            until,
        };
        let steps = (CHECK_STEPS * until / self.radian).ceil().max(1.0);
        let states = CHECK.sample(&problem, Setting::Steps(steps as u64), 1);
        let end = states
            .ok()
            .and_then(|states| states.into_iter().next_back());
        end.is_some_and(|end| apart(model, &end, &self.end) < AGREES * WRONG)
    }
}
