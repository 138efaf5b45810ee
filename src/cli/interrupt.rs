//! Signals that end a command, so that it can clean up after itself.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

#[cfg(feature = "chart")]
use {super::error::CliError, std::panic::resume_unwind, std::thread, std::time::Duration};

/// Time between two looks for a signal.
#[cfg(feature = "chart")]
const LOOK: Duration = Duration::from_millis(20);

#[cfg(unix)]
const ENDING: [i32; 3] = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(not(unix))]
const ENDING: [i32; 2] = [SIGINT, SIGTERM];

/// Remembers that the user wants the command to end.
#[derive(Clone)]
pub struct Interrupt {
    signal: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Listens from now on to the interrupt key, to requests to terminate, and to a terminal that hangs up.
    ///
    /// What the caller has set to be ignored stays so, as `nohup` does it.
    pub fn listen() -> io::Result<Self> {
        let signal = Arc::new(AtomicUsize::new(0));
        for number in ENDING.into_iter().filter(|number| !is_ignored(*number)) {
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

    /// The number of the signal that came, if one did.
    pub fn signal(&self) -> Option<usize> {
        match self.signal.load(Ordering::Relaxed) {
            0 => None,
            signal => Some(signal),
        }
    }

    /// What `work` comes to; an error soon after a signal, wherever the work is: it goes on beside, and ends with the command.
    #[cfg(feature = "chart")]
    pub fn heeding<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, CliError> {
        let waiting = thread::current();
        let worker = thread::Builder::new().spawn(move || {
            let done = work();
            waiting.unpark();
            done
        });
        let worker = worker.map_err(CliError::Thread)?;
        loop {
            if let Some(signal) = self.signal() {
                return Err(CliError::Stopped { signal });
            }
            if worker.is_finished() {
                return Ok(worker.join().unwrap_or_else(|panic| resume_unwind(panic)));
            }
            thread::park_timeout(LOOK);
        }
    }
}

/// Whether the caller has set a signal to be ignored.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let mut action = std::mem::MaybeUninit::<libc::sigaction>::uninit();
    #[allow(
        unsafe_code,
        reason = "it only asks, and the answer is read where there is one"
    )]
    unsafe {
        libc::sigaction(signal, std::ptr::null(), action.as_mut_ptr()) == 0
            && action.assume_init().sa_sigaction == libc::SIG_IGN
    }
}

#[cfg(not(unix))]
fn is_ignored(_: i32) -> bool {
    false
}
