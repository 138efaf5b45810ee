//! Invariance of a discrete Lagrangian, and the momentum map that follows.

use lie::laws::Report;
use lie::{LieGroup, VectorSpace};

use super::compare::{ROUNDING, extent, on_each};
use super::cyclic;
use super::displacements::displacements;
use super::steps::take;
use super::verdict::{LawError, Outcome};
use crate::system::generator;
use crate::{Context, Derivatives, DiscreteLagrangian, State, Symmetry, Variational, momentum_map};

/// Parameters at which the invariance is tried.
const PARAMETERS: [f64; 2] = [0.7, -1.3];
/// Steps over which the momentum map is followed.
const STEPS: u32 = 100;

/// Checks that $L_d$ is invariant under a symmetry, and that its momentum map is constant over a hundred steps of size `h`.
///
/// # Errors
/// [`LawError`] with the first law that fails.
pub fn check_symmetry<L: DiscreteLagrangian>(
    lagrangian: &L,
    symmetry: &impl Symmetry<L::Group>,
    states: &[State<L::Group>],
    h: f64,
) -> Result<Report, LawError> {
    on_each(states, |c, state| {
        cyclic::exist(lagrangian, &state.g)?;
        invariance(c, lagrangian, symmetry, state, h)?;
        momentum(c, lagrangian, symmetry, state, h)
    })
}

fn invariance<L: DiscreteLagrangian>(
    c: &mut Report,
    lagrangian: &L,
    symmetry: &impl Symmetry<L::Group>,
    state: &State<L::Group>,
    h: f64,
) -> Outcome {
    let State { t, g, .. } = state;
    let at = Context::new(*t, lagrangian.parameters());
    for f in displacements(lagrangian, state, h).each {
        let here = lagrangian.value(at, g, &f, h);
        let mut derivatives = Derivatives::new(g);
        derivatives.by_jets(lagrangian, at, g, &f, h);
        let size = here.abs() + derivatives.d_f.max_magnitude() + derivatives.d_g.max_magnitude();
        for s in PARAMETERS {
            let act = |g: &L::Group| symmetry.act::<f64>(s, g);
            let moved = act(g);
            let moved_f = moved.inverse().compose(&act(&g.compose(&f)));
            let there = lagrangian.value(at, &moved, &moved_f, h);
            let case = || format!("t = {t:?}, g = {g:?}, f = {f:?}, h = {h:?}, parameter {s:?}");
            let formula = "L_d(a g, (a g)^-1 a (g f)) = L_d(g, f)";
            let tolerance = ROUNDING * size * extent(&moved);
            c.number(formula, &case, 0, (there, here), tolerance)?;
        }
    }
    Ok(())
}

fn momentum<L: DiscreteLagrangian>(
    c: &mut Report,
    lagrangian: &L,
    symmetry: &impl Symmetry<L::Group>,
    state: &State<L::Group>,
    h: f64,
) -> Outcome {
    let (mut now, mut integrator) = (state.clone(), Variational::new(lagrangian));
    let start = momentum_map(symmetry, &state.g, &state.mu);
    let solved = take(&mut integrator, &mut now, (h, STEPS))?;
    let end = momentum_map(symmetry, &now.g, &now.mu);
    let zeta = generator(symmetry, &now.g).max_magnitude();
    let size = now.mu.max_magnitude() * zeta * now.mu.dim() as f64 * extent(&now.g);
    // A random walk of rounding, and what each step's residual may add.
    let steps = f64::from(STEPS);
    let tolerance = (10.0 * f64::EPSILON * steps.sqrt() + steps * solved) * size;
    let case = || format!("{state:?}, h = {h:?}, after {STEPS} steps");
    let formula = "<mu, g^-1 d/ds a_s g> is constant";
    Ok(c.number(formula, &case, 0, (end, start), tolerance)?)
}
