//! Whether a method goes where the motion goes, over so short a time that chaos plays no part.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::State;
use sim::{Method, Sample};

use super::outcome::WRONG;
use crate::baseline::{Tolerance, on_group};
use crate::contender::{Contender, Problem, Setting};
use crate::work_precision::{apart, fastest_rate};

/// Of the reference's steps: it is to tell a radian.
const TOLERANCE: f64 = 1e-9;
/// A window ends where the reference has turned an attitude by this, rad: then an error of a radian is no small one of it.
const TURNED: f64 = 0.5;
/// A step of more radians has no reference.
const MOST: f64 = 1e3;
/// The method of another family that must agree with it where it contradicts.
const CHECK: Contender = Contender::Structure(Method::gauss(8).unwrap());
/// Steps of the check in a radian.
const CHECK_STEPS: f64 = 8.0;
/// To this part of the angle in question.
const AGREES: f64 = 0.1;

/// The largest kinetic energy, J, of the motion until it has turned a body by half a radian: after a step of `h`, after twice that and so
/// on. It is that of as much of the motion as there is a reference for.
pub(super) fn kinetic_ahead(problem: &Problem, h: f64) -> f64 {
    let Problem {
        model,
        start,
        until,
    } = problem;
    let tolerance = Tolerance::uniform(TOLERANCE);
    let (mut ahead, mut state, mut kinetic) = (h, start.clone(), 0.0_f64);
    if fastest_rate(model, start).is_none_or(|rate| h * rate > MOST) {
        return kinetic;
    }
    loop {
        let to = start.t + ahead.min(*until);
        let Ok(next) = on_group::integrate(model, &state, to, tolerance) else {
            return kinetic;
        };
        let sample = Sample::take(model, &next);
        kinetic = kinetic.max(sample.map_or(0.0, |sample| sample.kinetic));
        if ahead >= *until || apart(model, start, &next) >= TURNED {
            return kinetic;
        }
        (ahead, state) = (2.0 * ahead, next);
    }
}

/// A state on a method's way, and where the motion goes from there.
pub(super) struct Window {
    start: State<Configuration>,
    end: State<Configuration>,
    /// How many of the method's steps lie between.
    pub(super) steps: u64,
}

impl Window {
    /// One step of `h` from `start`, or twice as many and so on, at most `most`, until the motion has turned a body by half a radian. There
    /// is none where there is no reference.
    pub(super) fn open(
        model: &ArticulatedBody,
        start: &State<Configuration>,
        h: f64,
        most: u64,
    ) -> Option<Self> {
        if h * fastest_rate(model, start)? > MOST {
            return None;
        }
        let tolerance = Tolerance::uniform(TOLERANCE);
        let to = |from: &State<Configuration>, steps: u64| {
            on_group::integrate(model, from, start.t + steps as f64 * h, tolerance).ok()
        };
        let (mut steps, mut end) = (1, to(start, 1)?);
        while 2 * steps <= most && apart(model, start, &end) < TURNED {
            steps *= 2;
            end = to(&end, steps)?;
        }
        Some(Self {
            start: start.clone(),
            end,
            steps,
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
        let rate = |state| fastest_rate(model, state).unwrap_or(0.0);
        let radians = (self.end.t - self.start.t) * rate(&self.start).max(rate(&self.end));
        let problem = Problem {
            model: model.clone(),
            start: State {
                t: 0.0,
                ..self.start.clone()
            },
            until: self.end.t - self.start.t,
        };
        let steps = CHECK_STEPS * radians.ceil().max(1.0);
        let states = CHECK.sample(&problem, Setting::Steps(steps as u64), 1);
        let end = states
            .ok()
            .and_then(|states| states.into_iter().next_back());
        end.is_some_and(|end| apart(model, &end, &self.end) < AGREES * WRONG)
    }
}
