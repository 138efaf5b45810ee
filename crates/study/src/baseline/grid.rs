//! The sampling times.

use super::BaselineError;

/// Words kept at most over all samples (2 GiB).
const MAX_WORDS: usize = 1 << 28;

/// Words a sample takes beside its numbers: time, vector and allocation.
const OVERHEAD: usize = 6;

/// A multiple of the interval this close to the end is the end; the stepper
/// cannot step over less than ten units of rounding.
const SAME: f64 = 16.0 * f64::EPSILON;

/// Sampling times `0, every, …, inner * every, until`.
pub(super) struct Grid {
    every: f64,
    until: f64,
    inner: usize,
}

impl Grid {
    pub(super) fn new(until: f64, every: f64, dimension: usize) -> Result<Self, BaselineError> {
        if !(until > 0.0 && until.is_finite()) {
            return Err(BaselineError::Until { until });
        }
        if !(every > 0.0 && every.is_finite()) {
            return Err(BaselineError::Every { every });
        }
        let inner = count_inner(until, every, MAX_WORDS / (dimension + OVERHEAD))?;
        Ok(Self {
            every,
            until,
            inner,
        })
    }

    /// The end time.
    pub(super) fn until(&self) -> f64 {
        self.until
    }

    /// The sampling times, strictly increasing.
    pub(super) fn times(&self) -> impl Iterator<Item = f64> {
        let inner = (0..=self.inner).map(|k| self.every * k as f64);
        inner.chain([self.until])
    }
}

fn count_inner(until: f64, every: f64, limit: usize) -> Result<usize, BaselineError> {
    let ratio = until / every;
    if ratio + 2.0 > limit as f64 {
        return Err(BaselineError::TooManySamples {
            samples: ratio,
            limit,
        });
    }
    let mut inner = ratio.ceil() as usize;
    while inner > 0 && every * inner as f64 >= until * (1.0 - SAME) {
        inner -= 1;
    }
    Ok(inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(until: f64, every: f64) -> Vec<f64> {
        let grid = Grid::new(until, every, 1).expect("a valid grid");
        grid.times().collect()
    }

    #[test]
    fn multiples_then_the_end_once() {
        assert_eq!(times(1.0, 0.25), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(times(1.0, 0.4), [0.0, 0.4, 0.8, 1.0]);
        assert_eq!(times(1.0, 7.0), [0.0, 1.0]);
    }

    #[test]
    fn rounding_makes_no_twin_of_the_end() {
        assert_eq!(times(0.3, 0.1), [0.0, 0.1, 0.2, 0.3]);
        for n in 1..2000 {
            let every = 0.1;
            assert_eq!(times(every * n as f64, every).len(), n + 1);
            assert_eq!(times(n as f64 / 10.0, every).len(), n + 1);
        }
    }

    #[test]
    fn an_absurd_number_of_samples_is_refused() {
        assert!(matches!(
            Grid::new(1.0, 1e-300, 3),
            Err(BaselineError::TooManySamples { .. })
        ));
    }
}
