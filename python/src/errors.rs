//! Rust's errors as Python's, with their fields.

use std::io::ErrorKind;
use std::path::Path;

use articulated_fluid::SceneError;
use dvi::{Cause, Hint, StepError};
use gait::GaitError;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sim::SimError;
use urdf::UrdfError;

/// An exception of `lgvi._errors` with a message and fields.
fn with_fields(py: Python<'_>, class: &str, message: &str, fields: &Bound<'_, PyDict>) -> PyErr {
    let made = py
        .import("lgvi._errors")
        .and_then(|module| module.getattr(class))
        .and_then(|class| class.call((message,), Some(fields)));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// A scene's: `OSError` where a file cannot be read, else `lgvi.SceneError`, which is a `ValueError`.
pub fn of_scene(py: Python<'_>, error: &SceneError) -> PyErr {
    let message = error.to_string();
    match error {
        SceneError::Io { source, .. } if source.kind() != ErrorKind::InvalidData => {
            of_file(source, message)
        }
        SceneError::Invalid {
            file,
            line,
            column,
            key,
            ..
        } => {
            let fields = PyDict::new(py);
            let set = fields
                .set_item("file", file)
                .and_then(|()| fields.set_item("line", line))
                .and_then(|()| fields.set_item("column", column))
                .and_then(|()| fields.set_item("key", key));
            match set {
                Ok(()) => with_fields(py, "SceneError", &message, &fields),
                Err(error) => error,
            }
        }
        _ => with_fields(py, "SceneError", &message, &PyDict::new(py)),
    }
}

/// A robot's: `OSError` where the file cannot be read, else `lgvi.SceneError` with the file alone.
pub fn of_robot(py: Python<'_>, file: &Path, error: &UrdfError) -> PyErr {
    let message = format!("{}: {error}", file.display());
    if let UrdfError::Io(source) = error
        && source.kind() != ErrorKind::InvalidData
    {
        return of_file(source, message);
    }
    let fields = PyDict::new(py);
    match fields.set_item("file", file.display().to_string()) {
        Ok(()) => with_fields(py, "SceneError", &message, &fields),
        Err(error) => error,
    }
}

/// A gait's: `lgvi.StepError` where a step was refused, else `ValueError`.
pub fn of_gait(py: Python<'_>, error: &GaitError) -> PyErr {
    match error {
        GaitError::Step(source) => of_step(py, source, source.step, &error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

fn of_file(source: &std::io::Error, message: String) -> PyErr {
    match source.raw_os_error() {
        Some(code) => PyOSError::new_err((code, message)),
        None => PyOSError::new_err(message),
    }
}

/// A run's: `lgvi.StepError` where a step was refused, else `ValueError`.
pub fn of_run(py: Python<'_>, error: &SimError) -> PyErr {
    match error {
        SimError::Step { step, source, .. } => of_step(py, source, *step, &error.to_string()),
        SimError::Rehearsal { source, .. } => of_step(py, source, source.step, &error.to_string()),
        // The command's options are arguments here.
        _ => PyValueError::new_err(
            error
                .to_string()
                .replace("--until", "t")
                .replace("--step", "step"),
        ),
    }
}

/// A refused step's.
pub fn of_step(py: Python<'_>, error: &StepError, step: u64, message: &str) -> PyErr {
    match fields(py, error, step) {
        Ok(fields) => with_fields(py, "StepError", message, &fields),
        Err(error) => error,
    }
}

fn fields<'py>(py: Python<'py>, error: &StepError, step: u64) -> PyResult<Bound<'py, PyDict>> {
    let fields = PyDict::new(py);
    fields.set_item("step", step)?;
    fields.set_item("t", error.t)?;
    fields.set_item("h", error.h)?;
    let cause = match error.cause {
        Cause::NotConverged {
            residual,
            iterations,
            hint,
        } => {
            fields.set_item("residual", residual)?;
            fields.set_item("iterations", iterations)?;
            match hint {
                Hint::SmallerStep { h } | Hint::AnotherBranch { h } => {
                    fields.set_item("suggested_step", h)?;
                }
                Hint::LooserTolerance { tolerance } => {
                    fields.set_item("suggested_tolerance", tolerance)?;
                }
                _ => (),
            }
            "not-converged"
        }
        Cause::InvalidStep => "invalid-step",
        Cause::Misfit => "misfit",
        Cause::Shape { .. } => "shape",
        Cause::Degenerate { coordinate } => {
            fields.set_item("coordinate", coordinate)?;
            "degenerate"
        }
        Cause::NotFinite => "not-finite",
        _ => "other",
    };
    fields.set_item("cause", cause)?;
    Ok(fields)
}
