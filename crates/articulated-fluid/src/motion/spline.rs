//! Cubic splines through measured points, with a continuous second derivative.

use thiserror::Error;

use super::law::Law;

/// How a spline goes on beyond its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// No curvature at the ends, beyond which it goes on straight.
    Natural,
    /// The last point is the first one again, a period later.
    Periodic,
}

/// Why there is no spline through these points.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SplineError {
    /// Fewer points than a spline needs.
    #[error("{found} points; expected at least {least}")]
    TooFew {
        /// Points given.
        found: usize,
        /// Points needed.
        least: usize,
    },
    /// The times do not increase, or a number is not finite.
    #[error(
        "row {row}: the time {time:?} does not come after the one before, or a number is not finite; expected increasing times and finite numbers"
    )]
    Order {
        /// Index of the point, from 0.
        row: usize,
        /// Its time, s.
        time: f64,
    },
    /// A periodic spline whose ends differ.
    #[error(
        "the last point differs from the first by {difference:e}; expected equal ends, or a table that does not repeat"
    )]
    Ends {
        /// The largest difference.
        difference: f64,
    },
}

/// The cubic spline through given points.
///
/// It is [told](Law::told) between its first and its last point, or for ever if it is periodic.
///
/// ```
/// use articulated_fluid::motion::{Ends, Law, Spline};
///
/// let points = [(0.0, [0.0]), (1.0, [1.0]), (2.0, [0.0])];
/// let spline = Spline::new(&points, Ends::Natural)?;
/// assert_eq!(spline.derivative(1.0, 0), [1.0]);
/// assert!(spline.derivative(1.0, 1)[0].abs() < 1e-15);
/// # Ok::<(), articulated_fluid::motion::SplineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Spline<const N: usize> {
    times: Vec<f64>,
    values: Vec<[f64; N]>,
    /// The second derivatives at the points.
    curvatures: Vec<[f64; N]>,
    ends: Ends,
}

impl<const N: usize> Spline<N> {
    /// The spline through points at increasing times.
    ///
    /// # Errors
    /// [`SplineError`].
    pub fn new(points: &[(f64, [f64; N])], ends: Ends) -> Result<Self, SplineError> {
        let (found, least) = (points.len(), if ends == Ends::Periodic { 4 } else { 2 });
        if found < least {
            return Err(SplineError::TooFew { found, least });
        }
        let mut before = f64::NEG_INFINITY;
        for (row, (time, values)) in points.iter().enumerate() {
            let finite = time.is_finite() && values.iter().all(|x| x.is_finite());
            if !(finite && *time > before) {
                return Err(SplineError::Order { row, time: *time });
            }
            before = *time;
        }
        let (times, mut values): (Vec<_>, Vec<_>) = points.iter().copied().unzip();
        if ends == Ends::Periodic {
            let differences = (0..N).map(|i| (values[found - 1][i] - values[0][i]).abs());
            let difference = differences.fold(0.0, f64::max);
            let size = values
                .iter()
                .flatten()
                .fold(0.0, |m: f64, x| m.max(x.abs()));
            if difference > 1e-9 * size {
                return Err(SplineError::Ends { difference });
            }
            values[found - 1] = values[0];
        }
        let mut curvatures = vec![[0.0; N]; found];
        for i in 0..N {
            let column: Vec<f64> = values.iter().map(|value| value[i]).collect();
            let second = match ends {
                Ends::Natural => natural(&times, &column),
                Ends::Periodic => periodic(&times, &column),
            };
            curvatures
                .iter_mut()
                .zip(second)
                .for_each(|(all, one)| all[i] = one);
        }
        Ok(Self {
            times,
            values,
            curvatures,
            ends,
        })
    }

    /// From the first to the last time, s.
    pub fn span(&self) -> [f64; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    fn segment(&self, k: usize, t: f64, order: u32) -> [f64; N] {
        let width = self.times[k + 1] - self.times[k];
        let (a, b) = (self.times[k + 1] - t, t - self.times[k]);
        core::array::from_fn(|i| {
            let [y, z] = [self.values[k][i], self.values[k + 1][i]];
            let [m, n] = [self.curvatures[k][i], self.curvatures[k + 1][i]];
            let (u, v) = (y / width - m * width / 6.0, z / width - n * width / 6.0);
            match order {
                0 => (m * a * a * a + n * b * b * b) / (6.0 * width) + u * a + v * b,
                1 => (n * b * b - m * a * a) / (2.0 * width) + v - u,
                2 => (m * a + n * b) / width,
                3 => (n - m) / width,
                _ => 0.0,
            }
        })
    }
}

impl<const N: usize> Law<N> for Spline<N> {
    fn derivative(&self, t: f64, k: u32) -> [f64; N] {
        let [first, last] = self.span();
        let t = match self.ends {
            Ends::Periodic => first + (t - first).rem_euclid(last - first),
            Ends::Natural => t,
        };
        let after = self.times.partition_point(|knot| *knot <= t);
        let segment = after.clamp(1, self.times.len() - 1) - 1;
        let inside = t.clamp(first, last);
        if inside == t {
            return self.segment(segment, t, k);
        }
        let slope = self.segment(segment, inside, 1);
        match k {
            0 => {
                let end = self.segment(segment, inside, 0);
                core::array::from_fn(|i| end[i] + slope[i] * (t - inside))
            }
            1 => slope,
            _ => [0.0; N],
        }
    }

    fn repeats(&self) -> Option<[f64; 2]> {
        let [first, last] = self.span();
        (self.ends == Ends::Periodic).then_some([0.0, last - first])
    }

    fn told(&self) -> [f64; 2] {
        match self.ends {
            Ends::Periodic => [f64::NEG_INFINITY, f64::INFINITY],
            Ends::Natural => self.span(),
        }
    }
}

/// The widths of the segments, and the jumps of the slopes of the chords, times 6, at the inner points.
fn chords(times: &[f64], values: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let widths: Vec<f64> = times.windows(2).map(|t| t[1] - t[0]).collect();
    let rises = values.windows(2).zip(&widths);
    let slopes: Vec<f64> = rises.map(|(y, w)| (y[1] - y[0]) / w).collect();
    let jumps = slopes.windows(2).map(|s| 6.0 * (s[1] - s[0])).collect();
    (widths, jumps)
}

/// No curvature at the ends.
fn natural(times: &[f64], values: &[f64]) -> Vec<f64> {
    let (widths, jumps) = chords(times, values);
    let diagonal: Vec<f64> = widths.windows(2).map(|w| 2.0 * (w[0] + w[1])).collect();
    let beside = widths.get(1..widths.len() - 1).unwrap_or_default();
    let inner = tridiagonal(&diagonal, beside, &jumps);
    core::iter::once(0.0).chain(inner).chain([0.0]).collect()
}

/// The same curvature at both ends, which is an unknown of its own: by superposition.
fn periodic(times: &[f64], values: &[f64]) -> Vec<f64> {
    let (widths, jumps) = chords(times, values);
    let n = widths.len();
    let diagonal: Vec<f64> = widths.windows(2).map(|w| 2.0 * (w[0] + w[1])).collect();
    let beside = &widths[1..n - 1];
    let mut unit = vec![0.0; n - 1];
    (unit[0], unit[n - 2]) = (-widths[0], -widths[n - 1]);
    let own = tridiagonal(&diagonal, beside, &jumps);
    let by_end = tridiagonal(&diagonal, beside, &unit);
    let slope = |k: usize| (values[k + 1] - values[k]) / widths[k];
    let jump = 6.0 * (slope(0) - slope(n - 1));
    let (first, last) = (widths[0], widths[n - 1]);
    let end = (jump - first * own[0] - last * own[n - 2])
        / (2.0 * (first + last) + first * by_end[0] + last * by_end[n - 2]);
    let inner = own
        .iter()
        .zip(by_end)
        .map(|(own, by_end)| own + end * by_end);
    core::iter::once(end).chain(inner).chain([end]).collect()
}

/// Solves a symmetric, diagonally dominant system.
fn tridiagonal(diagonal: &[f64], beside: &[f64], right: &[f64]) -> Vec<f64> {
    let (mut pivots, mut x) = (diagonal.to_vec(), right.to_vec());
    for k in 1..x.len() {
        let factor = beside[k - 1] / pivots[k - 1];
        pivots[k] -= factor * beside[k - 1];
        x[k] -= factor * x[k - 1];
    }
    for k in (0..x.len()).rev() {
        let above = if k + 1 < x.len() {
            beside[k] * x[k + 1]
        } else {
            0.0
        };
        x[k] = (x[k] - above) / pivots[k];
    }
    x
}
