//! The text of a scene file: its syntax, and messages as `FILE:LINE:COLUMN: KEY: what is wrong`.

use std::cell::RefCell;
use std::path::Path;

use toml::Spanned;
use toml::de::DeTable;

use super::error::SceneError;
use super::note::Note;

/// Longest piece of the file's own text in a message, in characters.
const QUOTE: usize = 120;

pub(super) struct Source<'a> {
    text: &'a str,
    file: &'a str,
    /// What was corrected so far.
    pub notes: RefCell<Vec<Note>>,
}

impl<'a> Source<'a> {
    pub fn new(text: &'a str, file: &'a str) -> Self {
        Self {
            text,
            file,
            notes: RefCell::default(),
        }
    }

    /// Where the scene is.
    pub fn folder(&self) -> &Path {
        Path::new(self.file).parent().unwrap_or(Path::new(""))
    }

    /// Parses the TOML syntax.
    pub fn parse(&self) -> Result<Spanned<DeTable<'a>>, SceneError> {
        DeTable::parse(self.text).map_err(|error| self.syntax_error(&error))
    }

    fn syntax_error(&self, error: &toml::de::Error) -> SceneError {
        let offset = error.span().map_or(self.text.len(), |span| span.start);
        let message = error.message().replacen(", expected ", "; expected ", 1);
        let message = format!("TOML syntax: {}", quote(&message));
        match key_of_line(self.text, offset) {
            "" => self.error("TOML", offset, message),
            key => self.error(&quote(key), offset, message),
        }
    }

    /// The error about the key that starts at `offset`.
    pub fn error(&self, key: &str, offset: usize, message: String) -> SceneError {
        let (line, column) = position(self.text, offset);
        SceneError::Invalid {
            file: self.file.to_owned(),
            line,
            column,
            key: key.to_owned(),
            message,
        }
    }

    /// The line of the byte at `offset`, from 1.
    pub fn line(&self, offset: usize) -> usize {
        position(self.text, offset).0
    }

    /// What was noted, in the order of the lines.
    pub fn into_notes(self) -> Vec<Note> {
        let mut notes = self.notes.into_inner();
        notes.sort_by_key(|note| note.line);
        notes
    }
}

/// What is left of `=` in the line of `offset`: broken text has no other key.
fn key_of_line(text: &str, offset: usize) -> &str {
    let start = text
        .get(..offset)
        .and_then(|before| before.rfind('\n'))
        .map_or(0, |newline| newline + 1);
    let line = text.get(start..).unwrap_or("").lines().next().unwrap_or("");
    line.split('=').next().unwrap_or("").trim()
}

/// `text` on one line and not too long.
pub(super) fn quote(text: &str) -> String {
    let escape = |c: char| match c.is_control() {
        true => c.escape_debug().to_string(),
        false => c.to_string(),
    };
    let mut short: String = text.chars().take(QUOTE).map(escape).collect();
    if text.chars().nth(QUOTE).is_some() {
        short.push_str("...");
    }
    short
}

/// Line and column, from 1, of the byte at `offset`; the column counts characters.
fn position(text: &str, offset: usize) -> (usize, usize) {
    let before = (0..=offset.min(text.len()))
        .rev()
        .find_map(|end| text.get(..end));
    let before = before.unwrap_or("");
    let line = before.matches('\n').count() + 1;
    let last = before.rsplit('\n').next().unwrap_or("");
    // A byte order mark is invisible in an editor.
    let column = last.trim_start_matches('\u{feff}').chars().count() + 1;
    (line, column)
}
