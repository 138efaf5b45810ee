//! Text to the terminal, where a reader may have gone.

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};

use serde::Serialize;

use super::error::CliError;

/// Writes `text` to stdout; that nobody reads it is no error.
pub fn stdout(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::Stdout(error)),
        _ => Ok(()),
    }
}

/// Writes text to stderr, if it can be written.
pub fn stderr(text: &str) {
    let _ = write!(io::stderr(), "{text}");
}

/// Writes an error to stderr, on a line.
pub fn error(error: &CliError) {
    let error = escaped(&error.to_string(), |_| false);
    stderr(&format!("error: {error}\n"));
}

/// Writes what a user had better know to stderr, on a line.
pub fn warning(what: &impl Display) {
    let what = escaped(&what.to_string(), |_| false);
    stderr(&format!("warning: {what}\n"));
}

/// Writes what is worth knowing to stderr, on a line.
pub fn note(what: &impl Display) {
    let what = escaped(&what.to_string(), |_| false);
    stderr(&format!("note: {what}\n"));
}

/// The text with its control characters written out, but for those to be kept: paths and arguments may have any, and a terminal
/// obeys them.
pub fn escaped(text: &str, is_kept: impl Fn(char) -> bool) -> String {
    let escape = |c: char| match c.is_control() && !is_kept(c) {
        true => c.escape_debug().to_string(),
        false => c.to_string(),
    };
    text.chars().map(escape).collect()
}

/// Names are the user's own, and may hold what breaks lines.
pub fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

/// A value as JSON on a line.
pub fn json(value: &impl Serialize) -> Result<String, CliError> {
    let text = serde_json::to_string(value).map_err(|error| CliError::Stdout(error.into()))?;
    Ok(text + "\n")
}

/// Rows with their columns aligned to the left, two spaces apart.
pub fn columns<R: AsRef<[String]>>(rows: &[R]) -> String {
    let count = rows.iter().map(|row| row.as_ref().len()).max().unwrap_or(0);
    let width = |column: usize| {
        let texts = rows.iter().filter_map(|row| row.as_ref().get(column));
        texts.map(|text| text.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..count).map(width).collect();
    let line = |row: &R| {
        let padded = row
            .as_ref()
            .iter()
            .zip(&widths)
            .map(|(text, width)| format!("{text:width$}  "));
        padded.collect::<String>().trim_end().to_owned() + "\n"
    };
    rows.iter().map(line).collect()
}
