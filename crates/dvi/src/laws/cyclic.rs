//! Whether the coordinates that are declared cyclic are.

use lie::laws::Report;
use lie::{LieGroup, VectorSpace};

use super::compare::{ROUNDING, extent};
use super::verdict::{LawError, Outcome};
use crate::{Context, Derivatives, DiscreteLagrangian, State};

/// How far the configuration is moved along them.
const SHIFTS: [f64; 2] = [0.7, -1.3];

/// Whether the group has such coordinates; to be asked before any step is solved.
pub(super) fn exist<L: DiscreteLagrangian>(lagrangian: &L, g: &L::Group) -> Outcome {
    let (cyclic, dimension) = (lagrangian.cyclic(), g.zero_algebra().dim());
    if cyclic.is_empty() || cyclic.end <= dimension {
        return Ok(());
    }
    Err(LawError::Cyclic { cyclic, dimension })
}

/// Compares with what does not depend on them, for the displacement `f` and sizes of the terms up to `size`.
pub(super) fn check<L: DiscreteLagrangian>(
    c: &mut Report,
    lagrangian: &L,
    (state, f, h): (&State<L::Group>, &L::Group, f64),
    given: &Derivatives<L::Group, f64>,
    size: f64,
) -> Outcome {
    let State { t, g, .. } = state;
    let at = Context::new(*t, lagrangian.parameters());
    let here = lagrangian.value(at, g, f, h);
    for i in lagrangian.cyclic() {
        let case = || format!("t = {t:?}, g = {g:?}, f = {f:?}, h = {h:?}");
        let mut unit = g.zero_algebra();
        unit.set(i, 1.0);
        let formula = "Ad_f e = e along cyclic(), a factor R^m of a direct product";
        c.within(formula, &case, (&f.adjoint(&unit), &unit), ROUNDING)?;
        for shift in SHIFTS {
            unit.set(i, shift);
            let moved = g.compose(&L::Group::exp(&unit));
            let there = lagrangian.value(at, &moved, f, h);
            let case = || format!("{}, moved by {shift:?}", case());
            let formula = "L_d(g exp(s e), f) = L_d(g, f) along cyclic()";
            let tolerance = ROUNDING * size * extent(&moved);
            c.number(formula, &case, i, (there, here), tolerance)?;
        }
        let formula = "d_g = 0 along cyclic()";
        c.number(formula, &case, i, (given.d_g.get(i), 0.0), ROUNDING * size)?;
    }
    Ok(())
}
