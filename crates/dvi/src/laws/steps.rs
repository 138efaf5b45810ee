//! What a step of an integrator must be: solved, symplectic, reversible.

use lie::laws::Report;
use lie::{LieGroup, VectorSpace};

use super::compare::{ROUNDING, difference, extent, on_each};
use super::displacements::size;
use super::verdict::{LawError, Outcome};
use crate::numerics::numbers::larger;
use crate::{
    DiscreteLagrangian, FirstVariation, Integrator, State, StepError, Variation, legendre_minus,
    legendre_plus, symplectic_form,
};

/// Checks that steps of an integrator solve the equations of this discrete Lagrangian.
///
/// With $f_k = g_k^{-1} g_{k+1}$, both discrete Legendre transforms must give the momenta of the trajectory,
/// $\mathbb F^- L_d(g_k, f_k) = \mu_k$ and $\mathbb F^+ L_d(g_k, f_k) = \mu_{k+1}$. An integrator that derives its momentum
/// anew by one of them meets that one whatever $f_k$, and fails the other where the step is not solved.
///
/// # Errors
/// [`LawError`] with the first state where it fails.
pub fn check_step<I, L>(
    integrator: &mut I,
    lagrangian: &L,
    states: &[State<L::Group>],
    h: f64,
) -> Result<Report, LawError>
where
    I: Integrator<Group = L::Group>,
    L: DiscreteLagrangian,
{
    on_each(states, |c, state| {
        legendre(c, integrator, lagrangian, state, h)
    })
}

pub(super) fn legendre<I, L>(
    c: &mut Report,
    integrator: &mut I,
    lagrangian: &L,
    state: &State<L::Group>,
    h: f64,
) -> Outcome
where
    I: Integrator<Group = L::Group>,
    L: DiscreteLagrangian,
{
    let mut next = state.clone();
    integrator.step(&mut next, h)?;
    let case = || format!("{state:?}, h = {h:?}");
    let f = state.g.inverse().compose(&next.g);
    let minus = legendre_minus(lagrangian, state.t, &state.g, &f, h);
    let plus = legendre_plus(lagrangian, state.t, &state.g, &f, h);
    let size = state.mu.max_magnitude().max(next.mu.max_magnitude());
    // The displacement is read off two configurations: their rounding is divided by the step.
    let tolerance = ROUNDING * size + stiffness(lagrangian, state, &f, h) * f64::EPSILON;
    let formula = "F^- L_d (g_k, f_k) = mu_k";
    c.within(formula, &case, (&minus, &state.mu), tolerance)?;
    let formula = "F^+ L_d (g_k, f_k) = mu_(k+1)";
    Ok(c.within(formula, &case, (&plus, &next.mu), tolerance)?)
}

/// How the momentum answers to rounding in the displacement, from the sizes of its coordinates.
fn stiffness<L: DiscreteLagrangian>(
    lagrangian: &L,
    state: &State<L::Group>,
    f: &L::Group,
    h: f64,
) -> f64 {
    /// This part of the displacement is far from rounding, and small.
    const SMALL: f64 = 1e-6;
    let base = legendre_plus(lagrangian, state.t, &state.g, f, h);
    let small = SMALL * size(f, h);
    let slope = |i: usize| {
        let mut zeta = state.g.zero_algebra();
        zeta.set(i, small);
        let f = f.compose(&L::Group::exp(&zeta));
        let mut mu = legendre_plus(lagrangian, state.t, &state.g, &f, h);
        mu.add_scaled(-1.0, &base);
        mu.max_magnitude() / small
    };
    let steepest = (0..base.dim()).map(slope).fold(0.0, f64::max);
    10.0 * steepest * extent(&state.g)
}

/// The largest defect of the symplectic form over one step, relative to the momentum:
/// $|\omega(\mathrm dF a, \mathrm dF b) - \omega(a, b)| / |\mu|$ over unit variations, those of the momentum in units of $|\mu|$.
///
/// # Errors
/// As [`step`](Integrator::step).
pub fn symplectic_defect<I: FirstVariation>(
    integrator: &mut I,
    state: &State<I::Group>,
    h: f64,
) -> Result<f64, LawError> {
    let mut worst = 0.0_f64;
    for_each_pair(integrator, state, h, |_, (before, after)| {
        worst = larger(worst, (after - before).abs());
        Ok(())
    })?;
    Ok(worst)
}

/// Checks that steps preserve the symplectic form to rounding; see [`symplectic_defect`].
///
/// # Errors
/// [`LawError`] with the first state where it fails; the component is `2 dim G` times the first variation's index plus the second's.
pub fn check_symplecticity<I: FirstVariation>(
    integrator: &mut I,
    states: &[State<I::Group>],
    h: f64,
) -> Result<Report, LawError> {
    on_each(states, |c, state| symplecticity(c, integrator, state, h))
}

pub(super) fn symplecticity<I: FirstVariation>(
    c: &mut Report,
    integrator: &mut I,
    state: &State<I::Group>,
    h: f64,
) -> Outcome {
    for_each_pair(integrator, state, h, |pair, (before, after)| {
        let case = || format!("{state:?}, h = {h:?}");
        let formula = "omega(dF a, dF b) = omega(a, b)";
        Ok(c.number(formula, &case, pair, (after, before), ROUNDING)?)
    })
}

/// Visits all pairs of unit variations with the form before and after a step, both relative to the momentum.
fn for_each_pair<I: FirstVariation>(
    integrator: &mut I,
    state: &State<I::Group>,
    h: f64,
    mut visit: impl FnMut(usize, (f64, f64)) -> Outcome,
) -> Outcome {
    let mut before = Variation::basis(&state.g);
    let size = match state.mu.norm_squared().sqrt() {
        0.0 => 1.0,
        size => size,
    };
    let half = before.len() / 2;
    for unit in &mut before[half..] {
        let dual = unit.mu.clone();
        unit.mu.set_sum(&dual, size - 1.0, &dual);
    }
    let (mut next, mut after) = (state.clone(), before.clone());
    integrator.step_varied(&mut next, &mut after, h)?;
    for (i, a) in before.iter().enumerate() {
        for (j, b) in before.iter().enumerate().skip(i + 1) {
            let start = symplectic_form(&state.mu, a, b) / size;
            let end = symplectic_form(&next.mu, &after[i], &after[j]) / size;
            visit(i * before.len() + j, (start, end))?;
        }
    }
    Ok(())
}

/// Checks that a step of $-h$ undoes a step of $h$.
///
/// # Errors
/// [`LawError`] with the first state where it fails.
pub fn check_reversibility<I: Integrator>(
    integrator: &mut I,
    states: &[State<I::Group>],
    h: f64,
) -> Result<Report, LawError> {
    on_each(states, |c, state| reversibility(c, integrator, state, h))
}

pub(super) fn reversibility<I: Integrator>(
    c: &mut Report,
    integrator: &mut I,
    state: &State<I::Group>,
    h: f64,
) -> Outcome {
    let mut there = state.clone();
    integrator.step(&mut there, h)?;
    // A body at rest has a momentum only in between.
    let size = state.mu.max_magnitude().max(there.mu.max_magnitude());
    integrator.step(&mut there, -h)?;
    let case = || format!("{state:?}, h = {h:?}");
    let (turn, zero) = (difference(&state.g, &there.g), state.g.zero_algebra());
    let reach = extent(&state.g);
    let formula = "g after h and -h = g";
    c.within(formula, &case, (&turn, &zero), ROUNDING * reach)?;
    let formula = "mu after h and -h = mu";
    Ok(c.within(formula, &case, (&there.mu, &state.mu), ROUNDING * size)?)
}

/// Takes so many steps; the largest of their residuals.
pub(super) fn take<I: Integrator>(
    integrator: &mut I,
    state: &mut State<I::Group>,
    (h, steps): (f64, u32),
) -> Result<f64, StepError> {
    (0..steps).try_fold(0.0, |worst, _| {
        let report = integrator.step(state, h)?;
        Ok(larger(worst, report.residual))
    })
}
