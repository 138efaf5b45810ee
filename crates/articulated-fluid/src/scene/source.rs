//! The text of a scene file: from byte offsets to `FILE:LINE:COLUMN: KEY`.

use std::cell::RefCell;
use std::ops::Range;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::error::SceneError;
use super::keys::expected;
use super::note::{Correction, Note};
use super::raw::Node;

/// Longest piece of the file's own text in a message, in characters.
const QUOTE: usize = 120;

/// How a key begins that the `toml` crate uses to hand over dates.
const PRIVATE_KEY: &str = "$__toml";

const DATE: &str = "wrong type: date or time";

pub(super) struct Source<'a> {
    text: &'a str,
    file: &'a str,
    tree: Spanned<DeTable<'a>>,
    /// What was corrected so far.
    notes: RefCell<Vec<Note>>,
}

/// A key: its dotted path and the byte offset at which it starts.
struct Place {
    path: String,
    offset: usize,
}

impl<'a> Source<'a> {
    /// Parses the TOML syntax.
    pub fn new(text: &'a str, file: &'a str) -> Result<Self, SceneError> {
        match DeTable::parse(text) {
            Ok(tree) => Ok(Self {
                text,
                file,
                tree,
                notes: RefCell::default(),
            }),
            Err(error) => Err(syntax_error(text, file, &error)),
        }
    }

    /// Reads the TOML tree as a `T`: its keys and the types of its values.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, SceneError> {
        T::deserialize(Deserializer::from(self.tree.clone())).map_err(|error| {
            let span = error.span().unwrap_or_default();
            match unknown_key(error.message()) {
                Some(allowed) => self.fail(span, &format!("unknown key; expected {allowed}")),
                None => {
                    let written = self.text.get(span.clone()).unwrap_or("");
                    self.wrong(span, &wrong_type(error.message(), written))
                }
            }
        })
    }

    /// The value of a required `key` of `table`.
    pub fn require<'v, T, V>(
        &self,
        table: &Node<T>,
        key: &str,
        value: &'v Option<V>,
    ) -> Result<&'v V, SceneError> {
        value
            .as_ref()
            .ok_or_else(|| self.missing(table.span(), key))
    }

    /// The error that the value at `span` is not what its key expects: `what` says how.
    pub fn wrong(&self, span: Range<usize>, what: &str) -> SceneError {
        let place = self.place(&span);
        let message = match expected(&place.path) {
            Some(expected) => format!("{what}; expected {expected}"),
            None => what.to_owned(),
        };
        self.at(place, message)
    }

    /// The error `message` about the key of the value at `span`.
    pub fn fail(&self, span: Range<usize>, message: &str) -> SceneError {
        self.at(self.place(&span), message.to_owned())
    }

    /// The error that the table at `span` lacks `key`.
    pub fn missing(&self, span: Range<usize>, key: &str) -> SceneError {
        let place = self.place(&span);
        let path = format!("{}.{key}", place.path);
        let message = format!("missing; expected {}", expected(&path).unwrap_or("a value"));
        self.at(Place { path, ..place }, message)
    }

    /// The error that the file lacks the table `key`.
    pub fn absent(&self, key: &str) -> SceneError {
        let path = key.to_owned();
        let message = format!("missing; expected {}", expected(key).unwrap_or("a table"));
        self.at(Place { path, offset: 0 }, message)
    }

    /// Notes that the value at `span`, of a body, was corrected.
    pub fn note(&self, span: Range<usize>, correction: Correction, off: f64) {
        let place = self.place(&span);
        self.notes.borrow_mut().push(Note {
            body: self.body(span.start).unwrap_or_default(),
            line: position(self.text, place.offset).0,
            key: place.path,
            correction,
            off,
        });
    }

    /// What was noted, in the order of the lines.
    pub fn into_notes(self) -> Vec<Note> {
        let mut notes = self.notes.into_inner();
        notes.sort_by_key(|note| note.line);
        notes
    }

    /// The name of the body whose table has `offset`.
    fn body(&self, offset: usize) -> Option<String> {
        let bodies = self.tree.get_ref().get("body")?.get_ref().as_array()?;
        let mut tables = bodies.iter().filter_map(|body| body.get_ref().as_table());
        let table = tables.find(|table| find(table, "", offset).is_some())?;
        table.get("name")?.get_ref().as_str().map(str::to_owned)
    }

    /// The line of `span`, from 1.
    pub fn line(&self, span: Range<usize>) -> usize {
        position(self.text, span.start).0
    }

    fn at(&self, place: Place, message: String) -> SceneError {
        invalid(self.text, self.file, place, message)
    }

    fn place(&self, span: &Range<usize>) -> Place {
        find(self.tree.get_ref(), "", span.start).unwrap_or_else(|| Place {
            path: "scene".to_owned(),
            offset: span.start,
        })
    }
}

/// The innermost key of `table` that has `offset` in itself or in its value.
fn find(table: &DeTable<'_>, prefix: &str, offset: usize) -> Option<Place> {
    table.iter().find_map(|(key, value)| {
        let path = format!("{prefix}{}", quote(key.get_ref()));
        find_below(value, &path, offset).or_else(|| {
            let hit = key.span().contains(&offset) || value.span().contains(&offset);
            let offset = header_or_key(key.span(), value.span());
            hit.then_some(Place { path, offset })
        })
    })
}

fn find_below(value: &Spanned<DeValue<'_>>, path: &str, offset: usize) -> Option<Place> {
    match value.get_ref() {
        DeValue::Table(table) => find(table, &format!("{path}."), offset),
        DeValue::Array(array) => array.iter().find_map(|item| {
            let DeValue::Table(table) = item.get_ref() else {
                return None;
            };
            find(table, &format!("{path}."), offset).or_else(|| {
                item.span().contains(&offset).then(|| Place {
                    path: path.to_owned(),
                    offset: item.span().start,
                })
            })
        }),
        _ => None,
    }
}

/// The span of a table's value is its header, with the brackets before the key.
fn header_or_key(key: Range<usize>, value: Range<usize>) -> usize {
    if value.is_empty() {
        key.start
    } else {
        key.start.min(value.start)
    }
}

fn syntax_error(text: &str, file: &str, error: &toml::de::Error) -> SceneError {
    let offset = error.span().map_or(text.len(), |span| span.start);
    let message = error.message().replacen(", expected ", "; expected ", 1);
    let path = match key_of_line(text, offset) {
        "" => "TOML".to_owned(),
        key => quote(key),
    };
    let message = format!("TOML syntax: {}", quote(&message));
    invalid(text, file, Place { path, offset }, message)
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

/// The allowed keys in serde's message on an unknown one.
fn unknown_key(message: &str) -> Option<&str> {
    let rest = message.strip_prefix("unknown field `")?;
    if rest.starts_with(PRIVATE_KEY) {
        return None;
    }
    rest.rsplit_once("`, expected ").map(|(_, allowed)| allowed)
}

/// What serde found, in the words of TOML and without what it expected.
fn wrong_type(message: &str, written: &str) -> String {
    let found = message.rsplit_once(", expected ").map_or(message, |m| m.0);
    match found.strip_prefix("invalid type: ") {
        // A date arrives as a table with a private key.
        Some("map") if written.starts_with(|c: char| c.is_ascii_digit()) => DATE.to_owned(),
        Some("map") => "wrong type: table".to_owned(),
        Some("sequence") => "wrong type: array".to_owned(),
        Some(found) => format!("wrong type: {}", quote(found)),
        None if found.contains(PRIVATE_KEY) => DATE.to_owned(),
        None if found.starts_with("data did not match") => "wrong type".to_owned(),
        None => quote(found),
    }
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

fn invalid(text: &str, file: &str, place: Place, message: String) -> SceneError {
    let (line, column) = position(text, place.offset);
    SceneError::Invalid {
        file: file.to_owned(),
        line,
        column,
        key: place.path,
        message,
    }
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
