//! How the stages of a step are solved: by sweeps, and by Newton's method where they do not contract.

use lie::{Batch, Retraction, VectorSpace};

use super::newton::SweepNewton;
use super::progress::{AtEnd, EXHAUSTED, MEASURES_BELOW, Progress, ROUNDING, STAYS, looks_at_end};
use super::sweep::Side;
use super::work::{Limits, Method, Start, Work};
use crate::numerics::numbers::larger;
use crate::numerics::sizes::relative_beside;
use crate::{Cause, ContinuousSystem, Hint, StepReport};

/// Sweeps before the plain iteration is given up.
pub(super) const MAX_SWEEPS: u32 = 60;
/// Newton iterations before a step is given up.
const MAX_NEWTON: u32 = 40;
/// Contraction of Newton's method that keeps its matrix, from step to step too.
const KEEPS_MATRIX: f64 = 0.3;
/// A change below this is at a root; it may rise as an approximate matrix lets it.
const AT_ROOT: f64 = 1e-3;
/// The shortest part of a correction that is tried where the whole makes the change grow.
const SHORTEST_CORRECTION: f64 = 1e-2;
/// Steps solved by Newton's method before the plain iteration is tried again.
pub(super) const LONG_STEPS: u32 = 16;
/// Unknowns beyond which Newton's method, whose matrix is dense, costs more than shorter steps.
const NEWTON_LIMIT: usize = 1000;
/// Unknowns beyond which one step by Newton's method costs more than trying the plain iteration again.
const FEW: usize = 300;
/// Steps for which noise is taken to be as it was measured.
const NOISE_HOLDS: u32 = 16;
/// The weight of a single block's mismatch, relative to its own momentum, beside that of its kind.
const OF_BLOCK: f64 = 1e-7;

/// How an iteration ended.
enum Ended {
    Solved(StepReport),
    /// Does not contract, or too slowly.
    Slow(StepReport),
    /// At a solution that is not the motion's.
    AnotherBranch(StepReport),
}

impl Ended {
    /// The same, with the iterations of an attempt before it.
    fn after(mut self, iterations: u32) -> Self {
        let (Self::Solved(report) | Self::Slow(report) | Self::AnotherBranch(report)) = &mut self;
        report.iterations += iterations;
        self
    }

    fn report(&self) -> StepReport {
        let (Self::Solved(report) | Self::Slow(report) | Self::AnotherBranch(report)) = *self;
        report
    }

    fn solved(&self) -> Option<StepReport> {
        matches!(self, Self::Solved(_)).then(|| self.report())
    }

    /// Of a step of size `h` that was not solved.
    fn refusal(&self, h: f64) -> Cause {
        let h = 0.5 * h;
        let hint = match self {
            Self::AnotherBranch(_) => Hint::AnotherBranch { h },
            _ => Hint::SmallerStep { h },
        };
        let StepReport {
            iterations,
            residual,
            ..
        } = self.report();
        Cause::NotConverged {
            residual,
            iterations,
            hint,
        }
    }
}

impl<C: ContinuousSystem, S: Batch<Item = f64>> Work<C, S> {
    pub(super) fn solve<R: Retraction>(
        &mut self,
        method: Method<C>,
        start: Start<C>,
        limits: Limits,
    ) -> Result<StepReport, Cause> {
        let matrices = |work: &Self| work.newton.as_ref().map_or(0, |newton| newton.evaluations);
        let before = matrices(self);
        let mut report = self.solve_uncounted::<R>(method, start, limits)?;
        let stages = method.1.nodes.len() as u32;
        report.evaluations = stages * report.iterations + matrices(self).wrapping_sub(before);
        Ok(report)
    }

    fn solve_uncounted<R: Retraction>(
        &mut self,
        method: Method<C>,
        start: Start<C>,
        limits: Limits,
    ) -> Result<StepReport, Cause> {
        let tolerance = limits.tolerance;
        if self.noise_holds == 0 {
            self.sweep.forget_noise();
        }
        self.noise_holds = self.noise_holds.saturating_sub(1);
        if limits.sweeps_only {
            let ended = self.iterate::<R>(method, start, tolerance)?;
            return ended.solved().ok_or_else(|| ended.refusal(start.1));
        }
        let mut ended = self.attempt::<R>(method, start, tolerance)?;
        if ended.solved().is_none() && self.predictor.is_known() {
            self.predictor.forget();
            self.long_steps = 0;
            let before = ended.report().iterations;
            ended = self.attempt::<R>(method, start, tolerance)?.after(before);
        }
        if let Some(report) = ended.solved() {
            return Ok(report);
        }
        self.long_steps = 0;
        self.noise_holds = 0;
        self.predictor.forget();
        self.update.forget();
        self.drift.fill(0.0);
        Err(ended.refusal(start.1))
    }

    /// The plain iteration, and Newton's method where it is slow.
    fn attempt<R: Retraction>(
        &mut self,
        method: Method<C>,
        start: Start<C>,
        tolerance: f64,
    ) -> Result<Ended, Cause> {
        let mut sweeps = 0;
        if self.long_steps == 0 {
            let report = match self.iterate::<R>(method, start, tolerance)? {
                Ended::Slow(report) => report,
                ended => return Ok(ended),
            };
            sweeps = report.iterations;
            let unknowns = SweepNewton::<C>::unknowns(method.1, self.sweep.dim());
            if unknowns > NEWTON_LIMIT {
                return Ok(Ended::Slow(report));
            }
            self.long_steps = if unknowns > FEW { 1 } else { LONG_STEPS };
        }
        self.long_steps -= 1;
        let ended = self.newton::<R>(method, start, tolerance)?;
        Ok(ended.after(sweeps))
    }

    fn guess<R: Retraction>(
        &mut self,
        (system, tableau): Method<C>,
        (state, h): Start<C>,
    ) -> Result<(), Cause> {
        self.sweep.set_parameters(system.parameters());
        self.sweep.start_at(&state.g);
        self.sweep.judge.forget_rounding();
        self.sweep.weigh(system, (state.t, &state.mu));
        let known = self.predictor.guess::<C, R>(
            (system, tableau),
            (state.t, &state.mu, h),
            &mut self.sweep,
        );
        if !known && !self.sweep.is_finite() {
            return Err(Cause::NotFinite);
        }
        self.sweep.evaluate::<R>(system, (state.t, h));
        if !known && !self.sweep.has_rates() && self.sweep.leaves_domain(system, (state.t, h)) {
            return Err(Cause::NotFinite);
        }
        Ok(())
    }

    /// Sweeps until the estimated error is below the tolerance, or rounding.
    ///
    /// The stages start from $\pi_0 = \mu_k + d$. At the solution $d$ is what the moving base point asks for, tiny and
    /// hardly dependent on the rates. Taken from unfinished rates it would feed all of their error back, undamped by the
    /// small eigenvalues of $a_{ij}$. So it is kept until it is known better than it changes.
    fn iterate<R: Retraction>(
        &mut self,
        method: Method<C>,
        (state, h): Start<C>,
        tolerance: f64,
    ) -> Result<Ended, Cause> {
        self.guess::<R>(method, (state, h))?;
        let system = method.0;
        self.sweep.round(Side::Start);
        state.mu.write(&mut self.start);
        let [_, _, momenta] = &mut self.mismatch;
        momenta.fill(0.0);
        self.sweep.kinds.raise(momenta, &self.start);
        for (start, drift) in self.start.iter_mut().zip(&self.drift) {
            *start += drift;
        }
        let mut progress = Progress::default();
        let mut report = StepReport::default();
        for iterations in 2..=MAX_SWEEPS {
            self.sweep
                .run_from_start::<R>(system, (state.t, h), &self.start);
            let change = self.sweep.change(h);
            progress.push(change);
            if iterations == 2 {
                self.predictor.judge(change);
            }
            report = StepReport {
                iterations,
                residual: change,
                ..StepReport::default()
            };
            let settled = progress.is_settled(tolerance);
            if settled || looks_at_end(iterations) {
                let mismatch = self.mismatch::<R>((state, h), settled);
                report.residual = larger(change, mismatch);
                match progress.at_end((settled, mismatch), tolerance) {
                    AtEnd::Solved => return Ok(Ended::Solved(report)),
                    AtEnd::Corrects => self.start.copy_from_slice(&self.wanted),
                    AtEnd::Waits => {}
                }
            }
            if progress.stands_still() {
                self.measure_noise::<R>(system, (state, h));
                continue;
            }
            if progress.diverges() {
                report.residual = progress.best();
                return Ok(Ended::Slow(report));
            }
        }
        // There is no more to be had than rounding.
        let rounding = progress.circles() && report.residual < ROUNDING;
        Ok(match rounding {
            true => Ended::Solved(report),
            false => Ended::Slow(report),
        })
    }

    /// Measures what rounding makes of a sweep.
    fn measure_noise<R: Retraction>(&mut self, system: &C, (state, h): Start<C>) {
        self.noise_holds = NOISE_HOLDS;
        self.sweep
            .measure_noise::<R>(system, (&state.g, &mut self.moved), (state.t, h));
    }

    /// How far $\pi_0$ is from what the step's end asks for, relative to the momentum, in the kind of coordinates where that is largest.
    ///
    /// At the last look each block counts too, with less weight. What noise explains is none.
    fn mismatch<R: Retraction>(&mut self, (state, h): Start<C>, last: bool) -> f64 {
        let Self {
            sweep,
            start,
            wanted,
            sizes,
            mismatch: [numbers, parts, wholes],
            difference,
            ..
        } = &mut *self;
        sweep.end_to_start::<R>(h, &state.mu, wanted);
        let kinds = &sweep.kinds;
        parts.fill(0.0);
        // A body at rest has a momentum only in between.
        sweep.end.momentum.write(numbers);
        kinds.raise(wholes, numbers);
        for (number, (a, b)) in numbers.iter_mut().zip(start.iter().zip(&*wanted)) {
            *number = a - b;
        }
        kinds.raise(parts, numbers);
        let noise = |kind| sweep.judge.rounding_of_momentum(kind);
        let mut in_block = 0.0;
        if last {
            difference.read(numbers);
            sizes.set_scales(&[&state.mu, &sweep.end.momentum]);
            if sweep.judge.is_driven() {
                sizes.raise_scales(|kind| sweep.judge.least_momentum(kind));
            }
            in_block = sizes.relative_above(difference, noise);
        }
        let kinds = parts.iter().zip(wholes).enumerate();
        kinds.fold(OF_BLOCK * in_block, |found, (kind, (part, size))| {
            let size = larger(*size, sweep.judge.least_momentum(kind));
            larger(found, relative_beside(*part, size, noise(kind)))
        })
    }

    /// Newton's method on the sweep.
    fn newton<R: Retraction>(
        &mut self,
        method: Method<C>,
        (state, h): Start<C>,
        tolerance: f64,
    ) -> Result<Ended, Cause> {
        self.guess::<R>(method, (state, h))?;
        let newton = self.newton.take();
        let mut newton = newton.unwrap_or_else(|| SweepNewton::new(method.1, &state.g));
        newton.weigh(self.sweep.judge.weights());
        let ended = self.newton_with::<R>(&mut newton, method.0, (state, h), tolerance);
        self.newton = Some(newton);
        Ok(ended)
    }

    fn newton_with<R: Retraction>(
        &mut self,
        newton: &mut SweepNewton<C>,
        system: &C,
        (state, h): Start<C>,
        tolerance: f64,
    ) -> Ended {
        self.sweep.gather(&state.mu, h);
        self.sweep.round(Side::End);
        self.sweep.write(&mut newton.x);
        let (mut last, mut part) = (f64::INFINITY, 1.0);
        let (mut stale, mut renewed, mut measured) = (!newton.fits(h), false, false);
        let (mut report, mut best) = (StepReport::default(), f64::INFINITY);
        for iterations in 1..=MAX_NEWTON {
            self.sweep.read(&newton.x);
            self.sweep.run_from_end::<R>(system, (state.t, h));
            self.sweep.gather(&state.mu, h);
            let change = self.sweep.change(h);
            best = best.min(change);
            report = StepReport {
                iterations,
                residual: best,
                ..StepReport::default()
            };
            if is_solved(change, last, tolerance) {
                // Where the matrix of the steps before has done, the step is as theirs.
                if renewed && newton.has_turned::<R>(system, state, h) {
                    newton.forget();
                    return Ended::AnotherBranch(report);
                }
                self.sweep.end_to_start::<R>(h, &state.mu, &mut self.start);
                return Ended::Solved(report);
            }
            if !measured && change < MEASURES_BELOW && change > STAYS * last {
                measured = true;
                self.measure_noise::<R>(system, (state, h));
                continue;
            }
            // Beyond a change that grows lies any root: so it has to fall, by a part of the correction where not by all.
            if change.is_nan() || change > last.max(AT_ROOT) {
                if iterations == 1 || (renewed && part <= SHORTEST_CORRECTION) {
                    break;
                }
                if renewed {
                    part *= 0.5;
                    newton.correct(-part);
                } else {
                    // Back to where the matrix of the steps before has led away from.
                    newton.correct(-1.0);
                    (last, stale) = (f64::INFINITY, true);
                }
                continue;
            }
            if stale || part < 1.0 || change > KEEPS_MATRIX * last {
                newton.renew::<R>(system, state, h);
                renewed = true;
            }
            (last, part, stale) = (change, 1.0, false);
            newton.linearise(&self.sweep);
            newton.correct(1.0);
        }
        newton.forget();
        Ended::Slow(report)
    }
}

/// Whether a sweep that starts from Newton's iterate changes it no more: the iterate is what is returned, uncorrected.
fn is_solved(change: f64, last: f64, tolerance: f64) -> bool {
    let stands = change < ROUNDING && change >= last;
    change <= tolerance.max(EXHAUSTED[1]) || stands
}
