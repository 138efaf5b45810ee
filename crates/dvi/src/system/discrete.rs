//! The discrete Lagrangian: what an integrator is made of.

use core::fmt::Debug;
use core::ops::Range;

use lie::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, Scalar, VectorSpace};
use trace::Traced;

use super::context::{Context, System};
use super::continuous::Means;
use super::lifted::{Arguments, Lifted};
use super::state::{State, Still};
use super::traced::{DiscreteCache, DiscreteProgram, DiscreteRecording, Home, TracedError};
use crate::numerics::duals::{for_each_chunk, read_partials};

/// A discrete Lagrangian $L_d(g_k, f_k)$ with $f_k = g_k^{-1} g_{k+1}$: the action of one step of size $h$.
///
/// Only [`value`](Self::value) is required. Write it generic over the scalar: integrators record it once and differentiate what was recorded.
/// Where it branches on a value they take dual numbers. Where speed counts, give [`derivatives`](Self::derivatives) in closed form, and the model's own solve of its
/// inertia: [`factorise`](Self::factorise) and what follows it.
///
/// ```
/// use dvi::{Context, DiscreteLagrangian, Integrator, State, System, Variational};
/// use lie::{Cotangent, Mat3, SO3, Scalar};
///
/// /// A free rigid body with the moments of inertia 1, 2 and 3 kg m²: `tr[(I - F) J_d] / h`, (23).
/// struct RigidBody;
///
/// impl System for RigidBody {
///     type Group = SO3;
/// }
///
/// impl DiscreteLagrangian for RigidBody {
///     type Workspace<S: Scalar> = ();
///     fn value<S: Scalar>(&self, _: Context<S>, _: &SO3<S>, f: &SO3<S>, h: S) -> S {
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
pub trait DiscreteLagrangian: System {
    /// Storage of the model's own, empty at first and kept from call to call; `()` where derivatives come from dual numbers.
    type Workspace<S: Scalar>: Default + Send + Sync;

    /// Whether the model solves its inertia, by the four methods from [`factorise`](Self::factorise) on.
    const HAS_INERTIA: bool = false;

    /// $L_d(t_k, g, f)$ for a step of `h` seconds from the time of the context, in joule seconds.
    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Self::Group, S>,
        f: &Over<Self::Group, S>,
        h: S,
    ) -> S;

    /// Both left-trivialised derivatives, into `out`; those of the value unless given.
    ///
    /// They share most of their terms, hence one method. A closed form writes every coordinate of both.
    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Self::Group, S>,
        f: &Over<Self::Group, S>,
        h: S,
        _work: &mut Self::Workspace<S>,
        out: &mut Derivatives<Self::Group, S>,
    ) {
        out.by_value(self, at, g, f, h);
    }

    /// Whether `g` is in the domain of $L_d$; by default, whether there is an action of staying there.
    ///
    /// A step whose end is not is refused. A system that is defined everywhere may say so: it saves an evaluation a step.
    fn is_defined(&self, t: f64, g: &Self::Group, still: &Still<Self::Group>) -> bool {
        /// s: so short that it is still the time `t`.
        const MOMENT: f64 = 1e-100;
        let at = Context::new(t, self.parameters());
        self.value::<f64>(at, g, &still.displacement, MOMENT)
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

    /// Factorises the inertia $\mathbb I(g)$ at the time $t$, which answers to the velocity with the momentum.
    ///
    /// Its multiple $\mathbb I(g_k) / h$ is the matrix of the iteration that solves a step: it contracts by a factor of the order of $h |\xi|$.
    /// A model whose $L_d$ has stiff forces at its start adds $h$ times their slope by the velocity; at $h = 0$ it is the inertia alone.
    fn factorise(&self, (_t, _h): (f64, f64), _g: &Self::Group, _work: &mut Self::Workspace<f64>) {}

    /// Solves $\mathbb I(g) \xi = \mu$; writes every coordinate of `xi`. The factors stay as they are.
    fn solve(
        &self,
        _work: &mut Self::Workspace<f64>,
        _mu: &<Self::Group as LieGroup>::Dual,
        xi: &mut <Self::Group as LieGroup>::Algebra,
    ) {
        unknown(xi);
    }

    /// Solves the block of $\mathbb I(g)$ that belongs to the [cyclic](System::cyclic) coordinates alone; writes zero elsewhere.
    ///
    /// A model with an inertia and such coordinates must give it.
    fn solve_cyclic(
        &self,
        _work: &mut Self::Workspace<f64>,
        _mu: &<Self::Group as LieGroup>::Dual,
        xi: &mut <Self::Group as LieGroup>::Algebra,
    ) {
        unknown(xi);
    }

    /// The coordinates that [`eliminate`](Self::eliminate) solves for: cyclic ones, and others whose $\mathbf D_f L_d$ is linear in
    /// them and whose $\mathbf D_g L_d$ does not depend on `f`. None by default.
    fn eliminated(&self) -> Range<usize> {
        0..0
    }

    /// The [derivatives](Self::derivatives) of a step from `state`, once the [eliminated](Self::eliminated) coordinates are solved for.
    ///
    /// They are set in `f` and in its coordinates `c` so that $\mathbf D_f L_d = \mu + \mathbf D_g L_d$ holds in them. The other
    /// coordinates of `f` stay as given. One method, since both share most of their terms.
    #[inline(always)]
    fn eliminate(
        &self,
        work: &mut Self::Workspace<f64>,
        (state, h): (&State<Self::Group>, f64),
        f: &mut Self::Group,
        _c: &mut AlgebraOver<Self::Group, f64>,
        out: &mut Derivatives<Self::Group, f64>,
    ) {
        let at = Context::new(state.t, self.parameters());
        self.derivatives(at, &state.g, f, h, work, out);
    }
}

/// What a model without an inertia answers: no step is solved by it.
fn unknown<V: VectorSpace<Scalar = f64>>(xi: &mut V) {
    (0..xi.dim()).for_each(|i| xi.set(i, f64::NAN));
}

impl<L: DiscreteLagrangian> DiscreteLagrangian for &L {
    type Workspace<S: Scalar> = L::Workspace<S>;
    const HAS_INERTIA: bool = L::HAS_INERTIA;

    #[inline(always)]
    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
    ) -> S {
        L::value(self, at, g, f, h)
    }
    #[inline(always)]
    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
        work: &mut L::Workspace<S>,
        out: &mut Derivatives<L::Group, S>,
    ) {
        let home = out.follow(self);
        L::derivatives(self, at, g, f, h, work, out);
        out.home = home;
    }
    fn is_defined(&self, t: f64, g: &L::Group, still: &Still<L::Group>) -> bool {
        L::is_defined(self, t, g, still)
    }
    fn order(&self) -> u32 {
        L::order(self)
    }
    fn is_symmetric(&self) -> bool {
        L::is_symmetric(self)
    }
    #[inline(always)]
    fn factorise(&self, step: (f64, f64), g: &L::Group, work: &mut L::Workspace<f64>) {
        L::factorise(self, step, g, work);
    }
    #[inline(always)]
    fn solve(
        &self,
        work: &mut L::Workspace<f64>,
        mu: &<L::Group as LieGroup>::Dual,
        xi: &mut <L::Group as LieGroup>::Algebra,
    ) {
        L::solve(self, work, mu, xi);
    }
    fn solve_cyclic(
        &self,
        work: &mut L::Workspace<f64>,
        mu: &<L::Group as LieGroup>::Dual,
        xi: &mut <L::Group as LieGroup>::Algebra,
    ) {
        L::solve_cyclic(self, work, mu, xi);
    }
    fn eliminated(&self) -> Range<usize> {
        L::eliminated(self)
    }
    #[inline(always)]
    fn eliminate(
        &self,
        work: &mut L::Workspace<f64>,
        start: (&State<L::Group>, f64),
        f: &mut L::Group,
        c: &mut AlgebraOver<L::Group, f64>,
        out: &mut Derivatives<L::Group, f64>,
    ) {
        let home = out.follow(self);
        L::eliminate(self, work, start, f, c, out);
        out.home = home;
    }
}

/// The derivatives of a discrete Lagrangian, and the storage that finding them by dual numbers needs.
pub struct Derivatives<G: RealGroup, S: Scalar> {
    /// $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d$: the derivative along $f \exp(\zeta)$ at $\zeta = 0$.
    pub d_f: DualOver<G, S>,
    /// $\mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d$: the derivative along $g \exp(\eta)$ at $\eta = 0$.
    pub d_g: DualOver<G, S>,
    lifted: Option<Lifted<G, S>>,
    recording: Option<DiscreteRecording<G, S>>,
    /// Where the formulas are that may be recorded.
    home: Home,
    /// Why the last was not.
    refused: Option<TracedError>,
    /// How they came about last.
    pub(crate) means: Means,
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
            lifted: None,
            recording: None,
            home: Home::default(),
            refused: None,
            means: Means::Formulas,
        }
    }

    /// The same, with what is recorded of discrete Lagrangians in an integrator.
    pub(crate) fn with_cache(g: &Over<G, S>, cache: DiscreteCache<G>) -> Self {
        Self {
            recording: Some(DiscreteRecording::new(cache)),
            ..Self::new(g)
        }
    }

    /// Fills both by the Lagrangian in a function of its own: it is compiled once for all that do not count in the time of a step.
    #[inline(never)]
    pub(crate) fn find<L: DiscreteLagrangian<Group = G>>(
        &mut self,
        lagrangian: &L,
        at: Context<S>,
        (g, f): (&Over<G, S>, &Over<G, S>),
        h: S,
        work: &mut L::Workspace<S>,
    ) {
        lagrangian.derivatives(at, g, f, h, work, self);
    }

    /// Lets the formulas in the memory of a system be recorded, which has to stay as it is.
    pub(crate) fn settle<L: ?Sized>(&mut self, system: &L) {
        self.home = Home::of(system);
    }

    /// Lets those be recorded that a part of the system refers to; gives back where they were to be before.
    fn follow<L>(&mut self, reference: &&L) -> Home {
        let stays = self.home.part(reference).is_some();
        let there = match stays {
            true => Home::behind(*reference),
            false => Home::default(),
        };
        core::mem::replace(&mut self.home, there)
    }

    /// Fills both from the value alone: in an integrator by a program, where the value can be recorded, and by dual numbers elsewhere.
    pub fn by_value<L: DiscreteLagrangian<Group = G> + ?Sized>(
        &mut self,
        lagrangian: &L,
        at: Context<S>,
        g: &Over<G, S>,
        f: &Over<G, S>,
        h: S,
    ) {
        if !self.by_recording(lagrangian, (at, (g, f), h)) {
            self.by_jets(lagrangian, at, g, f, h);
        }
    }

    /// Fills both by the program of a recorded value; false where there is none.
    pub(crate) fn by_recording<L: DiscreteLagrangian<Group = G> + ?Sized>(
        &mut self,
        lagrangian: &L,
        arguments: Arguments<'_, G, S>,
    ) -> bool {
        self.refused = None;
        let Some(recording) = &mut self.recording else {
            return false;
        };
        let record = |g: &G| {
            let value = |(at, (g, f), h): Arguments<'_, G, Traced>| lagrangian.value(at, g, f, h);
            DiscreteProgram::of(g, lagrangian.parameters().len(), value)
        };
        let part = self.home.part(lagrangian);
        let found = part.ok_or(TracedError::Elsewhere);
        let out = match found.and_then(|part| recording.run(part, record, arguments)) {
            Ok(out) => out,
            Err(why) => {
                self.refused = Some(why);
                return false;
            }
        };
        let (d_f, d_g) = out.split_at(out.len() / 2);
        self.d_f.read(d_f);
        self.d_g.read(d_g);
        self.means = Means::Recorded;
        true
    }

    /// Fills both from the value alone, by dual numbers seeded at the identity of $f \exp\zeta$ and $g \exp\eta$.
    pub fn by_jets<L: DiscreteLagrangian<Group = G> + ?Sized>(
        &mut self,
        lagrangian: &L,
        at: Context<S>,
        g: &Over<G, S>,
        f: &Over<G, S>,
        h: S,
    ) {
        self.by_jets_of((at, (g, f), h), |(at, (g, f), h)| {
            lagrangian.value(at, g, f, h)
        });
    }

    /// The same of a function with storage of its own.
    #[inline(always)]
    pub(crate) fn by_jets_of(
        &mut self,
        arguments: Arguments<'_, G, S>,
        mut value: impl FnMut(Arguments<'_, G, S::Jet>) -> S::Jet,
    ) {
        let why = self.refused.take();
        self.means = Means::DualNumbers { why };
        let Self {
            d_f, d_g, lifted, ..
        } = self;
        let (_, (g, _), _) = arguments;
        let lifted = lifted.get_or_insert_with(|| Lifted::new(g));
        lifted.set(arguments);
        for_each_chunk(d_f.dim(), |first| {
            read_partials(d_f, first, value(lifted.moving_f(first)));
            read_partials(d_g, first, value(lifted.moving_g(first)));
        });
    }
}
