//! The text of a scene file: its syntax, and messages as `FILE:LINE:COLUMN: KEY: what is wrong`.

use std::cell::{OnceCell, RefCell};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use toml::Spanned;
use toml::de::DeTable;

use super::error::{MOST_BYTES, SceneError};
use super::note::Note;

/// Longest piece of the file's own text in a message, in characters.
const QUOTE: usize = 120;

/// What gives the bytes of a file, by its path.
pub type Reads<'a> = dyn Fn(&Path) -> io::Result<Vec<u8>> + 'a;

pub(super) struct Source<'a> {
    text: &'a str,
    file: &'a str,
    /// What reads the tables that the scene names.
    pub reads: &'a Reads<'a>,
    /// What was corrected so far.
    pub notes: RefCell<Vec<Note>>,
    /// The bytes at which lines end: each body may ask for its line.
    newlines: OnceCell<Vec<usize>>,
}

impl<'a> Source<'a> {
    pub fn new(text: &'a str, file: &'a str, reads: &'a Reads) -> Self {
        Self {
            text,
            file,
            reads,
            notes: RefCell::default(),
            newlines: OnceCell::new(),
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
        let (line, column) = (self.line(offset), self.column(offset));
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
        self.newlines_before(offset).len() + 1
    }

    /// The column of the byte at `offset`, from 1, in characters.
    fn column(&self, offset: usize) -> usize {
        let start = self.newlines_before(offset).last().map_or(0, |end| end + 1);
        let line = self.text.get(start..).unwrap_or("");
        let before = line.char_indices();
        let before = before.take_while(|(at, c)| start + at + c.len_utf8() <= offset);
        // A byte order mark is invisible in an editor.
        before.skip_while(|(_, c)| *c == '\u{feff}').count() + 1
    }

    fn newlines_before(&self, offset: usize) -> &[usize] {
        let all = || self.text.match_indices('\n').map(|(at, _)| at).collect();
        let all: &Vec<usize> = self.newlines.get_or_init(all);
        &all[..all.partition_point(|at| *at < offset)]
    }

    /// What was noted, in the order of the lines.
    pub fn into_notes(self) -> Vec<Note> {
        let mut notes = self.notes.into_inner();
        notes.sort_by_key(|note| note.line);
        notes
    }
}

/// The bytes of a file, or as many as tell that it is larger than [`MOST_BYTES`]: it may be a device without end.
///
/// # Errors
/// Those of the operating system.
pub fn read_bounded(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = vec![];
    let file = File::open(path)?;
    file.take(MOST_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
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
