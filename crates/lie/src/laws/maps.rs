//! The exponential, the Cayley map, and their inverses.

use super::checker::{Report, log_of, size, tolerance};
use super::examples::Examples;
use super::group::other_than;
use super::linear::{at_most, generic, length, scaled, vector_size, zero};
use super::verdict::Outcome;
use crate::{Cayley, Exp, LieGroup, Retraction, Scalar};

pub(super) fn check<G: LieGroup>(c: &mut Report, examples: &Examples<G>) -> Outcome {
    for g in examples.elements {
        inverses_of_an_element(c, g)?;
    }
    for xi in &examples.velocities {
        one_parameter(c, examples.shape(), xi)?;
        near_the_identity::<G>(c, xi)?;
        logarithm_is_shortest::<G>(c, xi)?;
        in_place::<G, Exp>(c, &G::exp(xi), xi)?;
        in_place::<G, Cayley>(c, &G::cayley(xi), xi)?;
    }
    // Only now: it compares logarithms, which are known to be right by the laws before.
    examples.elements.iter().try_for_each(|g| square_root(c, g))
}

fn inverses_of_an_element<G: LieGroup>(c: &mut Report, g: &G) -> Outcome {
    let (case, scale) = (|| format!("g = {g:?}"), size(g).powi(2));
    c.elements("exp(log g) = g", &case, (&G::exp(&log_of(g)), g), scale)?;
    let Ok(xi) = g.cayley_inverse() else {
        return Ok(());
    };
    // Near a half turn the chart's coordinates grow without bound, and their rounding with them.
    let scale = scale * vector_size(&xi);
    c.elements("cay(cay^-1 g) = g", &case, (&G::cayley(&xi), g), scale)
}

fn square_root<G: LieGroup>(c: &mut Report, g: &G) -> Outcome {
    let (case, scale, root) = (|| format!("g = {g:?}"), size(g).powi(2), g.sqrt());
    let sides = (&root.compose(&root), g);
    c.elements("sqrt(g) sqrt(g) = g", &case, sides, scale)?;
    let mut out = other_than(&root);
    g.sqrt_into(&mut out);
    c.elements("sqrt_into = sqrt", &case, (&out, &root), scale)?;
    let Ok(xi) = g.log() else {
        return Ok(());
    };
    let formula = "log(sqrt g) = log(g)/2";
    let log = c.exists(formula, &case, root.log())?;
    c.vectors(formula, &case, (&log, &scaled(&xi, 0.5)), scale)
}

fn one_parameter<G: LieGroup>(c: &mut Report, shape: &G, xi: &G::Algebra) -> Outcome {
    let (case, scale) = (|| format!("xi = {xi:?}"), vector_size(xi).powi(2));
    let (e, none, minus) = (shape.identity_like(), zero(xi), scaled(xi, -1.0));
    c.elements("exp(0) = e", &case, (&G::exp(&none), &e), 1.0)?;
    c.elements("cay(0) = e", &case, (&G::cayley(&none), &e), 1.0)?;

    let (exp, cay) = (G::exp(xi), G::cayley(xi));
    let sides = (&G::exp(&minus), &exp.inverse());
    c.elements("exp(-xi) = exp(xi)^-1", &case, sides, scale)?;
    let sides = (&G::cayley(&minus), &cay.inverse());
    c.elements("cay(-xi) = cay(xi)^-1", &case, sides, scale)?;

    let parts = G::exp(&scaled(xi, 0.25)).compose(&G::exp(&scaled(xi, 0.75)));
    let formula = "exp(s xi) exp(t xi) = exp((s + t) xi)";
    c.elements(formula, &case, (&parts, &exp), scale)
}

/// Both maps have inverses there, and differ by $O(\xi^3)$: for $|\xi| = \varepsilon^{1/3}$ by rounding.
fn near_the_identity<G: LieGroup>(c: &mut Report, xi: &G::Algebra) -> Outcome {
    let short = at_most(xi, 0.5);
    let case = || format!("xi = {short:?}");
    let formula = "log(exp xi) = xi for |xi| <= 1/2";
    let back = c.exists(formula, &case, G::exp(&short).log())?;
    c.vectors(formula, &case, (&back, &short), 1.0)?;
    let formula = "cay^-1(cay xi) = xi for |xi| <= 1/2";
    let back = c.exists(formula, &case, G::cayley(&short).cayley_inverse())?;
    c.vectors(formula, &case, (&back, &short), 1.0)?;

    let tiny = at_most(xi, G::Scalar::EPSILON.cbrt());
    let (case, sides) = (
        || format!("xi = {tiny:?}"),
        (&G::cayley(&tiny), &G::exp(&tiny)),
    );
    c.elements("cay xi = exp xi + O(xi^3)", &case, sides, 1.0)
}

fn logarithm_is_shortest<G: LieGroup>(c: &mut Report, xi: &G::Algebra) -> Outcome {
    let (case, scale) = (|| format!("xi = {xi:?}"), vector_size(xi).powi(2));
    let g = G::exp(xi);
    let log = log_of(&g);
    let sides = (&G::exp(&log), &g);
    c.elements("exp(log(exp xi)) = exp xi", &case, sides, scale)?;
    let (known, found) = (length(xi), length(&log));
    let sides = (&[found.max(known)][..], &[known][..]);
    let tolerance = tolerance::<G::Scalar>(scale);
    c.numbers("|log(exp xi)| <= |xi|", &case, sides, tolerance)
}

fn in_place<G: LieGroup, R: Retraction>(c: &mut Report, element: &G, xi: &G::Algebra) -> Outcome {
    let case = || format!("{}, xi = {xi:?}", R::NAME);
    let mut out = other_than(element);
    G::retract_into::<R>(xi, &mut out);
    let scale = vector_size(xi).powi(2);
    c.elements("retract_into = tau", &case, (&out, element), scale)?;
    let Ok(expected) = element.retract_inverse::<R>() else {
        return Ok(());
    };
    let (mut back, formula) = (generic(xi, 9.0), "retract_inverse_into = tau^-1");
    c.exists(formula, &case, element.retract_inverse_into::<R>(&mut back))?;
    // Near a half turn the chart's coordinates grow without bound, and their rounding with them.
    let scale = vector_size(&expected).powi(2);
    c.vectors(formula, &case, (&back, &expected), scale)
}
