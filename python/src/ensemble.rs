//! Many runs on all cores.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyList;
use sim::SimError;

use crate::attend::{Desk, attend};
use crate::errors;
use crate::run::{Arguments, Trajectory, Wanted, run};
use crate::scene::NativeScene;

type Outcome = Result<Option<Trajectory>, SimError>;

/// The runs of scenes, on `workers` threads: for each a dictionary, or the exception that it met.
#[pyfunction]
pub fn ensemble<'py>(
    py: Python<'py>,
    scenes: Vec<Py<NativeScene>>,
    arguments: Arguments,
    workers: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyList>> {
    let wanted = Wanted::new(arguments)?;
    let scenes: Vec<_> = scenes.iter().map(|scene| scene.get().shared()).collect();
    let outcomes = attend(py, progress, move |desk| {
        all(scenes.len(), workers, desk, |i, desk| {
            run(&scenes[i], &wanted, desk)
        })
    })?;
    let rows = PyList::empty(py);
    for outcome in outcomes {
        match outcome {
            Ok(Some(trajectory)) => rows.append(trajectory.into_dict(py)?)?,
            Ok(None) => rows.append(py.None())?,
            Err(error) => rows.append(errors::of_run(py, &error).into_value(py))?,
        }
    }
    Ok(rows)
}

/// Does each of `count` pieces of work once, whichever thread is free; the results are in their order.
fn all(
    count: usize,
    workers: usize,
    desk: &Desk,
    work: impl Fn(usize, &Desk) -> Outcome + Sync,
) -> Vec<Outcome> {
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let results: Arc<Mutex<Vec<Option<Outcome>>>> =
        Arc::new(Mutex::new((0..count).map(|_| None).collect()));
    let worker = || {
        let part = desk.part();
        while !desk.is_stopped() {
            let i = next.fetch_add(1, Ordering::Relaxed);
            if i >= count {
                break;
            }
            let outcome = work(i, &part);
            results.lock().unwrap_or_else(PoisonError::into_inner)[i] = Some(outcome);
            desk.reach((done.fetch_add(1, Ordering::Relaxed) + 1) as f64);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..workers.clamp(1, count.max(1)) {
            scope.spawn(worker);
        }
    });
    let mut results = results.lock().unwrap_or_else(PoisonError::into_inner);
    results
        .iter_mut()
        .map(|outcome| outcome.take().unwrap_or(Ok(None)))
        .collect()
}
