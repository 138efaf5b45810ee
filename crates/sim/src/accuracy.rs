//! Stages and step that keep an accuracy to the end, found by trying and checked over the whole run.
//!
//! A candidate runs to the end beside a companion in steps a quarter longer, at a tenth of its tolerance. With the order $p$ the
//! companion's error is about $1.25^p \ge 6$ times as large, so their difference bounds the error where the order is seen. Where it is
//! not, for steps too long or where rounding leads, the difference is still of the size of the larger of two errors.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{PilotError, State, StepError};

use crate::clock::Clock;
use crate::companion::{Companion, next_look};
use crate::drives::Drives;
use crate::error::{LARGEST_ACCURACY, SimError};
use crate::method::BoxedIntegrator;
use crate::run::Run;

/// Candidates that are tried, at most.
const ATTEMPTS: u32 = 16;
/// Steps of a candidate, at least, and at most: a day of computing.
const STEPS: [u64; 2] = [8, 2_000_000_000];
/// Steps of the companion, in parts of the candidate's.
const COMPANION: f64 = 0.8;
/// The tolerance of the companion, in parts of the candidate's.
const TIGHTER: f64 = 0.1;
/// From this part of the run on, a candidate is given up whose error, growing in proportion to time, would be this many times too large.
const FORESEEN: [f64; 2] = [1.0 / 16.0, 4.0];
/// How a step is shortened after a miss.
const SHORTER: [f64; 2] = [0.5, 0.87];
/// An error that was to fall to less than this, and did not fall to [`STAYS`], is not the step's.
const FALLS: f64 = 0.1;
const STAYS: f64 = 0.5;

/// What a check to the end has found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checked {
    /// What stages are solved to; see [`dvi::Gauss::with_tolerance`].
    pub tolerance: f64,
    /// The largest difference from the companion on the way, rad and m.
    pub estimate: f64,
    /// The steps that choosing and checking took, beside those of the run.
    pub steps: u64,
}

/// Gauss collocation, so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Candidate {
    pub(crate) stages: u32,
    pub(crate) steps: u64,
    pub(crate) tolerance: f64,
}

impl Candidate {
    pub(crate) fn new(stages: u32, until: f64, step: f64, tolerance: f64) -> Self {
        let mut candidate = Self {
            stages,
            steps: 0,
            tolerance,
        };
        candidate.set_steps((until / step).ceil());
        candidate
    }

    fn set_steps(&mut self, steps: f64) {
        self.steps = (steps as u64).clamp(STEPS[0], STEPS[1]);
    }

    fn order(&self) -> f64 {
        2.0 * f64::from(self.stages)
    }

    /// What the error falls to, by the order, from that of `last`.
    fn promised(&self, last: &Self) -> f64 {
        match self.stages == last.stages {
            true => (last.steps as f64 / self.steps as f64).powf(self.order()),
            false => 0.0,
        }
    }

    /// The next one to try, where the error has to fall to this part.
    fn better(mut self, part: f64) -> Self {
        let steps = self.steps as f64;
        if self.stages < 8 && part < 0.01 {
            self.stages = 8;
        }
        self.set_steps(
            (steps / part.powf(1.0 / self.order()).clamp(SHORTER[0], SHORTER[1])).ceil(),
        );
        self.tolerance *= part.clamp(1e-3, 1.0);
        if self.tolerance < f64::EPSILON {
            self.tolerance = 0.0;
        }
        self
    }
}

/// How a check ended.
enum Outcome {
    Kept {
        estimate: f64,
    },
    /// Kept until `held`, and missed there unless only foreseen to be; `projected` is what the error grows to by the end.
    Missed {
        held: f64,
        projected: f64,
        is_foreseen: bool,
    },
    Refused {
        held: f64,
        source: StepError,
    },
}

/// A run that is to be accurate.
pub(crate) struct Search<'a> {
    pub(crate) model: &'a ArticulatedBody,
    pub(crate) make: &'a dyn Fn(u32, f64) -> BoxedIntegrator<Configuration>,
    pub(crate) start: State<Configuration>,
    pub(crate) until: f64,
    pub(crate) accuracy: f64,
    /// Steps spent so far.
    pub(crate) spent: u64,
}

impl Search<'_> {
    /// A candidate that keeps the accuracy to the end, from a first guess.
    pub(crate) fn run(&mut self, guess: Candidate) -> Result<(Candidate, Checked), SimError> {
        let mut now = guess;
        let mut last: Option<(Candidate, f64)> = None;
        let mut is_last = false;
        for attempt in 1..=ATTEMPTS {
            is_last |= attempt == ATTEMPTS || now.steps == STEPS[1];
            match self.check(&now, !is_last) {
                Outcome::Kept { estimate } => return Ok((now, self.checked(&now, estimate))),
                Outcome::Missed {
                    held,
                    projected,
                    is_foreseen,
                } => {
                    let stays = last.is_some_and(|(last, before)| {
                        now.promised(&last) < FALLS && projected > STAYS * before
                    });
                    let is_rounding = stays && now.tolerance == 0.0;
                    if is_last || (is_rounding && !is_foreseen) {
                        return Err(self.out_of_reach(held));
                    }
                    if is_rounding {
                        // Once more, to where it is missed.
                        is_last = true;
                        continue;
                    }
                    last = Some((now, projected));
                    now = now.better(0.5 * self.accuracy / projected);
                    if stays {
                        now.tolerance = 0.0;
                    }
                }
                Outcome::Refused { held, source } if is_last => {
                    return Err(SimError::Rehearsal { t: held, source });
                }
                Outcome::Refused { .. } => {
                    now.set_steps((now.steps as f64 / COMPANION).ceil());
                }
            }
        }
        Err(self.out_of_reach(0.0))
    }

    fn out_of_reach(&self, held: f64) -> SimError {
        SimError::AccuracyOutOfReach {
            accuracy: self.accuracy,
            until: self.until,
            held,
        }
    }

    fn checked(&self, candidate: &Candidate, estimate: f64) -> Checked {
        Checked {
            tolerance: candidate.tolerance,
            estimate,
            steps: self.spent,
        }
    }

    /// Goes to the end with a companion, or to where the accuracy is missed; where it will be, if `foreseeing`.
    fn check(&mut self, candidate: &Candidate, foreseeing: bool) -> Outcome {
        let clock = Clock::divided(self.until, candidate.steps);
        let [main, other] = [candidate.tolerance, TIGHTER * candidate.tolerance]
            .map(|tolerance| (self.make)(candidate.stages, tolerance));
        let mut run = Run::new(main, self.start.clone(), clock);
        let longer = (COMPANION * candidate.steps as f64) as u64;
        let mut companion = Companion::new(other, self.start.clone(), (self.until, longer));
        let outcome = self.compare(&mut run, &mut companion, foreseeing);
        self.spent += run.cost().steps + companion.steps();
        outcome
    }

    fn compare(
        &self,
        run: &mut Run<BoxedIntegrator<Configuration>>,
        companion: &mut Companion,
        foreseeing: bool,
    ) -> Outcome {
        let (steps, mut growth, mut held) = (run.clock().steps(), Growth::default(), 0.0);
        let mut balance = Balance::new(self.model, &self.start);
        let mut at = 0;
        while at < steps {
            at = next_look(at, steps);
            let apart = balance.advance(run, at).and_then(|unbalanced| {
                let apart = companion.apart(run.state())?;
                Ok(apart.max(unbalanced))
            });
            let apart = match apart {
                Ok(apart) => apart,
                Err(source) => return Outcome::Refused { held, source },
            };
            let t = run.state().t - self.start.t;
            growth.push(t, apart);
            let foreseen = growth.worst() * (self.until / t) > FORESEEN[1] * self.accuracy;
            let is_foreseen = growth.worst() <= self.accuracy;
            if !is_foreseen || (foreseeing && foreseen && t > FORESEEN[0] * self.until) {
                return Outcome::Missed {
                    held,
                    projected: growth.at(self.until),
                    is_foreseen,
                };
            }
            held = t;
        }
        Outcome::Kept {
            estimate: growth.worst(),
        }
    }
}

/// Energy less work of a driven run: a pose that is told is right at any step, what it takes is not.
struct Balance<'a> {
    model: &'a ArticulatedBody,
    drives: Drives,
    energy: f64,
    /// The largest so far, J.
    kinetic: f64,
}

impl<'a> Balance<'a> {
    fn new(model: &'a ArticulatedBody, start: &State<Configuration>) -> Self {
        let kept = model.conserved(start);
        let [energy, kinetic] = kept.map_or([f64::NAN; 2], |kept| [kept.energy, kept.kinetic]);
        Self {
            model,
            drives: Drives::new(model),
            energy,
            kinetic,
        }
    }

    /// Goes on to step number `at`; by how much energy and work differ there, in parts of the largest kinetic energy.
    fn advance(
        &mut self,
        run: &mut Run<BoxedIntegrator<Configuration>>,
        at: u64,
    ) -> Result<f64, StepError> {
        if self.drives.are_none() {
            return run.advance(at).map(|()| 0.0);
        }
        while run.cost().steps < at {
            self.drives.step(self.model, run)?;
        }
        // What is no number there, the run itself will refuse.
        let Ok(kept) = self.model.conserved(run.state()) else {
            return Ok(0.0);
        };
        self.kinetic = self.kinetic.max(kept.kinetic);
        let off = kept.energy - self.energy - self.drives.work();
        let relative = off.abs() / self.kinetic;
        Ok(if relative.is_finite() { relative } else { 0.0 })
    }
}

/// How an error has grown: its largest value so far at some times.
#[derive(Default)]
struct Growth(Vec<(f64, f64)>);

impl Growth {
    fn push(&mut self, t: f64, error: f64) {
        let worst = self.worst().max(error);
        self.0.push((t, worst));
    }

    fn worst(&self) -> f64 {
        self.0.last().map_or(0.0, |last| last.1)
    }

    /// What it comes to by the time `end`. It goes on by the power of time that it grew by since half the time, at least the first; or
    /// exponentially, where no regular motion has such a power.
    fn at(&self, end: f64) -> f64 {
        let Some(&(t, now)) = self.0.last() else {
            return 0.0;
        };
        let before = self.0.iter().rev().find(|(time, _)| *time <= 0.5 * t);
        let (half, before) = before.map_or((0.5 * t, 0.5 * now), |half| *half);
        let growth = (now / before.max(f64::MIN_POSITIVE)).ln();
        let power = (growth / (t / half).ln()).max(1.0);
        let exponent = match power > REGULAR {
            true => growth / (t - half) * (end - t),
            false => power * (end / t).ln(),
        };
        (now * exponent.min(LARGEST_EXPONENT).exp()).max(now)
    }
}

/// Errors of a regular motion grow as time or, where a force is constant, as a low power of it.
const REGULAR: f64 = 4.0;
/// What is beyond is as good as infinite.
const LARGEST_EXPONENT: f64 = 100.0;

/// Refuses what is no accuracy.
pub(crate) fn check_accuracy(accuracy: f64, duration: f64) -> Result<(), SimError> {
    let positive = |x: f64| x.is_finite() && x > 0.0;
    match positive(accuracy) && positive(duration) {
        false => Err(PilotError::Input { accuracy, duration }.into()),
        true if accuracy > LARGEST_ACCURACY => Err(SimError::NoAccuracy { accuracy }),
        true => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grown(law: impl Fn(f64) -> f64) -> f64 {
        let mut growth = Growth::default();
        for k in 1..=64 {
            let t = 0.25 * f64::from(k);
            growth.push(t, law(t));
        }
        growth.at(64.0) / law(64.0)
    }

    #[test]
    fn growth_is_told_from_its_past() {
        for (name, ratio) in [
            ("linear", grown(|t| 1e-9 * t)),
            ("quadratic", grown(|t| 1e-9 * t * t)),
            ("exponential", grown(|t| 1e-9 * t.exp())),
        ] {
            assert!((ratio - 1.0).abs() < 0.1, "{name}: {ratio}");
        }
        // Never less than in proportion to time.
        assert!(grown(|_| 1e-9) >= 4.0);
    }
}
