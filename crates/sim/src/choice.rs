//! What steps a scene: a method, or what is found for an accuracy.

use articulated_fluid::{ArticulatedBody, Configuration, Scene, Smallest};
use dvi::{Gauss, Integrator, Pilot, PilotError, State};

use crate::accuracy::{Candidate, Checked, Search, check_accuracy};
use crate::error::{SimError, positive};
use crate::method::{BoxedIntegrator, Method, Model};
use crate::scout::Scout;

/// What is to step a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choice {
    /// A method.
    Method {
        /// Which.
        method: Method,
        /// The longest step to take, s; unless given, the method's [default](Method::default_step), by a power of two longer or
        /// shorter as the scene moves.
        step: Option<f64>,
    },
    /// Gauss collocation with the stages and the step that keep this error to the end, rad and m.
    ///
    /// A [pilot run](Pilot) of the fastest part of the motion gives a first guess. A rehearsal of the whole run, beside a companion in
    /// longer steps, then checks it; where the two part too far, it begins again with shorter steps. So the run itself takes the steps of
    /// a rehearsal that has kept the accuracy to the end, and no frame is ever taken back.
    Accuracy(f64),
}

impl Default for Choice {
    fn default() -> Self {
        Method::default().into()
    }
}

impl From<Method> for Choice {
    fn from(method: Method) -> Self {
        Self::Method { method, step: None }
    }
}

/// What a [`Choice`] has come to for a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chosen {
    /// The method.
    pub method: Method,
    /// The longest step to take, s.
    pub step: f64,
    /// What was found of an accuracy.
    pub checked: Option<Checked>,
}

impl Chosen {
    /// The integrator of a model.
    pub fn integrator<M: Model>(&self, model: M) -> BoxedIntegrator<M::Group> {
        match self.checked {
            Some(checked) => self.gauss(model, checked.tolerance),
            None => self.method.integrator(model),
        }
    }

    /// The same with all coordinates among the unknowns of a step.
    pub fn integrator_in_full<M: Model>(&self, model: M) -> BoxedIntegrator<M::Group> {
        match self.checked {
            Some(checked) => self.gauss(model, checked.tolerance),
            None => self.method.integrator_in_full(model),
        }
    }

    /// The integrator of a scene's smallest exact model: it steps that, and gives the scene's own states.
    pub fn integrator_of_smallest(&self, smallest: &Smallest) -> BoxedIntegrator<Configuration> {
        smallest.integrator(
            |model| self.integrator(model),
            |model| self.integrator(model),
        )
    }

    fn gauss<M: Model>(&self, model: M, tolerance: f64) -> BoxedIntegrator<M::Group> {
        match self
            .method
            .stages()
            .and_then(|s| Gauss::with_stages(model.clone(), s as usize))
        {
            Some(gauss) => Box::new(gauss.with_tolerance(tolerance)),
            None => self.method.integrator(model),
        }
    }
}

/// A scene that is to be run.
pub(crate) struct Stage<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) model: &'a ArticulatedBody,
    pub(crate) smallest: &'a Smallest,
    pub(crate) until: f64,
    pub(crate) full: bool,
}

impl Stage<'_> {
    /// What a choice comes to.
    pub(crate) fn resolve(&self, choice: Choice) -> Result<Chosen, SimError> {
        match choice {
            Choice::Method {
                method,
                step: Some(step),
            } => match self.longest_with_dampers(method)? {
                longest if step > longest => Err(SimError::DamperPole {
                    method,
                    step,
                    longest,
                }),
                _ => Ok(Chosen {
                    method,
                    step,
                    checked: None,
                }),
            },
            Choice::Method { method, step: None } => {
                positive("time to run to, in seconds,", self.until)?;
                let longest = self.longest_with_dampers(method)?;
                let mut step = self.on_model(DefaultStep {
                    method,
                    longest: self.longest(),
                });
                while step > longest {
                    step *= 0.5;
                }
                Ok(Chosen {
                    method,
                    step,
                    checked: None,
                })
            }
            Choice::Accuracy(accuracy) => {
                check_accuracy(accuracy, self.until)?;
                self.accurate(accuracy)
            }
        }
    }

    /// The integrator that steps the scene.
    pub(crate) fn integrator(&self, chosen: &Chosen) -> BoxedIntegrator<Configuration> {
        match self.full {
            true => chosen.integrator_in_full(self.model.clone()),
            false => chosen.integrator_of_smallest(self.smallest),
        }
    }

    fn accurate(&self, accuracy: f64) -> Result<Chosen, SimError> {
        let (guess, spent) = self.on_model(Guess {
            accuracy,
            longest: self.longest(),
        })?;
        let make = |stages, tolerance| {
            let checked = Checked {
                tolerance,
                estimate: 0.0,
                steps: 0,
            };
            self.integrator(&chosen(stages, self.until, checked))
        };
        let mut search = Search {
            model: self.model,
            make: &make,
            start: self.scene.initial_state()?,
            until: self.until,
            accuracy,
            spent,
        };
        let (found, checked) = search.run(guess)?;
        Ok(chosen(
            found.stages,
            self.until / found.steps as f64,
            checked,
        ))
    }

    /// The longest easy step for what moves as told, s: the unknowns alone may not show how fast that is.
    fn longest(&self) -> f64 {
        TOLD / self.model.told_rate(self.until.min(BEGINNING))
    }

    /// The longest step that keeps away from the poles of dampers, s, as the scene starts.
    fn longest_with_dampers(&self, method: Method) -> Result<f64, SimError> {
        let State { t, g, .. } = self.scene.initial_state()?;
        let rate = self.model.braking_rate(t, &g)?;
        Ok(match rate > 0.0 {
            true => method.longest_with_dampers(self.model.clone(), rate),
            false => f64::INFINITY,
        })
    }

    /// Asks the smallest model, in space or in its plane.
    fn on_model<A: Ask>(&self, question: A) -> A::Answer {
        let Smallest {
            model,
            start,
            plane,
            ..
        } = self.smallest;
        match plane {
            None => question.ask(model, start, self.until),
            Some(plane) => question.ask(&plane.model(), &plane.project(start), self.until),
        }
    }
}

fn chosen(stages: u32, step: f64, checked: Checked) -> Chosen {
    Chosen {
        // No other numbers of stages are tried than there are methods of.
        method: Method::gauss(stages).unwrap_or_default(),
        step,
        checked: Some(checked),
    }
}

/// What is asked of a model, whatever its group.
trait Ask {
    type Answer;

    fn ask<M: Model>(self, model: &M, start: &State<M::Group>, until: f64) -> Self::Answer;
}

/// The step that a method takes where none is given.
struct DefaultStep {
    method: Method,
    /// The longest easy step for what moves as told, s.
    longest: f64,
}

/// The longest easy step of a [`Scout`] on the paper's scene, s.
const PAPER: f64 = 0.1;
/// The radians that what moves as told may go on in an easy step.
const TOLD: f64 = 0.6;
/// A default step is that of the first so many seconds, so that it does not depend on the length of the run.
const BEGINNING: f64 = 100.0;
/// The doublings of a default step, at most: of a motion that hardly moves, and of one that is very fast.
const DOUBLINGS: [f64; 2] = [-60.0, 4.0];
/// Steps that have to be solved.
const TRIED: u32 = 16;
/// Halvings of a step that is not.
const HALVINGS: u32 = 20;

impl Ask for DefaultStep {
    type Answer = f64;

    fn ask<M: Model>(self, model: &M, start: &State<M::Group>, until: f64) -> f64 {
        let scout = Scout::run(model, start, BEGINNING);
        let easy = scout.step.unwrap_or(f64::INFINITY).min(self.longest);
        let ratio = easy / PAPER;
        let doublings = ratio.log2().round().clamp(DOUBLINGS[0], DOUBLINGS[1]);
        let mut step = self.method.default_step() * doublings.exp2();
        for _ in 0..HALVINGS {
            let solved = [start, &scout.fastest]
                .into_iter()
                .all(|start| self.solves(model, start, step.min(until)));
            if solved {
                break;
            }
            step *= 0.5;
        }
        step
    }
}

impl DefaultStep {
    /// Whether the first steps are solved.
    fn solves<M: Model>(&self, model: &M, start: &State<M::Group>, step: f64) -> bool {
        let (mut integrator, mut state) = (self.method.integrator(model.clone()), start.clone());
        (0..TRIED).all(|_| integrator.step(&mut state, step).is_ok())
    }
}

/// Stages and step for an accuracy, not yet checked, and the steps that this took.
struct Guess {
    accuracy: f64,
    /// As of a default step.
    longest: f64,
}

/// The easy steps that a pilot run goes over.
const PILOTED: f64 = 64.0;
/// The part of the accuracy that a pilot's error may come to by the end, if it grows in proportion to time.
const PART: f64 = 0.1;
/// No pilot is asked for less.
const LEAST: f64 = 1e-13;
/// A step is at most so many that are easy for what moves as told.
const LONGEST: f64 = 2.0;
/// A guess where no pilot makes one: the stages, and the step in parts of an easy one.
const FALLBACK: (u32, f64) = (8, 0.25);

impl Ask for Guess {
    type Answer = Result<(Candidate, u64), PilotError>;

    fn ask<M: Model>(self, model: &M, start: &State<M::Group>, until: f64) -> Self::Answer {
        let scout = Scout::run(model, start, until);
        let easy = scout.step.unwrap_or(until).min(self.longest);
        let duration = until.min(PILOTED * easy);
        let wanted = (PART * self.accuracy * duration / until).max(LEAST);
        let pilot = match Pilot::run(model, &scout.fastest, duration, wanted) {
            Err(PilotError::OutOfReach { best, .. }) if 20.0 * best < self.accuracy => {
                Pilot::run(model, &scout.fastest, duration, 20.0 * best)
            }
            found => found,
        };
        let candidate = |stages, step, tolerance| Candidate::new(stages, until, step, tolerance);
        match pilot {
            Ok(pilot) => {
                let step = pilot.h.min(LONGEST * self.longest);
                let guess = candidate(pilot.stages as u32, step, pilot.tolerance);
                Ok((guess, scout.steps + pilot.steps))
            }
            Err(PilotError::OutOfReach { .. }) => {
                let (stages, part) = FALLBACK;
                Ok((candidate(stages, part * easy, 0.0), scout.steps))
            }
            Err(error) => Err(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_scene_takes_the_steps_of_the_table() {
        let text = include_str!("../../../scenes/fish-chain.toml");
        let smallest = Scene::parse(text, "fish-chain.toml")
            .unwrap()
            .smallest()
            .unwrap();
        let scout = Scout::run(&smallest.model, &smallest.start, 100.0);
        let step = scout.step.expect("a step that is too long");
        println!("{step} s, {} steps", scout.steps);
        // Not near the next power of two.
        assert!((step / PAPER).log2().abs() < 0.1, "{step}");
    }
}
