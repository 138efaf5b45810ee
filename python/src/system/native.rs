//! What `lgvi.System` holds.

use dvi::laws::{self, LawError};
use dvi::{Context, Gauss, Lagrangian, Quadrature, State};
use lie::LieGroup;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::elements::{Counts, Elements, coordinates, identity, numbers_of, read, velocity, write};
use super::recorded::{Recorded, RecordedForce};
use super::run::{Frames, Method, Refusal, Systems, Varied, run, vary};
use super::tracer::NativeFormula;
use crate::attend::attend;
use crate::errors;

/// The numbers of the element that a velocity leads to in one second.
#[pyfunction]
pub fn exp(counts: Counts, xi: Vec<f64>) -> PyResult<Vec<f64>> {
    let xi = velocity(&identity(counts), &xi).map_err(PyValueError::new_err)?;
    let mut numbers = Vec::with_capacity(numbers_of(counts));
    write(&Elements::exp(&xi), &mut numbers);
    Ok(numbers)
}

#[pyclass(frozen)]
pub struct NativeSystem {
    systems: Systems,
}

/// Time, numbers of the configuration, coordinates of the velocity.
type Start = (f64, Vec<f64>, Vec<f64>);

#[pymethods]
impl NativeSystem {
    #[new]
    fn new(
        counts: Counts,
        lagrangian: &NativeFormula,
        force: Option<&NativeFormula>,
        parameters: Vec<f64>,
    ) -> Self {
        let lagrangian = Recorded {
            formula: lagrangian.formula.clone(),
            counts,
            parameters: parameters.into(),
        };
        let force = force.map(|force| RecordedForce(force.formula.clone()));
        Self {
            systems: Systems { lagrangian, force },
        }
    }

    fn simulate<'py>(
        &self,
        py: Python<'py>,
        start: Start,
        frames: (f64, Option<Vec<f64>>, u64),
        steps: (String, f64),
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let ((until, times, every), (method, step)) = (frames, steps);
        let frames = match times {
            Some(times) => Frames::At(times.into()),
            None => Frames::Every(every),
        };
        let (method, state) = (self.method(&method)?, self.state(start)?);
        let (systems, means) = (self.systems.clone(), self.systems.means(&state));
        let outcome = attend(py, progress, move |desk| {
            run(&systems, (method, state), (until, step), &frames, desk)
        })?;
        let motion = outcome.map_err(|refusal| raised(py, &refusal))?;
        let motion = motion.ok_or_else(stopped)?;
        let frames = motion.t.len();
        let dict = PyDict::new(py);
        for (name, numbers) in [
            ("numbers", motion.numbers),
            ("velocity", motion.velocity),
            ("momentum", motion.momentum),
        ] {
            let width = numbers.len() / frames.max(1);
            let array = PyArray1::from_vec(py, numbers).reshape([frames, width])?;
            dict.set_item(name, array)?;
        }
        dict.set_item("t", PyArray1::from_vec(py, motion.t))?;
        dict.set_item("energy", PyArray1::from_vec(py, motion.energy))?;
        let (cost, report) = (motion.cost, PyDict::new(py));
        let steps = cost.steps.max(1) as f64;
        report.set_item("steps", cost.steps)?;
        report.set_item("time_per_step_us", cost.time.as_secs_f64() * 1e6 / steps)?;
        report.set_item("solver_residual_max", cost.residual)?;
        report.set_item("solver_iterations_mean", cost.iterations as f64 / steps)?;
        report.set_item("evaluations_per_step_mean", cost.evaluations as f64 / steps)?;
        report.set_item("derivatives", means)?;
        dict.set_item("report", report)?;
        Ok(dict)
    }

    /// Numbers and momentum of the state at the end; its derivatives, column by column.
    #[allow(clippy::type_complexity)]
    fn vary(
        &self,
        py: Python<'_>,
        start: Start,
        until: f64,
        steps: (String, f64),
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Vec<f64>, Vec<f64>, Vec<Vec<f64>>)> {
        let (method, step) = steps;
        let (method, state) = (self.method(&method)?, self.state(start)?);
        let systems = self.systems.clone();
        let outcome = attend(py, progress, move |desk| {
            vary(&systems, (method, state), (until, step), desk)
        })?;
        let varied = outcome.map_err(|refusal| raised(py, &refusal))?;
        let Varied { state, columns } = varied.ok_or_else(stopped)?;
        let mut numbers = Vec::with_capacity(numbers_of(self.systems.lagrangian.counts));
        write(&state.g, &mut numbers);
        Ok((numbers, coordinates(&state.mu), columns))
    }

    /// The laws, each with what it found, and whether it holds.
    fn check(
        &self,
        py: Python<'_>,
        starts: Vec<Start>,
        step: f64,
    ) -> PyResult<Vec<(String, bool, String)>> {
        let states = starts.into_iter().map(|start| self.state(start));
        let states: Vec<_> = states.collect::<PyResult<_>>()?;
        let systems = self.systems.clone();
        attend(py, None, move |_| checked(&systems, &states, step))
    }

    /// The value of the Lagrangian.
    fn value(&self, start: Start) -> PyResult<f64> {
        let lagrangian = &self.systems.lagrangian;
        let (t, numbers, xi) = start;
        let g = read(lagrangian.counts, &numbers).map_err(PyValueError::new_err)?;
        let xi = velocity(&g, &xi).map_err(PyValueError::new_err)?;
        Ok(lagrangian.value(Context::new(t, &lagrangian.parameters), &g, &xi))
    }
}

impl NativeSystem {
    fn method(&self, name: &str) -> PyResult<Method> {
        name.parse().map_err(PyValueError::new_err)
    }

    fn state(&self, (t, numbers, xi): Start) -> PyResult<State<Elements>> {
        let lagrangian = &self.systems.lagrangian;
        let g = read(lagrangian.counts, &numbers).map_err(PyValueError::new_err)?;
        let xi = velocity(&g, &xi).map_err(PyValueError::new_err)?;
        let state = lagrangian.state(t, g, &xi);
        state.map_err(|error| PyValueError::new_err(error.to_string()))
    }
}

fn stopped() -> PyErr {
    PyRuntimeError::new_err("the run was stopped")
}

fn raised(py: Python<'_>, refusal: &Refusal) -> PyErr {
    match refusal {
        Refusal::Step(error) => errors::of_step(py, error, error.step, &error.to_string()),
        Refusal::Clock(error) => errors::of_run(py, error),
    }
}

/// The laws that a system is checked by.
fn checked(systems: &Systems, states: &[State<Elements>], h: f64) -> Vec<(String, bool, String)> {
    let lagrangian = &systems.lagrangian;
    let discrete = lagrangian.clone().discretise(Quadrature::Midpoint);
    let mut out = vec![];
    let mut law = |name: &str, found: Result<String, LawError>| {
        let (holds, what) = match found {
            Ok(what) => (true, what),
            Err(error) => (false, error.to_string()),
        };
        out.push((name.to_owned(), holds, what));
    };
    let compared = |report: laws::Report| {
        format!(
            "{} comparisons, the worst at {:.2} of its tolerance",
            report.comparisons, report.worst
        )
    };
    law(
        "midpoint: derivatives, inertia, Legendre transforms, symplecticity, reversibility",
        laws::check(&discrete, states, h).map(compared),
    );
    law(
        "midpoint: the value is that of L",
        laws::check_consistency(&discrete, lagrangian, states).map(compared),
    );
    let mut gauss = Gauss::new::<4>(lagrangian.clone().hamiltonian());
    law(
        "gauss-4: symplecticity",
        laws::check_symplecticity(&mut gauss, states, h).map(compared),
    );
    let steps = [10, 20, 40];
    for state in states.iter().take(1) {
        let integrator = || systems.integrator(Method::Midpoint);
        let order = laws::check_order(integrator, state, 10.0 * h, &steps);
        let found = order.map(|order| format!("{:.3} observed, 2 declared", order.slope));
        law("midpoint: order", found);
    }
    out
}
