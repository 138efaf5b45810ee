//! Integrators of a recorded system, and runs of them.

use std::sync::Arc;

use dvi::{
    Composition, Discretised, FirstVariation, Forced, Gauss, Lagrangian, Quadrature, State,
    StepError, Variation, Variational,
};
use sim::{Clock, Cost, Due, Run, Schedule, SimError};

use super::elements::{Elements, coordinates, write};
use super::recorded::{Recorded, RecordedForce};
use crate::attend::Desk;

/// An integrator chosen at run time.
pub type Boxed = Box<dyn FirstVariation<Group = Elements> + Send>;

/// What steps a system.
#[derive(Clone, Copy)]
pub enum Method {
    Midpoint,
    Composition(u32),
    Gauss(usize),
}

impl std::str::FromStr for Method {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let number = |prefix| {
            name.strip_prefix(prefix)
                .and_then(|n| n.parse::<usize>().ok())
        };
        match (name, number("composition-"), number("gauss-")) {
            ("midpoint", ..) => Ok(Self::Midpoint),
            (_, Some(order @ (2 | 4 | 6 | 8)), _) => Ok(Self::Composition(order as u32)),
            (.., Some(stages @ 1..=8)) => Ok(Self::Gauss(stages)),
            _ => Err(format!(
                "no method of a system is called `{name}`; expected midpoint, composition-P with P = 2, 4, 6, 8, or gauss-S with S = 1 to 8"
            )),
        }
    }
}

/// A system: a Lagrangian, and perhaps a force.
#[derive(Clone)]
pub struct Systems {
    pub lagrangian: Recorded,
    pub force: Option<RecordedForce>,
}

impl Systems {
    pub fn integrator(&self, method: Method) -> Boxed {
        let lagrangian = self.lagrangian.clone();
        let discrete = lagrangian.clone().discretise(Quadrature::Midpoint);
        match (&self.force, method) {
            (None, Method::Midpoint) => Box::new(Variational::new(discrete)),
            (None, Method::Composition(order)) => {
                composed(Composition::with_order(discrete, order))
            }
            (None, Method::Gauss(stages)) => {
                composed(Gauss::with_stages(lagrangian.hamiltonian(), stages))
            }
            (Some(force), method) => forced(discrete, lagrangian, force.clone(), method),
        }
    }

    /// A report's word on how derivatives come about.
    pub fn means(&self, state: &State<Elements>) -> String {
        use dvi::ContinuousSystem;
        let means = self
            .lagrangian
            .clone()
            .hamiltonian()
            .means(state.t, &state.g);
        means.to_string()
    }
}

fn forced(
    discrete: Discretised<Recorded>,
    lagrangian: Recorded,
    force: RecordedForce,
    method: Method,
) -> Boxed {
    let discrete = discrete.with_force(force.clone());
    match method {
        Method::Midpoint => Box::new(Variational::new(discrete)),
        Method::Composition(order) => composed(Composition::with_order(discrete, order)),
        Method::Gauss(stages) => {
            let system = Forced::new(lagrangian.hamiltonian(), force);
            composed(Gauss::with_stages(system, stages))
        }
    }
}

fn composed<I: FirstVariation<Group = Elements> + Send + 'static>(made: Option<I>) -> Boxed {
    Box::new(made.expect("a method of the list"))
}

/// When there are frames.
#[derive(Clone)]
pub enum Frames {
    Every(u64),
    At(Arc<[f64]>),
}

/// What was seen, frame by frame.
#[derive(Default)]
pub struct Motion {
    pub t: Vec<f64>,
    pub numbers: Vec<f64>,
    pub velocity: Vec<f64>,
    pub momentum: Vec<f64>,
    pub energy: Vec<f64>,
    pub cost: Cost,
}

/// Why there is no motion.
pub enum Refusal {
    Step(StepError),
    Clock(SimError),
}

impl From<StepError> for Refusal {
    fn from(error: StepError) -> Self {
        Self::Step(error)
    }
}

impl From<SimError> for Refusal {
    fn from(error: SimError) -> Self {
        Self::Clock(error)
    }
}

/// Steps between two looks at who waits.
const CHUNK: u64 = 64;

/// Runs a system from a state; none where nobody waits for it.
///
/// # Errors
/// [`Refusal`].
pub fn run(
    systems: &Systems,
    (method, start): (Method, State<Elements>),
    (until, step): (f64, f64),
    frames: &Frames,
    desk: &Desk,
) -> Result<Option<Motion>, Refusal> {
    let clock = Clock::new(until, step)?;
    let schedule = match frames {
        Frames::Every(every) => Schedule::Steps(*every),
        Frames::At(_) => Schedule::Steps(u64::MAX),
    };
    schedule.check(&clock)?;
    let hamiltonian = systems.lagrangian.clone().hamiltonian();
    let mut run = Run::new(systems.integrator(method), start, clock);
    let mut motion = Motion::default();
    for k in 0.. {
        let due = match frames {
            Frames::Every(_) => schedule.due(&clock, k),
            Frames::At(times) => Due::at(&clock, times[k as usize]),
        };
        while run.cost().steps < due.steps {
            run.advance(due.steps.min(run.cost().steps + CHUNK))?;
            desk.reach(run.state().t);
            if desk.is_stopped() {
                return Ok(None);
            }
        }
        let state = run.look(&due)?;
        motion.t.push(state.t);
        write(&state.g, &mut motion.numbers);
        motion
            .velocity
            .extend(coordinates(&hamiltonian.velocity(&state)));
        motion.momentum.extend(coordinates(&state.mu));
        motion.energy.push(hamiltonian.energy(&state));
        let is_last = match frames {
            Frames::Every(_) => due.steps == clock.steps(),
            Frames::At(times) => k as usize + 1 == times.len(),
        };
        if is_last {
            break;
        }
    }
    motion.cost = *run.cost();
    Ok(Some(motion))
}

/// The state at the end, and its derivatives.
pub struct Varied {
    pub state: State<Elements>,
    /// By the state at the start, then by the parameters.
    pub columns: Vec<Vec<f64>>,
}

/// Runs a system with its first variations; none where nobody waits for it.
///
/// # Errors
/// [`Refusal`].
pub fn vary(
    systems: &Systems,
    (method, start): (Method, State<Elements>),
    (until, step): (f64, f64),
    desk: &Desk,
) -> Result<Option<Varied>, Refusal> {
    let clock = Clock::new(until, step)?;
    let mut integrator = systems.integrator(method);
    let mut columns = Variation::basis(&start.g);
    columns.extend(Variation::parameters(&systems.lagrangian, &start.g));
    let mut state = start;
    let origin = state.t;
    for k in 0..clock.steps() {
        integrator.step_varied(&mut state, &mut columns, clock.step())?;
        state.t = origin + clock.time(k + 1);
        desk.reach(state.t);
        if desk.is_stopped() {
            return Ok(None);
        }
    }
    let column =
        |column: &Variation<Elements>| [coordinates(&column.eta), coordinates(&column.mu)].concat();
    let columns = columns.iter().map(column).collect();
    Ok(Some(Varied { state, columns }))
}
