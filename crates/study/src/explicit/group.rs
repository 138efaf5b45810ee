//! Runge–Kutta methods on the group itself.

use dvi::{ContinuousSystem, Integrator, State, StepError, StepReport};
use lie::{Exp, LieGroup, RealGroup, VectorSpace};

use super::check;

type Algebra<S> = <<S as ContinuousSystem>::Group as LieGroup>::Algebra;
type Dual<S> = <<S as ContinuousSystem>::Group as LieGroup>::Dual;

/// How the stages of the classical tableau are carried to the group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Scheme {
    /// Runge–Kutta–Munthe-Kaas: in the chart $g = g_k \exp(c)$, with $\dot c = \mathrm d\exp_c^{-1} \xi$; order 4
    /// (H. Munthe-Kaas, *High order Runge–Kutta methods on manifolds*, Appl. Numer. Math. 29, 1999).
    MuntheKaas,
    /// The same with $\dot c = \xi$, which holds where velocities commute; order 2, and so a check on what measures orders.
    WithoutDexp,
    /// Commutator-free, two exponentials at the end; order 4
    /// (E. Celledoni, A. Marthinsen, B. Owren, *Commutator-free Lie group methods*, Future Gener. Comput. Syst. 19, 2003).
    CommutatorFree,
}

/// The classical method of order 4 for $\dot g = g \xi$, $\dot\mu = \mathrm{ad}^\ast_\xi \mu + \tau$ by one of three [`Scheme`]s; the
/// momentum is a vector, carried by the tableau.
///
/// Velocities are trivialised on the left, so increments multiply from the right, and the chart's equation has the left-trivialised
/// $\mathrm d\exp_c^{-1} = 1 + \frac12 \mathrm{ad}_c + \dots$
///
/// ```
/// use dvi::{Integrator, Lagrangian};
/// use lie::SO3;
/// use study::explicit::{GroupRungeKutta, Scheme};
/// use study::problems::{HeavyTop, Solution};
///
/// let tilted = SO3::from_quaternion([1.0, 0.2, 0.0, 0.0]);
/// let problem = HeavyTop::new(1.0, 0.5, 1.0)?.problem(tilted, [0.0, 0.0, 10.0])?;
/// let mut integrator = GroupRungeKutta::new(problem.lagrangian.hamiltonian(), Scheme::MuntheKaas);
/// let mut state = problem.start.clone();
/// for _ in 0..100 {
///     integrator.step(&mut state, 0.01)?;
/// }
/// let exact = problem.exact.at(1.0)?;
/// assert!((*state.g.matrix() - *exact.g.matrix()).frobenius() < 1e-5);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct GroupRungeKutta<S: ContinuousSystem> {
    system: S,
    scheme: Scheme,
    steps: u64,
    storage: Option<Storage<S>>,
}

/// What of a scheme is not the classical tableau; rows weigh the stages' rates.
struct Tableau {
    last_stage: [f64; 4],
    /// Whether the last stage goes on from the second one, not from the step's start.
    from_second: bool,
    /// The exponentials of the step, one after the other.
    ends: &'static [[f64; 4]],
}

const NODES: [f64; 4] = [0.0, 0.5, 0.5, 1.0];
const FIRST_HALF: [f64; 4] = [0.5, 0.0, 0.0, 0.0];
const SECOND_HALF: [f64; 4] = [0.0, 0.5, 0.0, 0.0];
const WEIGHTS: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

const CHART: Tableau = Tableau {
    last_stage: [0.0, 0.0, 1.0, 0.0],
    from_second: false,
    ends: &[WEIGHTS],
};

const COMMUTATOR_FREE: Tableau = Tableau {
    last_stage: [-0.5, 0.0, 1.0, 0.0],
    from_second: true,
    ends: &[
        [0.25, 1.0 / 6.0, 1.0 / 6.0, -1.0 / 12.0],
        [-1.0 / 12.0, 1.0 / 6.0, 1.0 / 6.0, 0.25],
    ],
};

impl Scheme {
    fn tableau(self) -> &'static Tableau {
        match self {
            Self::CommutatorFree => &COMMUTATOR_FREE,
            _ => &CHART,
        }
    }
}

struct Storage<S: ContinuousSystem> {
    workspace: S::Workspace<f64>,
    /// What the exponential is taken of, and the exponential.
    c: Algebra<S>,
    exp: S::Group,
    stage: State<S::Group>,
    second: S::Group,
    xi: Algebra<S>,
    /// The rate of `c` at each stage.
    rates: [Algebra<S>; 4],
    /// The rate of the momentum at each stage.
    forces: [Dual<S>; 4],
}

impl<S: ContinuousSystem> GroupRungeKutta<S> {
    /// The method for a system.
    pub fn new(system: S, scheme: Scheme) -> Self {
        Self {
            system,
            scheme,
            steps: 0,
            storage: None,
        }
    }
}

impl<S: ContinuousSystem> Integrator for GroupRungeKutta<S> {
    type Group = S::Group;

    fn order(&self) -> u32 {
        match self.scheme {
            Scheme::MuntheKaas | Scheme::CommutatorFree => 4,
            Scheme::WithoutDexp => 2,
        }
    }

    fn is_symmetric(&self) -> bool {
        false
    }

    fn is_symplectic(&self) -> bool {
        false
    }

    fn reset(&mut self) {
        (self.steps, self.storage) = (0, None);
    }

    fn step(&mut self, state: &mut State<S::Group>, h: f64) -> Result<StepReport, StepError> {
        check(state, h, self.steps, self.system.fits(&state.g))?;
        let storage = match self.storage.take() {
            Some(storage) if storage.stage.g.same_shape(&state.g) => storage,
            _ => Storage::new(&self.system, state),
        };
        let storage = self.storage.insert(storage);
        storage.step(&self.system, self.scheme, state, h);
        let end = &mut storage.stage;
        let finite = end.g.is_finite() && end.mu.max_magnitude().is_finite();
        if !(finite && self.system.is_defined(state.t + h, &end.g)) {
            let (step, t) = (self.steps, state.t);
            return Err(StepError::NotFinite { step, t, h });
        }
        end.t = state.t + h;
        core::mem::swap(state, end);
        self.steps += 1;
        Ok(StepReport::default())
    }
}

impl<S: ContinuousSystem> Storage<S> {
    fn new(system: &S, state: &State<S::Group>) -> Self {
        let zero = || state.g.zero_algebra();
        Self {
            workspace: system.workspace::<f64>(&state.g),
            c: zero(),
            exp: state.g.clone(),
            stage: state.clone(),
            second: state.g.clone(),
            xi: zero(),
            rates: core::array::from_fn(|_| zero()),
            forces: core::array::from_fn(|_| state.g.zero_dual()),
        }
    }

    /// Leaves the end of the step in `stage`.
    fn step(&mut self, system: &S, scheme: Scheme, from: &State<S::Group>, h: f64) {
        let tableau = scheme.tableau();
        let rows = [[0.0; 4], FIRST_HALF, SECOND_HALF, tableau.last_stage];
        for (i, row) in rows.into_iter().enumerate() {
            self.exponential(h, row);
            let base = match i == 3 && tableau.from_second {
                true => &self.second,
                false => &from.g,
            };
            base.compose_into(&self.exp, &mut self.stage.g);
            if i == 1 {
                self.second.copy_from(&self.stage.g);
            }
            self.evaluate(system, from, h, i);
            match scheme {
                Scheme::MuntheKaas if i > 0 => {
                    self.rates[i] = S::Group::d_left_inv::<Exp>(&self.c, &self.xi);
                }
                _ => self.rates[i].copy_from(&self.xi),
            }
        }
        self.finish(tableau, from, h);
    }

    /// The exponential of the stages' rates by weight.
    fn exponential(&mut self, h: f64, weights: [f64; 4]) {
        self.c.set_zero();
        for (weight, rate) in weights.into_iter().zip(&self.rates) {
            if weight != 0.0 {
                self.c.add_scaled(weight * h, rate);
            }
        }
        S::Group::retract_into::<Exp>(&self.c, &mut self.exp);
    }

    /// Velocity and force of stage `i`, whose configuration is there.
    fn evaluate(&mut self, system: &S, from: &State<S::Group>, h: f64, i: usize) {
        let t = from.t + NODES[i] * h;
        let (g, mu, force) = (&self.stage.g, &mut self.stage.mu, &mut self.forces);
        mu.copy_from(&from.mu);
        if i > 0 {
            mu.add_scaled(NODES[i] * h, &force[i - 1]);
        }
        let (xi, force) = (&mut self.xi, &mut force[i]);
        system.velocity_and_force::<f64>(t, g, mu, &mut self.workspace, xi, force);
        force.add_scaled(1.0, &S::Group::coadjoint_bracket(xi, mu));
    }

    fn finish(&mut self, tableau: &Tableau, from: &State<S::Group>, h: f64) {
        self.second.copy_from(&from.g);
        for row in tableau.ends {
            self.exponential(h, *row);
            self.second.compose_into(&self.exp, &mut self.stage.g);
            self.second.copy_from(&self.stage.g);
        }
        self.stage.g.normalize();
        self.stage.mu.copy_from(&from.mu);
        for (weight, force) in WEIGHTS.into_iter().zip(&self.forces) {
            self.stage.mu.add_scaled(weight * h, force);
        }
    }
}
