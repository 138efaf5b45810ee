//! Text to the terminal, where a reader may have gone.

use std::io::{self, ErrorKind, Write};

use super::error::CliError;

/// Writes `text` to stdout; that nobody reads it is no error.
pub fn stdout(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::Stdout(error)),
        _ => Ok(()),
    }
}

/// Writes an error to stderr, if it can be written.
pub fn error(error: &CliError) {
    let _ = writeln!(io::stderr(), "error: {error}");
}

/// A number with all its digits, and with an exponent where there would be many zeros.
pub fn decimal(value: f64) -> String {
    let moderate = value == 0.0 || (1e-6..1e12).contains(&value.abs());
    if moderate {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}
