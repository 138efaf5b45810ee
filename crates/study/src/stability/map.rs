//! The grid, and its cells run side by side.

use std::time::{Duration, Instant};

use articulated_fluid::Scene;
use rayon::iter::{IntoParallelRefIterator, ParallelBridge, ParallelIterator};
use serde::Serialize;

use super::outcome::{Class, Outcome};
use super::run::run;
use super::wall::Limit;
use super::{Parameter, ParameterError};
use crate::contender::{Contender, Control, Problem};

/// What is run: every method in steps of every size at every value of the parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Grid {
    /// What is varied.
    pub parameter: Parameter,
    /// The multiples of the scene's own, from small to large.
    pub values: Vec<f64>,
    /// Each once, in the order given; none that chooses its steps.
    #[serde(skip)]
    pub methods: Vec<Contender>,
    /// The sizes of the steps, s, from short to long.
    #[serde(rename = "steps_seconds")]
    pub steps: Vec<f64>,
    /// How long the motion is followed, s.
    #[serde(rename = "until_seconds")]
    pub until: f64,
}

impl Grid {
    /// The grid over these; what is there twice counts once, and a method that chooses its steps has no place on it.
    pub fn new(
        parameter: Parameter,
        values: &[f64],
        methods: &[Contender],
        steps: &[f64],
        until: f64,
    ) -> Self {
        let mut once: Vec<Contender> = vec![];
        for &method in methods {
            if method.control() == Control::Step && !once.contains(&method) {
                once.push(method);
            }
        }
        Self {
            parameter,
            values: sorted(values),
            methods: once,
            steps: sorted(steps),
            until,
        }
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.values.len() * self.methods.len() * self.steps.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

fn sorted(numbers: &[f64]) -> Vec<f64> {
    let mut numbers = numbers.to_vec();
    numbers.sort_by(f64::total_cmp);
    numbers.dedup();
    numbers
}

/// What bounds the run of a grid, and hears of it.
pub struct Pace<'a> {
    /// After this time no cell is begun, and those on their way are given up.
    pub budget: Duration,
    /// Asked often; once it says so, all ends as if the time were over.
    pub stop: &'a (dyn Fn() -> bool + Sync),
    /// Told of each cell when it is done.
    pub done: &'a (dyn Fn() + Sync),
}

/// A grid and what came of it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Map {
    /// What was run.
    pub grid: Grid,
    /// Method by method, within that value by value, within that step by step.
    cells: Vec<Outcome>,
    /// Method by method, within that value by value.
    limits: Vec<Limit>,
}

impl Map {
    /// Runs the cells of a grid on all processors, the cheapest first.
    ///
    /// # Errors
    /// [`ParameterError`] where the scene cannot be varied so.
    pub fn new(scene: &Scene, grid: Grid, pace: &Pace) -> Result<Self, ParameterError> {
        let problem = |value: &f64| grid.parameter.problem(scene, *value, grid.until);
        let problems: Vec<Problem> = grid.values.iter().map(problem).collect::<Result<_, _>>()?;
        let begin = Instant::now();
        let late = || (pace.stop)() || begin.elapsed() >= pace.budget;
        let places = by_cost(&grid);
        // A bridge keeps their order.
        let ran = places.iter().par_bridge().map(|&place @ [m, v, s]| {
            let outcome = match late() {
                true => None,
                false => run(grid.methods[m], &problems[v], grid.steps[s], &late),
            };
            (pace.done)();
            (place, outcome.unwrap_or(Outcome::NOT_RUN))
        });
        let mut ran: Vec<_> = ran.collect();
        ran.sort_by_key(|(place, _)| *place);
        let cells: Vec<Outcome> = ran.into_iter().map(|(_, outcome)| outcome).collect();
        let rows: Vec<_> = cells.chunks(grid.steps.len().max(1)).enumerate().collect();
        let limits = rows.par_iter().map(|&(row, cells)| {
            let (method, value) = (row / grid.values.len(), row % grid.values.len());
            Limit::new(
                grid.methods[method],
                &problems[value],
                &grid.steps,
                cells,
                late(),
            )
        });
        let limits = limits.collect();
        Ok(Self {
            grid,
            cells,
            limits,
        })
    }

    /// The outcome of a method at a value in steps of a size, by their indices in the grid.
    pub fn cell(&self, method: usize, value: usize, step: usize) -> &Outcome {
        let Grid { values, steps, .. } = &self.grid;
        &self.cells[(method * values.len() + value) * steps.len() + step]
    }

    /// How far a method is good at a value, by their indices in the grid.
    pub fn limit(&self, method: usize, value: usize) -> &Limit {
        &self.limits[method * self.grid.values.len() + value]
    }

    /// How many cells are of a class.
    pub fn count(&self, class: Class) -> usize {
        let same = |cell: &&Outcome| cell.class == class;
        self.cells.iter().filter(same).count()
    }
}

/// The cells from long steps to short ones.
fn by_cost(grid: &Grid) -> Vec<[usize; 3]> {
    let (methods, values) = (grid.methods.len(), grid.values.len());
    let of_step = |step| (0..methods).flat_map(move |m| (0..values).map(move |v| [m, v, step]));
    (0..grid.steps.len()).rev().flat_map(of_step).collect()
}
