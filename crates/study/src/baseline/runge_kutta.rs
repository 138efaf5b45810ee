//! Methods of a fixed step on raw matrix entries.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{Cause, Integrator, State, StepError, StepReport, check_momentum, check_step};

use super::stages::{combine, evaluate, is_finite};
use super::{Tableau, raw};

/// An explicit Runge–Kutta method on the entries of the rotation matrices, which nothing keeps orthogonal.
///
/// ```
/// use articulated_fluid::{Scene, scene};
/// use dvi::Integrator;
/// use study::baseline::{RungeKutta, Tableau};
///
/// let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
/// let (model, mut state) = (scene.model()?, scene.initial_state()?);
/// let mut integrator = RungeKutta::new(&Tableau::CLASSICAL, model.clone(), &state);
/// (0..10).try_for_each(|_| integrator.step(&mut state, 0.1).map(drop))?;
/// assert!(model.orthogonality_error(&state.g) > 1e-12);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct RungeKutta {
    tableau: &'static Tableau,
    model: ArticulatedBody,
    rates: raw::Rates<f64>,
    steps: u64,
    y: Vec<f64>,
    /// At a stage, and at the end.
    next: Vec<f64>,
    k: Vec<Vec<f64>>,
}

impl RungeKutta {
    /// The method for a model and states of the shape of `state`.
    pub fn new(
        tableau: &'static Tableau,
        model: ArticulatedBody,
        state: &State<Configuration>,
    ) -> Self {
        let y = raw::zero(&state.g);
        Self {
            tableau,
            rates: raw::Rates::new(&model, &state.g),
            model,
            steps: 0,
            next: y.clone(),
            k: vec![y.clone(); tableau.stages()],
            y,
        }
    }
}

impl Integrator for RungeKutta {
    type Group = Configuration;

    fn order(&self) -> u32 {
        self.tableau.order
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
        let at = (self.steps, state.t, h);
        let refused = |cause: Cause| cause.at(at);
        check_step(&self.model, (state.t, &state.g), h).map_err(refused)?;
        check_momentum(&state.mu, self.rates.momentum()).map_err(refused)?;
        let Self {
            tableau,
            rates,
            y,
            next,
            k,
            ..
        } = self;
        raw::write(state, y);
        let mut rhs = |t: f64, y: &[f64], dy: &mut [f64]| rates.evaluate(t, y, dy);
        rhs(state.t, y, &mut k[0]);
        evaluate::<f64>(tableau.rows, &mut rhs, (state.t, y), h, next, k);
        combine::<f64>(next, y, h, tableau.weights, k);
        if !is_finite::<f64>(next) {
            return Err(refused(Cause::NotFinite));
        }
        raw::read(next, &mut state.g, &mut state.mu);
        state.t += h;
        self.steps += 1;
        Ok(StepReport::default())
    }
}
