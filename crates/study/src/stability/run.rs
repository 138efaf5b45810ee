//! One method in steps of one size, from the start until it has gone wrong.

use articulated_fluid::Configuration;
use sim::{BoxedIntegrator, Clock, Run, Sample};

use super::outcome::{End, Judge, Outcome};
use super::window::{Window, kinetic_ahead};
use crate::contender::{Contender, Problem};

/// Times at which a run is looked at, where it has so many steps.
const SAMPLES: u64 = 4096;
/// Steps between two looks at the clock.
const ASK: u64 = 64;
/// Windows in which it is compared with the reference.
const WINDOWS: u64 = 32;

/// What a method comes to in steps of `h`; `late` is asked often, and ends the run unjudged. None of a contender without a step.
pub(super) fn run(
    contender: Contender,
    problem: &Problem,
    h: f64,
    late: &dyn Fn() -> bool,
) -> Option<Outcome> {
    // The whole steps that there is room for; one that rounding alone leaves out is one of them.
    let steps = (problem.until / h + 1e-9).floor().max(1.0) as u64;
    let (integrator, clock) = (contender.integrator(problem)?, Clock::counted(steps, h));
    let mut trial = Trial {
        problem,
        run: Run::new(integrator, problem.start.clone(), clock),
        window: None,
    };
    let Some(start) = Sample::take(&problem.model, &problem.start) else {
        return Some(Outcome::not_finite(problem.start.t));
    };
    // From rest, the first step's error is as large as its energy.
    let mut judge = Judge::new(&problem.model, start, kinetic_ahead(problem, h));
    let end = trial.follow(&mut judge, late);
    Some(judge.judge(end))
}

struct Trial<'a> {
    problem: &'a Problem,
    run: Run<BoxedIntegrator<Configuration>>,
    /// The one that is open, and the step with which it closes.
    window: Option<(u64, Window)>,
}

impl Trial<'_> {
    fn follow(&mut self, judge: &mut Judge, late: &dyn Fn() -> bool) -> End {
        let (model, clock) = (&self.problem.model, *self.run.clock());
        let (steps, h) = (clock.steps(), clock.step());
        let (look, compare) = (steps.div_ceil(SAMPLES), steps.div_ceil(WINDOWS));
        for step in 1..=steps {
            if self.window.is_none() && (step - 1).is_multiple_of(compare) {
                let window = Window::open(model, self.run.state(), h, compare);
                self.window = window.map(|window| (step - 1 + window.steps, window));
            }
            if let Err(error) = self.run.step() {
                return End::Stopped(error, Box::new(self.run.state().clone()));
            }
            self.close_window(step, judge);
            if step.is_multiple_of(look) || step == steps {
                match Sample::take(model, self.run.state()) {
                    None => return End::NotFinite(self.run.state().t),
                    Some(sample) if !judge.add(&sample) => return End::OffBand,
                    Some(_) => {}
                }
            }
            if step.is_multiple_of(ASK) && step < steps && late() {
                return End::OutOfTime;
            }
        }
        End::Reached
    }

    fn close_window(&mut self, step: u64, judge: &mut Judge) {
        if let Some((_, window)) = self.window.take_if(|(last, _)| *last == step)
            && let Some(angle) = window.angle(&self.problem.model, self.run.state())
        {
            judge.compare(angle);
        }
    }
}
