//! Symmetries and their momentum maps.

use lie::{Jet, LieGroup, Over, RealGroup, Scalar, VectorSpace};

/// A one-parameter group of transformations of the configurations, $g \mapsto \Phi_s(g)$ with $\Phi_0(g) = g$.
///
/// Where a Lagrangian is invariant under it, [`momentum_map`] is constant along the motion (Noether).
pub trait Symmetry<G: RealGroup> {
    /// $\Phi_s(g)$.
    fn act<S: Scalar>(&self, s: S, g: &Over<G, S>) -> Over<G, S>;
}

/// The symmetry $g \mapsto \exp(s \zeta) g$: a motion of space. Its momentum map is $\langle \mu, \mathrm{Ad}_{g^{-1}} \zeta \rangle$.
///
/// ```
/// use dvi::{LeftTranslation, momentum_map};
/// use lie::{Cotangent, LieGroup, SO3, Tangent};
///
/// let (r, mu) = (SO3::exp(&Tangent([0.3, 0.2, -1.0])), Cotangent([1.0, 2.0, 3.0]));
/// let vertical = LeftTranslation(Tangent([0.0, 0.0, 1.0]));
/// assert!((momentum_map(&vertical, &r, &mu) - r.rotate(mu.vec3())[2]).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftTranslation<A>(pub A);

/// The symmetry $g \mapsto g \exp(s \zeta)$: a motion of the body against its frame. Its momentum map is $\langle \mu, \zeta \rangle$.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RightTranslation<A>(pub A);

fn along<G: RealGroup, S: Scalar>(zeta: &G::Algebra, s: S, g: &Over<G, S>) -> Over<G, S> {
    let mut scaled = g.zero_algebra();
    for i in 0..scaled.dim() {
        scaled.set(i, s * S::from_f64(zeta.get(i)));
    }
    Over::<G, S>::exp(&scaled)
}

impl<G: RealGroup> Symmetry<G> for LeftTranslation<G::Algebra> {
    fn act<S: Scalar>(&self, s: S, g: &Over<G, S>) -> Over<G, S> {
        along::<G, S>(&self.0, s, g).compose(g)
    }
}

impl<G: RealGroup> Symmetry<G> for RightTranslation<G::Algebra> {
    fn act<S: Scalar>(&self, s: S, g: &Over<G, S>) -> Over<G, S> {
        g.compose(&along::<G, S>(&self.0, s, g))
    }
}

/// The infinitesimal generator, left-trivialised: $g^{-1} \frac{d}{ds}\vert_{s=0} \Phi_s(g)$.
pub(crate) fn generator<G: RealGroup>(symmetry: &impl Symmetry<G>, g: &G) -> G::Algebra {
    type J = <f64 as Scalar>::Jet;
    let lifted = g.lift::<J>();
    let moved = symmetry.act(J::variable(0.0, 0), &lifted);
    let turn = lifted.inverse().compose(&moved).cayley_inverse();
    let mut zeta = g.zero_algebra();
    for i in 0..zeta.dim() {
        let rate = turn.as_ref().map_or(f64::NAN, |c| c.get(i).partial(0));
        zeta.set(i, rate);
    }
    zeta
}

/// The momentum map $\langle \mu, g^{-1} \frac{d}{ds}\vert_{s=0} \Phi_s(g) \rangle$.
pub fn momentum_map<G: RealGroup>(symmetry: &impl Symmetry<G>, g: &G, mu: &G::Dual) -> f64 {
    G::pair(mu, &generator(symmetry, g))
}
