//! The classical method on raw matrix entries.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{ContinuousSystem, Integrator, State, StepError, StepReport};

use super::check;
use crate::raw;

/// The classical Runge–Kutta method of order 4 on the entries of the rotation matrices, which nothing keeps orthogonal.
///
/// ```
/// use articulated_fluid::{Scene, scene};
/// use dvi::Integrator;
/// use study::explicit::ClassicalRungeKutta;
///
/// let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
/// let (model, mut state) = (scene.model()?, scene.initial_state()?);
/// let mut integrator = ClassicalRungeKutta::new(model.clone(), &state);
/// (0..10).try_for_each(|_| integrator.step(&mut state, 0.1).map(drop))?;
/// assert!(model.orthogonality_error(&state.g) > 1e-12);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct ClassicalRungeKutta {
    model: ArticulatedBody,
    rhs: RightHandSide,
    steps: u64,
    /// The state at the step's start, at a stage and at the end.
    start: Vec<f64>,
    stage: Vec<f64>,
    end: Vec<f64>,
    rate: Vec<f64>,
}

type RightHandSide = Box<dyn FnMut(f64, &[f64], &mut [f64]) + Send>;

/// Node of each stage, and its weight at the end.
const TABLEAU: [(f64, f64); 4] = [
    (0.0, 1.0 / 6.0),
    (0.5, 1.0 / 3.0),
    (0.5, 1.0 / 3.0),
    (1.0, 1.0 / 6.0),
];

impl ClassicalRungeKutta {
    /// The method for a model and states of the shape of `state`.
    pub fn new(model: ArticulatedBody, state: &State<Configuration>) -> Self {
        let y = raw::pack(state);
        Self {
            rhs: Box::new(raw::right_hand_side(&model, state)),
            model,
            steps: 0,
            stage: y.clone(),
            end: y.clone(),
            rate: vec![0.0; y.len()],
            start: y,
        }
    }

    /// Leaves the end of the step from `start` in `end`.
    fn advance(&mut self, t: f64, h: f64) {
        self.end.copy_from_slice(&self.start);
        for (node, weight) in TABLEAU {
            add(&mut self.stage, &self.start, node * h, &self.rate);
            (self.rhs)(t + node * h, &self.stage, &mut self.rate);
            for (y, rate) in self.end.iter_mut().zip(&self.rate) {
                *y += weight * h * rate;
            }
        }
    }
}

fn add(out: &mut [f64], y: &[f64], factor: f64, rate: &[f64]) {
    if factor == 0.0 {
        return out.copy_from_slice(y);
    }
    for ((out, y), rate) in out.iter_mut().zip(y).zip(rate) {
        *out = y + factor * rate;
    }
}

impl Integrator for ClassicalRungeKutta {
    type Group = Configuration;

    fn order(&self) -> u32 {
        4
    }

    fn is_symmetric(&self) -> bool {
        false
    }

    fn is_symplectic(&self) -> bool {
        false
    }

    fn reset(&mut self) {
        self.steps = 0;
    }

    fn step(&mut self, state: &mut State<Configuration>, h: f64) -> Result<StepReport, StepError> {
        let fits = self.model.fits(&state.g) && self.start.len() == raw::length(state);
        check(state, h, self.steps, fits)?;
        raw::write(state, &mut self.start);
        self.advance(state.t, h);
        if !self.end.iter().all(|y| y.is_finite()) {
            let (step, t) = (self.steps, state.t);
            return Err(StepError::NotFinite { step, t, h });
        }
        raw::fill(state, &self.end);
        state.t += h;
        self.steps += 1;
        Ok(StepReport::default())
    }
}
