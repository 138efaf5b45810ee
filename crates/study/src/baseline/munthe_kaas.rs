//! Runge–Kutta methods on the group itself.

use dvi::{
    Cause, Context, ContinuousSystem, Integrator, State, StepError, StepReport, System,
    check_momentum, check_step,
};
use lie::{Exp, LieGroup, RealGroup, VectorSpace};

use super::tableau::{Row, Tableau, sum};

type Algebra<S> = <<S as System>::Group as LieGroup>::Algebra;
type Dual<S> = <<S as System>::Group as LieGroup>::Dual;

/// The method whose stages are carried to the group.
const CLASSICAL: Tableau = Tableau::CLASSICAL;
const STAGES: usize = CLASSICAL.stages();

/// How the stages of the classical method are carried to the group.
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
/// use articulated_fluid::{Scene, scene};
/// use dvi::Integrator;
/// use study::baseline::{GroupRungeKutta, Scheme};
///
/// let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
/// let (model, mut state) = (scene.model()?, scene.initial_state()?);
/// let mut integrator = GroupRungeKutta::new(model.clone(), Scheme::MuntheKaas);
/// (0..10).try_for_each(|_| integrator.step(&mut state, 0.1).map(drop))?;
/// assert!(model.orthogonality_error(&state.g) < 1e-14);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct GroupRungeKutta<S: ContinuousSystem> {
    system: S,
    scheme: Scheme,
    steps: u64,
    storage: Option<Storage<S>>,
}

/// The last stage of the commutator-free method, after the second.
const LAST: Row = &[(0, -0.5), (2, 1.0)];
/// The exponentials of its step, one after the other.
const ENDS: [Row; 2] = [
    &[(0, 0.25), (1, 1.0 / 6.0), (2, 1.0 / 6.0), (3, -1.0 / 12.0)],
    &[(0, -1.0 / 12.0), (1, 1.0 / 6.0), (2, 1.0 / 6.0), (3, 0.25)],
];

impl Scheme {
    /// The error at a fixed time falls as $h^{\text{order}}$.
    #[must_use]
    pub fn order(self) -> u32 {
        match self {
            Self::MuntheKaas | Self::CommutatorFree => CLASSICAL.order,
            Self::WithoutDexp => 2,
        }
    }

    /// The stage that stage `i` > 0 goes on from, and by what exponential.
    fn stage(self, i: usize) -> (usize, Row) {
        match (self, i) {
            (Self::CommutatorFree, 3) => (1, LAST),
            _ => (0, CLASSICAL.rows[i - 1]),
        }
    }

    /// The exponentials from the start of a step to its end.
    fn ends(self) -> &'static [Row] {
        match self {
            Self::CommutatorFree => &ENDS,
            _ => &[CLASSICAL.weights],
        }
    }
}

struct Storage<S: ContinuousSystem> {
    workspace: S::Workspace<f64>,
    /// What the exponential is taken of, and the exponential.
    c: Algebra<S>,
    exp: S::Group,
    /// The configuration at each stage.
    stages: [S::Group; STAGES],
    end: State<S::Group>,
    xi: Algebra<S>,
    /// The rate of `c` at each stage.
    rates: [Algebra<S>; STAGES],
    /// The rate of the momentum at each stage.
    forces: [Dual<S>; STAGES],
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
        self.scheme.order()
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
        let at = (self.steps, state.t, h);
        let refused = |cause: Cause| cause.at(at);
        check_step(&self.system, (state.t, &state.g), h).map_err(refused)?;
        let storage = match self.storage.take() {
            Some(storage) if storage.end.g.same_shape(&state.g) => storage,
            _ => Storage::new(state),
        };
        let storage = self.storage.insert(storage);
        check_momentum(&state.mu, &storage.forces[0]).map_err(refused)?;
        storage.step(&self.system, self.scheme, state, h);
        let end = &mut storage.end;
        let finite = end.g.is_finite() && end.mu.max_magnitude().is_finite();
        if !(finite && self.system.is_defined(state.t + h, &end.g)) {
            return Err(refused(Cause::NotFinite));
        }
        end.t = state.t + h;
        core::mem::swap(state, end);
        self.steps += 1;
        Ok(StepReport::default())
    }
}

impl<S: ContinuousSystem> Storage<S> {
    fn new(state: &State<S::Group>) -> Self {
        let zero = || state.g.zero_algebra();
        Self {
            workspace: Default::default(),
            c: zero(),
            exp: state.g.clone(),
            stages: core::array::from_fn(|_| state.g.clone()),
            end: State {
                t: state.t,
                g: state.g.clone(),
                mu: state.g.zero_dual(),
            },
            xi: zero(),
            rates: core::array::from_fn(|_| zero()),
            forces: core::array::from_fn(|_| state.g.zero_dual()),
        }
    }

    /// Leaves the end of the step in `end`.
    fn step(&mut self, system: &S, scheme: Scheme, from: &State<S::Group>, h: f64) {
        self.stages[0].copy_from(&from.g);
        self.evaluate(system, from, h, 0);
        self.rates[0].copy_from(&self.xi);
        for i in 1..STAGES {
            let (base, row) = scheme.stage(i);
            self.exponential(h, row);
            let (before, stage) = self.stages.split_at_mut(i);
            before[base].compose_into(&self.exp, &mut stage[0]);
            self.evaluate(system, from, h, i);
            match scheme {
                Scheme::MuntheKaas => {
                    self.rates[i] = S::Group::d_left_inv::<Exp>(&self.c, &self.xi)
                }
                _ => self.rates[i].copy_from(&self.xi),
            }
        }
        for row in scheme.ends() {
            self.exponential(h, row);
            self.stages[0].compose_into(&self.exp, &mut self.end.g);
            self.stages[0].copy_from(&self.end.g);
        }
        self.end.g.normalize();
        self.momentum(from, h, CLASSICAL.weights);
    }

    /// The exponential of a sum of rates.
    fn exponential(&mut self, h: f64, row: Row) {
        self.c.set_zero();
        for (j, a) in row {
            self.c.add_scaled(a * h, &self.rates[*j]);
        }
        S::Group::retract_into::<Exp>(&self.c, &mut self.exp);
    }

    /// Leaves the momentum by a row of the tableau in `end`.
    fn momentum(&mut self, from: &State<S::Group>, h: f64, row: Row) {
        self.end.mu.copy_from(&from.mu);
        for (j, a) in row {
            self.end.mu.add_scaled(a * h, &self.forces[*j]);
        }
    }

    /// Velocity and force of stage `i`, whose configuration is there.
    fn evaluate(&mut self, system: &S, from: &State<S::Group>, h: f64, i: usize) {
        let row = i.checked_sub(1).map_or(&[][..], |i| CLASSICAL.rows[i]);
        self.momentum(from, h, row);
        let (t, g, mu) = (from.t + sum(row) * h, &self.stages[i], &self.end.mu);
        let (xi, force) = (&mut self.xi, &mut self.forces[i]);
        let at = Context::new(t, system.parameters());
        system.velocity_and_force::<f64>(at, g, mu, &mut self.workspace, xi, force);
        force.add_scaled(1.0, &S::Group::coadjoint_bracket(xi, mu));
    }
}
