//! A reference solution for any continuous system on a Lie group.
//!
//! Hamilton's equations in the chart $g = g_0 \exp(c)$,
//! $$ \dot c = \mathrm d\exp_c^{-1} \xi, \qquad \dot\mu = \mathrm{ad}^\ast_\xi \mu + \tau, $$
//! by the Dormand–Prince pair 8(5,3) of [`baseline`]. Where $c$ has grown to about one, the chart is moved:
//! $g_0 \leftarrow g_0 \exp(c)$. So the configuration stays on the group, and no formula is shared with a variational method but
//! those of the group and of the system.
//!
//! ```
//! use dvi::Lagrangian;
//! use lie::SO3;
//! use study::baseline::Tolerance;
//! use study::on_group::integrate;
//! use study::problems::{HeavyTop, Solution};
//!
//! let tilted = SO3::from_quaternion([1.0, 0.2, 0.0, 0.0]);
//! let problem = HeavyTop::new(1.0, 0.5, 1.0)?.problem(tilted, [0.0, 0.0, 10.0])?;
//! let system = problem.lagrangian.hamiltonian();
//! let end = integrate(&system, &problem.start, problem.time, Tolerance::uniform(1e-13))?;
//! let exact = problem.exact.at(problem.time)?;
//! assert!((*end.g.matrix() - *exact.g.matrix()).frobenius() < 1e-11);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

use dvi::{ContinuousSystem, State};
use lie::{Exp, LieGroup, VectorSpace};

use crate::baseline::{self, BaselineError, Pair, Tolerance};
use crate::problems::{ProblemError, Solution};

/// Coordinates in the chart larger than this are not used; $\mathrm d\exp$ is singular at angles of $2\pi$.
const CHART: f64 = 2.0;
/// The chart is moved when its coordinates are expected to reach this.
const WANTED: f64 = 1.0;
/// A segment is at most this many times as long as the one before it.
const GROWTH: f64 = 2.0;
/// A segment is halved this often before a right-hand side without an answer is the system's own.
const MAX_HALVINGS: u32 = 40;

/// Why there is no reference solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReferenceError {
    /// The start is no configuration of the system, or its momentum has another shape.
    #[error("the start does not fit the system: give a configuration and a momentum of its size")]
    Misfit,
    /// A time is not finite.
    #[error("the time {t} is not finite")]
    Time {
        /// The time given.
        t: f64,
    },
    /// The integration from time `t` on failed; the times in its source count from `t`.
    #[error("the integration failed after t = {t}: {source}")]
    Integration {
        /// Time reached.
        t: f64,
        /// What happened.
        source: BaselineError,
    },
}

/// The state at the time `until`, which may lie before the start.
///
/// # Errors
/// [`ReferenceError`].
pub fn integrate<S: ContinuousSystem>(
    system: &S,
    start: &State<S::Group>,
    until: f64,
    tolerance: Tolerance,
) -> Result<State<S::Group>, ReferenceError> {
    check(system, start, until)?;
    let mut chart = Chart::new(system, start);
    let mut length = (until - start.t).abs();
    while chart.state.t != until {
        length = chart.advance(until, length, tolerance)?;
    }
    Ok(chart.state)
}

/// The states at `times`, each integrated from the one before; in any order, but one that turns back costs more.
///
/// # Errors
/// [`ReferenceError`].
pub fn sample<S: ContinuousSystem>(
    system: &S,
    start: &State<S::Group>,
    times: &[f64],
    tolerance: Tolerance,
) -> Result<Vec<State<S::Group>>, ReferenceError> {
    let mut states = Vec::with_capacity(times.len());
    let mut last = start.clone();
    for &t in times {
        last = integrate(system, &last, t, tolerance)?;
        states.push(last.clone());
    }
    Ok(states)
}

/// The motion of a system as [`integrate`] finds it, anew from the start at every call.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference<S: ContinuousSystem> {
    /// The system.
    pub system: S,
    /// The state at its own time.
    pub start: State<S::Group>,
    /// Of the steps.
    pub tolerance: Tolerance,
}

impl<S: ContinuousSystem> Solution<S::Group> for Reference<S> {
    fn at(&self, t: f64) -> Result<State<S::Group>, ProblemError> {
        Ok(integrate(&self.system, &self.start, t, self.tolerance)?)
    }
}

fn check<S: ContinuousSystem>(
    system: &S,
    start: &State<S::Group>,
    until: f64,
) -> Result<(), ReferenceError> {
    if !system.fits(&start.g) || !start.mu.same_shape(&start.g.zero_dual()) {
        return Err(ReferenceError::Misfit);
    }
    match [start.t, until].into_iter().find(|t| !t.is_finite()) {
        Some(t) => Err(ReferenceError::Time { t }),
        None => Ok(()),
    }
}

/// The chart at a state, and storage for the right-hand side.
struct Chart<'a, S: ContinuousSystem> {
    system: &'a S,
    state: State<S::Group>,
    workspace: S::Workspace<f64>,
    c: <S::Group as LieGroup>::Algebra,
    xi: <S::Group as LieGroup>::Algebra,
    mu: <S::Group as LieGroup>::Dual,
    tau: <S::Group as LieGroup>::Dual,
}

impl<'a, S: ContinuousSystem> Chart<'a, S> {
    fn new(system: &'a S, start: &State<S::Group>) -> Self {
        Self {
            system,
            workspace: system.workspace::<f64>(&start.g),
            c: start.g.zero_algebra(),
            xi: start.g.zero_algebra(),
            mu: start.mu.clone(),
            tau: start.g.zero_dual(),
            state: start.clone(),
        }
    }

    /// Runs one segment of at most `length`, s, towards `until`, and says how long the next one may be.
    fn advance(
        &mut self,
        until: f64,
        mut length: f64,
        tolerance: Tolerance,
    ) -> Result<f64, ReferenceError> {
        let mut halvings = 0;
        loop {
            let left = until - self.state.t;
            // A remainder of rounding would be a segment of its own.
            let last = length >= 0.99 * left.abs();
            let step = if last { left } else { length.copysign(left) };
            match self.segment(step, tolerance) {
                Ok(y) => {
                    let reached = self.rebase(&y, if last { until } else { self.state.t + step });
                    return Ok(step.abs() * (WANTED / reached).min(GROWTH));
                }
                Err(BaselineError::NonFiniteRhs { .. }) if halvings < MAX_HALVINGS => {
                    halvings += 1;
                    length = 0.5 * step.abs();
                }
                Err(source) => {
                    let t = self.state.t;
                    return Err(ReferenceError::Integration { t, source });
                }
            }
        }
    }

    /// The chart's coordinates and the momentum after the time `step`, which may be negative.
    fn segment(&mut self, step: f64, tolerance: Tolerance) -> Result<Vec<f64>, BaselineError> {
        let (start, length, sense) = (self.state.t, step.abs(), step.signum());
        let mut y = vec![0.0; self.c.dim()];
        y.extend(self.state.mu.coordinates());
        let rhs = |s: f64, y: &[f64], dy: &mut [f64]| {
            self.derivative(start + sense * s, y, dy);
            dy.iter_mut().for_each(|rate| *rate *= sense);
        };
        let run = baseline::integrate(Pair::DormandPrince853, rhs, &y, length, length, tolerance);
        Ok(run?.y.pop().unwrap_or(y))
    }

    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        let (c, mu) = y.split_at(self.c.dim());
        self.c.read(c);
        self.mu.read(mu);
        if self.c.max_magnitude() > CHART {
            dy.fill(f64::NAN);
            return;
        }
        let g = self.state.g.compose(&S::Group::exp(&self.c));
        let (xi, tau) = (&mut self.xi, &mut self.tau);
        self.system
            .velocity_and_force::<f64>(t, &g, &self.mu, &mut self.workspace, xi, tau);
        tau.add_scaled(1.0, &S::Group::coadjoint_bracket(xi, &self.mu));
        let (dc, dmu) = dy.split_at_mut(self.c.dim());
        S::Group::d_left_inv::<Exp>(&self.c, xi).write(dc);
        tau.write(dmu);
    }

    /// Moves the chart to where the segment ended, and says how far that was in the old one.
    fn rebase(&mut self, y: &[f64], t: f64) -> f64 {
        let (c, mu) = y.split_at(self.c.dim());
        self.c.read(c);
        self.state.mu.read(mu);
        self.state.g = self.state.g.compose(&S::Group::exp(&self.c));
        self.state.g.normalize();
        self.state.t = t;
        self.c.max_magnitude()
    }
}
