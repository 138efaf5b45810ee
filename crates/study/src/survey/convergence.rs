//! The order of a method against a known state.

use dvi::laws::distance;
use dvi::{Integrator, State, StepError};
use sim::{Clock, Run};

use super::slope;
use crate::problems::ProblemError;

/// Why a problem could not be measured.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SurveyError {
    /// The problem could not be posed, or its solution not be evaluated.
    #[error("the problem has no solution to compare with")]
    Problem(#[from] ProblemError),
    /// A step was refused.
    #[error("a step was refused")]
    Step(#[from] StepError),
}

/// Errors at one time as the step shrinks.
#[derive(Debug, Clone, PartialEq)]
pub struct Convergence {
    /// Step sizes, s, and errors of all runs: the larger of the distance of the configurations and of the momenta,
    /// $|\log(g^{-1} g_\mathrm{exact})|$ and $|\mu - \mu_\mathrm{exact}| / |\mu_\mathrm{exact}|$.
    pub errors: Vec<(f64, f64)>,
    /// The slope of $\log \text{error}$ over $\log h$, by least squares, of the errors above the plateau.
    pub order: f64,
}

/// Runs from `start` to the time of `exact` in each of these numbers of steps; errors below `plateau` are rounding.
///
/// # Errors
/// [`StepError`].
pub fn convergence<I: Integrator>(
    integrator: impl Fn() -> I,
    start: &State<I::Group>,
    exact: &State<I::Group>,
    steps: &[u32],
    plateau: f64,
) -> Result<Convergence, StepError> {
    let run = |&steps: &u32| {
        let h = (exact.t - start.t) / f64::from(steps);
        let clock = Clock::counted(steps.into(), h);
        let mut run = Run::new(integrator(), start.clone(), clock);
        run.advance(clock.steps())?;
        Ok((h, distance(exact, run.state())))
    };
    let errors: Vec<(f64, f64)> = steps.iter().map(run).collect::<Result<_, StepError>>()?;
    let above = errors.iter().filter(|(_, error)| *error > plateau);
    let logs: Vec<_> = above.map(|(h, error)| (h.ln(), error.ln())).collect();
    let order = slope(&logs);
    Ok(Convergence { errors, order })
}
