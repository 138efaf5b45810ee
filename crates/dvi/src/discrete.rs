//! The discrete Lagrangian: what an integrator is made of.

use core::fmt::Debug;
use core::ops::Range;

use lie::{DualOver, Jet, LieGroup, Over, RealGroup, Scalar, Vec3, VectorSpace};

use crate::jets::{Lifted, for_each_chunk, read_partials};

/// A discrete Lagrangian $L_d(g_k, f_k)$ with $f_k = g_k^{-1} g_{k+1}$: the action of one step of size $h$.
///
/// Only [`value`](Self::value) is required; write it generic over the scalar and the framework differentiates
/// it by dual numbers. Give [`derivatives`](Self::derivatives) in closed form where speed counts.
///
/// ```
/// use dvi::{DiscreteLagrangian, Variational, Integrator, State};
/// use lie::{Cotangent, Mat3, SO3, Scalar};
///
/// /// A free rigid body with the moments of inertia 1, 2 and 3 kg m²: `tr[(I - F) J_d] / h`, (23).
/// struct RigidBody;
///
/// impl DiscreteLagrangian for RigidBody {
///     type Group = SO3;
///     fn value<S: Scalar>(&self, _: &SO3<S>, f: &SO3<S>, h: S) -> S {
///         let jd = Mat3::diagonal([2.0, 1.0, 0.0]).lift::<S>();
///         -(f.minus_identity() * jd).trace() / h
///     }
/// }
///
/// let mut state = State { t: 0.0, g: SO3::identity(), mu: Cotangent([0.1, 2.0, 0.1]) };
/// let spatial = |s: &State<SO3>| s.g.rotate(s.mu.vec3());
/// let start = spatial(&state);
/// let mut integrator = Variational::new(RigidBody);
/// for _ in 0..1000 {
///     integrator.step(&mut state, 0.01)?;
/// }
/// assert!((spatial(&state) - start).norm() < 1e-13);
/// # Ok::<(), dvi::StepError>(())
/// ```
pub trait DiscreteLagrangian {
    /// The configuration group.
    type Group: RealGroup;

    /// $L_d(g, f)$ for a step of `h` seconds, in joule seconds.
    fn value<S: Scalar>(&self, g: &Over<Self::Group, S>, f: &Over<Self::Group, S>, h: S) -> S;

    /// $L_d(t_k, g, f)$ for a step that starts at `t`, the only value that the framework asks for.
    ///
    /// A system that depends on time gives this one, and as [`value`](Self::value) the one at $t = 0$.
    #[inline(always)]
    fn value_at<S: Scalar>(
        &self,
        _t: S,
        g: &Over<Self::Group, S>,
        f: &Over<Self::Group, S>,
        h: S,
    ) -> S {
        self.value(g, f, h)
    }

    /// Both left-trivialised derivatives, into `out`; by dual numbers unless given.
    ///
    /// They share most of their terms, hence one method. A closed form writes every coordinate of both.
    fn derivatives<S: Scalar>(
        &self,
        t: S,
        g: &Over<Self::Group, S>,
        f: &Over<Self::Group, S>,
        h: S,
        out: &mut Derivatives<Self::Group, S>,
    ) {
        out.by_jets(self, t, g, f, h);
    }

    /// The coordinates of a factor $\mathbb{R}^m$ of a direct product that `g` does not enter $L_d$ by.
    ///
    /// Their equation is solved to rounding in every step, so their momentum map holds whatever the tolerance.
    fn cyclic(&self) -> Range<usize> {
        0..0
    }

    /// Whether `g` is a configuration of this system; for systems whose size is known at run time.
    fn fits(&self, _g: &Self::Group) -> bool {
        true
    }

    /// Whether `g` is in the domain of $L_d$; by default, whether there is an action of staying there.
    ///
    /// A step whose end is not is refused. A system that is defined everywhere may say so: it saves an evaluation a step.
    fn is_defined(&self, t: f64, g: &Self::Group) -> bool {
        /// s: so short that it is still the time `t`.
        const MOMENT: f64 = 1e-100;
        self.value_at::<f64>(t, g, &g.identity_like(), MOMENT)
            .is_finite()
    }

    /// The order of the method.
    fn order(&self) -> u32 {
        1
    }

    /// Whether $L_d(g, f)$ for $h$ equals $-L_d(g f, f^{-1})$ for $-h$.
    fn is_symmetric(&self) -> bool {
        false
    }

    /// Whether the derivatives are those of a value, so that the step preserves the symplectic form; not so with a [force](crate::Forced).
    fn is_symplectic(&self) -> bool {
        true
    }
}

impl<L: DiscreteLagrangian> DiscreteLagrangian for &L {
    type Group = L::Group;

    #[inline(always)]
    fn value<S: Scalar>(&self, g: &Over<L::Group, S>, f: &Over<L::Group, S>, h: S) -> S {
        L::value(self, g, f, h)
    }
    #[inline(always)]
    fn value_at<S: Scalar>(&self, t: S, g: &Over<L::Group, S>, f: &Over<L::Group, S>, h: S) -> S {
        L::value_at(self, t, g, f, h)
    }
    #[inline(always)]
    fn derivatives<S: Scalar>(
        &self,
        t: S,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
        out: &mut Derivatives<L::Group, S>,
    ) {
        L::derivatives(self, t, g, f, h, out);
    }
    fn cyclic(&self) -> Range<usize> {
        L::cyclic(self)
    }
    fn fits(&self, g: &L::Group) -> bool {
        L::fits(self, g)
    }
    fn is_defined(&self, t: f64, g: &L::Group) -> bool {
        L::is_defined(self, t, g)
    }
    fn order(&self) -> u32 {
        L::order(self)
    }
    fn is_symmetric(&self) -> bool {
        L::is_symmetric(self)
    }
    fn is_symplectic(&self) -> bool {
        L::is_symplectic(self)
    }
}

/// The derivatives of a discrete Lagrangian, and the storage that finding them by dual numbers needs.
pub struct Derivatives<G: RealGroup, S: Scalar> {
    /// $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d$: the derivative along $f \exp(\zeta)$ at $\zeta = 0$.
    pub d_f: DualOver<G, S>,
    /// $\mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d$: the derivative along $g \exp(\eta)$ at $\eta = 0$.
    pub d_g: DualOver<G, S>,
    /// Storage for a closed form's own use, kept from call to call and empty at first: a recursion over bodies has
    /// quantities for each.
    pub scratch: Vec<Vec3<S>>,
    lifted: Option<Lifted<G, S>>,
    ends: Option<Ends<G, S>>,
}

/// Storage for a step seen from its other end.
pub(crate) struct Ends<G: RealGroup, S: Scalar> {
    /// $g f$.
    pub(crate) end: Over<G, S>,
    /// $f^{-1}$.
    pub(crate) back: Over<G, S>,
    pub(crate) momentum: DualOver<G, S>,
}

impl<G: RealGroup, S: Scalar> Debug for Derivatives<G, S> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Derivatives")
            .field("d_f", &self.d_f)
            .field("d_g", &self.d_g)
            .finish()
    }
}

impl<G: RealGroup, S: Scalar> Derivatives<G, S> {
    /// Zero derivatives, of the shape of `g`.
    pub fn new(g: &Over<G, S>) -> Self {
        Self {
            d_f: g.zero_dual(),
            d_g: g.zero_dual(),
            scratch: Vec::new(),
            lifted: None,
            ends: None,
        }
    }

    /// The storage for the other end, to be [given back](Self::give_ends): the derivatives are borrowed meanwhile.
    pub(crate) fn take_ends(&mut self, g: &Over<G, S>) -> Ends<G, S> {
        self.ends.take().unwrap_or_else(|| Ends {
            end: g.clone(),
            back: g.clone(),
            momentum: g.zero_dual(),
        })
    }

    pub(crate) fn give_ends(&mut self, ends: Ends<G, S>) {
        self.ends = Some(ends);
    }

    /// Fills both from the value alone, by dual numbers seeded at the identity of $f \exp\zeta$ and $g \exp\eta$.
    pub fn by_jets<L: DiscreteLagrangian<Group = G> + ?Sized>(
        &mut self,
        lagrangian: &L,
        t: S,
        g: &Over<G, S>,
        f: &Over<G, S>,
        h: S,
    ) {
        let Self {
            d_f, d_g, lifted, ..
        } = self;
        let lifted = lifted.get_or_insert_with(|| Lifted::new(g));
        let (t, h) = (S::Jet::constant(t), S::Jet::constant(h));
        lifted.set(g, f);
        for_each_chunk(d_f.dim(), |first| {
            let (g, f) = lifted.moving_f(first);
            read_partials(d_f, first, lagrangian.value_at(t, g, f, h));
            let (g, f) = lifted.moving_g(first);
            read_partials(d_g, first, lagrangian.value_at(t, g, f, h));
        });
    }
}
