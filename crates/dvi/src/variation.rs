//! First variations: the derivative of the flow, carried along with a trajectory.

use lie::{
    AlgebraOver, Cayley, DualOver, Jet, LieGroup, Over, RealGroup, Retraction, Scalar, VectorSpace,
};

use crate::balance::Balance;
use crate::jets::add_constant;
use crate::{DiscreteLagrangian, Integrator, Newton, State, StepError, StepReport, StepSolver};

/// A first variation of a trajectory: how the state moves when the initial state or the forces do.
///
/// Left-trivialised: the varied configuration is $g \exp(\epsilon \eta)$, the varied momentum $\mu + \epsilon\, \delta\mu$.
/// Columns of the flow's derivative $\partial (g_T, \mu_T) / \partial (g_0, \mu_0)$ are variations that start as a
/// [basis](Self::basis); see [`FirstVariation`].
#[derive(Clone, Debug, PartialEq)]
pub struct Variation<G: RealGroup> {
    /// $\eta = g^{-1} \delta g$.
    pub eta: G::Algebra,
    /// $\delta \mu$.
    pub mu: G::Dual,
    /// $\delta F$: a change of the force, in N m, the same in every step until it is set anew. In the step of a discrete Lagrangian it
    /// acts by the impulses $f_d^- = f_d^+ = \frac h2 \delta F$, in [`Gauss`](crate::Gauss) at the stages, as
    /// [`Forced`](crate::Forced) does. An impulse at one time is a change of [`mu`](Self::mu) there.
    pub force: G::Dual,
}

impl<G: RealGroup> Variation<G> {
    /// No variation, of the shape of `g`.
    pub fn zero(g: &G) -> Self {
        Self {
            eta: g.zero_algebra(),
            mu: g.zero_dual(),
            force: g.zero_dual(),
        }
    }

    /// The unit variations of the state: of the configuration first, then of the momentum; $2 \dim G$ of them.
    pub fn basis(g: &G) -> Vec<Self> {
        let dim = g.zero_dual().dim();
        let unit = |i: usize| {
            let mut unit = Self::zero(g);
            match i.checked_sub(dim) {
                None => unit.eta.set(i, 1.0),
                Some(i) => unit.mu.set(i, 1.0),
            }
            unit
        };
        (0..2 * dim).map(unit).collect()
    }

    /// The unit variations of a constant force, $\dim G$ of them.
    pub fn forces(g: &G) -> Vec<Self> {
        let unit = |i: usize| {
            let mut unit = Self::zero(g);
            unit.force.set(i, 1.0);
            unit
        };
        (0..g.zero_dual().dim()).map(unit).collect()
    }

    pub(crate) fn is_finite(&self) -> bool {
        self.eta.max_magnitude().is_finite() && self.mu.max_magnitude().is_finite()
    }
}

/// The canonical symplectic form at a state with momentum `mu`, in the left trivialisation:
/// $\omega(a, b) = \langle \delta\mu_b, \eta_a \rangle - \langle \delta\mu_a, \eta_b \rangle + \langle \mu, [\eta_a, \eta_b] \rangle$.
pub fn symplectic_form<G: RealGroup>(mu: &G::Dual, a: &Variation<G>, b: &Variation<G>) -> f64 {
    G::pair(&b.mu, &a.eta) - G::pair(&a.mu, &b.eta) + G::pair(mu, &G::bracket(&a.eta, &b.eta))
}

/// An integrator that carries first variations along: the derivative of its own discrete flow, not of the continuous one.
///
/// ```
/// use dvi::{FirstVariation, Lagrangian, Midpoint, Variation, Variational};
/// use lie::{Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg on a spring of 1 N/m.
/// struct Spring;
///
/// impl Lagrangian for Spring {
///     type Group = Rn<1>;
///     fn value<S: Scalar>(&self, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         (v[0] * v[0] - x.0[0] * x.0[0]) * S::from_f64(0.5)
///     }
/// }
///
/// let mut state = Spring.state(0.0, Rn([1.0]), &Tangent([0.0]))?;
/// let mut columns = Variation::basis(&state.g);
/// let mut integrator = Variational::new(Spring.discretise::<Midpoint>());
/// for _ in 0..100 {
///     integrator.step_varied(&mut state, &mut columns, 0.01)?;
/// }
/// // The flow turns the plane of position and momentum by one radian.
/// assert!((columns[0].eta[0] - 1.0_f64.cos()).abs() < 1e-5);
/// assert!((columns[1].eta[0] - 1.0_f64.sin()).abs() < 1e-5);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub trait FirstVariation: Integrator {
    /// [`step`](Integrator::step), with the variations carried to the step's end.
    ///
    /// # Errors
    /// As [`step`](Integrator::step); state and variations are as they were.
    fn step_varied(
        &mut self,
        state: &mut State<Self::Group>,
        variations: &mut [Variation<Self::Group>],
        h: f64,
    ) -> Result<StepReport, StepError>;
}

type J = <f64 as Scalar>::Jet;

/// The derivative of a solved step by the implicit-function rule: with $r(c; g, \mu) = 0$, $\delta c = -(\partial_c r)^{-1} \delta r$.
pub(crate) struct Linearised<G: RealGroup> {
    newton: Newton<G>,
    balance: Balance<G, J>,
    varied: Varied<G>,
    c: AlgebraOver<G, J>,
    delta: G::Algebra,
    delta_residual: G::Dual,
}

impl<G: RealGroup> Linearised<G> {
    pub(crate) fn new<L: DiscreteLagrangian<Group = G>>(lagrangian: &L, state: &G) -> Self {
        let varied = Varied::new(state);
        Self {
            newton: StepSolver::<L>::allocate(lagrangian, state),
            balance: Balance::new(&varied.g),
            c: varied.g.zero_algebra(),
            delta: state.zero_algebra(),
            delta_residual: state.zero_dual(),
            varied,
        }
    }

    /// Whether the storage is for states of the shape of `g`.
    pub(crate) fn fits(&self, g: &G) -> bool {
        self.varied.same_shape(g)
    }

    /// Carries variations of `state` over the step of size `h` whose solution is `c`.
    pub(crate) fn carry<L: DiscreteLagrangian<Group = G>, R: Retraction>(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<G>, f64),
        c: &G::Algebra,
        variations: &mut [Variation<G>],
    ) {
        StepSolver::<L>::renew::<R>(&mut self.newton, lagrangian, state, h, c);
        for chunk in variations.chunks_mut(lie::JET_DIRECTIONS) {
            self.varied.enter(state, chunk);
            let (mu, force) = (&mut self.varied.mu, &self.varied.force);
            mu.add_scaled(J::constant(0.5 * h), force);
            self.c.set_zero();
            add_constant(&mut self.c, c);
            self.evaluate::<L, R>(lagrangian, state.t, h);
            for direction in 0..chunk.len() {
                self.follow::<L>(lagrangian, direction);
            }
            self.evaluate::<L, R>(lagrangian, state.t, h);
            let (f, mu) = (&self.balance.f, &self.balance.transported);
            self.varied.leave(f, mu, chunk);
            for variation in chunk {
                variation.mu.add_scaled(0.5 * h, &variation.force);
            }
        }
    }

    fn evaluate<L: DiscreteLagrangian<Group = G>, R: Retraction>(
        &mut self,
        lagrangian: &L,
        t: f64,
        h: f64,
    ) {
        self.balance.retract::<R>(&self.c);
        let (t, h) = (J::constant(t), J::constant(h));
        let Varied { g, mu, .. } = &self.varied;
        self.balance.evaluate(lagrangian, t, g, mu, h);
    }

    /// Moves `c` along with one direction of the variations, so that the residual stays zero to first order.
    fn follow<L: DiscreteLagrangian<Group = G>>(&mut self, lagrangian: &L, direction: usize) {
        for i in 0..self.delta_residual.dim() {
            let slope = self.balance.residual.get(i).partial(direction);
            self.delta_residual.set(i, slope);
        }
        self.newton
            .solve(lagrangian, &self.delta_residual, &mut self.delta);
        for i in 0..self.delta.dim() {
            let moved = J::variable(0.0, direction).times(self.delta.get(i));
            self.c.set(i, self.c.get(i) - moved);
        }
    }
}

/// A varied state over dual numbers, a direction for each variation.
pub(crate) struct Varied<G: RealGroup> {
    /// $\exp(\eta)$.
    turn: Over<G, J>,
    /// $g \exp(\eta)$.
    pub(crate) g: Over<G, J>,
    /// $\mu + \delta\mu$.
    pub(crate) mu: DualOver<G, J>,
    /// $\delta F$.
    pub(crate) force: DualOver<G, J>,
}

impl<G: RealGroup> Varied<G> {
    pub(crate) fn new(g: &G) -> Self {
        let g = g.lift::<J>();
        Self {
            turn: g.clone(),
            mu: g.zero_dual(),
            force: g.zero_dual(),
            g,
        }
    }

    pub(crate) fn same_shape(&self, g: &G) -> bool {
        self.g.same_shape(&g.lift::<J>())
    }

    pub(crate) fn enter(&mut self, state: &State<G>, chunk: &[Variation<G>]) {
        let along = |part: &dyn Fn(&Variation<G>) -> f64| {
            let terms = chunk.iter().enumerate();
            terms.fold(J::constant(0.0), |sum, (direction, variation)| {
                sum + J::variable(0.0, direction).times(part(variation))
            })
        };
        let mut eta = self.g.zero_algebra();
        for i in 0..eta.dim() {
            eta.set(i, along(&|variation| variation.eta.get(i)));
            let change = along(&|variation| variation.mu.get(i));
            self.mu.set(i, J::constant(state.mu.get(i)) + change);
            self.force
                .set(i, along(&|variation| variation.force.get(i)));
        }
        Over::<G, J>::retract_into::<Cayley>(&eta, &mut self.turn);
        self.g = state.g.lift::<J>().compose(&self.turn);
    }

    /// The variations at the end: of $g f$ by $f^{-1} \exp(\eta) f$, and of the momentum there.
    pub(crate) fn leave(&self, f: &Over<G, J>, mu: &DualOver<G, J>, chunk: &mut [Variation<G>]) {
        let still = G::convert::<J, f64>(f, Jet::value).lift::<J>();
        let end = still.inverse().compose(&self.turn.compose(f));
        let eta = end.cayley_inverse().ok();
        for (direction, variation) in chunk.iter_mut().enumerate() {
            for i in 0..variation.eta.dim() {
                let slope = |x: J| x.partial(direction);
                let rate = eta.as_ref().map_or(f64::NAN, |eta| slope(eta.get(i)));
                variation.eta.set(i, rate);
                variation.mu.set(i, slope(mu.get(i)));
            }
        }
    }
}
