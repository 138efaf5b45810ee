//! When samples are due: every so many steps, or every so many seconds.

use crate::clock::Clock;
use crate::error::{MAX_STEPS, SimError, positive};

/// The rule that samples follow; t = 0 and the end belong to every one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Schedule {
    /// Every so many steps.
    Steps(u64),
    /// Every so many seconds, whatever the step.
    Seconds(f64),
}

/// A sample to take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Due {
    /// The steps to take before.
    pub steps: u64,
    /// How far the sample is ahead of their end, s; zero where it is at the end.
    pub ahead: f64,
    /// Its time, s: counted, not summed.
    pub t: f64,
}

impl Due {
    /// The sample at the time `t`, s: at the end of a step, or inside the next one.
    pub fn at(clock: &Clock, t: f64) -> Self {
        if clock.is_end(t) {
            return Self::at_step(clock, clock.steps());
        }
        let (steps, ahead) = clock.locate(t);
        Self { steps, ahead, t }
    }

    fn at_step(clock: &Clock, steps: u64) -> Self {
        Self {
            steps,
            ahead: 0.0,
            t: clock.time(steps),
        }
    }
}

impl Schedule {
    /// Refuses what has no end.
    ///
    /// # Errors
    /// [`SimError::NotPositive`], [`SimError::TooManySamples`].
    pub fn check(&self, clock: &Clock) -> Result<(), SimError> {
        let every = match *self {
            Self::Steps(every) => {
                return positive("number of steps between samples", every as f64).map(drop);
            }
            Self::Seconds(every) => positive("time between samples, in seconds,", every)?,
        };
        let (until, count) = (clock.until(), clock.until() / every);
        match count > MAX_STEPS {
            true => Err(SimError::TooManySamples {
                until,
                every,
                count,
            }),
            false => Ok(()),
        }
    }

    /// The sample number `k`, with the one at t = 0 as number zero; from some number on, the end.
    pub fn due(&self, clock: &Clock, k: u64) -> Due {
        match *self {
            Self::Steps(every) => Due::at_step(clock, every.saturating_mul(k).min(clock.steps())),
            Self::Seconds(every) => Due::at(clock, k as f64 * every),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(schedule: Schedule, clock: Clock) -> Vec<f64> {
        let last = |due: &Due| due.steps == clock.steps();
        let mut dues: Vec<_> = (0..)
            .map(|k| schedule.due(&clock, k))
            .take_while(|due| !last(due))
            .collect();
        dues.push(schedule.due(&clock, dues.len() as u64));
        dues.iter().map(|due| due.t).collect()
    }

    #[test]
    fn seconds_do_not_depend_on_the_step() {
        for step in [0.001, 0.07, 0.1, 0.25, 5.0] {
            let clock = Clock::new(1.0, step).unwrap();
            let times = times(Schedule::Seconds(0.1), clock);
            let expected: Vec<f64> = (0..10).map(|k| f64::from(k) * 0.1).chain([1.0]).collect();
            assert_eq!(times, expected, "{step}");
        }
    }

    #[test]
    fn a_sample_is_ahead_of_the_last_step_before_it() {
        let clock = Clock::new(1.0, 0.25).unwrap();
        let due = |k| Schedule::Seconds(0.125).due(&clock, k);
        assert_eq!((due(3).steps, due(3).ahead, due(3).t), (1, 0.125, 0.375));
        assert_eq!((due(4).steps, due(4).ahead, due(4).t), (2, 0.0, 0.5));
        assert_eq!((due(8).steps, due(9).t), (4, 1.0));
    }

    #[test]
    fn the_end_is_sampled_whatever_the_interval() {
        let clock = Clock::new(0.25, 0.1).unwrap();
        assert_eq!(times(Schedule::Steps(2), clock), [0.0, clock.time(2), 0.25]);
        assert_eq!(times(Schedule::Steps(u64::MAX), clock), [0.0, 0.25]);
        assert_eq!(times(Schedule::Seconds(0.2), clock), [0.0, 0.2, 0.25]);
        assert_eq!(times(Schedule::Seconds(1e300), clock), [0.0, 0.25]);
    }

    #[test]
    fn absurd_counts_are_refused() {
        let clock = Clock::new(100.0, 0.1).unwrap();
        assert!(Schedule::Seconds(1e-20).check(&clock).is_err());
        assert!(Schedule::Seconds(1e-3).check(&clock).is_ok());
    }
}
