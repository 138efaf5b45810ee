//! The adjoint of a discrete Lagrangian.

use lie::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, Scalar, VectorSpace};

use super::context::{Adapter, Context, System};
use super::discrete::{Derivatives, DiscreteLagrangian};
use super::state::Still;

/// The adjoint of a discrete Lagrangian, $L_d^\ast(t, g, f, h) = -L_d(t + h, g f, f^{-1}, -h)$.
///
/// Its step of $h$ is the inverse of the other's step of $-h$; what looked at the start of the step looks at its end.
///
/// ```
/// use dvi::{Adjoint, Context, DiscreteLagrangian, Lagrangian, Quadrature, System};
/// use lie::{Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg on a spring of 1 N/m.
/// #[derive(Clone, Copy)]
/// struct Spring;
///
/// impl System for Spring {
///     type Group = Rn<1>;
/// }
///
/// impl Lagrangian for Spring {
///     fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         (v[0] * v[0] - x.0[0] * x.0[0]) * S::from_f64(0.5)
///     }
/// }
///
/// let (at, x, f) = (Context::new(0.0, &[]), Rn([1.0]), Rn([0.25]));
/// let adjoint = Adjoint(Spring.discretise(Quadrature::LeftPoint)).value(at, &x, &f, 0.5);
/// assert_eq!(adjoint, Spring.discretise(Quadrature::RightPoint).value(at, &x, &f, 0.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adjoint<L>(pub L);

/// Storage for a step seen from its other end.
struct Ends<G: RealGroup, S: Scalar> {
    /// $g f$.
    end: Over<G, S>,
    /// $f^{-1}$.
    back: Over<G, S>,
    momentum: DualOver<G, S>,
}

/// Storage of an [`Adjoint`]: that of the other, and for the step seen from its end.
pub struct AdjointWorkspace<L: DiscreteLagrangian, S: Scalar> {
    other: L::Workspace<S>,
    ends: Option<Ends<L::Group, S>>,
}

impl<L: DiscreteLagrangian, S: Scalar> Default for AdjointWorkspace<L, S> {
    fn default() -> Self {
        Self {
            other: Default::default(),
            ends: None,
        }
    }
}

impl<L: System> Adapter for Adjoint<L> {
    type Inner = L;

    fn inner(&self) -> &L {
        &self.0
    }
}

impl<L: DiscreteLagrangian> DiscreteLagrangian for Adjoint<L> {
    type Workspace<S: Scalar> = AdjointWorkspace<L, S>;

    const HAS_INERTIA: bool = L::HAS_INERTIA;

    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
    ) -> S {
        -self
            .0
            .value(at.at(at.t + h), &g.compose(f), &f.inverse(), -h)
    }

    /// With $d_f$, $d_g$ of the other at its own arguments: $d_f^\ast = \mathrm{Ad}^\ast_f d_f - d_g$ and $d_g^\ast = -\mathrm{Ad}^\ast_{f^{-1}} d_g$.
    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
        work: &mut AdjointWorkspace<L, S>,
        out: &mut Derivatives<L::Group, S>,
    ) {
        let Ends {
            end,
            back,
            momentum,
        } = work.ends.get_or_insert_with(|| Ends {
            end: g.clone(),
            back: g.clone(),
            momentum: g.zero_dual(),
        });
        g.compose_into(f, end);
        f.inverse_into(back);
        let at_end = at.at(at.t + h);
        out.find(&self.0, at_end, (end, back), -h, &mut work.other);
        f.coadjoint_into(&out.d_f, momentum);
        momentum.add_scaled(-S::one(), &out.d_g);
        core::mem::swap(&mut out.d_f, momentum);
        f.inverse_coadjoint_into(&out.d_g, momentum);
        core::mem::swap(&mut out.d_g, momentum);
        out.d_g.scale(-S::one());
    }

    fn is_defined(&self, t: f64, g: &L::Group, still: &Still<L::Group>) -> bool {
        self.0.is_defined(t, g, still)
    }
    fn order(&self) -> u32 {
        self.0.order()
    }
    fn is_symmetric(&self) -> bool {
        self.0.is_symmetric()
    }

    /// What acts at the start of the other's step acts at the end of this one: nothing of it is in the equations.
    fn factorise(&self, (t, _): (f64, f64), g: &L::Group, work: &mut AdjointWorkspace<L, f64>) {
        self.0.factorise((t, 0.0), g, &mut work.other);
    }
    fn solve(
        &self,
        work: &mut AdjointWorkspace<L, f64>,
        mu: &DualOver<L::Group, f64>,
        xi: &mut AlgebraOver<L::Group, f64>,
    ) {
        self.0.solve(&mut work.other, mu, xi);
    }
    fn solve_cyclic(
        &self,
        work: &mut AdjointWorkspace<L, f64>,
        mu: &DualOver<L::Group, f64>,
        xi: &mut AlgebraOver<L::Group, f64>,
    ) {
        self.0.solve_cyclic(&mut work.other, mu, xi);
    }
}
