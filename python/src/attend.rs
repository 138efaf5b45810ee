//! Work on another thread, while this one heeds Ctrl-C and shows progress.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use pyo3::prelude::*;

/// Between two looks at signals.
const PATIENCE: Duration = Duration::from_millis(30);

/// What the two threads tell one another.
#[derive(Default)]
pub struct Desk {
    is_stopped: Arc<AtomicBool>,
    /// The bits of how far the work is.
    reached: AtomicU64,
}

impl Desk {
    /// Whether nobody waits for the work any more.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }

    /// For a part of the work, which stops with the whole, and whose progress is its own.
    pub fn part(&self) -> Self {
        Self {
            is_stopped: self.is_stopped.clone(),
            reached: AtomicU64::default(),
        }
    }

    /// Tells how far the work is.
    pub fn reach(&self, at: f64) {
        self.reached.store(at.to_bits(), Ordering::Relaxed);
    }

    fn reached(&self) -> f64 {
        f64::from_bits(self.reached.load(Ordering::Relaxed))
    }
}

/// Does the work without holding the interpreter; `progress` is called with how far it is, and at its end.
///
/// # Errors
/// What a signal's handler or `progress` raises: then the work stops at its next look at the [`Desk`].
pub fn attend<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&Desk) -> T + Send + 'static,
) -> PyResult<T> {
    let desk = Arc::new(Desk::default());
    let (done, result) = channel();
    let theirs = desk.clone();
    let worker = std::thread::spawn(move || {
        // Nobody receives what is no longer waited for.
        let _ = done.send(work(&theirs));
    });
    let (desk, progress) = (&desk, &progress);
    let look = move |py: Python<'_>| {
        py.check_signals()?;
        match progress {
            Some(progress) => progress.call1(py, (desk.reached(),)).map(drop),
            None => Ok(()),
        }
    };
    let outcome = py.detach(move || {
        loop {
            match result.recv_timeout(PATIENCE) {
                Ok(value) => break Ok(Some(value)),
                Err(RecvTimeoutError::Disconnected) => break Ok(None),
                Err(RecvTimeoutError::Timeout) => {
                    if let Err(error) = Python::attach(look) {
                        desk.is_stopped.store(true, Ordering::Relaxed);
                        break Err(error);
                    }
                }
            }
        }
    });
    match outcome? {
        Some(value) => {
            look(py)?;
            Ok(value)
        }
        None => match worker.join() {
            Err(panic) => std::panic::resume_unwind(panic),
            Ok(()) => Err(pyo3::exceptions::PyRuntimeError::new_err(
                "the work ended without a result",
            )),
        },
    }
}
