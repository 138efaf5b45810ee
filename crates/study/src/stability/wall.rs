//! How far a method is good, and what ends there.

use articulated_fluid::Configuration;
use dvi::{Integrator, State};
use serde::{Serialize, Serializer};
use sim::BoxedIntegrator;

use super::outcome::{Class, Outcome, WRONG};
use super::window::Window;
use crate::contender::{Contender, Kind, Problem};
use crate::work_precision::apart;

/// Continuation begins at this part of the refused step.
const FIRST: f64 = 1.0 / 64.0;
/// By this factor a step is longer than the one before; by its root after each failure, until it is below the second.
const GROWTH: f64 = 1.25;
const FINEST: f64 = 1.002;
/// A solution that turns an attitude by more, rad, than the one before is another branch's.
const JUMP: f64 = 0.5;

/// The largest step in which a method is good, and what ends there.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Limit {
    /// The largest step, s, such that it and all shorter ones of the grid that had time are good; none where the shortest is not.
    #[serde(rename = "largest_good_step_seconds")]
    pub step: Option<f64>,
    /// How many of the shortest steps had no time.
    #[serde(rename = "shorter_steps_without_time")]
    pub untried: usize,
    /// What the next longer step runs into.
    #[serde(flatten)]
    pub wall: Wall,
    /// The index of that step; none where all are good.
    #[serde(skip)]
    pub next: Option<usize>,
}

/// What a method runs into when its step grows.
///
/// The solver's wall and the dynamics' are different ones. Beyond the first a better solver goes on. Beyond the second the method's own
/// discrete dynamics is no longer near the motion, however well it is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Wall {
    /// Nothing: all steps of the grid are good.
    None,
    /// The solver: it refused a step whose equation has a solution near the motion, found from shorter steps by continuation. What would
    /// come after that step is not known.
    Solver,
    /// As far as continuation can tell, the equation of the step. From the state where it was refused, the branch of solutions that starts
    /// at the state itself was followed to this step, s. No way on was found.
    Equation {
        /// The longest step that was solved, s; zero where not even the shortest tried was.
        ends: f64,
    },
    /// The dynamics of the method: the energy left its band, drifted, or a number became infinite (nonlinear resonance, instability).
    Dynamics(Class),
    /// What the method does not keep at all: a momentum or the group; a shorter step only loses it more slowly.
    Structure(Class),
    /// Another motion, which keeps all that is kept; or a refused step whose only solution leads there.
    Wrong,
    /// The budget ended before this was known, or there is no reference to tell.
    Unknown,
}

impl Wall {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Solver => "solver",
            Self::Equation { .. } => "equation",
            Self::Dynamics(_) => "dynamics",
            Self::Structure(_) => "structure",
            Self::Wrong => "wrong",
            Self::Unknown => "unknown",
        }
    }
}

impl Serialize for Wall {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Object {
            wall: &'static str,
            equation_ends_at_step_seconds: Option<f64>,
        }
        let ends = match self {
            Self::Equation { ends } => Some(*ends),
            _ => None,
        };
        let object = Object {
            wall: self.name(),
            equation_ends_at_step_seconds: ends,
        };
        object.serialize(serializer)
    }
}

impl Limit {
    /// The limit of a method, from its outcomes in these steps, from short to long; when it is late, a refusal is not looked into.
    pub(super) fn new(
        contender: Contender,
        problem: &Problem,
        steps: &[f64],
        cells: &[Outcome],
        late: bool,
    ) -> Self {
        // Long steps are run first: where the time is over, it is the short ones that are missing.
        let tried = cells.iter().position(|cell| !cell.had_no_time());
        let untried = tried.unwrap_or(0);
        let good = cells[untried..].iter();
        let good = untried + good.take_while(|cell| cell.class == Class::Good).count();
        let wall = |cell: &Outcome| match cell.class {
            Class::Good => Wall::None,
            Class::Refused if late => Wall::Unknown,
            Class::Refused => refused(contender, problem, cell, steps[good]),
            class @ (Class::EnergyBand | Class::EnergyDrift | Class::NonFinite) => {
                Wall::Dynamics(class)
            }
            class @ (Class::MomentumLost | Class::GroupLeft) => Wall::Structure(class),
            Class::SilentlyWrong => Wall::Wrong,
            Class::NotRun => Wall::Unknown,
        };
        Self {
            step: (good > untried).then(|| steps[good - 1]),
            untried,
            wall: cells.get(good).map_or(Wall::None, wall),
            next: (good < cells.len()).then_some(good),
        }
    }
}

/// Whether the refused step has a solution where it should be: on the branch of the shorter steps from the same state, and near the motion.
fn refused(contender: Contender, problem: &Problem, cell: &Outcome, h: f64) -> Wall {
    let branch = cell
        .refused_at
        .as_ref()
        .and_then(|state| Branch::new(contender, problem, state, FIRST * h));
    let Some(mut branch) = branch else {
        return Wall::Equation { ends: 0.0 };
    };
    branch.follow(h);
    let Branch { start, end, .. } = &branch;
    let window = Window::open(&problem.model, start, h, 1);
    if branch.reached() < h {
        return Wall::Equation {
            ends: branch.reached(),
        };
    }
    match window.and_then(|window| window.angle(&problem.model, end)) {
        Some(angle) if angle <= WRONG => Wall::Solver,
        Some(_) => Wall::Wrong,
        None => Wall::Unknown,
    }
}

/// The solutions of steps of all sizes from one state, that begin with the state itself.
struct Branch<'a> {
    contender: Contender,
    problem: &'a Problem,
    start: &'a State<Configuration>,
    /// It has solved the last step of the path.
    integrator: BoxedIntegrator<Configuration>,
    /// The steps solved, each from the solution of the one before.
    path: Vec<f64>,
    /// Where the last of them leads.
    end: State<Configuration>,
}

impl<'a> Branch<'a> {
    /// None where the first step is not solved.
    fn new(
        contender: Contender,
        problem: &'a Problem,
        start: &'a State<Configuration>,
        first: f64,
    ) -> Option<Self> {
        let mut branch = Self {
            contender,
            problem,
            start,
            integrator: contender.integrator(problem)?,
            path: vec![first],
            end: start.clone(),
        };
        branch.end = branch.solve(first)?;
        Some(branch)
    }

    fn reached(&self) -> f64 {
        self.path.last().copied().unwrap_or(0.0)
    }

    /// Goes on as far as `h`, or as there are solutions.
    fn follow(&mut self, h: f64) {
        let mut factor = GROWTH;
        while self.reached() < h && factor > FINEST {
            let next = (factor * self.reached()).min(h);
            match self.solve(next) {
                Some(end) if apart(&self.problem.model, &end, &self.end) < JUMP => {
                    self.path.push(next);
                    self.end = end;
                }
                _ => {
                    factor = factor.sqrt();
                    self.replay();
                }
            }
        }
    }

    /// The step of size `h`, from the solution of the step before, and leaves its own for the next.
    fn solve(&mut self, h: f64) -> Option<State<Configuration>> {
        let mut end = self.start.clone();
        self.integrator.step(&mut end, h).ok()?;
        if self.contender.kind() == Kind::Gauss {
            // Its guess continues the step before in time: so it is led back to where the next one starts.
            let _ = self.integrator.step(&mut end.clone(), -h);
        }
        Some(end)
    }

    /// A refused step has made the integrator forget.
    fn replay(&mut self) {
        if let Some(integrator) = self.contender.integrator(self.problem) {
            self.integrator = integrator;
        }
        for h in self.path.clone() {
            self.solve(h);
        }
    }
}

#[cfg(test)]
mod tests {
    use articulated_fluid::{Scene, scene};

    use super::*;

    fn example() -> Problem {
        let scene = Scene::parse(scene::EXAMPLE, "example.toml").unwrap();
        Problem {
            model: scene.model().unwrap(),
            start: scene.initial_state().unwrap(),
            until: 1.0,
        }
    }

    #[test]
    fn short_steps_that_had_no_time_hide_no_wall() {
        let problem = example();
        let of = |class| Outcome {
            class,
            ..Outcome::NOT_RUN
        };
        let limit = |classes: [Class; 4]| {
            let steps = [0.1, 0.2, 0.3, 0.4];
            let rk4 = "rk4".parse().unwrap();
            let limit = Limit::new(rk4, &problem, &steps, &classes.map(of), true);
            (limit.step, limit.untried, limit.wall)
        };
        use Class::{EnergyDrift, Good, NotRun};
        let drift = Wall::Dynamics(EnergyDrift);
        assert_eq!(
            limit([NotRun, NotRun, Good, EnergyDrift]),
            (Some(0.3), 2, drift)
        );
        assert_eq!(limit([NotRun, EnergyDrift, Good, Good]), (None, 1, drift));
        assert_eq!(
            limit([Good, NotRun, Good, Good]),
            (Some(0.1), 0, Wall::Unknown)
        );
        assert_eq!(limit([NotRun; 4]), (None, 0, Wall::Unknown));
    }

    #[test]
    fn continuation_finds_the_solution_of_a_step_that_has_one() {
        let problem = example();
        // As if a solver had refused it.
        let refused_at = Some(problem.start.clone());
        let cell = Outcome {
            class: Class::Refused,
            refused_at,
            ..Outcome::NOT_RUN
        };
        for name in ["lgvi", "composition-2", "gauss-3"] {
            let contender = name.parse().unwrap();
            assert_eq!(refused(contender, &problem, &cell, 0.2), Wall::Solver);
        }
    }
}
