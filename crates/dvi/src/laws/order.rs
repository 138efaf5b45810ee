//! The observed order of a method.

use lie::{RealGroup, VectorSpace};

use super::compare::difference;
use super::steps::take;
use super::verdict::LawError;
use crate::numerics::numbers::larger;
use crate::{Integrator, State};

/// Errors below this many roundings, which grow as a random walk, are those of the plateau.
const PLATEAU: f64 = 1e3 * f64::EPSILON;
/// How far the observed order may be from the declared one.
const TOLERANCE: f64 = 0.1;

/// The observed order of a method.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Order {
    /// The slope of the line through $(\log h, \log \text{error})$, by least squares.
    pub slope: f64,
    /// The step sizes, in seconds, and errors that the fit took: those above the plateau of rounding.
    pub errors: Vec<(f64, f64)>,
}

/// Measures the order: the error at `start.t + until` against the number of steps.
///
/// The error of a run is its distance from the run of twice as many steps, which falls with the same order;
/// distances are the larger of $|\log(g_a^{-1} g_b)|$ and $|\mu_a - \mu_b| / |\mu_a|$.
///
/// # Errors
/// [`LawError::TooFewRuns`] where fewer than two runs have errors above rounding; [`LawError::Step`].
pub fn observed_order<I: Integrator>(
    integrator: impl Fn() -> I,
    start: &State<I::Group>,
    until: f64,
    steps: &[u32],
) -> Result<Order, LawError> {
    let run = |steps: u32| -> Result<State<I::Group>, LawError> {
        let (mut state, mut integrator) = (start.clone(), integrator());
        take(
            &mut integrator,
            &mut state,
            (until / f64::from(steps), steps),
        )?;
        Ok(state)
    };
    let (mut all, mut errors) = (Vec::new(), Vec::new());
    for &n in steps {
        let h = until / f64::from(n);
        let error = distance(&run(n)?, &run(n.saturating_mul(2))?);
        all.push((h, error));
        // What is not a number is no plateau, and spoils the fit.
        if error.is_nan() || error > PLATEAU * f64::from(n).sqrt() {
            errors.push((h, error));
        }
    }
    if errors.len() < 2 {
        return Err(LawError::TooFewRuns { errors: all });
    }
    Ok(Order {
        slope: slope(&errors),
        errors,
    })
}

/// Checks that the observed order is within 0.1 of the declared one; see [`observed_order`].
///
/// # Errors
/// [`LawError::Order`] where it is not, and as [`observed_order`].
pub fn check_order<I: Integrator>(
    integrator: impl Fn() -> I,
    start: &State<I::Group>,
    until: f64,
    steps: &[u32],
) -> Result<Order, LawError> {
    let declared = integrator().order();
    let order = observed_order(integrator, start, until, steps)?;
    if (order.slope - f64::from(declared)).abs() <= TOLERANCE {
        return Ok(order);
    }
    Err(LawError::Order {
        declared,
        observed: order.slope,
        errors: order.errors,
    })
}

/// How far two states are apart: the larger of $|\log(g_a^{-1} g_b)|$ and $|\mu_a - \mu_b| / |\mu_a|$; not a number where one is not.
pub fn distance<G: RealGroup>(a: &State<G>, b: &State<G>) -> f64 {
    let turn = difference(&a.g, &b.g).norm_squared().sqrt();
    let mut momentum = a.mu.clone();
    momentum.add_scaled(-1.0, &b.mu);
    let size = a.mu.norm_squared().max(f64::MIN_POSITIVE);
    larger(turn, (momentum.norm_squared() / size).sqrt())
}

fn slope(errors: &[(f64, f64)]) -> f64 {
    let logs = || errors.iter().map(|(h, error)| (h.ln(), error.ln()));
    let n = errors.len() as f64;
    let (x, y) = logs().fold((0.0, 0.0), |(x, y), (h, e)| (x + h / n, y + e / n));
    let centred = logs().map(|(h, e)| (h - x, e - y));
    let (xy, xx) = centred.fold((0.0, 0.0), |(xy, xx), (h, e)| (xy + h * e, xx + h * h));
    xy / xx
}
