//! The scene file as it is written: shapes and types only, with the place of each value.
//!
//! Required keys are optional here: what is missing is reported with the key's own path.

use std::fmt;
use std::marker::PhantomData;

use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, MapAccess, Visitor};
use toml::Spanned;

/// A table and the place of its header.
pub(super) type Node<T> = Spanned<Table<T>>;

/// A value that may be missing, and its place.
pub(super) type Field<T> = Option<Spanned<T>>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawScene {
    pub title: Option<String>,
    pub fluid: Option<Node<RawFluid>>,
    pub start: Option<Node<RawStart>>,
    #[serde(default)]
    pub body: Vec<Node<RawBody>>,
    #[serde(default)]
    pub joint: Vec<Node<RawJoint>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawFluid {
    pub density: Field<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawStart {
    pub position: Field<Vec<f64>>,
    pub velocity: Field<Vec<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawBody {
    pub name: Field<String>,
    pub semi_axes: Field<Vec<f64>>,
    pub mass: Field<f64>,
    pub total_mass: Field<Vec<Entry>>,
    pub total_inertia: Field<Vec<Entry>>,
    pub attitude: Field<Vec<f64>>,
    pub angular_velocity: Field<Vec<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawJoint {
    pub parent: Field<String>,
    pub child: Field<String>,
    pub at_parent: Field<Vec<f64>>,
    pub at_child: Field<Vec<f64>>,
}

/// An element of a diagonal, or a row of a matrix.
#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum Entry {
    Number(f64),
    Row(Vec<f64>),
}

/// A `T` that must be written as a table: serde's structs would also accept an array.
pub(super) struct Table<T>(pub T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Table<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(TableVisitor(PhantomData))
    }
}

struct TableVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for TableVisitor<T> {
    type Value = Table<T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a table")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(Table)
    }
}
