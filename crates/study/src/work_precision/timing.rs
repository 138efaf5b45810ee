//! The time of a run, of several.

use std::time::{Duration, Instant};

use crate::contender::{Contender, Cost, Failure, Problem, Setting};

/// How often a run is repeated: the least time is the one that nothing else has disturbed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// Runs at most, after the first one, which only warms up.
    pub runs: u32,
    /// No further run is begun after this time.
    pub within: Duration,
    /// No finer setting is tried after two in a row that took longer; a step too long for its solver may be slower than a shorter one.
    pub longest: Duration,
}

impl Timing {
    /// 10 runs or 1 s: for a sweep, and once more [later](super::Curve::time_again), since what disturbs a short run disturbs its
    /// neighbours.
    pub const BEST_OF_10: Self = Self {
        runs: 10,
        within: Duration::from_secs(1),
        longest: Duration::from_millis(500),
    };

    /// One run: for counts, which do not vary.
    pub const ONCE: Self = Self {
        runs: 1,
        ..Self::BEST_OF_10
    };

    /// The cost of a run with its least time, and the number of runs.
    pub(super) fn measure(
        self,
        contender: Contender,
        problem: &Problem,
        setting: Setting,
    ) -> Result<(Cost, u32), Failure> {
        let mut least = contender.run(problem, setting)?;
        let (begin, mut runs) = (Instant::now(), 0);
        // The run above has warmed up: its time does not count.
        while runs < self.runs && (runs == 0 || begin.elapsed() < self.within) {
            let cost = contender.run(problem, setting)?;
            least.time = if runs == 0 {
                cost.time
            } else {
                least.time.min(cost.time)
            };
            runs += 1;
        }
        Ok((least, runs))
    }
}
