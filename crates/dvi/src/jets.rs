//! Dual copies of group elements, moved along the basis of the algebra in chunks.

use lie::{AlgebraOver, Cayley, Jet, LieGroup, Over, RealGroup, Scalar, VectorSpace};
use num_traits::Zero;

/// Calls `body` with the first direction of every chunk.
#[inline(always)]
pub(crate) fn for_each_chunk(dim: usize, body: impl FnMut(usize)) {
    (0..dim).step_by(lie::JET_DIRECTIONS).for_each(body);
}

/// Copies the derivatives of a chunk into the coordinates from `first` on; where there is no value, these are not numbers either: that of a
/// logarithm is finite where its value is not.
#[inline(always)]
pub(crate) fn read_partials<V: VectorSpace>(
    out: &mut V,
    first: usize,
    value: impl Jet<Value = V::Scalar>,
) {
    let end = out.dim().min(first + lie::JET_DIRECTIONS);
    let poison = value.value() * V::Scalar::zero();
    for i in first..end {
        out.set(i, value.partial(i - first) + poison);
    }
}

/// $x \leftarrow x + y$ for a `y` that is not differentiated.
#[inline(always)]
pub(crate) fn add_constant<V, W>(x: &mut V, y: &W)
where
    V: VectorSpace<Scalar: Jet<Value = W::Scalar>>,
    W: VectorSpace,
{
    for i in 0..x.dim() {
        x.set(i, x.get(i) + V::Scalar::constant(y.get(i)));
    }
}

/// An element of `G` over the duals of `S`.
type Moved<G, S> = Over<G, <S as Scalar>::Jet>;

/// $g$ and $f$ over the duals of `S`, with room for the moved one.
pub(crate) struct Lifted<G: RealGroup, S: Scalar> {
    g: Moved<G, S>,
    f: Moved<G, S>,
    zeta: AlgebraOver<G, S::Jet>,
    small: Moved<G, S>,
    moved: Moved<G, S>,
}

impl<G: RealGroup, S: Scalar> Lifted<G, S> {
    pub(crate) fn new(g: &Over<G, S>) -> Self {
        let g = G::convert::<S, S::Jet>(g, Jet::constant);
        let zeta = g.zero_algebra();
        Self {
            f: g.clone(),
            small: g.clone(),
            moved: g.clone(),
            g,
            zeta,
        }
    }

    pub(crate) fn g(&self) -> &Moved<G, S> {
        &self.g
    }

    pub(crate) fn zero_algebra(&self) -> AlgebraOver<G, S::Jet> {
        self.g.zero_algebra()
    }

    pub(crate) fn set(&mut self, g: &Over<G, S>, f: &Over<G, S>) {
        self.set_g(g);
        G::convert_into::<S, S::Jet>(f, Jet::constant, &mut self.f);
    }

    pub(crate) fn set_g(&mut self, g: &Over<G, S>) {
        G::convert_into::<S, S::Jet>(g, Jet::constant, &mut self.g);
    }

    /// $(g, f \exp\zeta)$ with the directions from `first` on; to first order, any retraction is the exponential.
    pub(crate) fn moving_f(&mut self, first: usize) -> (&Moved<G, S>, &Moved<G, S>) {
        self.step_along(first);
        self.f.compose_into(&self.small, &mut self.moved);
        (&self.g, &self.moved)
    }

    /// $(g \exp\eta, f)$, likewise.
    pub(crate) fn moving_g(&mut self, first: usize) -> (&Moved<G, S>, &Moved<G, S>) {
        self.step_along(first);
        self.g.compose_into(&self.small, &mut self.moved);
        (&self.moved, &self.f)
    }

    /// $g \exp\eta$ alone.
    pub(crate) fn moved_g(&mut self, first: usize) -> &Moved<G, S> {
        self.moving_g(first).0
    }

    fn step_along(&mut self, first: usize) {
        lie::seed(&mut self.zeta, first);
        Over::<G, S::Jet>::retract_into::<Cayley>(&self.zeta, &mut self.small);
    }
}
