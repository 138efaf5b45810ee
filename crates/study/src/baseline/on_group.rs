//! A reference solution for any continuous system on a Lie group.
//!
//! Hamilton's equations in the chart $g = g_0 \exp(c)$,
//! $$ \dot c = \mathrm d\exp_c^{-1} \xi, \qquad \dot\mu = \mathrm{ad}^\ast_\xi \mu + \tau, $$
//! by the Dormand–Prince pair [8(5,3)](super::Pair::DP853). Where $c$ has grown to one, the chart is moved:
//! $g_0 \leftarrow g_0 \exp(c)$. So the configuration stays on the group, and no formula is shared with a variational method but
//! those of the group and of the system.
//!
//! ```
//! use articulated_fluid::{Scene, scene};
//! use study::baseline::{Tolerance, on_group};
//!
//! let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
//! let (model, start) = (scene.model()?, scene.initial_state()?);
//! let end = on_group::integrate(&model, &start, 1.0, Tolerance::uniform(1e-12))?;
//! assert!(model.orthogonality_error(&end.g) < 1e-14);
//! let (before, after) = (model.conserved(&start)?, model.conserved(&end)?);
//! assert!((after.energy / before.energy - 1.0).abs() < 1e-11);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

use dvi::{Context, ContinuousSystem, State};
use lie::{Exp, LieGroup, VectorSpace};

use super::{BaselineError, Pair, RightHandSide, Tolerance, Trajectory};

/// Coordinates in the chart larger than this are not used; $\mathrm d\exp$ is singular at angles of $2\pi$.
const CHART: f64 = 2.0;
/// The chart is moved after a step to coordinates larger than this.
const LARGE: f64 = 1.0;

/// Why there is no reference solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReferenceError {
    /// The start is no configuration of the system, or its momentum has another shape.
    #[error("the start does not fit the system: give a configuration and a momentum of its size")]
    Misfit,
    /// A time is not finite.
    #[error("the time {t:?} is not finite")]
    Time {
        /// The time given.
        t: f64,
    },
    /// The integration from time `t` on failed; the times in its source count from `t`.
    #[error("the integration failed after t = {t:?}: {source}")]
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
    while chart.state.t != until {
        let t = chart.state.t;
        let advanced = chart.advance(until, tolerance);
        advanced.map_err(|source| ReferenceError::Integration { t, source })?;
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
            workspace: Default::default(),
            c: start.g.zero_algebra(),
            xi: start.g.zero_algebra(),
            mu: start.mu.clone(),
            tau: start.g.zero_dual(),
            state: start.clone(),
        }
    }

    /// Steps towards `until` as long as the chart's coordinates are small, and moves the chart there.
    fn advance(&mut self, until: f64, tolerance: Tolerance) -> Result<(), BaselineError> {
        let (start, way, dim) = (self.state.t, until - self.state.t, self.c.dim());
        let (length, sense) = (way.abs(), way.signum());
        let mut y = vec![0.0; dim];
        y.extend(self.state.mu.coordinates());
        let mut rhs = |s: f64, y: &[f64], dy: &mut [f64]| {
            self.derivative(start + sense * s, y, dy);
            dy.iter_mut().for_each(|rate| *rate *= sense);
        };
        // Its type forgotten, the method is compiled once, and not for every system again.
        let rhs: &mut dyn RightHandSide = &mut rhs;
        let pair = &Pair::DP853;
        let mut trajectory: Trajectory<_> =
            Trajectory::new(pair, rhs, (0.0, &y), length, tolerance)?;
        let mut s = 0.0;
        while s < length && y[..dim].iter().all(|c| c.abs() < LARGE) {
            trajectory.step()?;
            let reached = trajectory.reached();
            s = reached.0;
            y.copy_from_slice(reached.1);
        }
        let t = if s == length {
            until
        } else {
            start + sense * s
        };
        self.rebase(&y, t);
        Ok(())
    }

    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        let (c, mu) = y.split_at(self.c.dim());
        self.c.read(c);
        self.mu.read(mu);
        if !c.iter().all(|c| c.abs() <= CHART) {
            return dy.fill(f64::NAN);
        }
        let g = self.state.g.compose(&S::Group::exp(&self.c));
        let (at, work) = (
            Context::new(t, self.system.parameters()),
            &mut self.workspace,
        );
        let (xi, tau) = (&mut self.xi, &mut self.tau);
        self.system
            .velocity_and_force::<f64>(at, &g, &self.mu, work, xi, tau);
        tau.add_scaled(1.0, &S::Group::coadjoint_bracket(xi, &self.mu));
        let (dc, dmu) = dy.split_at_mut(self.c.dim());
        S::Group::d_left_inv::<Exp>(&self.c, xi).write(dc);
        tau.write(dmu);
    }

    /// Moves the chart.
    fn rebase(&mut self, y: &[f64], t: f64) {
        let (c, mu) = y.split_at(self.c.dim());
        self.c.read(c);
        self.state.mu.read(mu);
        self.state.g = self.state.g.compose(&S::Group::exp(&self.c));
        self.state.g.normalize();
        self.state.t = t;
    }
}
