//! The laws that differentiate, by dual numbers and by central differences.

use super::checker::{Report, difference_tolerance, log_of};
use super::examples::Examples;
use super::linear::{filled, scaled, sum, vector_size, zero};
use super::verdict::{Family, Outcome};
use crate::{AlgebraOver, Cayley, Exp, Jet, LieGroup, Over, Retraction, Scalar, VectorSpace};

pub(super) fn check<G: Family>(c: &mut Report, examples: &Examples<G>) -> Outcome {
    let (shape, velocities) = (examples.shape(), &examples.velocities);
    for eta in velocities {
        identity_at_zero::<G, Exp>(c, eta)?;
        identity_at_zero::<G, Cayley>(c, eta)?;
    }
    for xi in velocities {
        for eta in velocities {
            bracket_is_the_derivative_of_adjoint(c, shape, xi, eta)?;
            retraction_laws::<G, Exp>(c, shape, xi, eta)?;
            retraction_laws::<G, Cayley>(c, shape, xi, eta)?;
        }
    }
    Ok(())
}

fn identity_at_zero<G: LieGroup, R: Retraction>(c: &mut Report, eta: &G::Algebra) -> Outcome {
    let sides = (&G::d_left::<R>(&zero(eta), eta), eta);
    let case = || format!("{}, eta = {eta:?}", R::NAME);
    c.vectors("dtau_0 eta = eta", &case, sides, vector_size(eta))
}

fn bracket_is_the_derivative_of_adjoint<G: Family>(
    c: &mut Report,
    shape: &G,
    xi: &G::Algebra,
    eta: &G::Algebra,
) -> Outcome {
    let case = || format!("xi = {xi:?}, eta = {eta:?}");
    let (bracket, scale) = (G::bracket(xi, eta), vector_size(xi) * vector_size(eta));
    let line = line::<G>(shape, &zero(xi), xi);
    let moved = Over::<G, JetOf<G>>::exp(&line).adjoint(&constant::<G>(shape, eta));
    let formula = "ad_xi eta = d/ds Ad_exp(s xi) eta, by duals";
    c.vectors(formula, &case, (&bracket, &partial::<G>(xi, &moved)), scale)?;

    let s = step::<G>();
    let at = |s: f64| G::exp(&scaled(xi, s)).adjoint(eta);
    let difference = central(&at(s), &at(-s), s);
    let tolerance = difference_tolerance::<G::Scalar>(scale * vector_size(xi).powi(2));
    let formula = "ad_xi eta = d/ds Ad_exp(s xi) eta, by differences";
    c.within(formula, &case, (&bracket, &difference), tolerance)
}

fn retraction_laws<G: Family, R: Retraction>(
    c: &mut Report,
    shape: &G,
    xi: &G::Algebra,
    eta: &G::Algebra,
) -> Outcome {
    let case = || format!("{}, xi = {xi:?}, eta = {eta:?}", R::NAME);
    let scale = vector_size(xi).powi(3) * vector_size(eta);
    let (left, right) = (G::d_left::<R>(xi, eta), G::d_right::<R>(xi, eta));

    let base = lifted::<G>(&G::retract::<R>(xi));
    let moved = Over::<G, JetOf<G>>::retract::<R>(&line::<G>(shape, xi, eta));
    let by_dual = partial::<G>(xi, &log_of(&base.inverse().compose(&moved)));
    let formula = "dtau_xi eta = tau(-xi) d/ds tau(xi + s eta), by duals";
    c.vectors(formula, &case, (&left, &by_dual), scale)?;
    let by_dual = partial::<G>(xi, &log_of(&moved.compose(&base.inverse())));
    let formula = "dtau^R_xi eta = d/ds tau(xi + s eta) tau(-xi), by duals";
    c.vectors(formula, &case, (&right, &by_dual), scale)?;

    let s = step::<G>() / vector_size(eta);
    let base = G::retract::<R>(xi).inverse();
    let at = |s: f64| log_of(&base.compose(&G::retract::<R>(&sum(xi, &scaled(eta, s)))));
    let by_difference = central(&at(s), &at(-s), s);
    let tolerance = difference_tolerance::<G::Scalar>(scale * vector_size(eta));
    let formula = "dtau_xi eta = tau(-xi) d/ds tau(xi + s eta), by differences";
    c.within(formula, &case, (&left, &by_difference), tolerance)?;

    let back = G::d_left::<R>(xi, &G::d_left_inv::<R>(xi, eta));
    c.vectors("dtau_xi dtau^-1_xi eta = eta", &case, (&back, eta), scale)?;
    let back = G::d_right::<R>(xi, &G::d_right_inv::<R>(xi, eta));
    let formula = "dtau^R_xi (dtau^R_xi)^-1 eta = eta";
    c.vectors(formula, &case, (&back, eta), scale)
}

pub(super) type JetOf<G> = <<G as LieGroup>::Scalar as Scalar>::Jet;

/// $\xi + s \eta$ with the dual variable $s$ at zero.
pub(super) fn line<G: Family>(
    shape: &G,
    xi: &G::Algebra,
    eta: &G::Algebra,
) -> AlgebraOver<G, JetOf<G>> {
    let mut line = constant::<G>(shape, xi);
    let s = JetOf::<G>::variable(G::Scalar::from_f64(0.0), 0);
    line.add_scaled(s, &constant::<G>(shape, eta));
    line
}

pub(super) fn constant<G: Family>(shape: &G, xi: &G::Algebra) -> AlgebraOver<G, JetOf<G>> {
    filled(&lifted(shape).zero_algebra(), &|i| Jet::constant(xi.get(i)))
}

fn lifted<G: Family>(g: &G) -> Over<G, JetOf<G>> {
    G::convert::<G::Scalar, JetOf<G>>(g, Jet::constant)
}

/// The derivative along $s$.
pub(super) fn partial<G: LieGroup>(
    shape: &G::Algebra,
    x: &impl VectorSpace<Scalar = JetOf<G>>,
) -> G::Algebra {
    filled(shape, &|i| x.get(i).partial(0))
}

/// The step that balances truncation and rounding of central differences.
pub(super) fn step<G: LieGroup>() -> f64 {
    G::Scalar::EPSILON.cbrt()
}

pub(super) fn central<V: VectorSpace>(plus: &V, minus: &V, s: f64) -> V {
    scaled(&sum(plus, &scaled(minus, -1.0)), 0.5 / s)
}
