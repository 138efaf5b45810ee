//! What steps in a chart are made of, against the maps they stand for; and compensated products.

use super::checker::{Report, size};
use super::examples::Examples;
use super::linear::{at_most, generic, scaled, vector_size};
use super::verdict::{Family, Outcome};
use crate::{Cayley, Exp, LieGroup, Retraction, Scalar, VectorSpace};

/// Products of one small displacement, in a row.
const PRODUCTS: u32 = 64;

pub(super) fn check<G: Family>(c: &mut Report, examples: &Examples<G>) -> Outcome {
    for g in examples.elements {
        inverses(c, examples, g)?;
        for xi in &examples.velocities {
            products(c, g, xi)?;
        }
    }
    for xi in &examples.velocities {
        for mu in &examples.momenta {
            ends::<G, Exp>(c, xi, mu)?;
            ends::<G, Cayley>(c, xi, mu)?;
            for eta in examples.given {
                rates::<G, Exp>(c, (xi, mu), eta)?;
                rates::<G, Cayley>(c, (xi, mu), eta)?;
            }
        }
    }
    Ok(())
}

fn inverses<G: LieGroup>(c: &mut Report, examples: &Examples<G>, g: &G) -> Outcome {
    let (case, mut out) = (|| format!("g = {g:?}"), g.compose(g));
    g.inverse_into(&mut out);
    c.elements(
        "inverse_into = inverse",
        &case,
        (&out, &g.inverse()),
        size(g),
    )?;
    for mu in &examples.momenta {
        let case = || format!("g = {g:?}, mu = {mu:?}");
        let mut out = generic(mu, 9.0);
        g.inverse_coadjoint_into(mu, &mut out);
        let sides = (&out, &g.inverse().coadjoint(mu));
        let scale = size(g).powi(2) * vector_size(mu);
        c.vectors("inverse_coadjoint_into = Ad*_(g^-1)", &case, sides, scale)?;
    }
    Ok(())
}

/// One product after another, and the same in one.
fn products<G: LieGroup>(c: &mut Report, g: &G, xi: &G::Algebra) -> Outcome {
    let case = || format!("g = {g:?}, xi = {xi:?}");
    let whole = at_most(xi, 0.5);
    let part = G::exp(&scaled(&whole, 1.0 / f64::from(PRODUCTS)));
    let (mut advanced, mut carry) = (g.clone(), g.zero_carry());
    for _ in 0..PRODUCTS {
        advanced.advance(&part, &mut carry);
    }
    let formula = "advance by exp(xi/n), n times = g exp(xi)";
    // One factor again and again rounds in one direction, where nothing compensates.
    let scale = size(g).powi(2) * f64::from(PRODUCTS);
    c.elements(
        formula,
        &case,
        (&advanced, &g.compose(&G::exp(&whole))),
        scale,
    )
}

fn ends<G: LieGroup, R: Retraction>(c: &mut Report, xi: &G::Algebra, mu: &G::Dual) -> Outcome {
    let case = || format!("{}, c = {xi:?}, momentum {mu:?}", R::NAME);
    let scale = vector_size(xi).powi(3) * vector_size(mu);
    let element = G::retract::<R>(xi);
    let mut f = element.compose(&element);
    let (mut out, mut pi) = (generic(mu, 9.0), generic(mu, 9.0));
    G::chart_enter_into::<R>(xi, mu, (&mut f, &mut out));
    c.elements("chart_enter_into: f = tau(c)", &case, (&f, &element), scale)?;
    let sides = (&out, &G::d_left_inv_dual::<R>(xi, mu));
    c.vectors(
        "chart_enter_into: mu = (dtau^-1_c)* pi",
        &case,
        sides,
        scale,
    )?;

    let mut f = element.compose(&element);
    G::chart_leave_into::<R>(xi, mu, (&mut f, &mut out, &mut pi));
    c.elements("chart_leave_into: f = tau(c)", &case, (&f, &element), scale)?;
    let moved = element.coadjoint(mu);
    let scale = scale * vector_size(xi);
    c.vectors(
        "chart_leave_into: mu = Ad*_f P",
        &case,
        (&out, &moved),
        scale,
    )?;
    let sides = (&pi, &G::d_left_dual::<R>(xi, &moved));
    c.vectors("chart_leave_into: pi = (dtau_c)* mu", &case, sides, scale)
}

fn rates<G: LieGroup, R: Retraction>(
    c: &mut Report,
    (xi, mu): (&G::Algebra, &G::Dual),
    eta: &G::Algebra,
) -> Outcome {
    let case = || format!("{}, c = {xi:?}, pi = {mu:?}, xi = {eta:?}", R::NAME);
    let scale = vector_size(xi).powi(4) * vector_size(mu) * vector_size(eta);
    // A force that is no multiple of the momentum.
    let tau = generic(mu, 0.3);
    let (mut c_dot, mut pi_dot) = (generic(eta, 9.0), generic(mu, 9.0));
    G::chart_rates_into::<R>((xi, mu), (eta, &tau), (&mut c_dot, &mut pi_dot));
    let sides = (&c_dot, &G::d_left_inv::<R>(xi, eta));
    c.vectors("chart_rates_into: c' = dtau^-1_c xi", &case, sides, scale)?;
    let mut expected = G::d_left_dual::<R>(xi, &tau);
    let minus = G::Scalar::from_f64(-1.0);
    expected.add_scaled(minus, &G::d_left_inv_gradient::<R>(xi, mu, eta));
    let formula = "chart_rates_into: pi' = (dtau_c)* tau - d/dc <pi, dtau^-1_c xi>";
    c.vectors(formula, &case, (&pi_dot, &expected), scale)
}
