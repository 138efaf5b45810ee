//! The transposes of the retractions' differentials, and the gradients of their inverses in the argument.

use super::Outcome;
use super::checker::{Checker, by_pairing, difference_tolerance};
use super::differentials::{JetOf, central, constant, line, partial, step};
use super::examples::Examples;
use super::linear::{scaled, sum, vector_size};
use crate::{Cayley, Exp, LieGroup, Over, Retraction};

pub(super) fn check<G>(c: &mut Checker, examples: &Examples<G>) -> Outcome
where
    G: LieGroup<WithScalar<<G as LieGroup>::Scalar> = G>,
{
    for xi in &examples.velocities {
        transposes::<G, Exp>(c, examples, xi, EXP)?;
        transposes::<G, Cayley>(c, examples, xi, CAYLEY)?;
    }
    for xi in &examples.velocities {
        for eta in &examples.velocities {
            gradients::<G, Exp>(c, examples, xi, eta, EXP)?;
            gradients::<G, Cayley>(c, examples, xi, eta, CAYLEY)?;
        }
    }
    Ok(())
}

/// The formulas, to name them in a failure.
struct Formulas {
    transpose: &'static str,
    inverse_transpose: &'static str,
    gradient_dual: &'static str,
    gradient_difference: &'static str,
}

const EXP: Formulas = Formulas {
    transpose: "<(dexp_xi)* mu, eta> = <mu, dexp_xi eta>",
    inverse_transpose: "<(dexp^-1_xi)* mu, eta> = <mu, dexp^-1_xi eta>",
    gradient_dual: "dexp_inv_gradient = d/dxi <mu, dexp^-1_xi eta>, by duals",
    gradient_difference: "dexp_inv_gradient = d/dxi <mu, dexp^-1_xi eta>, by differences",
};

const CAYLEY: Formulas = Formulas {
    transpose: "<(dcay_xi)* mu, eta> = <mu, dcay_xi eta>",
    inverse_transpose: "<(dcay^-1_xi)* mu, eta> = <mu, dcay^-1_xi eta>",
    gradient_dual: "dcay_inv_gradient = d/dxi <mu, dcay^-1_xi eta>, by duals",
    gradient_difference: "dcay_inv_gradient = d/dxi <mu, dcay^-1_xi eta>, by differences",
};

fn transposes<G: LieGroup, R: Retraction>(
    c: &mut Checker,
    examples: &Examples<G>,
    xi: &G::Algebra,
    formulas: Formulas,
) -> Outcome {
    let basis = &examples.basis;
    let images: Vec<_> = basis.iter().map(|e| R::d_left::<G>(xi, e)).collect();
    let inverse_images: Vec<_> = basis.iter().map(|e| R::d_left_inv::<G>(xi, e)).collect();
    for mu in &examples.momenta {
        let case = || format!("xi = {xi:?}, mu = {mu:?}");
        let scale = vector_size(xi).powi(3) * vector_size(mu);
        let (nu, pairings) = (R::d_left_dual::<G>(xi, mu), by_pairing::<G>(mu, &images));
        c.vectors(formulas.transpose, &case, (&nu, &pairings), scale)?;
        let (nu, pairings) = (
            R::d_left_inv_dual::<G>(xi, mu),
            by_pairing::<G>(mu, &inverse_images),
        );
        c.vectors(formulas.inverse_transpose, &case, (&nu, &pairings), scale)?;
    }
    Ok(())
}

fn gradients<G, R>(
    c: &mut Checker,
    examples: &Examples<G>,
    xi: &G::Algebra,
    eta: &G::Algebra,
    formulas: Formulas,
) -> Outcome
where
    G: LieGroup<WithScalar<<G as LieGroup>::Scalar> = G>,
    R: Retraction,
{
    let along = |e| derivative_by_duals::<G, R>(examples.shape(), xi, eta, e);
    let by_duals: Vec<_> = examples.basis.iter().map(along).collect();
    let along = |e| derivative_by_differences::<G, R>(xi, eta, e);
    let by_differences: Vec<_> = examples.basis.iter().map(along).collect();
    for mu in &examples.momenta {
        let case = || format!("xi = {xi:?}, mu = {mu:?}, eta = {eta:?}");
        let scale = vector_size(xi).powi(3) * vector_size(eta) * vector_size(mu);
        let gradient = R::d_left_inv_gradient::<G>(xi, mu, eta);
        let sides = (&gradient, &by_pairing::<G>(mu, &by_duals));
        c.vectors(formulas.gradient_dual, &case, sides, scale)?;
        let sides = (&gradient, &by_pairing::<G>(mu, &by_differences));
        let tolerance = difference_tolerance::<G::Scalar>(scale);
        c.within(formulas.gradient_difference, &case, sides, tolerance)?;
    }
    Ok(())
}

/// $\frac{d}{ds} \mathrm d\tau_{\xi + s e}^{-1} \eta$ at $s = 0$.
fn derivative_by_duals<G, R>(
    shape: &G,
    xi: &G::Algebra,
    eta: &G::Algebra,
    e: &G::Algebra,
) -> G::Algebra
where
    G: LieGroup<WithScalar<<G as LieGroup>::Scalar> = G>,
    R: Retraction,
{
    let (line, eta) = (line::<G>(shape, xi, e), constant::<G>(shape, eta));
    partial::<G>(xi, &R::d_left_inv::<Over<G, JetOf<G>>>(&line, &eta))
}

/// The same by a central difference.
fn derivative_by_differences<G: LieGroup, R: Retraction>(
    xi: &G::Algebra,
    eta: &G::Algebra,
    e: &G::Algebra,
) -> G::Algebra {
    let s = step::<G>();
    let at = |s: f64| R::d_left_inv::<G>(&sum(xi, &scaled(e, s)), eta);
    central(&at(s), &at(-s), s)
}
