//! The group axioms, the forms that write in place, and the way back to the group.

use super::checker::{Report, size};
use super::examples::Examples;
use super::linear::{at_most, generic, zero};
use super::verdict::{Family, Outcome};
use crate::{Jet, LieGroup, Over, Scalar, Units, VectorSpace};

pub(super) fn check<G: Family>(c: &mut Report, examples: &Examples<G>) -> Outcome {
    for g in examples.elements {
        zeros(c, g)?;
        units(c, g)?;
        conversions(c, g)?;
        for h in examples.elements {
            for k in examples.elements {
                associativity(c, g, h, k)?;
            }
            in_place(c, g, h)?;
        }
    }
    // Only now: that an element is back on the group shows by the axioms.
    examples.elements.iter().try_for_each(|g| normalize(c, g))
}

fn zeros<G: LieGroup>(c: &mut Report, g: &G) -> Outcome {
    let (algebra, dual, case) = (g.zero_algebra(), g.zero_dual(), || format!("g = {g:?}"));
    let sides = (&algebra, &zero(&algebra));
    c.vectors("zero_algebra = 0", &case, sides, 1.0)?;
    c.vectors("zero_dual = 0", &case, (&dual, &zero(&dual)), 1.0)?;
    let named: usize = Units::of(g).blocks().map(|(block, _)| block.len()).sum();
    let sides = [named, dual.dim()].map(|n| G::Scalar::from_f64(n as f64));
    let formula = "units name as many coordinates as there are";
    c.numbers(formula, &case, (&sides[..1], &sides[1..]), 0.5)
}

fn units<G: LieGroup>(c: &mut Report, g: &G) -> Outcome {
    let (e, case, scale) = (g.identity_like(), || format!("g = {g:?}"), size(g).powi(2));
    c.elements("g e = g", &case, (&g.compose(&e), g), scale)?;
    c.elements("e g = g", &case, (&e.compose(g), g), scale)?;
    let inverse = g.inverse();
    c.elements("g g^-1 = e", &case, (&g.compose(&inverse), &e), scale)?;
    c.elements("g^-1 g = e", &case, (&inverse.compose(g), &e), scale)
}

fn associativity<G: LieGroup>(c: &mut Report, g: &G, h: &G, k: &G) -> Outcome {
    let case = || format!("g = {g:?}, h = {h:?}, k = {k:?}");
    let scale = size(g) * size(h) * size(k);
    let (left, right) = (g.compose(h).compose(k), g.compose(&h.compose(k)));
    c.elements("(g h) k = g (h k)", &case, (&left, &right), scale)
}

fn in_place<G: LieGroup>(c: &mut Report, g: &G, h: &G) -> Outcome {
    let (case, product) = (|| format!("g = {g:?}, h = {h:?}"), g.compose(h));
    let mut out = other_than(&product);
    g.compose_into(h, &mut out);
    let scale = (size(g) * size(h)).powi(2);
    c.elements("compose_into = compose", &case, (&out, &product), scale)
}

fn conversions<G: Family>(c: &mut Report, g: &G) -> Outcome {
    let (case, scale) = (|| format!("g = {g:?}"), size(g).powi(2));
    let same = G::convert::<G::Scalar, G::Scalar>(g, |x| x);
    c.elements("convert(g, x -> x) = g", &case, (&same, g), scale)?;
    let mut out = other_than(g);
    G::convert_into::<G::Scalar, G::Scalar>(g, |x| x, &mut out);
    c.elements("convert_into = convert", &case, (&out, g), scale)?;

    type JetOf<G> = <<G as LieGroup>::Scalar as Scalar>::Jet;
    let lifted: Over<G, JetOf<G>> = G::convert(g, JetOf::<G>::constant);
    let mut out = other_than(&lifted);
    G::convert_into::<G::Scalar, JetOf<G>>(g, Jet::constant, &mut out);
    let formula = "convert_into = convert, to duals";
    c.elements(formula, &case, (&out, &lifted), scale)
}

/// An element that differs from $g$ in every factor.
pub(super) fn other_than<G: LieGroup>(g: &G) -> G {
    g.compose(&G::exp(&at_most(&generic(&g.zero_algebra(), 1.5), 0.5)))
}

/// $g$ with its numbers moved by $\delta = \frac12 \sqrt\varepsilon$, normalised, is on the group up to
/// $\delta^2 = \frac14 \varepsilon$, which is rounding; not normalised, or the wrong way, it is off by $\delta$.
///
/// Where any numbers make an element ($\mathbb{R}^n$), normalising need not do anything.
fn normalize<G: Family>(c: &mut Report, g: &G) -> Outcome {
    let case = || format!("g = {g:?}");
    let normal = normalized(g);
    c.elements("normalize g = g", &case, (&normal, g), size(g).powi(2))?;

    let delta = G::Scalar::from_f64(0.5 * G::Scalar::EPSILON.sqrt());
    let p = G::convert::<G::Scalar, G::Scalar>(g, |x| x + x * x * delta);
    let (p, e) = (normalized(&p), g.identity_like());
    let case = || format!("p = normalize {p:?}, from {g:?} moved by delta");
    let scale = size(&p).powi(2);
    let formula = "normalize(normalize p) = normalize p + O(delta^2)";
    c.elements(formula, &case, (&normalized(&p), &p), scale)?;
    let formula = "p p^-1 = e + O(delta^2) for p normalised";
    c.elements(formula, &case, (&p.compose(&p.inverse()), &e), scale)
}

fn normalized<G: LieGroup>(g: &G) -> G {
    let mut normal = g.clone();
    normal.normalize();
    normal
}
