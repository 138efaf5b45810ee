//! The derivatives of a discrete Lagrangian, and its value against the continuous one.

use lie::{LieGroup, VectorSpace};

use super::compare::{Checker, ROUNDING, on_each};
use super::{LawError, Outcome, Report};
use crate::{Derivatives, DiscreteLagrangian, HamiltonianSystem, Lagrangian, State};

/// Half-width of the central difference of order 4: $\varepsilon^{1/5}$ balances rounding against truncation.
const WIDTH: f64 = 7e-4;
/// Roundings and truncations that a central difference may gather.
const DIFFERENCES: f64 = 30.0;
/// Step sizes at which the value is compared with the continuous one, s.
const SHRINKING: [f64; 2] = [1e-3, 1e-4];

/// The displacements that formulas are tried on: no coordinate zero, no two alike, of both signs.
pub(super) fn displacements<G: lie::RealGroup>(g: &G) -> [G; 2] {
    [0.11, -0.07].map(|size| {
        let mut c = g.zero_algebra();
        for i in 0..c.dim() {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            c.set(i, sign * size * (1.0 + 0.2 * i as f64));
        }
        G::exp(&c)
    })
}

pub(super) fn check<L: DiscreteLagrangian>(
    c: &mut Checker,
    lagrangian: &L,
    state: &State<L::Group>,
    h: f64,
) -> Outcome {
    for f in displacements(&state.g) {
        against_the_value(c, lagrangian, state, &f, h)?;
        if lagrangian.is_symmetric() {
            symmetric(c, lagrangian, state, &f, h)?;
        }
    }
    Ok(())
}

fn against_the_value<L: DiscreteLagrangian>(
    c: &mut Checker,
    lagrangian: &L,
    state: &State<L::Group>,
    f: &L::Group,
    h: f64,
) -> Outcome {
    let State { t, g, .. } = state;
    let case = || format!("t = {t:?}, g = {g:?}, f = {f:?}, h = {h:?}");
    let (mut given, mut duals) = (Derivatives::new(g), Derivatives::new(g));
    lagrangian.derivatives(*t, g, f, h, &mut given);
    duals.by_jets(lagrangian, *t, g, f, h);
    let value = lagrangian.value_at(*t, g, f, h).abs();
    let sizes = [value, duals.d_f.max_magnitude(), duals.d_g.max_magnitude()];
    let tolerance = ROUNDING * sizes.iter().fold(0.0, |a: f64, b| a.max(*b));
    let formula = "d_f = T*L_f D_f L_d, by duals";
    c.vectors(formula, case, (&given.d_f, &duals.d_f), tolerance)?;
    let formula = "d_g = T*L_g D_g L_d, by duals";
    c.vectors(formula, case, (&given.d_g, &duals.d_g), tolerance)?;

    let moved = |g: &L::Group, i: usize, s: f64| {
        let mut eta = g.zero_algebra();
        eta.set(i, s);
        g.compose(&L::Group::exp(&eta))
    };
    for i in 0..given.d_f.dim() {
        let along_f = |s| lagrangian.value_at(*t, g, &moved(f, i, s), h);
        let formula = "d_f = T*L_f D_f L_d, by central differences";
        difference(c, formula, case, i, (given.d_f.get(i), &along_f))?;
        let along_g = |s| lagrangian.value_at(*t, &moved(g, i, s), f, h);
        let formula = "d_g = T*L_g D_g L_d, by central differences";
        difference(c, formula, case, i, (given.d_g.get(i), &along_g))?;
    }
    Ok(())
}

/// Compares a derivative with $\left(8 (v_1 - v_{-1}) - (v_2 - v_{-2})\right) / 12 w$.
fn difference(
    c: &mut Checker,
    formula: &'static str,
    case: impl Fn() -> String,
    component: usize,
    (derivative, value): (f64, &dyn Fn(f64) -> f64),
) -> Outcome {
    let [a, b, o, p, q] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| value(k * WIDTH));
    let slope = (8.0 * (p - b) - (q - a)) / (12.0 * WIDTH);
    let curvature = ((p - o) - (o - b)).abs() / WIDTH.powi(2);
    let size = o.abs() + slope.abs() + curvature;
    let tolerance = DIFFERENCES * (f64::EPSILON / WIDTH + WIDTH.powi(4)) * size;
    c.number(formula, case, component, (derivative, slope), tolerance)
}

fn symmetric<L: DiscreteLagrangian>(
    c: &mut Checker,
    lagrangian: &L,
    state: &State<L::Group>,
    f: &L::Group,
    h: f64,
) -> Outcome {
    let State { t, g, .. } = state;
    let case = || format!("t = {t:?}, g = {g:?}, f = {f:?}, h = {h:?}");
    let forth = lagrangian.value_at(*t, g, f, h);
    let back = -lagrangian.value_at(t + h, &g.compose(f), &f.inverse(), -h);
    let mut derivatives = Derivatives::new(g);
    derivatives.by_jets(lagrangian, *t, g, f, h);
    let size = forth.abs() + derivatives.d_f.max_magnitude();
    let formula = "L_d(t, g, f, h) = -L_d(t + h, g f, f^-1, -h)";
    c.number(formula, case, 0, (forth, back), ROUNDING * size)
}

/// Checks that $L_d(t, g, \exp(h \xi), h) = h L(t, g, \xi) + O(h^2)$: that the value is the right one.
///
/// The velocities are those of the states. It finds a wrong sign or factor in a discrete Lagrangian written by hand.
///
/// # Errors
/// [`LawError`] with the first state where it fails.
pub fn check_consistency<D, L>(
    discrete: &D,
    continuous: &L,
    states: &[State<D::Group>],
) -> Result<Report, LawError>
where
    D: DiscreteLagrangian,
    L: Lagrangian<Group = D::Group>,
{
    on_each(states, |c, state| {
        let State { t, g, .. } = state;
        let xi = HamiltonianSystem(continuous).velocity(state);
        let expected = continuous.value_at(*t, g, &xi);
        let mean = |h: f64| {
            let mut step = xi.zero_like();
            step.add_scaled(h, &xi);
            discrete.value_at(*t, g, &D::Group::exp(&step), h) / h
        };
        let [far, near] = SHRINKING.map(mean);
        let kinetic = D::Group::pair(&state.mu, &xi).abs();
        // An error of the order of h falls by the ratio of the two, ten; half of that is asked for.
        let size = expected.abs() + kinetic;
        let tolerance = (far - expected).abs() / 5.0 + ROUNDING * size / SHRINKING[1];
        let case = || format!("{state:?}, xi = {xi:?}, h = {:?}", SHRINKING[1]);
        let formula = "L_d(g, exp(h xi), h) / h = L(g, xi) + O(h)";
        c.number(formula, case, 0, (near, expected), tolerance)
    })
}
