//! Tables and values of a scene file. Each knows its key and its place, and so makes the errors about itself.

use std::path::PathBuf;

use toml::Spanned;
use toml::de::{DeArray, DeFloat, DeInteger, DeTable, DeValue};

use super::error::SceneError;
use super::keys::{below, expected};
use super::note::{Correction, Note};
use super::source::{Reads, Source, quote};

/// A table or a value of a file.
#[derive(Clone)]
pub(crate) struct Entry<'a, T> {
    source: &'a Source<'a>,
    /// Its dotted path.
    key: String,
    /// The byte at which the key or the table's header starts.
    offset: usize,
    /// The name of the body that it is of.
    body: &'a str,
    inner: &'a T,
}

pub(crate) type Table<'a> = Entry<'a, DeTable<'a>>;

pub(crate) type Value<'a> = Entry<'a, DeValue<'a>>;

impl<'a, T> Entry<'a, T> {
    /// The error `message`.
    pub fn fail(&self, message: &str) -> SceneError {
        let error = message.to_owned();
        self.source.error(&self.key, self.offset, error)
    }

    /// The error that this is not what its key expects: `what` says how.
    pub fn wrong(&self, what: &str) -> SceneError {
        match expected(&self.key) {
            Some(expected) => self.fail(&format!("{what}; expected {expected}")),
            None => self.fail(what),
        }
    }

    /// The line of the key, from 1.
    pub fn line(&self) -> usize {
        self.source.line(self.offset)
    }

    /// Notes that this was corrected.
    pub fn note(&self, correction: Correction, off: f64) {
        self.source.notes.borrow_mut().push(Note {
            body: self.body.to_owned(),
            key: self.key.clone(),
            line: self.line(),
            correction,
            off,
        });
    }

    fn with<U>(&self, inner: &'a U) -> Entry<'a, U> {
        Entry {
            source: self.source,
            key: self.key.clone(),
            offset: self.offset,
            body: self.body,
            inner,
        }
    }
}

impl<'a> Table<'a> {
    /// The file's own table, with no key that is not documented.
    pub(super) fn root(source: &'a Source<'a>, inner: &'a DeTable<'a>) -> Result<Self, SceneError> {
        let root = Self {
            source,
            key: String::new(),
            offset: 0,
            body: "",
            inner,
        };
        root.refuse_unknown_keys()?;
        Ok(root)
    }

    /// The same table, as one of the body of this name.
    pub fn of_body(self, body: &'a str) -> Self {
        Self { body, ..self }
    }

    /// The value of `key`, if it is there.
    pub fn get(&self, key: &str) -> Option<Value<'a>> {
        let (key, value) = self.inner.get_key_value(key)?;
        Some(self.value(key.get_ref(), key.span(), value))
    }

    /// The value of a required `key`.
    pub fn require(&self, key: &str) -> Result<Value<'a>, SceneError> {
        self.get(key).ok_or_else(|| self.missing(key))
    }

    /// The error that `key` is missing.
    pub fn missing(&self, key: &str) -> SceneError {
        let key = self.path(key);
        let expected = expected(&key).unwrap_or("a value");
        let message = format!("missing; expected {expected}");
        self.source.error(&key, self.offset, message)
    }

    /// What is read of `key`, or the default.
    pub fn read<U>(
        &self,
        key: &str,
        default: U,
        read: impl Fn(&Value<'a>) -> Result<U, SceneError>,
    ) -> Result<U, SceneError> {
        self.get(key).map_or(Ok(default), |value| read(&value))
    }

    fn path(&self, key: &str) -> String {
        match self.key.as_str() {
            "" => key.to_owned(),
            table => format!("{table}.{key}"),
        }
    }

    fn value(
        &self,
        key: &str,
        span: core::ops::Range<usize>,
        value: &'a Spanned<DeValue<'a>>,
    ) -> Value<'a> {
        // The span of a table's value is its header, with the brackets before the key.
        let header = value.span();
        Entry {
            key: self.path(&quote(key)),
            offset: match header.is_empty() {
                true => span.start,
                false => span.start.min(header.start),
            },
            ..self.with(value.get_ref())
        }
    }

    /// By what is documented, so that no key is read without being documented.
    fn refuse_unknown_keys(&self) -> Result<(), SceneError> {
        let known: Vec<&str> = below(&self.key).collect();
        for (key, value) in self.inner {
            let entry = self.value(key.get_ref(), key.span(), value);
            if !known.contains(&key.get_ref().as_ref()) {
                let expected = known.join("`, `");
                let message = match known[..] {
                    [_] => format!("unknown key; expected `{expected}`"),
                    [a, b] => format!("unknown key; expected `{a}` or `{b}`"),
                    _ => format!("unknown key; expected one of `{expected}`"),
                };
                return Err(entry.fail(&message));
            }
            if below(&entry.key).next().is_some() {
                let tables = match entry.is_table() {
                    true => entry.table().map(|table| vec![table]),
                    false => entry.tables(),
                };
                let tables = tables.unwrap_or_default();
                tables.iter().try_for_each(Self::refuse_unknown_keys)?;
            }
        }
        Ok(())
    }
}

impl<'a> Value<'a> {
    /// A string.
    pub fn text(&self) -> Result<&'a str, SceneError> {
        self.word().ok_or_else(|| self.wrong_type())
    }

    /// The string that this is, if it is one.
    pub fn word(&self) -> Option<&'a str> {
        self.inner.as_str()
    }

    /// `true` or `false`.
    pub fn boolean(&self) -> Result<bool, SceneError> {
        self.inner.as_bool().ok_or_else(|| self.wrong_type())
    }

    /// The path that is named, from the folder of the scene.
    pub fn beside_the_scene(&self) -> Result<PathBuf, SceneError> {
        Ok(self.source.folder().join(self.text()?))
    }

    /// What reads the file at such a path.
    pub(super) fn reads(&self) -> &'a Reads<'a> {
        self.source.reads
    }

    pub fn is_array(&self) -> bool {
        self.inner.is_array()
    }

    pub fn is_table(&self) -> bool {
        self.inner.is_table()
    }

    /// A number, finite or not.
    pub fn number(&self) -> Result<f64, SceneError> {
        let number = match self.inner {
            DeValue::Integer(x) => integer(x).map(|x| x as f64),
            DeValue::Float(x) => float(x),
            _ => None,
        };
        number.ok_or_else(|| self.wrong_type())
    }

    /// An array of anything.
    pub fn elements(&self) -> Result<Vec<Value<'a>>, SceneError> {
        let elements = self.array_of_values()?.iter();
        Ok(elements
            .map(|element| self.with(element.get_ref()))
            .collect())
    }

    /// An array of numbers.
    pub fn numbers(&self) -> Result<Vec<f64>, SceneError> {
        self.elements()?.iter().map(Value::number).collect()
    }

    /// A table.
    pub fn table(&self) -> Result<Table<'a>, SceneError> {
        let table = self.inner.as_table().ok_or_else(|| self.wrong_type())?;
        Ok(self.with(table))
    }

    /// An array of tables.
    pub fn tables(&self) -> Result<Vec<Table<'a>>, SceneError> {
        let elements = self.array_of_values()?.iter();
        let table = |element: &'a Spanned<DeValue<'a>>| {
            let table = self.with(element.get_ref()).table()?;
            let offset = element.span().start;
            Ok(Entry { offset, ..table })
        };
        elements.map(table).collect()
    }

    fn array_of_values(&self) -> Result<&'a DeArray<'a>, SceneError> {
        self.inner.as_array().ok_or_else(|| self.wrong_type())
    }

    fn wrong_type(&self) -> SceneError {
        let found = match self.inner {
            DeValue::String(text) => format!("string {text:?}"),
            DeValue::Integer(x) => match integer(x) {
                Some(x) => format!("integer `{x}`"),
                None => return self.wrong("integer overflowed"),
            },
            DeValue::Float(x) => match float(x) {
                Some(x) => format!("floating point `{x:?}`"),
                None => return self.wrong("floating-point number overflowed"),
            },
            DeValue::Boolean(x) => format!("boolean `{x}`"),
            DeValue::Datetime(_) => "date or time".to_owned(),
            DeValue::Array(_) => "array".to_owned(),
            DeValue::Table(_) => "table".to_owned(),
        };
        self.wrong(&format!("wrong type: {}", quote(&found)))
    }
}

fn integer(x: &DeInteger) -> Option<i128> {
    i128::from_str_radix(x.as_str(), x.radix()).ok()
}

/// Infinite only where it is written so.
fn float(x: &DeFloat) -> Option<f64> {
    let (text, x) = (x.as_str(), x.as_str().parse::<f64>().ok()?);
    (!x.is_infinite() || text.contains("inf")).then_some(x)
}
