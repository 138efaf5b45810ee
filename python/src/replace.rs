//! Other values for keys of a scene's text; the rest of the text stays as it is, comments too.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use toml_edit::{Array, DocumentMut, InlineTable, Item, TableLike, Value};

/// The text with these keys changed: paths such as `joint.tail.stiffness`, where a body or a joint is named, and `None` takes a key away.
///
/// # Errors
/// `ValueError` of a path that leads nowhere, `TypeError` of a value that a scene file cannot have.
pub fn replace(text: &str, changes: &Bound<'_, PyDict>) -> PyResult<String> {
    let mut document: DocumentMut = text
        .parse()
        .map_err(|error: toml_edit::TomlError| PyValueError::new_err(error.to_string()))?;
    for (path, value) in changes {
        let path: String = path.extract()?;
        let value = match value.is_none() {
            true => None,
            false => Some(converted(&value, &path)?),
        };
        set(document.as_table_mut(), &path, value)
            .map_err(|what| PyValueError::new_err(format!("{path}: {what}")))?;
    }
    Ok(document.to_string())
}

fn set(table: &mut dyn TableLike, path: &str, value: Option<Value>) -> Result<(), String> {
    let Some((key, rest)) = path.split_once('.') else {
        put(table, path, value);
        return Ok(());
    };
    let empty = || Item::Value(Value::InlineTable(InlineTable::new()));
    match table.entry(key).or_insert_with(empty) {
        Item::ArrayOfTables(tables) => {
            let tables = tables.iter_mut().map(|table| table as &mut dyn TableLike);
            set_named(tables.collect(), key, rest, value)
        }
        Item::Value(Value::Array(array)) => {
            let tables = array.iter_mut().filter_map(Value::as_inline_table_mut);
            let tables = tables.map(|table| table as &mut dyn TableLike);
            set_named(tables.collect(), key, rest, value)
        }
        item => match item.as_table_like_mut() {
            Some(table) => set(table, rest, value),
            None => Err(format!("{key} is a value, and has no {rest}")),
        },
    }
}

/// A body by its name, a joint by its own or its child's.
fn set_named(
    tables: Vec<&mut dyn TableLike>,
    key: &str,
    rest: &str,
    value: Option<Value>,
) -> Result<(), String> {
    let name = |table: &dyn TableLike| {
        let name = table.get("name").or_else(|| table.get("child"));
        name.and_then(Item::as_str).unwrap_or_default().to_owned()
    };
    let names: Vec<String> = tables.iter().map(|table| name(*table)).collect();
    // Names may have dots: the longest that fits is meant.
    let after = |name: &String| {
        Some(
            rest.strip_prefix(name.as_str())?
                .strip_prefix('.')?
                .to_owned(),
        )
    };
    let fitting = names
        .iter()
        .enumerate()
        .filter(|(_, name)| after(name).is_some());
    let Some((i, name)) = fitting.max_by_key(|(_, name)| name.len()) else {
        let known = names.join(", ");
        return Err(format!(
            "no {key} has this name; expected {key}.NAME.KEY with NAME one of: {known}"
        ));
    };
    let rest = after(name).unwrap_or_default();
    match tables.into_iter().nth(i) {
        Some(table) => set(table, &rest, value),
        None => Ok(()),
    }
}

/// Where there is a value already, its comment stays.
fn put(table: &mut dyn TableLike, key: &str, value: Option<Value>) {
    let Some(mut value) = value else {
        table.remove(key);
        return;
    };
    if let Some(Item::Value(old)) = table.get(key) {
        *value.decor_mut() = old.decor().clone();
    }
    table.insert(key, Item::Value(value));
}

fn converted(value: &Bound<'_, PyAny>, path: &str) -> PyResult<Value> {
    if let Ok(value) = value.cast::<PyBool>() {
        return Ok(value.is_true().into());
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(value.extract::<i64>()?.into());
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(value.extract::<f64>()?.into());
    }
    if let Ok(value) = value.cast::<PyString>() {
        return Ok(value.to_string().into());
    }
    if let Ok(value) = value.cast::<PyDict>() {
        let mut table = InlineTable::new();
        for (key, value) in value {
            table.insert(key.extract::<String>()?, converted(&value, path)?);
        }
        return Ok(table.into());
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let mut array = Array::new();
        for value in value.try_iter()? {
            array.push(converted(&value?, path)?);
        }
        return Ok(array.into());
    }
    let class = value.get_type().name()?;
    Err(PyTypeError::new_err(format!(
        "{path}: a scene has no value of type {class}; expected a number, a string, True or False, a list or a dictionary"
    )))
}
