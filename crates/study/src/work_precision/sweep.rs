//! One contender, from coarse to fine.

use std::time::{Duration, Instant};

use serde::Serialize;
use sim::number::three_digits;

use super::{Errors, Reference, SAMPLES, Timing};
use crate::contender::{Contender, Control, Cost, Failure, Problem, Setting};

/// The first step, in times of the [radian](Reference::radian).
const COARSEST: f64 = 4.0;
/// The loosest tolerance or accuracy is ten to the minus this, and the tightest.
const TOLERANCES: (i32, i32) = (2, 13);
/// An error within so many of the reference's own is as small as one can be seen to be.
const NEAR: f64 = 3.0;
/// Within so many, an error that no longer shrinks is rounding's.
const PLATEAU: f64 = 100.0;
/// A reference whose own error, rad, is larger does not tell an error of attitudes.
pub const MEANINGFUL: f64 = 1e-2;
/// So many times longer may a run take that fails: its steps are too long, and shorter ones are solved faster.
const LATE: u32 = 10;
/// No more settings than this.
const MOST: usize = 64;

/// What a setting reached, and at what price.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Measured {
    /// With the least time of several runs.
    #[serde(flatten)]
    pub cost: Cost,
    /// How many.
    pub runs: u32,
    /// The largest over the run.
    #[serde(flatten)]
    pub errors: Errors,
}

/// A setting and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// The steps or the tolerance.
    pub setting: Setting,
    /// Why not, where it failed.
    pub outcome: Result<Measured, Failure>,
}

/// The points of a contender, the coarsest first.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Whose.
    pub contender: Contender,
    /// From long steps or loose tolerances to short or tight ones.
    pub points: Vec<Point>,
}

impl Curve {
    /// How many settings failed, and in short why the finest of them did; `None` where none did.
    pub fn failures(&self, until: f64) -> Option<String> {
        let failed = |point: &Point| {
            let failure = point.outcome.as_ref().err()?;
            Some((point.setting.value(until), failure.to_string()))
        };
        let failures: Vec<_> = self.points.iter().filter_map(failed).collect();
        let (value, cause) = failures.last()?;
        let (name, count) = (self.contender, failures.len());
        let setting = match self.contender.control() {
            Control::Step => format!("h = {} s", three_digits(*value)),
            Control::Tolerance => format!("tolerance {value:e}"),
            Control::Accuracy => format!("accuracy {value:e}"),
        };
        let settings = if count == 1 { "setting" } else { "settings" };
        // What follows is advice.
        let advice = ["; try", ": try", "; check"].iter();
        let end = advice.filter_map(|advice| cause.find(advice)).min();
        let cause = &cause[..end.unwrap_or(cause.len())];
        Some(format!("{name}, {count} {settings} to {setting}: {cause}"))
    }

    /// Times all points once more, and keeps the least.
    pub fn time_again(&mut self, problem: &Problem, timing: Timing) {
        for Point { setting, outcome } in &mut self.points {
            let Ok(measured) = outcome else { continue };
            // What has run once runs again: a failure would be none of the method's.
            if let Ok((cost, runs)) = timing.measure(self.contender, problem, *setting) {
                measured.cost.time = measured.cost.time.min(cost.time);
                measured.runs += runs;
            }
        }
    }
}

/// Runs one setting after the other, about a decade of error apart: it ends at the reference's own error, or where two in a row take too
/// long.
#[derive(Clone, Debug)]
pub struct Sweep<'a> {
    contender: Contender,
    problem: &'a Problem,
    reference: &'a Reference,
    timing: Timing,
    next: Option<Setting>,
    tried: usize,
    /// The smallest attitude error so far, rad, and how many settings have not halved it.
    best: f64,
    stalled: u32,
    /// How many settings in a row have taken too long.
    slow: u32,
    /// Of the last setting that did not fail.
    last: Duration,
}

impl<'a> Sweep<'a> {
    /// The sweep of a contender.
    pub fn new(
        contender: Contender,
        problem: &'a Problem,
        reference: &'a Reference,
        timing: Timing,
    ) -> Self {
        let steps = (problem.until / (COARSEST * reference.radian)).ceil();
        let first = match contender.control() {
            Control::Step => Setting::Steps((steps as u64).max(1)),
            Control::Tolerance => Setting::Tolerance(power_of_ten(TOLERANCES.0)),
            Control::Accuracy => Setting::Accuracy(power_of_ten(TOLERANCES.0)),
        };
        Self {
            contender,
            problem,
            reference,
            timing,
            next: Some(first),
            tried: 0,
            best: f64::INFINITY,
            stalled: 0,
            slow: 0,
            last: Duration::ZERO,
        }
    }

    fn measure(&self, setting: Setting) -> Result<Measured, Failure> {
        // First without samples: of a step that fails, the cause is then the step's, not that of a part of it.
        let (cost, runs) = self.timing.measure(self.contender, self.problem, setting)?;
        let states = self.contender.sample(self.problem, setting, SAMPLES)?;
        let errors = Errors::new(&self.problem.model, &states, &self.reference.states)?;
        Ok(Measured { cost, runs, errors })
    }

    fn is_last(&mut self, outcome: &Result<Measured, Failure>, elapsed: Duration) -> bool {
        let limit = self.timing.longest;
        let is_slow = match outcome {
            // Where shorter steps are solved faster, those that follow may be fast.
            Ok(measured) => measured.cost.time > limit && measured.cost.time >= self.last,
            Err(_) => elapsed > LATE * limit,
        };
        self.last = outcome
            .as_ref()
            .map_or(self.last, |measured| measured.cost.time);
        self.slow = if is_slow { self.slow + 1 } else { 0 };
        if self.slow >= 2 || self.tried >= MOST {
            return true;
        }
        let Ok(measured) = outcome else {
            return false;
        };
        let (error, floor) = (measured.errors.attitude, self.reference.attitude);
        self.stalled = if error < 0.5 * self.best {
            0
        } else {
            self.stalled + 1
        };
        self.best = self.best.min(error);
        let is_rounding = error <= NEAR * floor || (self.stalled >= 2 && error <= PLATEAU * floor);
        // Beyond its horizon a motion has no floor, and the energy is still worth a look.
        is_rounding && floor <= MEANINGFUL
    }

    /// The next finer setting: by the order, errors fall by ten, but no step by more than two.
    fn finer(&self, setting: Setting) -> Option<Setting> {
        match setting {
            Setting::Steps(steps) => {
                let ratio = 10_f64
                    .powf(1.0 / f64::from(self.contender.order()))
                    .min(2.0);
                let finer = (steps as f64 * ratio).round() as u64;
                Some(Setting::Steps(finer.max(steps.saturating_add(1))))
            }
            Setting::Tolerance(tolerance) => Some(Setting::Tolerance(a_tenth(tolerance)?)),
            Setting::Accuracy(accuracy) => Some(Setting::Accuracy(a_tenth(accuracy)?)),
        }
    }
}

/// The next power of ten below, if it is worth trying.
fn a_tenth(tolerance: f64) -> Option<f64> {
    let exponent = -tolerance.log10().round() as i32 + 1;
    (exponent <= TOLERANCES.1).then(|| power_of_ten(exponent))
}

/// $10^{-n}$, correctly rounded.
fn power_of_ten(n: i32) -> f64 {
    format!("1e-{n}").parse().unwrap_or(f64::EPSILON)
}

impl Iterator for Sweep<'_> {
    type Item = Point;

    fn next(&mut self) -> Option<Point> {
        let setting = self.next.take()?;
        let begin = Instant::now();
        let outcome = self.measure(setting);
        self.tried += 1;
        if !self.is_last(&outcome, begin.elapsed()) {
            self.next = self.finer(setting);
        }
        Some(Point { setting, outcome })
    }
}
