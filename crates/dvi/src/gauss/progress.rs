//! Whether the sweeps of a step get anywhere.

/// A change below this that no longer shrinks is rounding.
pub(super) const ROUNDING: f64 = 1e-11;
/// Sweeps without a smaller change.
const IDLE: u32 = 3;
/// The remaining error, and the change, at which iterating on is rounding alone.
pub(super) const EXHAUSTED: [f64; 2] = [0.1 * f64::EPSILON, 4.0 * f64::EPSILON];
/// Sweeps from one look at $\pi_0$ to the next.
const LOOKS_AT_END: u32 = 4;
/// A change of $\pi_0$ this much larger than that of the rates, both relative, is no echo of it.
const KNOWN_BETTER: f64 = 0.01;
/// A mismatch or a change of which one more iteration leaves at least this part is rounding, where it is small.
pub(super) const STAYS: f64 = 0.5;
/// Noise is measured only below this change: above, the iteration diverges.
pub(super) const MEASURES_BELOW: f64 = 1e-4;
/// Corrections of $\pi_0$ at rounding after which rates and $\pi_0$ go round in a circle; each begins anew.
const CORRECTIONS: u32 = 3;
/// In a circle no change becomes smaller than this part from one correction to the next.
const CIRCLES: f64 = 0.9;

/// Whether it is time to look at $\pi_0$.
pub(super) fn looks_at_end(sweeps: u32) -> bool {
    sweeps.is_multiple_of(LOOKS_AT_END)
}

/// How far the sweeps of a step have come.
pub(super) struct Progress {
    changes: Changes,
    /// The last mismatch of $\pi_0$ that rates had settled for.
    mismatch: f64,
    /// Corrections of $\pi_0$ in a row that were made when the changes were rounding, and no smaller than before the last one.
    corrections: u32,
    /// The smallest change before the last correction.
    best: f64,
}

/// What a look at $\pi_0$ says.
pub(super) enum AtEnd {
    Solved,
    /// The stages are to start from what the step's end asks for.
    Corrects,
    Waits,
}

impl Default for Progress {
    fn default() -> Self {
        Self {
            changes: Changes::default(),
            mismatch: f64::INFINITY,
            corrections: 0,
            best: f64::INFINITY,
        }
    }
}

impl Progress {
    /// Takes in the change that a sweep has made.
    pub(super) fn push(&mut self, change: f64) {
        self.changes.push(change);
    }

    /// Whether the rates are solved for the $\pi_0$ that the stages start from.
    pub(super) fn is_settled(&self, tolerance: f64) -> bool {
        self.changes.are_solved(tolerance)
    }

    /// Whether rates and $\pi_0$ go round in a circle of rounding.
    pub(super) fn circles(&self) -> bool {
        self.corrections > CORRECTIONS
    }

    /// What is to be done about a mismatch of $\pi_0$, of rates that have settled or not.
    pub(super) fn at_end(&mut self, (settled, mismatch): (bool, f64), tolerance: f64) -> AtEnd {
        let enough = tolerance.max(8.0 * f64::EPSILON);
        let stays = mismatch < ROUNDING && mismatch > STAYS * self.mismatch;
        if settled && (mismatch <= enough || stays) {
            return AtEnd::Solved;
        }
        if settled {
            self.mismatch = mismatch;
        }
        let known = mismatch > enough && mismatch > KNOWN_BETTER * self.changes.now;
        if settled || known {
            let circles = self.changes.now < ROUNDING && self.changes.best > CIRCLES * self.best;
            self.corrections = if circles { self.corrections + 1 } else { 0 };
            self.best = self.best.min(self.changes.best);
            self.changes = Changes::default();
            return AtEnd::Corrects;
        }
        AtEnd::Waits
    }

    /// Whether the changes have become no smaller for a while, for the first time.
    pub(super) fn stands_still(&mut self) -> bool {
        let still = self.changes.idle == IDLE && self.changes.now < MEASURES_BELOW;
        self.changes.idle += u32::from(still);
        still
    }

    pub(super) fn diverges(&self) -> bool {
        self.changes.diverge()
    }

    /// The smallest change.
    pub(super) fn best(&self) -> f64 {
        self.changes.best
    }
}

/// How much the last sweeps have changed.
///
/// The contraction is taken over two of them: its eigenvalues are complex, and single changes jump up and down.
#[derive(Default)]
struct Changes {
    now: f64,
    /// One and two sweeps before.
    before: [f64; 2],
    best: f64,
    /// Sweeps, and sweeps since the best.
    count: u32,
    idle: u32,
}

impl Changes {
    fn push(&mut self, change: f64) {
        self.before = [self.now, self.before[0]];
        let better = self.count == 0 || change < self.best;
        self.idle = if better { 0 } else { self.idle + 1 };
        self.best = if better { change } else { self.best };
        self.now = change;
        self.count += 1;
    }

    /// Whether the error that remains, estimated by the contraction, is below the tolerance, or rounding stands in the way.
    fn are_solved(&self, tolerance: f64) -> bool {
        if self.now <= EXHAUSTED[1] || self.count < 3 {
            return self.now <= EXHAUSTED[1];
        }
        let contraction = (self.now / self.before[1]).sqrt().min(1.0);
        let remains = self.now * contraction / (1.0 - contraction);
        let stands = self.now < ROUNDING && self.idle >= IDLE;
        stands || remains <= tolerance.max(EXHAUSTED[0])
    }

    fn diverge(&self) -> bool {
        !self.now.is_finite() || (self.count > 6 && self.now > 10.0 * self.best.max(ROUNDING))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sweeps whose changes and mismatches are these, over and over.
    fn swept(rates: &[f64], mismatches: &[f64]) -> Progress {
        let mut progress = Progress::default();
        for sweep in 1..=60_u32 {
            let at = sweep as usize;
            progress.push(rates[at % rates.len()]);
            if looks_at_end(sweep) {
                let mismatch = mismatches[at / 4 % mismatches.len()];
                progress.at_end((progress.is_settled(0.0), mismatch), 0.0);
            }
        }
        progress
    }

    #[test]
    fn what_still_contracts_is_no_circle() {
        for contraction in [0.3, 0.7, 0.9] {
            let (mut progress, mut change) = (Progress::default(), 1e-11);
            for sweep in 1..1000 {
                change *= contraction;
                progress.push(change);
                assert!(!progress.circles(), "{contraction}: {change:e}");
                let settled = progress.is_settled(0.0);
                if settled {
                    break;
                }
                if looks_at_end(sweep) {
                    progress.at_end((settled, change), 0.0);
                }
            }
            assert!(change < EXHAUSTED[1], "{contraction}: {change:e}");
        }
    }

    #[test]
    fn a_circle_of_rounding_is_seen() {
        let rates = [5.16e-13, 5.30e-13, 5.29e-13, 5.17e-13, 5.31e-13];
        assert!(swept(&rates, &[9.4e-15]).circles());
        assert!(swept(&rates, &[9.4e-15, 8e-15, 3e-14]).circles());
        let larger = rates.map(|rate| 1e3 * rate);
        assert!(!swept(&larger, &[9.4e-12]).circles());
    }
}
