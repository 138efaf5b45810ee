//! What a long run keeps.

use dvi::{Integrator, Lagrangian, State, StepError, Symmetry, momentum_map};
use lie::{RealGroup, VectorSpace};
use sim::{Clock, Run};

use super::slope;
use crate::problems::Problem;

/// What was seen of a long run.
#[derive(Debug, Clone, PartialEq)]
pub struct LongRun {
    /// Times, s, and errors of the energy, relative to the energy at the start.
    pub energy: Vec<(f64, f64)>,
    /// The largest magnitude among them.
    pub band: f64,
    /// Their slope over time, 1/s, by least squares.
    pub drift: f64,
    /// Of each momentum map $\langle\mu, \zeta\rangle$ the largest change, relative to the largest $|\mu| |\zeta|$ of the run: the
    /// size of the terms that its value is a sum of.
    pub momenta: Vec<f64>,
    /// The largest residual that a step was accepted with, relative to the momentum.
    pub residual: f64,
}

/// Takes `steps` steps of `h` seconds from the problem's start, and looks at every `every`-th state.
///
/// # Errors
/// [`StepError`].
pub fn long_run<L, X>(
    problem: &Problem<L, X>,
    integrator: &mut impl Integrator<Group = L::Group>,
    h: f64,
    steps: u32,
    every: u32,
) -> Result<LongRun, StepError>
where
    L: Lagrangian,
{
    let (steps, every) = (u64::from(steps), u64::from(every.max(1)));
    let start = problem.start.clone();
    let (initial, momenta) = (problem.energy(&start), problem.momenta(&start));
    let mut run = Run::new(integrator, start, Clock::counted(steps, h));
    let mut energy = vec![];
    let mut seen = vec![(0.0_f64, 0.0_f64); momenta.len()];
    for look in 1..=steps / every {
        run.advance(look * every)?;
        let state = run.state();
        energy.push((state.t, problem.energy(state) / initial - 1.0));
        for (named, (then, seen)) in problem.symmetries.iter().zip(momenta.iter().zip(&mut seen)) {
            let now = momentum_map(&named.symmetry, &state.g, &state.mu);
            seen.0 = seen.0.max((now - then).abs());
            seen.1 = seen.1.max(terms(&named.symmetry, state));
        }
    }
    run.advance(steps)?;
    Ok(LongRun {
        band: energy
            .iter()
            .fold(0.0, |band, (_, error)| error.abs().max(band)),
        drift: slope(&energy),
        energy,
        momenta: seen.iter().map(|(change, size)| change / size).collect(),
        residual: run.cost().residual,
    })
}

/// $|\mu| |\zeta|$, with $\zeta$ the generator at this state.
fn terms<G: RealGroup>(symmetry: &impl Symmetry<G>, state: &State<G>) -> f64 {
    let mut unit = state.g.zero_dual();
    let mut square = 0.0;
    for i in 0..unit.dim() {
        unit.set_zero();
        unit.set(i, 1.0);
        square += momentum_map(symmetry, &state.g, &unit).powi(2);
    }
    (state.mu.norm_squared() * square).sqrt()
}
