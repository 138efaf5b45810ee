//! How the stages of a step are solved: by sweeps, and by Newton's method where they do not contract.

use lie::{RealGroup, Retraction, VectorSpace};

use super::Work;
use super::newton::{SweepNewton, read, write};
use super::tableau::Tableau;
use crate::{ContinuousSystem, Hint, State, StepReport};

/// Sweeps before the plain iteration is given up.
const MAX_SWEEPS: u32 = 60;
/// Newton iterations before a step is given up.
const MAX_NEWTON: u32 = 40;
/// A change below this that no longer shrinks is rounding.
const ROUNDING: f64 = 1e-12;
/// The remaining error at which iterating on is rounding alone.
const EXHAUSTED: f64 = 0.1 * f64::EPSILON;
/// Contraction of Newton's method that keeps its matrix.
const KEEPS_MATRIX: f64 = 0.1;
/// Steps solved by Newton's method before the plain iteration is tried again.
const LONG_STEPS: u32 = 16;
/// Halvings of a refused step in the search for one that would do.
const HALVINGS: i32 = 20;

/// Why a step was not solved.
pub(super) enum Failure {
    NotFinite,
    NotConverged(StepReport, Hint),
}

/// The rates of the last sweep, to see how much the next one changes.
pub(super) struct Last<G: RealGroup> {
    c_dot: Vec<G::Algebra>,
    pi_dot: Vec<G::Dual>,
}

impl<G: RealGroup> Last<G> {
    pub(super) fn new(stages: usize, g: &G) -> Self {
        Self {
            c_dot: vec![g.zero_algebra(); stages],
            pi_dot: vec![g.zero_dual(); stages],
        }
    }
}

/// How an iteration ended.
enum Ended {
    Solved(StepReport),
    /// Does not contract, or too slowly.
    Slow(StepReport),
}

type Method<'a, C> = (&'a C, &'a Tableau);
type Start<'a, C> = (&'a State<<C as ContinuousSystem>::Group>, f64);

impl<C: ContinuousSystem> Work<C> {
    pub(super) fn solve<R: Retraction>(
        &mut self,
        method: Method<C>,
        start: Start<C>,
        tolerance: f64,
    ) -> Result<StepReport, Failure> {
        let (report, starts) = match self.attempt::<R>(method, start, tolerance)? {
            Ended::Solved(report) => return Ok(report),
            Ended::Slow(report) => (report, self.predictor.is_known()),
        };
        self.predictor.forget();
        if starts && let Ended::Solved(again) = self.attempt::<R>(method, start, tolerance)? {
            let iterations = report.iterations + again.iterations;
            return Ok(StepReport {
                iterations,
                ..again
            });
        }
        self.long_steps = 0;
        let h = self.shorter::<R>(method, start, tolerance);
        self.predictor.forget();
        self.update.forget();
        Err(Failure::NotConverged(report, Hint::SmallerStep { h }))
    }

    /// The plain iteration, and Newton's method where it is slow.
    fn attempt<R: Retraction>(
        &mut self,
        method: Method<C>,
        start: Start<C>,
        tolerance: f64,
    ) -> Result<Ended, Failure> {
        let mut sweeps = 0;
        if self.long_steps == 0 {
            match self.iterate::<R>(method, start, tolerance)? {
                Ended::Slow(report) => sweeps = report.iterations,
                solved => return Ok(solved),
            }
            self.long_steps = LONG_STEPS;
        }
        self.long_steps -= 1;
        Ok(match self.newton::<R>(method, start, tolerance)? {
            Ended::Solved(report) => Ended::Solved(StepReport {
                iterations: report.iterations + sweeps,
                ..report
            }),
            Ended::Slow(report) => Ended::Slow(StepReport {
                iterations: report.iterations + sweeps,
                ..report
            }),
        })
    }

    fn guess<R: Retraction>(
        &mut self,
        (system, tableau): Method<C>,
        (state, h): Start<C>,
    ) -> Result<(), Failure> {
        let known = self
            .predictor
            .guess::<C, R>((system, tableau), (state, h), &mut self.sweep);
        let sweep = &mut self.sweep;
        sweep.evaluate::<R>(system, tableau, (state.t, h), &state.g);
        sweep.gather(tableau, &state.mu, h);
        let finite = sweep.momentum.max_magnitude().is_finite()
            && sweep
                .stages
                .iter()
                .all(|s| s.c_dot.max_magnitude().is_finite());
        if finite || known {
            return Ok(());
        }
        Err(Failure::NotFinite)
    }

    /// Sweeps until the estimated error is below the tolerance, or rounding.
    fn iterate<R: Retraction>(
        &mut self,
        (system, tableau): Method<C>,
        (state, h): Start<C>,
        tolerance: f64,
    ) -> Result<Ended, Failure> {
        self.guess::<R>((system, tableau), (state, h))?;
        let (mut last, mut best) = (f64::INFINITY, f64::INFINITY);
        for iterations in 2..=MAX_SWEEPS {
            self.remember();
            let sweep = &mut self.sweep;
            sweep.place::<R>(tableau, h);
            sweep.evaluate::<R>(system, tableau, (state.t, h), &state.g);
            sweep.gather(tableau, &state.mu, h);
            let change = self.change(h);
            let report = StepReport {
                iterations,
                residual: change,
            };
            if is_solved(change, last, tolerance) {
                self.sweep.end::<R>(tableau, h);
                return Ok(Ended::Solved(report));
            }
            if !change.is_finite() || (iterations > 6 && change > 2.0 * best) {
                return Ok(Ended::Slow(report));
            }
            (last, best) = (change, best.min(change));
        }
        let report = StepReport {
            iterations: MAX_SWEEPS,
            residual: best,
        };
        Ok(Ended::Slow(report))
    }

    fn remember(&mut self) {
        for (i, stage) in self.sweep.stages.iter().enumerate() {
            self.last.c_dot[i].clone_from(&stage.c_dot);
            self.last.pi_dot[i].clone_from(&stage.pi_dot);
        }
    }

    /// The largest change of the rates in the last sweep: of $\dot c$ relative to it, of $h \dot\pi$ to the momentum.
    fn change(&mut self, h: f64) -> f64 {
        let (mut c, mut c_size, mut pi, mut pi_size) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
        for (i, stage) in self.sweep.stages.iter().enumerate() {
            let (c_last, pi_last) = (&mut self.last.c_dot[i], &mut self.last.pi_dot[i]);
            c_last.add_scaled(-1.0, &stage.c_dot);
            pi_last.add_scaled(-1.0, &stage.pi_dot);
            c = larger(c, c_last.max_magnitude());
            pi = larger(pi, pi_last.max_magnitude());
            c_size = larger(c_size, stage.c_dot.max_magnitude());
            pi_size = larger(pi_size, stage.pi.max_magnitude());
        }
        let (c, pi) = (relative(c, c_size), relative(pi * h.abs(), pi_size));
        larger(c, pi)
    }

    /// Newton's method on the sweep, with halved corrections where they overshoot.
    fn newton<R: Retraction>(
        &mut self,
        method: Method<C>,
        (state, h): Start<C>,
        tolerance: f64,
    ) -> Result<Ended, Failure> {
        self.guess::<R>(method, (state, h))?;
        let mut newton = self
            .newton
            .take()
            .unwrap_or_else(|| SweepNewton::new(method.0, method.1.nodes.len(), &state.g));
        let ended = self.newton_with::<R>(&mut newton, method, (state, h), tolerance);
        self.newton = Some(newton);
        Ok(ended)
    }

    fn newton_with<R: Retraction>(
        &mut self,
        newton: &mut SweepNewton<C>,
        (system, tableau): Method<C>,
        (state, h): Start<C>,
        tolerance: f64,
    ) -> Ended {
        write(&self.sweep, &mut newton.x);
        let (mut last, mut stale, mut damping) = (f64::INFINITY, true, 1.0);
        let mut report = StepReport::default();
        for iterations in 1..=MAX_NEWTON {
            read(&mut self.sweep, &newton.x);
            self.remember();
            self.sweep.place::<R>(tableau, h);
            self.sweep
                .evaluate::<R>(system, tableau, (state.t, h), &state.g);
            self.sweep.gather(tableau, &state.mu, h);
            let change = self.change(h);
            report = StepReport {
                iterations,
                residual: change,
            };
            if is_solved(change, last, tolerance) {
                self.sweep.end::<R>(tableau, h);
                return Ended::Solved(report);
            }
            let overshot = change.is_nan() || change > 2.0 * last;
            if overshot && damping > 1e-3 {
                // Half of the correction back.
                damping *= 0.5;
                for (x, delta) in newton.x.iter_mut().zip(&newton.correction) {
                    *x += damping * delta;
                }
                continue;
            }
            if !change.is_finite() {
                return Ended::Slow(report);
            }
            stale |= change > KEEPS_MATRIX * last || damping < 1.0;
            if stale {
                let x = core::mem::take(&mut newton.x);
                newton.renew::<R>((system, tableau), state, h, &x);
                newton.x = x;
                stale = false;
            }
            (last, damping) = (change, 1.0);
            let mut image = core::mem::take(&mut newton.correction);
            write(&self.sweep, &mut image);
            for (entry, x) in image.iter_mut().zip(&newton.x) {
                *entry = x - *entry;
            }
            newton.correction = image;
            newton.solve();
            for (x, delta) in newton.x.iter_mut().zip(&newton.correction) {
                *x -= delta;
            }
        }
        Ended::Slow(report)
    }

    /// The longest of the halved steps from this state that is solved.
    fn shorter<R: Retraction>(
        &mut self,
        method: Method<C>,
        (state, h): Start<C>,
        tolerance: f64,
    ) -> f64 {
        let half = |k| h * 0.5_f64.powi(k);
        let solved = (1..=HALVINGS).map(half).find(|h| {
            self.predictor.forget();
            let ended = self.attempt::<R>(method, (state, *h), tolerance);
            matches!(ended, Ok(Ended::Solved(_)))
        });
        self.long_steps = 0;
        solved.unwrap_or(half(HALVINGS))
    }
}

/// Whether the error that remains after a change, estimated by the contraction, is below the tolerance, or rounding stands in the way.
fn is_solved(change: f64, last: f64, tolerance: f64) -> bool {
    let contraction = (change / last).min(1.0);
    let remains = change * contraction / (1.0 - contraction).max(f64::MIN_POSITIVE);
    let stands = change < ROUNDING && change >= last;
    change == 0.0 || stands || (last.is_finite() && remains <= tolerance.max(EXHAUSTED))
}

/// A system at rest has no scale, and no change either.
fn relative(change: f64, size: f64) -> f64 {
    if change == 0.0 { 0.0 } else { change / size }
}

/// The larger of the two, not a number where one is not.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}
