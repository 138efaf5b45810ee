//! Stages and step of Gauss collocation for a wanted accuracy, found by trying.

use core::cell::Cell;

use lie::VectorSpace;
use thiserror::Error;

use crate::numerics::numbers::larger;
use crate::{ContinuousSystem, Gauss, Integrator, State, StepError};

/// Times at which runs are compared.
const SAMPLES: usize = 8;
/// Steps of the pilot's coarsest run, at most: what is longer is judged by its beginning.
const LONGEST: f64 = 2000.0;
/// Steps of the pilot's finest run, at most.
const FINEST: usize = 400_000;
/// The part of the accuracy that the reference's own error may take, as that of unfinished iterations, and that a run's may.
const PARTS: [f64; 2] = [0.1, 0.4];
/// What stages are solved to, in parts of the accuracy: what a step leaves unfinished grows with the motion, and is tried too.
const TOLERANCES: [f64; 3] = [1e-3, 1e-5, 1e-7];
/// The numbers of stages that are tried: few cost less where the steps are short anyway.
const STAGES: [usize; 3] = [4, 6, 8];
/// Trials between a step that is too long and one that is not.
const BISECTIONS: u32 = 4;

/// A method that was found to be accurate enough, and what is known of it.
///
/// The step is fixed: one that follows the motion would give up the symplectic form and with it the bounded energy error.
///
/// ```
/// use dvi::{Context, Lagrangian, Pilot, System};
/// use lie::{Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg on a spring of 1 N/m.
/// #[derive(Clone)]
/// struct Spring;
///
/// impl System for Spring {
///     type Group = Rn<1>;
/// }
///
/// impl Lagrangian for Spring {
///     fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         (v[0] * v[0] - x.0[0] * x.0[0]) * S::from_f64(0.5)
///     }
/// }
///
/// let mut state = Spring.state(0.0, Rn([1.0]), &Tangent([0.0]))?;
/// let pilot = Pilot::run(&Spring.hamiltonian(), &state, 10.0, 1e-9)?;
/// let mut integrator = pilot.integrator(Spring.hamiltonian());
/// while state.t < 10.0 - 0.5 * pilot.h {
///     integrator.step(&mut state, pilot.h)?;
/// }
/// assert!((state.g.0[0] - 10.0_f64.cos()).abs() < 1e-9);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Pilot {
    /// Stages of [`Gauss`].
    pub stages: usize,
    /// The step, s; a whole number of them makes the horizon.
    pub h: f64,
    /// What the stages are solved to; see [`Gauss::with_tolerance`].
    pub tolerance: f64,
    /// The largest difference from a run of [`Gauss`] with eight stages and shorter steps, in the coordinates of
    /// $\mathrm{cay}^{-1}(g^{-1} g')$: radians and metres. It is no bound.
    pub estimate: f64,
    /// How far the two were compared, s: the whole duration, where that is not too long.
    pub horizon: f64,
    /// The steps that all trials took.
    pub steps: u64,
}

/// No method was found.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PilotError {
    /// The accuracy or the duration is not positive and finite.
    #[error("an accuracy of {accuracy} over {duration} s: both must be positive and finite")]
    Input {
        /// As given.
        accuracy: f64,
        /// As given, s.
        duration: f64,
    },
    /// Two runs of ever shorter steps differ by more than was asked for.
    #[error(
        "an accuracy of {accuracy:e} over {horizon} s is out of reach: the finest runs differ by {best:.1e}; \
         ask for {}a shorter time", less(20.0 * best)
    )]
    OutOfReach {
        /// As asked for.
        accuracy: f64,
        /// How far the runs were compared, s.
        horizon: f64,
        /// The smallest difference that was seen.
        best: f64,
    },
    /// No step that was tried is solved.
    #[error("no step of the pilot run was solved, down to {h:e} s")]
    Unsolved {
        /// The shortest, s.
        h: f64,
        /// Why.
        source: StepError,
    },
}

/// An accuracy to ask for, if it is one: attitudes are never more than $\pi$ apart.
fn less(accuracy: f64) -> String {
    match accuracy < 1.0 {
        true => format!("{accuracy:.0e}, or for "),
        false => String::new(),
    }
}

impl Pilot {
    /// Stages, step and tolerance with which the motion from `start` is accurate for `duration` seconds.
    ///
    /// The steps of runs of eight stages are halved until two agree. Runs of fewer stages or longer steps are then compared with the
    /// finest, and the one with the fewest evaluations is taken. Their stages are solved no further than that comparison can
    /// tell. All of it costs about ten such runs.
    ///
    /// # Errors
    /// [`PilotError`].
    pub fn run<C: ContinuousSystem + Clone + 'static>(
        system: &C,
        start: &State<C::Group>,
        duration: f64,
        accuracy: f64,
    ) -> Result<Self, PilotError> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        if !(positive(duration) && positive(accuracy)) {
            return Err(PilotError::Input { accuracy, duration });
        }
        let trials = Trials {
            system,
            start,
            accuracy,
            spent: Cell::new(0),
        };
        let (coarse, horizon) = trials.first(duration)?;
        let (fine, reference) = trials.reference(coarse, horizon)?;
        let tolerance = trials.tolerance((fine, horizon), &reference);
        let tried =
            STAGES.map(|stages| trials.longest(stages, (fine, horizon), tolerance, &reference));
        let cheapest = tried
            .into_iter()
            .flatten()
            .min_by_key(|trial| trial.evaluations);
        // The reference itself is accurate enough.
        let chosen = cheapest.unwrap_or(Trial {
            stages: 8,
            steps: fine,
            tolerance: 0.0,
            error: PARTS[0] * accuracy,
            evaluations: 0,
        });
        Ok(Self {
            stages: chosen.stages,
            h: horizon / (SAMPLES * chosen.steps) as f64,
            tolerance: chosen.tolerance,
            estimate: chosen.error,
            horizon,
            steps: trials.spent.get(),
        })
    }

    /// The integrator.
    pub fn integrator<C: ContinuousSystem + Send + 'static>(
        &self,
        system: C,
    ) -> Box<dyn Integrator<Group = C::Group> + Send> {
        Box::new(Gauss::of(system, self.stages.clamp(1, 8)).with_tolerance(self.tolerance))
    }
}

/// A method that was tried.
#[derive(Clone, Copy)]
struct Trial {
    stages: usize,
    /// Between two samples.
    steps: usize,
    tolerance: f64,
    error: f64,
    evaluations: u64,
}

struct Trials<'a, C: ContinuousSystem> {
    system: &'a C,
    start: &'a State<C::Group>,
    accuracy: f64,
    /// Steps of all runs.
    spent: Cell<u64>,
}

/// States at the samples, and sweeps.
type Samples<G> = (Vec<State<G>>, u64);
/// Steps between two samples, and the states there.
type Reference<G> = (usize, Vec<State<G>>);

impl<C: ContinuousSystem + Clone + 'static> Trials<'_, C> {
    /// The first halved step that is solved at all: steps between samples, and how far to go.
    fn first(&self, duration: f64) -> Result<(usize, f64), PilotError> {
        let mut h = duration / SAMPLES as f64;
        loop {
            let horizon = duration.min(LONGEST * h);
            let steps = (horizon / (SAMPLES as f64 * h)).round() as usize;
            match self.samples(8, steps, horizon / SAMPLES as f64, 0.0) {
                Ok(_) => return Ok((steps, horizon)),
                Err(source) if h < 1e-9 * duration => {
                    return Err(PilotError::Unsolved { h, source });
                }
                Err(_) => h *= 0.5,
            }
        }
    }

    /// The finer of two runs that agree, one of twice the steps of the other.
    fn reference(&self, coarse: usize, horizon: f64) -> Result<Reference<C::Group>, PilotError> {
        let (mut steps, mut best) = (coarse, f64::INFINITY);
        let mut last: Option<Vec<State<C::Group>>> = None;
        let mut worse = 0;
        while steps * SAMPLES <= FINEST && worse < 3 {
            let run = self.samples(8, steps, horizon / SAMPLES as f64, 0.0);
            let run = run.ok().map(|(states, _)| states);
            if let (Some(last), Some(run)) = (&last, &run) {
                let apart = difference(last, run);
                if apart <= PARTS[0] * self.accuracy {
                    return Ok((steps, run.clone()));
                }
                worse = if apart < best { 0 } else { worse + 1 };
                best = best.min(apart);
            }
            (last, steps) = (run, 2 * steps);
        }
        let accuracy = self.accuracy;
        Err(PilotError::OutOfReach {
            accuracy,
            horizon,
            best,
        })
    }

    /// The loosest tolerance that leaves the reference's run as it is, zero where only its own does.
    fn tolerance(&self, (fine, horizon): (usize, f64), reference: &[State<C::Group>]) -> f64 {
        let does = |tolerance: &f64| {
            let run = self.samples(8, fine, horizon / SAMPLES as f64, *tolerance);
            run.is_ok_and(|(run, _)| difference(&run, reference) <= PARTS[0] * self.accuracy)
        };
        let tolerances = TOLERANCES.map(|part| part * self.accuracy);
        tolerances.into_iter().find(does).unwrap_or(0.0)
    }

    /// The longest steps of so many stages that are accurate enough, by bisection between those of the reference and longer ones.
    fn longest(
        &self,
        stages: usize,
        (fine, horizon): (usize, f64),
        tolerance: f64,
        reference: &[State<C::Group>],
    ) -> Option<Trial> {
        let attempt = |steps: usize| {
            let run = self.samples(stages, steps, horizon / SAMPLES as f64, tolerance);
            let (states, sweeps) = run.ok()?;
            let error = difference(&states, reference);
            let enough = error <= PARTS[1] * self.accuracy;
            let evaluations = sweeps * stages as u64;
            enough.then_some(Trial {
                stages,
                steps,
                tolerance,
                error,
                evaluations,
            })
        };
        let (mut failing, mut passing) = (0, fine);
        let mut found = None;
        // Downwards in powers of two, then between the last two.
        while passing > 1 {
            match attempt(passing / 2) {
                Some(trial) => (passing, found) = (trial.steps, Some(trial)),
                None => {
                    failing = passing / 2;
                    break;
                }
            }
        }
        if found.is_none() {
            // Fewer stages may need shorter steps than the reference has.
            passing = [fine, 2 * fine, 4 * fine].into_iter().find(|steps| {
                found = attempt(*steps);
                found.is_some()
            })?;
            failing = passing / 2;
        }
        for _ in 0..BISECTIONS {
            let middle = ((failing as f64 * passing as f64).sqrt() as usize).max(failing + 1);
            if middle >= passing {
                break;
            }
            match attempt(middle) {
                Some(trial) => (passing, found) = (middle, Some(trial)),
                None => failing = middle,
            }
        }
        found
    }

    fn samples(
        &self,
        stages: usize,
        steps: usize,
        interval: f64,
        tolerance: f64,
    ) -> Result<Samples<C::Group>, StepError> {
        let mut integrator = Gauss::of(self.system.clone(), stages)
            .with_tolerance(tolerance)
            .by_sweeps_only();
        let mut state = self.start.clone();
        let (h, mut sweeps) = (interval / steps as f64, 0);
        let mut states = Vec::with_capacity(SAMPLES);
        for _ in 0..SAMPLES {
            for _ in 0..steps {
                self.spent.update(|steps| steps + 1);
                sweeps += u64::from(integrator.step(&mut state, h)?.iterations);
            }
            states.push(state.clone());
        }
        Ok((states, sweeps))
    }
}

/// The largest coordinate of $\mathrm{cay}^{-1}(g^{-1} g')$; infinite where that is outside the chart.
fn difference<G: lie::RealGroup>(a: &[State<G>], b: &[State<G>]) -> f64 {
    let apart = a.iter().zip(b).map(|(a, b)| {
        let between = a.g.inverse().compose(&b.g).cayley_inverse();
        between.map_or(f64::INFINITY, |c| c.max_magnitude())
    });
    apart.fold(0.0, larger)
}
