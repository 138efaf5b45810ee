//! The laws that take no derivative.

use super::{Checker, Outcome, log_of, momentum, scaled, size, sum, vector_size};
use crate::{LieGroup, Scalar, VectorSpace};

pub(super) fn check<G: LieGroup>(
    checker: &mut Checker,
    elements: &[G],
    velocities: &[G::Algebra],
) -> Outcome {
    for g in elements {
        one_element(checker, g)?;
        for h in elements {
            for k in elements {
                associativity(checker, g, h, k)?;
            }
            for xi in velocities {
                adjoint_is_a_homomorphism(checker, g, h, xi)?;
            }
        }
        for xi in velocities {
            conjugation(checker, g, xi)?;
            for eta in velocities {
                coadjoint_pairing(checker, g, xi, eta)?;
            }
        }
    }
    for xi in velocities {
        one_velocity(checker, &elements[0], xi)?;
        for eta in velocities {
            for zeta in velocities {
                bracket_laws::<G>(checker, xi, eta, zeta)?;
            }
        }
    }
    Ok(())
}

fn one_element<G: LieGroup>(c: &mut Checker, g: &G) -> Outcome {
    let (e, case, scale) = (g.identity_like(), || format!("g = {g:?}"), size(g).powi(2));
    c.elements("g e = g", case, &g.compose(&e), g, scale)?;
    c.elements("e g = g", case, &e.compose(g), g, scale)?;
    c.elements("g g^-1 = e", case, &g.compose(&g.inverse()), &e, scale)?;
    c.elements("g^-1 g = e", case, &g.inverse().compose(g), &e, scale)?;
    c.elements("exp(log g) = g", case, &G::exp(&log_of(g)), g, scale)?;
    if let Ok(xi) = g.cayley_inverse() {
        // Near a half turn the chart's coordinates grow without bound, and their rounding with them.
        let scale = scale * vector_size(&xi);
        c.elements("cay(cay^-1 g) = g", case, &G::cayley(&xi), g, scale)?;
    }
    let mut normal = g.clone();
    normal.normalize();
    c.elements("normalize g = g", case, &normal, g, scale)
}

fn associativity<G: LieGroup>(c: &mut Checker, g: &G, h: &G, k: &G) -> Outcome {
    let case = || format!("g = {g:?}, h = {h:?}, k = {k:?}");
    let scale = size(g) * size(h) * size(k);
    let (left, right) = (g.compose(h).compose(k), g.compose(&h.compose(k)));
    c.elements("(g h) k = g (h k)", case, &left, &right, scale)?;
    let mut out = k.clone();
    g.compose_into(h, &mut out);
    c.elements("compose_into = compose", case, &out, &g.compose(h), 1.0)
}

fn adjoint_is_a_homomorphism<G: LieGroup>(
    c: &mut Checker,
    g: &G,
    h: &G,
    xi: &G::Algebra,
) -> Outcome {
    let case = || format!("g = {g:?}, h = {h:?}, xi = {xi:?}");
    let scale = (size(g) * size(h)).powi(2) * vector_size(xi);
    let (left, right) = (g.compose(h).adjoint(xi), g.adjoint(&h.adjoint(xi)));
    c.vectors("Ad_gh xi = Ad_g Ad_h xi", case, &left, &right, scale)
}

fn conjugation<G: LieGroup>(c: &mut Checker, g: &G, xi: &G::Algebra) -> Outcome {
    let case = || format!("g = {g:?}, xi = {xi:?}");
    let scale = size(g).powi(2) * vector_size(xi);
    let right = g.compose(&G::exp(xi)).compose(&g.inverse());
    c.elements(
        "exp(Ad_g xi) = g exp(xi) g^-1",
        case,
        &G::exp(&g.adjoint(xi)),
        &right,
        scale,
    )
}

fn coadjoint_pairing<G: LieGroup>(
    c: &mut Checker,
    g: &G,
    xi: &G::Algebra,
    eta: &G::Algebra,
) -> Outcome {
    let (mu, case) = (momentum(g, eta), || {
        format!("g = {g:?}, xi = {xi:?}, mu from {eta:?}")
    });
    let scale = size(g) * vector_size(xi) * vector_size(eta) * xi.dim() as f64;
    let pair = |mu: &G::Dual, xi: &G::Algebra| crate::Tangent([G::pair(mu, xi)]);
    let moved = g.coadjoint(&mu);
    c.vectors(
        "<Ad*_g mu, xi> = <mu, Ad_g xi>",
        case,
        &pair(&moved, xi),
        &pair(&mu, &g.adjoint(xi)),
        scale,
    )?;
    let (left, right) = (G::coadjoint_bracket(xi, &mu), G::bracket(xi, eta));
    c.vectors(
        "<ad*_xi mu, eta> = <mu, ad_xi eta>",
        case,
        &pair(&left, eta),
        &pair(&mu, &right),
        scale,
    )?;
    let mut out = g.zero_dual();
    g.coadjoint_into(&mu, &mut out);
    c.vectors("coadjoint_into = coadjoint", case, &out, &moved, 1.0)?;
    let zero = G::Scalar::from_f64(0.0);
    let by_coordinates = (0..mu.dim()).fold(zero, |sum, i| sum + mu.get(i) * xi.get(i));
    let formula = "<mu, xi> = sum of mu_i xi_i";
    c.vectors(
        formula,
        case,
        &pair(&mu, xi),
        &crate::Tangent([by_coordinates]),
        scale,
    )
}

fn one_velocity<G: LieGroup>(c: &mut Checker, shape: &G, xi: &G::Algebra) -> Outcome {
    let (e, case, scale) = (
        shape.identity_like(),
        || format!("xi = {xi:?}"),
        vector_size(xi).powi(2),
    );
    let minus = scaled(xi, -1.0);
    c.elements("exp(0) = e", case, &G::exp(&scaled(xi, 0.0)), &e, 1.0)?;
    c.elements(
        "exp(-xi) = exp(xi)^-1",
        case,
        &G::exp(&minus),
        &G::exp(xi).inverse(),
        scale,
    )?;
    c.elements(
        "cay(-xi) = cay(xi)^-1",
        case,
        &G::cayley(&minus),
        &G::cayley(xi).inverse(),
        scale,
    )?;
    let parts = G::exp(&scaled(xi, 0.25)).compose(&G::exp(&scaled(xi, 0.75)));
    c.elements(
        "exp(s xi) exp(t xi) = exp((s + t) xi)",
        case,
        &parts,
        &G::exp(xi),
        scale,
    )?;
    let short = scaled(xi, 0.5 / vector_size(xi));
    c.vectors(
        "log(exp xi) = xi",
        case,
        &log_of(&G::exp(&short)),
        &short,
        1.0,
    )?;
    let (mut by_exp, mut by_cayley) = (e.clone(), e);
    G::exp_into(xi, &mut by_exp);
    G::cayley_into(xi, &mut by_cayley);
    c.elements("exp_into = exp", case, &by_exp, &G::exp(xi), 1.0)?;
    c.elements(
        "cayley_into = cayley",
        case,
        &by_cayley,
        &G::cayley(xi),
        1.0,
    )?;
    let mut coordinates = xi.to_vec();
    let mut copy = xi.zero_like();
    xi.write(&mut coordinates);
    copy.read(&coordinates);
    c.vectors("read(write(xi)) = xi", case, &copy, xi, 1.0)
}

fn bracket_laws<G: LieGroup>(
    c: &mut Checker,
    xi: &G::Algebra,
    eta: &G::Algebra,
    zeta: &G::Algebra,
) -> Outcome {
    let case = || format!("xi = {xi:?}, eta = {eta:?}, zeta = {zeta:?}");
    let scale = vector_size(xi) * vector_size(eta) * vector_size(zeta);
    let b = |x: &G::Algebra, y: &G::Algebra| G::bracket(x, y);
    c.vectors(
        "[xi, eta] = -[eta, xi]",
        case,
        &b(xi, eta),
        &scaled(&b(eta, xi), -1.0),
        scale,
    )?;
    let cyclic = sum(&b(xi, &b(eta, zeta)), &b(eta, &b(zeta, xi)));
    let minus_last = scaled(&b(zeta, &b(xi, eta)), -1.0);
    c.vectors(
        "[xi,[eta,zeta]] + [eta,[zeta,xi]] + [zeta,[xi,eta]] = 0",
        case,
        &cyclic,
        &minus_last,
        scale,
    )
}
