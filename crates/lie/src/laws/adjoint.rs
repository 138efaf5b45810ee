//! The adjoint action, the bracket, and their transposes.

use super::checker::{Report, by_pairing, size, tolerance};
use super::examples::Examples;
use super::linear::{generic, scaled, sum, vector_size};
use super::verdict::Outcome;
use crate::{LieGroup, Scalar, VectorSpace};

pub(super) fn check<G: LieGroup>(c: &mut Report, examples: &Examples<G>) -> Outcome {
    for g in examples.elements {
        for xi in &examples.velocities {
            for h in examples.elements {
                homomorphism(c, g, h, xi)?;
            }
            conjugation(c, g, xi)?;
        }
        coadjoint(c, g, examples)?;
    }
    for xi in &examples.velocities {
        pairing::<G>(c, xi, examples)?;
        coadjoint_bracket::<G>(c, xi, examples)?;
        for eta in &examples.velocities {
            antisymmetry::<G>(c, xi, eta)?;
        }
    }
    for xi in examples.given {
        for eta in examples.given {
            for zeta in &examples.velocities {
                jacobi::<G>(c, xi, eta, zeta)?;
            }
        }
    }
    Ok(())
}

fn homomorphism<G: LieGroup>(c: &mut Report, g: &G, h: &G, xi: &G::Algebra) -> Outcome {
    let case = || format!("g = {g:?}, h = {h:?}, xi = {xi:?}");
    let scale = (size(g) * size(h)).powi(2) * vector_size(xi);
    let (left, right) = (g.compose(h).adjoint(xi), g.adjoint(&h.adjoint(xi)));
    c.vectors("Ad_gh xi = Ad_g Ad_h xi", &case, (&left, &right), scale)
}

fn conjugation<G: LieGroup>(c: &mut Report, g: &G, xi: &G::Algebra) -> Outcome {
    let case = || format!("g = {g:?}, xi = {xi:?}");
    let scale = size(g).powi(2) * vector_size(xi);
    let left = G::exp(&g.adjoint(xi));
    let right = g.compose(&G::exp(xi)).compose(&g.inverse());
    let formula = "exp(Ad_g xi) = g exp(xi) g^-1";
    c.elements(formula, &case, (&left, &right), scale)
}

/// By the pairing with the whole basis, which leaves a dual vector no freedom.
fn coadjoint<G: LieGroup>(c: &mut Report, g: &G, examples: &Examples<G>) -> Outcome {
    let images: Vec<_> = examples.basis.iter().map(|e| g.adjoint(e)).collect();
    for mu in &examples.momenta {
        let (case, moved) = (|| format!("g = {g:?}, mu = {mu:?}"), g.coadjoint(mu));
        let scale = size(g).powi(2) * vector_size(mu);
        let sides = (&moved, &by_pairing::<G>(mu, &images));
        c.vectors("<Ad*_g mu, xi> = <mu, Ad_g xi>", &case, sides, scale)?;
        let mut out = sum(&moved, &generic(mu, 1.5));
        g.coadjoint_into(mu, &mut out);
        c.vectors("coadjoint_into = coadjoint", &case, (&out, &moved), scale)?;
    }
    Ok(())
}

fn coadjoint_bracket<G: LieGroup>(
    c: &mut Report,
    xi: &G::Algebra,
    examples: &Examples<G>,
) -> Outcome {
    let images: Vec<_> = examples.basis.iter().map(|e| G::bracket(xi, e)).collect();
    for mu in &examples.momenta {
        let case = || format!("xi = {xi:?}, mu = {mu:?}");
        let scale = vector_size(xi) * vector_size(mu);
        let sides = (&G::coadjoint_bracket(xi, mu), &by_pairing::<G>(mu, &images));
        c.vectors("<ad*_xi mu, eta> = <mu, ad_xi eta>", &case, sides, scale)?;
    }
    Ok(())
}

fn pairing<G: LieGroup>(c: &mut Report, xi: &G::Algebra, examples: &Examples<G>) -> Outcome {
    for mu in &examples.momenta {
        let zero = G::Scalar::from_f64(0.0);
        let products = (0..xi.dim()).map(|i| mu.get(i) * xi.get(i));
        let sides = (
            &[G::pair(mu, xi)][..],
            &[products.fold(zero, |sum, x| sum + x)][..],
        );
        let case = || format!("mu = {mu:?}, xi = {xi:?}");
        let scale = vector_size(xi) * vector_size(mu) * xi.dim() as f64;
        let tolerance = tolerance::<G::Scalar>(scale);
        c.numbers("<mu, xi> = sum of mu_i xi_i", &case, sides, tolerance)?;
    }
    Ok(())
}

fn antisymmetry<G: LieGroup>(c: &mut Report, xi: &G::Algebra, eta: &G::Algebra) -> Outcome {
    let case = || format!("xi = {xi:?}, eta = {eta:?}");
    let scale = vector_size(xi) * vector_size(eta);
    let (left, right) = (G::bracket(xi, eta), scaled(&G::bracket(eta, xi), -1.0));
    c.vectors("[xi, eta] = -[eta, xi]", &case, (&left, &right), scale)
}

fn jacobi<G: LieGroup>(
    c: &mut Report,
    xi: &G::Algebra,
    eta: &G::Algebra,
    zeta: &G::Algebra,
) -> Outcome {
    let case = || format!("xi = {xi:?}, eta = {eta:?}, zeta = {zeta:?}");
    let scale = vector_size(xi) * vector_size(eta) * vector_size(zeta);
    let b = |x: &G::Algebra, y: &G::Algebra| G::bracket(x, y);
    let cyclic = sum(&b(xi, &b(eta, zeta)), &b(eta, &b(zeta, xi)));
    let minus_last = scaled(&b(zeta, &b(xi, eta)), -1.0);
    let formula = "[xi,[eta,zeta]] + [eta,[zeta,xi]] + [zeta,[xi,eta]] = 0";
    c.vectors(formula, &case, (&cyclic, &minus_last), scale)
}
