//! First variations: the derivative of the flow, carried along with a trajectory.

use lie::{Cayley, DualOver, Jet, LieGroup, Over, RealGroup, Scalar, VectorSpace};

use crate::{Integrator, State, StepError, StepReport, System};

/// A first variation of a trajectory: how the state moves when the initial state, the forces or the parameters do.
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
    /// $\delta p$: a change of the system's [parameters](System::parameters), the same in every step until it is set anew; those past its end
    /// do not change.
    pub parameters: Vec<f64>,
}

impl<G: RealGroup> Variation<G> {
    /// No variation, of the shape of `g`.
    pub fn zero(g: &G) -> Self {
        Self {
            eta: g.zero_algebra(),
            mu: g.zero_dual(),
            force: g.zero_dual(),
            parameters: Vec::new(),
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

    /// The unit variations of the parameters of a system, one for each: they become the derivatives of the state by them.
    pub fn parameters<C: System<Group = G>>(system: &C, g: &G) -> Vec<Self> {
        let count = system.parameters().len();
        let unit = |i: usize| {
            let mut unit = Self::zero(g);
            unit.parameters.resize(count, 0.0);
            unit.parameters[i] = 1.0;
            unit
        };
        (0..count).map(unit).collect()
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
/// use dvi::{Context, FirstVariation, Lagrangian, Quadrature, System, Variation, Variational};
/// use lie::{Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg on a spring of 1 N/m.
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
/// let mut state = Spring.state(0.0, Rn([1.0]), &Tangent([0.0]))?;
/// let mut columns = Variation::basis(&state.g);
/// let mut integrator = Variational::new(Spring.discretise(Quadrature::Midpoint));
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
    /// $p + \delta p$.
    pub(crate) parameters: Vec<J>,
}

impl<G: RealGroup> Varied<G> {
    pub(crate) fn new(g: &G) -> Self {
        let g = g.lift::<J>();
        Self {
            turn: g.clone(),
            mu: g.zero_dual(),
            force: g.zero_dual(),
            parameters: Vec::new(),
            g,
        }
    }

    pub(crate) fn same_shape(&self, g: &G) -> bool {
        self.g.same_shape(&g.lift::<J>())
    }

    pub(crate) fn enter(
        &mut self,
        (parameters, state): (&[f64], &State<G>),
        chunk: &[Variation<G>],
    ) {
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
        self.parameters.clear();
        for (i, parameter) in parameters.iter().enumerate() {
            let change = along(&|variation| variation.parameters.get(i).copied().unwrap_or(0.0));
            self.parameters.push(J::constant(*parameter) + change);
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
