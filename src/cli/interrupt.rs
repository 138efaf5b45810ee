//! Signals that end a run, so that it can clean up after itself.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Remembers that the user wants the command to end.
pub struct Interrupt {
    signal: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Listens to the interrupt key and to requests to terminate, from now on.
    pub fn listen() -> io::Result<Self> {
        let signal = Arc::new(AtomicUsize::new(0));
        for number in [SIGINT, SIGTERM] {
            // The second one ends the command at once, whatever it is at.
            let came = Arc::new(AtomicBool::new(false));
            flag::register_conditional_shutdown(number, 128 + number, came.clone())?;
            flag::register(number, came)?;
            flag::register_usize(number, signal.clone(), number.unsigned_abs() as usize)?;
        }
        // A file over the size limit is then a failed write.
        #[cfg(unix)]
        flag::register(
            signal_hook::consts::SIGXFSZ,
            Arc::new(AtomicBool::new(false)),
        )?;
        Ok(Self { signal })
    }

    /// An error where a signal came.
    #[cfg(feature = "chart")]
    pub fn heed(&self) -> Result<(), super::error::CliError> {
        match self.signal() {
            Some(signal) => Err(super::error::CliError::Stopped { signal }),
            None => Ok(()),
        }
    }

    /// The number of the signal that came, if one did.
    pub fn signal(&self) -> Option<usize> {
        match self.signal.load(Ordering::Relaxed) {
            0 => None,
            signal => Some(signal),
        }
    }
}
