//! Signals that end a command, so that it can clean up after itself.

use std::io;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::error::CliError;

/// Time between two looks for a signal.
const LOOK: Duration = Duration::from_millis(20);
/// What a main thread has, in bytes.
const STACK: usize = 8 << 20;

#[cfg(unix)]
const ENDING: [i32; 3] = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(not(unix))]
const ENDING: [i32; 2] = [SIGINT, SIGTERM];

/// Remembers that the user wants the command to end.
pub struct Interrupt {
    signal: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Listens from now on to the interrupt key, to requests to terminate, and to a terminal that hangs up.
    ///
    /// A caller may have set the last to be ignored, as `nohup` does: then it stays so. Shells set the key's signal so for what they
    /// run in the background, where one sent on purpose still counts.
    pub fn listen() -> io::Result<Self> {
        let signal = Arc::new(AtomicUsize::new(0));
        let counts = |number: &i32| [SIGINT, SIGTERM].contains(number) || !is_ignored(*number);
        for number in ENDING.into_iter().filter(counts) {
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

    /// The number of the signal, once one came.
    pub fn signal(&self) -> Option<usize> {
        match self.signal.load(Ordering::Relaxed) {
            0 => None,
            signal => Some(signal),
        }
    }

    /// What `work` comes to, or the number of a signal, soon after it came: wherever the work is, it goes on beside and ends with the
    /// command.
    pub fn heeding<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> Result<T, CliError> + Send + 'static,
    ) -> Result<Result<T, CliError>, usize> {
        let waiting = thread::current();
        let worker = thread::Builder::new().stack_size(STACK).spawn(move || {
            let done = work();
            waiting.unpark();
            done
        });
        let worker = match worker {
            Ok(worker) => worker,
            Err(error) => return Ok(Err(CliError::Thread(error))),
        };
        loop {
            match self.signal() {
                Some(signal) => return Err(signal),
                None if worker.is_finished() => {
                    return Ok(worker.join().unwrap_or_else(|panic| resume_unwind(panic)));
                }
                None => thread::park_timeout(LOOK),
            }
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
