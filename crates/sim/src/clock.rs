//! The times of a run: counted, not summed.

use crate::error::{MAX_STEPS, SimError, positive};

/// What rounding does to the quotient of two durations, relative, with room to spare.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A run of equal steps from time zero; from some step on they may be halved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Steps before the equal ones, and the time there, s.
    before: (u64, f64),
    until: f64,
    steps: u64,
    step: f64,
    asked: f64,
}

impl Clock {
    /// The fewest equal steps, none longer than `step` seconds, that end at `until` seconds.
    ///
    /// # Errors
    /// [`SimError::NotPositive`], [`SimError::TooManySteps`].
    pub fn new(until: f64, step: f64) -> Result<Self, SimError> {
        positive("time to run to, in seconds,", until)?;
        positive("step, in seconds,", step)?;
        let ratio = until / step;
        let nearest = ratio.round();
        let whole = (ratio - nearest).abs() <= ROUNDING * ratio;
        let count = if whole { nearest } else { ratio.ceil() }.max(1.0);
        if count > MAX_STEPS {
            return Err(SimError::TooManySteps { until, step, count });
        }
        Ok(Self {
            before: (0, 0.0),
            until,
            steps: count as u64,
            step: until / count,
            asked: step,
        })
    }

    /// So many steps of `step` seconds each.
    pub fn counted(steps: u64, step: f64) -> Self {
        Self {
            before: (0, 0.0),
            until: steps as f64 * step,
            steps,
            step,
            asked: step,
        }
    }

    /// So many equal steps that end at `until` seconds.
    pub(crate) fn divided(until: f64, steps: u64) -> Self {
        let step = until / steps as f64;
        Self {
            before: (0, 0.0),
            until,
            steps,
            step,
            asked: step,
        }
    }

    /// The same with steps of half the size from step number `done` on.
    pub(crate) fn halved_from(self, done: u64) -> Self {
        Self {
            before: (done, self.time(done)),
            steps: done + 2 * self.steps.saturating_sub(done),
            step: 0.5 * self.step,
            ..self
        }
    }

    /// The time of the last step's end, s.
    pub fn until(&self) -> f64 {
        self.until
    }

    /// The number of steps.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The step taken, s.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The step that was asked for, s; the step taken is no longer.
    pub fn asked(&self) -> f64 {
        self.asked
    }

    /// Whether the step taken is shorter than the one asked for, by more than rounding.
    pub fn is_adjusted(&self) -> bool {
        (self.step - self.asked).abs() > 2.0 * ROUNDING * self.asked
    }

    /// The time after `done` steps, s, of those that are equal.
    pub fn time(&self, done: u64) -> f64 {
        if done == self.steps {
            return self.until;
        }
        let (before, since) = self.before;
        let done = done.saturating_sub(before) as f64;
        let (steps, rest) = ((self.steps - before) as f64, self.until - since);
        let product = done * rest;
        if product.is_finite() {
            since + product / steps
        } else {
            since + done / steps * rest
        }
    }

    /// The number of steps that end at `t` or before, and the seconds from there to `t`: none where only rounding is between.
    pub fn locate(&self, t: f64) -> (u64, f64) {
        let (before, since) = self.before;
        let nearest = before + ((t - since) / self.step).round() as u64;
        let nearest = nearest.min(self.steps);
        let ahead = t - self.time(nearest);
        if ahead.abs() <= ROUNDING * t {
            return (nearest, 0.0);
        }
        let before = nearest.saturating_sub(u64::from(ahead < 0.0));
        (before, t - self.time(before))
    }

    /// Whether `t` is the end, or beyond it, or before it by rounding only.
    pub fn is_end(&self, t: f64) -> bool {
        t >= self.until * (1.0 - ROUNDING)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(until: f64, step: f64) -> u64 {
        Clock::new(until, step).unwrap().steps()
    }

    #[test]
    fn rounding_adds_no_step() {
        assert_eq!(steps(100.0, 0.001), 100_000);
        assert_eq!(steps(0.3, 0.1), 3);
        assert_eq!(steps(0.7, 0.1), 7);
        assert_eq!(steps(1e6, 1e-4), 10_000_000_000);
        for n in 1..=10_000_u64 {
            let until = n as f64 * 0.001;
            assert_eq!(steps(until, 0.001), n);
            assert!(!Clock::new(until, 0.001).unwrap().is_adjusted());
        }
    }

    #[test]
    fn the_step_shrinks_to_meet_the_end() {
        let clock = Clock::new(1.0, 0.3).unwrap();
        assert_eq!((clock.steps, clock.step()), (4, 0.25));
        assert!(clock.is_adjusted());
        let clock = Clock::new(0.5, 2.0).unwrap();
        assert_eq!((clock.steps, clock.step()), (1, 0.5));
        assert_eq!(steps(1e-320, 1.0), 1);
    }

    #[test]
    fn the_last_time_is_exact() {
        for until in [0.1, 0.7, 1.1, 49.3, 1e308] {
            for n in [3, 7, 49, 1000] {
                let clock = Clock::new(until, until / f64::from(n)).unwrap();
                assert_eq!(clock.time(clock.steps), until);
                assert!(clock.time(clock.steps - 1) < until);
                assert_eq!(clock.time(0), 0.0);
            }
        }
    }

    #[test]
    fn a_time_is_found_between_steps() {
        let clock = Clock::new(100.0, 0.001).unwrap();
        for k in 0..1000_u64 {
            assert_eq!(clock.locate(k as f64 * 0.1), (100 * k, 0.0));
        }
        let clock = Clock::new(10.0, 0.25).unwrap();
        assert_eq!(clock.locate(0.1), (0, 0.1));
        assert_eq!(clock.locate(0.5), (2, 0.0));
        assert_eq!(clock.locate(0.6875), (2, 0.1875));
        assert!(clock.is_end(10.0) && clock.is_end(100.0 * 0.1) && !clock.is_end(9.99));
    }

    #[test]
    fn halved_steps_meet_the_end() {
        let clock = Clock::new(1.0, 0.25).unwrap().halved_from(1);
        assert_eq!((clock.steps(), clock.step()), (7, 0.125));
        let times: Vec<f64> = (1..=7).map(|k| clock.time(k)).collect();
        assert_eq!(times, [0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0]);
        assert_eq!(clock.locate(0.625), (4, 0.0));
        assert_eq!(clock.locate(0.6875), (4, 0.0625));
        let twice = clock.halved_from(3);
        assert_eq!((twice.steps(), twice.time(4)), (11, 0.5625));
    }

    #[test]
    fn absurd_counts_are_refused() {
        assert!(Clock::new(1e9, 1e-9).is_err());
        assert!(Clock::new(1e300, 1e-300).is_err());
        assert!(Clock::new(1e8, 1e-3).is_ok());
    }
}
