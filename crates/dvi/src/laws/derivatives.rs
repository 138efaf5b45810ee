//! The derivatives of a discrete Lagrangian, and its value against the continuous one.

use lie::laws::Report;
use lie::{LieGroup, VectorSpace};

use super::compare::{ROUNDING, extent, on_each};
use super::cyclic;
use super::displacements::{Displacements, displacements};
use super::verdict::{LawError, Outcome};
use crate::{Context, Derivatives, DiscreteLagrangian, Lagrangian, State};

/// Half-width of a central difference of order 4, relative to the displacement: $\varepsilon^{1/5}$ balances rounding against truncation.
const WIDTH: f64 = 7e-4;
/// Roundings that a central difference may gather.
const DIFFERENCES: f64 = 30.0;
/// Step sizes at which the value is compared with the continuous one, s.
const SHRINKING: [f64; 2] = [1e-3, 1e-4];

pub(super) fn check<L: DiscreteLagrangian>(
    c: &mut Report,
    lagrangian: &L,
    state: &State<L::Group>,
    h: f64,
) -> Outcome {
    let Displacements { each, size } = displacements(lagrangian, state, h);
    let width = WIDTH * size.min(1.0);
    for f in each {
        against_the_value(c, lagrangian, (state, &f, h), width)?;
        if lagrangian.is_symmetric() {
            symmetric(c, lagrangian, state, &f, h)?;
        }
    }
    Ok(())
}

fn against_the_value<L: DiscreteLagrangian>(
    c: &mut Report,
    lagrangian: &L,
    (state, f, h): (&State<L::Group>, &L::Group, f64),
    width: f64,
) -> Outcome {
    let State { t, g, .. } = state;
    let case = || format!("t = {t:?}, g = {g:?}, f = {f:?}, h = {h:?}");
    let at = Context::new(*t, lagrangian.parameters());
    let (mut given, mut duals) = (Derivatives::new(g), Derivatives::new(g));
    lagrangian.derivatives(at, g, f, h, &mut Default::default(), &mut given);
    duals.by_jets(lagrangian, at, g, f, h);
    let value = lagrangian.value(at, g, f, h).abs();
    let sizes = [value, duals.d_f.max_magnitude(), duals.d_g.max_magnitude()];
    let size = sizes.iter().fold(0.0, |a: f64, b| a.max(*b));
    cyclic::check(c, lagrangian, (state, f, h), &given, size)?;
    let tolerance = ROUNDING * size;
    let formula = "d_f = T*L_f D_f L_d, by duals";
    c.within(formula, &case, (&given.d_f, &duals.d_f), tolerance)?;
    let formula = "d_g = T*L_g D_g L_d, by duals";
    c.within(formula, &case, (&given.d_g, &duals.d_g), tolerance)?;

    let moved = |g: &L::Group, i: usize, s: f64| {
        let mut eta = g.zero_algebra();
        eta.set(i, s);
        g.compose(&L::Group::exp(&eta))
    };
    // Rounding of the value, and of what is moved.
    let rounding = |x: &L::Group| DIFFERENCES * f64::EPSILON / width * size * extent(x);
    for i in 0..given.d_f.dim() {
        let along_f = |s| lagrangian.value(at, g, &moved(f, i, s), h);
        let (slope, truncation) = difference(width, &along_f);
        let formula = "d_f = T*L_f D_f L_d, by central differences";
        let sides = (given.d_f.get(i), slope);
        c.number(formula, &case, i, sides, rounding(f) + truncation)?;
        let along_g = |s| lagrangian.value(at, &moved(g, i, s), f, h);
        let (slope, truncation) = difference(width, &along_g);
        let formula = "d_g = T*L_g D_g L_d, by central differences";
        let sides = (given.d_g.get(i), slope);
        c.number(formula, &case, i, sides, rounding(g) + truncation)?;
    }
    Ok(())
}

/// The central difference of order 4 at half the width, and a bound on its truncation: its change from that at the whole.
fn difference(width: f64, value: &dyn Fn(f64) -> f64) -> (f64, f64) {
    let slope = |w: f64| {
        let [a, b, p, q] = [-2.0, -1.0, 1.0, 2.0].map(|k| value(k * w));
        (8.0 * (p - b) - (q - a)) / (12.0 * w)
    };
    let fine = slope(0.5 * width);
    (fine, (slope(width) - fine).abs())
}

fn symmetric<L: DiscreteLagrangian>(
    c: &mut Report,
    lagrangian: &L,
    state: &State<L::Group>,
    f: &L::Group,
    h: f64,
) -> Outcome {
    let State { t, g, .. } = state;
    let case = || format!("t = {t:?}, g = {g:?}, f = {f:?}, h = {h:?}");
    let at = Context::new(*t, lagrangian.parameters());
    let forth = lagrangian.value(at, g, f, h);
    let back = -lagrangian.value(at.at(t + h), &g.compose(f), &f.inverse(), -h);
    let mut derivatives = Derivatives::new(g);
    derivatives.by_jets(lagrangian, at, g, f, h);
    let size = forth.abs() + derivatives.d_f.max_magnitude();
    let formula = "L_d(t, g, f, h) = -L_d(t + h, g f, f^-1, -h)";
    Ok(c.number(formula, &case, 0, (forth, back), ROUNDING * size)?)
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
        let xi = continuous.hamiltonian().velocity(state);
        let expected = continuous.value(Context::new(*t, continuous.parameters()), g, &xi);
        let at = Context::new(*t, discrete.parameters());
        let mean = |h: f64| {
            let mut step = xi.zero_like();
            step.add_scaled(h, &xi);
            discrete.value(at, g, &D::Group::exp(&step), h) / h
        };
        let [far, near] = SHRINKING.map(mean);
        let kinetic = D::Group::pair(&state.mu, &xi).abs();
        // An error of the order of h falls by the ratio of the two, ten; half of that is asked for.
        let size = expected.abs() + kinetic;
        let tolerance = (far - expected).abs() / 5.0 + ROUNDING * size / SHRINKING[1];
        let case = || format!("{state:?}, xi = {xi:?}, h = {:?}", SHRINKING[1]);
        let formula = "L_d(g, exp(h xi), h) / h = L(g, xi) + O(h)";
        Ok(c.number(formula, &case, 0, (near, expected), tolerance)?)
    })
}
