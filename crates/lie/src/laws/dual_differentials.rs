//! The transposes of the retractions' differentials, and the gradients of their inverses in the argument.

use super::checker::{Report, by_pairing, difference_tolerance};
use super::differentials::{JetOf, central, constant, line, partial, step};
use super::examples::Examples;
use super::linear::{scaled, sum, vector_size};
use super::verdict::{Family, Outcome};
use crate::{Cayley, Exp, LieGroup, Over, Retraction};

pub(super) fn check<G: Family>(c: &mut Report, examples: &Examples<G>) -> Outcome {
    for xi in &examples.velocities {
        transposes::<G, Exp>(c, examples, xi)?;
        transposes::<G, Cayley>(c, examples, xi)?;
    }
    for xi in &examples.velocities {
        for eta in &examples.velocities {
            gradients::<G, Exp>(c, examples, xi, eta)?;
            gradients::<G, Cayley>(c, examples, xi, eta)?;
        }
    }
    Ok(())
}

fn transposes<G: LieGroup, R: Retraction>(
    c: &mut Report,
    examples: &Examples<G>,
    xi: &G::Algebra,
) -> Outcome {
    let basis = &examples.basis;
    let images: Vec<_> = basis.iter().map(|e| G::d_left::<R>(xi, e)).collect();
    let inverse_images: Vec<_> = basis.iter().map(|e| G::d_left_inv::<R>(xi, e)).collect();
    for mu in &examples.momenta {
        let case = || format!("{}, xi = {xi:?}, mu = {mu:?}", R::NAME);
        let scale = vector_size(xi).powi(3) * vector_size(mu);
        let (nu, pairings) = (G::d_left_dual::<R>(xi, mu), by_pairing::<G>(mu, &images));
        c.vectors(
            "<(dtau_xi)* mu, eta> = <mu, dtau_xi eta>",
            &case,
            (&nu, &pairings),
            scale,
        )?;
        let (nu, pairings) = (
            G::d_left_inv_dual::<R>(xi, mu),
            by_pairing::<G>(mu, &inverse_images),
        );
        let formula = "<(dtau^-1_xi)* mu, eta> = <mu, dtau^-1_xi eta>";
        c.vectors(formula, &case, (&nu, &pairings), scale)?;
    }
    Ok(())
}

fn gradients<G: Family, R: Retraction>(
    c: &mut Report,
    examples: &Examples<G>,
    xi: &G::Algebra,
    eta: &G::Algebra,
) -> Outcome {
    let along = |e| derivative_by_duals::<G, R>(examples.shape(), xi, eta, e);
    let by_duals: Vec<_> = examples.basis.iter().map(along).collect();
    let along = |e| derivative_by_differences::<G, R>(xi, eta, e);
    let by_differences: Vec<_> = examples.basis.iter().map(along).collect();
    for mu in &examples.momenta {
        let case = || format!("{}, xi = {xi:?}, mu = {mu:?}, eta = {eta:?}", R::NAME);
        let scale = vector_size(xi).powi(3) * vector_size(eta) * vector_size(mu);
        let gradient = G::d_left_inv_gradient::<R>(xi, mu, eta);
        let sides = (&gradient, &by_pairing::<G>(mu, &by_duals));
        let formula = "d_left_inv_gradient = d/dxi <mu, dtau^-1_xi eta>, by duals";
        c.vectors(formula, &case, sides, scale)?;
        let sides = (&gradient, &by_pairing::<G>(mu, &by_differences));
        let tolerance = difference_tolerance::<G::Scalar>(scale);
        let formula = "d_left_inv_gradient = d/dxi <mu, dtau^-1_xi eta>, by differences";
        c.within(formula, &case, sides, tolerance)?;
    }
    Ok(())
}

/// $\frac{d}{ds} \mathrm d\tau_{\xi + s e}^{-1} \eta$ at $s = 0$.
fn derivative_by_duals<G: Family, R: Retraction>(
    shape: &G,
    xi: &G::Algebra,
    eta: &G::Algebra,
    e: &G::Algebra,
) -> G::Algebra {
    let (line, eta) = (line::<G>(shape, xi, e), constant::<G>(shape, eta));
    partial::<G>(xi, &Over::<G, JetOf<G>>::d_left_inv::<R>(&line, &eta))
}

/// The same by a central difference.
fn derivative_by_differences<G: LieGroup, R: Retraction>(
    xi: &G::Algebra,
    eta: &G::Algebra,
    e: &G::Algebra,
) -> G::Algebra {
    let s = step::<G>();
    let at = |s: f64| G::d_left_inv::<R>(&sum(xi, &scaled(e, s)), eta);
    central(&at(s), &at(-s), s)
}
