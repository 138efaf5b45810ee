//! Dormand–Prince 8(5,3) for the bodies' own equations, as fast as this workspace can make it.
//!
//! The same pair and step size control as [`baseline`](crate::baseline)'s, which serves any right-hand side; here the
//! right-hand side is inlined for the processor's instructions, as the variational methods' is, so that the two are compared
//! fairly. The state is the [`raw`] vector, which nothing keeps on the group.

mod coefficients;

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{ContinuousSystem, State};
use lie::Batch;
use lie::lanes::{self, Job};

use crate::baseline::{BaselineError, MAX_STEPS, Tolerance};
use crate::raw::{self, RightHandSide};
use coefficients::{ERROR_3, ERROR_5, Row, STAGES, WEIGHTS};

/// A step becomes at least and at most so many times as long.
const FACTORS: [f64; 2] = [1.0 / 3.0, 6.0];
/// Of the step size that would just pass.
const SAFETY: f64 = 0.9;

/// What sees samples: the time, and the [`raw`] state there.
pub type Watcher<'a> = dyn FnMut(f64, &[f64]) + 'a;

/// Where a run has ended, and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The state at the end.
    pub end: State<Configuration>,
    /// Calls of the right-hand side.
    pub evaluations: usize,
    /// Accepted steps.
    pub accepted: usize,
    /// Rejected steps.
    pub rejected: usize,
}

/// The motion from `start` for `duration` seconds, by the fastest instructions of this processor.
///
/// # Errors
/// [`BaselineError`] for a tolerance or a start out of range, and for a run that cannot reach its end.
///
/// ```
/// use articulated_fluid::Scene;
/// use study::baseline::Tolerance;
/// use study::dop853::integrate;
///
/// let scene = Scene::parse(include_str!("../../../../scenes/fish-chain.toml"), "fish-chain.toml")?;
/// let (model, start) = (scene.model()?, scene.initial_state()?);
/// let run = integrate(&model, &start, 1.0, Tolerance::uniform(1e-10))?;
/// assert_eq!(run.end.t, 1.0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub fn integrate(
    model: &ArticulatedBody,
    start: &State<Configuration>,
    duration: f64,
    tolerance: Tolerance,
) -> Result<Run, BaselineError> {
    sample(
        model,
        start,
        duration,
        (f64::INFINITY, &mut |_, _| ()),
        tolerance,
    )
}

/// The same, and `each` sees the times `every`, `2 every`, … with the [`raw`] states there: a step of their own from the
/// last accepted state, as exact as the steps, and not among the evaluations.
///
/// # Errors
/// As [`integrate`].
pub fn sample<'a>(
    model: &'a ArticulatedBody,
    start: &'a State<Configuration>,
    duration: f64,
    (every, each): (f64, &'a mut Watcher<'a>),
    tolerance: Tolerance,
) -> Result<Run, BaselineError> {
    tolerance.check()?;
    if !(duration.is_finite() && duration > 0.0) {
        return Err(BaselineError::Until { until: duration });
    }
    if every.is_nan() || every <= 0.0 {
        return Err(BaselineError::Every { every });
    }
    if !ContinuousSystem::fits(model, &start.g) {
        return Err(BaselineError::Misfit);
    }
    let y = raw::pack(start);
    crate::baseline::check_state(&y)?;
    let march = March {
        model,
        start,
        duration,
        tolerance,
        y,
        every,
        each,
    };
    lanes::run_single(march)
}

struct March<'a> {
    model: &'a ArticulatedBody,
    start: &'a State<Configuration>,
    duration: f64,
    tolerance: Tolerance,
    y: Vec<f64>,
    every: f64,
    each: &'a mut Watcher<'a>,
}

impl Job for March<'_> {
    type Output = Result<Run, BaselineError>;

    fn run<S: Batch<Item = f64>>(self) -> Self::Output {
        let rates = RightHandSide::<S>::new(self.model, self.start);
        let mut pair = Pair::new(rates, self.tolerance, self.y);
        let (mut t, until) = (0.0, self.duration);
        let mut h = pair.first_step(until);
        let (mut accepted, mut rejected, mut samples) = (0, 0, 1);
        while t < until {
            if accepted + rejected >= MAX_STEPS {
                return Err(BaselineError::TooManySteps {
                    t,
                    steps: MAX_STEPS,
                });
            }
            let last = t + 1.01 * h >= until;
            h = if last { until - t } else { h };
            if t + h == t {
                return Err(BaselineError::StepUnderflow { t });
            }
            let error = pair.attempt(h);
            let wanted = SAFETY * error.powf(-1.0 / 8.0);
            let factor = match wanted.is_nan() {
                true => FACTORS[0],
                false => wanted.clamp(FACTORS[0], FACTORS[1]),
            };
            if error <= 1.0 {
                let next = if last { until } else { t + h };
                while self.every * f64::from(samples) <= next {
                    let at = self.every * f64::from(samples);
                    (self.each)(at, pair.peek(at - t, h));
                    samples += 1;
                }
                pair.accept();
                t = next;
                accepted += 1;
                // After a refused step the next one is no longer.
                h *= if pair.refused {
                    factor.min(1.0)
                } else {
                    factor
                };
                pair.refused = false;
            } else {
                rejected += 1;
                pair.refused = true;
                h *= factor.min(1.0);
            }
        }
        let end = raw::unpack(self.start.t + until, &pair.y).ok_or(BaselineError::EmptyState)?;
        Ok(Run {
            end,
            evaluations: pair.rates.evaluations,
            accepted,
            rejected,
        })
    }
}

/// The stages of a step.
struct Pair<S: Batch<Item = f64>> {
    rates: RightHandSide<S>,
    tolerance: Tolerance,
    y: Vec<f64>,
    next: Vec<f64>,
    k: [Vec<f64>; 12],
    ahead: Vec<f64>,
    error: Vec<f64>,
    zero: Vec<f64>,
    refused: bool,
}

impl<S: Batch<Item = f64>> Pair<S> {
    fn new(mut rates: RightHandSide<S>, tolerance: Tolerance, y: Vec<f64>) -> Self {
        let mut k = [const { Vec::new() }; 12].map(|_: Vec<f64>| vec![0.0; y.len()]);
        rates.evaluate(&y, &mut k[0]);
        let zero = vec![0.0; y.len()];
        let (next, ahead, error) = (y.clone(), y.clone(), zero.clone());
        Self {
            rates,
            tolerance,
            y,
            next,
            ahead,
            k,
            error,
            zero,
            refused: false,
        }
    }

    /// A first step from the sizes of the state and of its first two derivatives (Hairer, Nørsett, Wanner, II.4).
    fn first_step(&mut self, until: f64) -> f64 {
        let size = |x: &[f64], pair: &Self| {
            let squares = x
                .iter()
                .zip(&pair.y)
                .map(|(x, y)| (x / pair.scale(*y)).powi(2));
            squares.sum::<f64>().sqrt()
        };
        let (y, f) = (size(&self.y, self), size(&self.k[0], self));
        let small = y <= 1e-5 || f <= 1e-5;
        let h = if small { 1e-6 } else { 0.01 * y / f }.min(until);
        combine::<S>(&mut self.next, &self.y, h, &[(0, 1.0)], &self.k);
        self.rates.evaluate(&self.next, &mut self.k[1]);
        let change: Vec<f64> = self.k[1]
            .iter()
            .zip(&self.k[0])
            .map(|(b, a)| b - a)
            .collect();
        let largest = f.max(size(&change, self) / h);
        let second = if largest <= 1e-15 {
            (h * 1e-3).max(1e-6)
        } else {
            (0.01 / largest).powf(1.0 / 8.0)
        };
        (100.0 * h).min(second).min(until)
    }

    fn scale(&self, y: f64) -> f64 {
        self.tolerance.absolute + self.tolerance.relative * y.abs()
    }

    /// A step into `next`, and its error in units of the tolerance.
    fn attempt(&mut self, h: f64) -> f64 {
        for (i, row) in STAGES.iter().enumerate() {
            combine::<S>(&mut self.next, &self.y, h, row, &self.k);
            self.rates.evaluate(&self.next, &mut self.k[i + 1]);
        }
        combine::<S>(&mut self.next, &self.y, h, WEIGHTS, &self.k);
        let [fifth, third] = [ERROR_5, ERROR_3].map(|row| {
            combine::<S>(&mut self.error, &self.zero, 1.0, row, &self.k);
            self.square_of_error()
        });
        let both = fifth + 0.01 * third;
        let both = if both == 0.0 { 1.0 } else { both };
        h.abs() * fifth / (both * self.y.len() as f64).sqrt()
    }

    /// $\sum_d (e_d / s_d)^2$ with the scales of the tolerance.
    fn square_of_error(&self) -> f64 {
        let Tolerance { relative, absolute } = self.tolerance;
        S::run(
            #[inline(always)]
            || {
                let ends = self.y.iter().zip(&self.next).zip(&self.error);
                let squares = ends.map(|((y, next), error)| {
                    let scaled = error / (absolute + relative * y.abs().max(next.abs()));
                    scaled * scaled
                });
                squares.sum()
            },
        )
    }

    /// The state a part of the attempted step of `h` ahead.
    fn peek(&mut self, part: f64, h: f64) -> &[f64] {
        self.ahead.copy_from_slice(&self.next);
        if part < h {
            let evaluations = self.rates.evaluations;
            self.attempt(part);
            self.rates.evaluations = evaluations;
            core::mem::swap(&mut self.next, &mut self.ahead);
        }
        &self.ahead
    }

    /// Takes the step; its end is the next one's first stage.
    fn accept(&mut self) {
        core::mem::swap(&mut self.y, &mut self.next);
        self.rates.evaluate(&self.y, &mut self.k[0]);
    }
}

/// $y + h \sum_j a_j k_j$.
fn combine<S: Batch>(out: &mut [f64], y: &[f64], h: f64, row: Row, k: &[Vec<f64>; 12]) {
    S::run(
        #[inline(always)]
        || {
            out.copy_from_slice(y);
            for (j, a) in row {
                let weight = h * a;
                for (out, k) in out.iter_mut().zip(&k[*j]) {
                    *out += weight * k;
                }
            }
        },
    );
}
