//! A run of a scene, from its plan to arrays.

use std::sync::Arc;

use articulated_fluid::Scene;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sim::table::Rows;
use sim::{Choice, Frame, Method, Plan, Report, Schedule, SimError, Simulation};
use view::{Motion, Recording, facts};

use crate::attend::Desk;

/// What is asked of each run.
#[derive(Clone)]
pub struct Wanted {
    pub plan: Plan,
    /// The times of the frames; without them, those of the plan's schedule.
    pub times: Option<Arc<[f64]>>,
    /// Whether frames inside a step take steps of their own.
    pub exact: bool,
}

/// As Python gives it: until when, the times of frames, method, step, accuracy, steps between frames; whether in full, with an estimate, exact.
pub type Arguments = (
    f64,
    Option<Vec<f64>>,
    Option<String>,
    Option<f64>,
    Option<f64>,
    u64,
    bool,
    bool,
    bool,
);

impl Wanted {
    /// # Errors
    /// `ValueError` of an unknown method.
    pub fn new(
        (until, times, method, step, accuracy, every, full, estimate, exact): Arguments,
    ) -> PyResult<Self> {
        let choice = match (accuracy, method) {
            (Some(accuracy), _) => Choice::Accuracy(accuracy),
            (None, method) => {
                let method = method.as_deref().unwrap_or("gauss-8").parse::<Method>();
                let method = method.map_err(|error| PyValueError::new_err(error.to_string()))?;
                Choice::Method { method, step }
            }
        };
        let schedule = Schedule::Steps(every);
        Ok(Self {
            plan: Plan {
                choice,
                until,
                schedule,
                full,
                estimate,
            },
            times: times.map(Arc::from),
            exact,
        })
    }
}

/// What is seen of a run.
pub struct Trajectory {
    names: Vec<String>,
    /// Frame by frame, the numbers of the names.
    table: Vec<f64>,
    /// Frame by frame, body by body, row by row.
    attitudes: Vec<f64>,
    frames: usize,
    bodies: usize,
    report: Report,
}

/// Runs a scene to its end; none where nobody waits for it.
///
/// # Errors
/// [`SimError`].
pub fn run(scene: &Scene, wanted: &Wanted, desk: &Desk) -> Result<Option<Trajectory>, SimError> {
    let mut seen = Seen::new(scene);
    let done = see_all(scene, wanted, desk, |_, frame| seen.add(frame))?;
    Ok(done.map(|simulation| seen.end(simulation.report())))
}

/// The same as a page with a moving picture.
///
/// # Errors
/// [`SimError`].
pub fn page(scene: &Scene, wanted: &Wanted, desk: &Desk) -> Result<Option<String>, SimError> {
    let mut recorded: Option<Recording> = None;
    let done = see_all(scene, wanted, desk, |simulation, frame| {
        let recording = recorded.get_or_insert_with(|| Recording::new(simulation.model()));
        recording.add(frame);
    })?;
    let title = scene.title.as_deref().unwrap_or("a run");
    let page = |(simulation, recording): (Simulation, &Recording)| {
        let report = simulation.report();
        let motion = Motion {
            name: report.method,
            facts: &facts(&report),
            recording,
        };
        view::page(scene, title, &[motion])
    };
    Ok(done.zip(recorded.as_ref()).map(page))
}

/// Runs a scene to its end, and shows each frame; none where nobody waits for it.
fn see_all(
    scene: &Scene,
    wanted: &Wanted,
    desk: &Desk,
    mut see: impl FnMut(&Simulation, &Frame),
) -> Result<Option<Simulation>, SimError> {
    let mut simulation = Simulation::new(scene, &wanted.plan)?;
    if !wanted.exact {
        simulation = simulation.interpolated();
    }
    let Some(times) = &wanted.times else {
        while !simulation.is_done() {
            if let Some(frame) = simulation.advance()? {
                see(&simulation, &frame);
            }
            if !heeded(&simulation, desk) {
                return Ok(None);
            }
        }
        return Ok(Some(simulation));
    };
    for t in times.iter() {
        loop {
            let frame = simulation.advance_to(*t)?;
            if !heeded(&simulation, desk) {
                return Ok(None);
            }
            if let Some(frame) = frame {
                see(&simulation, &frame);
                break;
            }
        }
    }
    Ok(Some(simulation))
}

/// Tells how far it is, and asks whether to go on.
fn heeded(simulation: &Simulation, desk: &Desk) -> bool {
    desk.reach(simulation.state().t);
    !desk.is_stopped()
}

/// The frames so far.
struct Seen {
    rows: Rows,
    bodies: usize,
    frames: usize,
    table: Vec<f64>,
    attitudes: Vec<f64>,
}

impl Seen {
    fn new(scene: &Scene) -> Self {
        Self {
            rows: Rows::of_all(scene),
            bodies: scene.bodies.len(),
            frames: 0,
            table: vec![],
            attitudes: vec![],
        }
    }

    fn add(&mut self, frame: &Frame) {
        self.frames += 1;
        // The frame is one of the same scene.
        self.table.extend(self.rows.row(frame).unwrap_or_default());
        for attitude in &frame.bodies.attitudes {
            self.attitudes.extend(attitude.matrix().0.as_flattened());
        }
    }

    fn end(self, report: Report) -> Trajectory {
        Trajectory {
            names: self.rows.names(),
            table: self.table,
            attitudes: self.attitudes,
            frames: self.frames,
            bodies: self.bodies,
            report,
        }
    }
}

impl Trajectory {
    /// As Python's `lgvi.Run` takes it, without a copy of the numbers.
    ///
    /// # Errors
    /// Those of Python.
    pub fn into_dict(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let (frames, bodies, width) = (self.frames, self.bodies, self.names.len());
        let dict = PyDict::new(py);
        dict.set_item("names", self.names)?;
        let table = PyArray1::from_vec(py, self.table).reshape([frames, width])?;
        dict.set_item("table", table)?;
        let attitudes = PyArray1::from_vec(py, self.attitudes).reshape([frames, bodies, 3, 3])?;
        dict.set_item("attitude", attitudes)?;
        let report = serde_json::to_string(&self.report);
        let report = report.map_err(|error| PyValueError::new_err(error.to_string()))?;
        dict.set_item("report", report)?;
        Ok(dict)
    }
}

/// All methods: what is known of each, as JSON.
#[pyfunction]
pub fn methods() -> PyResult<String> {
    let all: Vec<Method> = Method::all().collect();
    serde_json::to_string(&all).map_err(|error| PyValueError::new_err(error.to_string()))
}
