//! The scene file as it is written: shapes and types only, with the place of each value.
//!
//! Required keys are optional here: what is missing is reported with the key's own path.

use std::fmt;
use std::marker::PhantomData;

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use toml::Spanned;

/// A table and the place of its header.
pub(super) type Node<T> = Spanned<Table<T>>;

/// A value that may be missing, and its place.
pub(super) type Field<T> = Option<Spanned<T>>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawScene {
    pub title: Option<String>,
    pub gravity: Field<Vec<f64>>,
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
    pub velocity: Field<WordOr<Vec<f64>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawBody {
    pub name: Field<String>,
    pub semi_axes: Field<Vec<f64>>,
    pub mass: Field<f64>,
    pub inertia: Field<Vec<Entry>>,
    pub added_mass: Field<Vec<Entry>>,
    pub added_inertia: Field<Vec<Entry>>,
    pub volume: Field<f64>,
    pub total_mass: Field<Vec<Entry>>,
    pub total_inertia: Field<Vec<Entry>>,
    pub shape: Field<Vec<f64>>,
    pub attitude: Field<WordOr<RawRotation>>,
    pub angular_velocity: Field<Vec<f64>>,
    pub joint_rate: Field<Vec<f64>>,
}

/// A rotation: an array or a table.
pub(super) enum RawRotation {
    Quaternion(Vec<f64>),
    AxisAngle(RawAxisAngle),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawAxisAngle {
    pub axis: Field<Vec<f64>>,
    pub angle: Field<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawJoint {
    pub parent: Field<String>,
    pub child: Field<String>,
    pub at_parent: Field<Vec<f64>>,
    pub at_child: Field<Vec<f64>>,
    pub stiffness: Field<f64>,
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

/// A string, or a `T` that is written as an array or as a table.
pub(super) enum WordOr<T> {
    Word(String),
    Value(T),
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for WordOr<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(WordOrVisitor(PhantomData))
    }
}

struct WordOrVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for WordOrVisitor<T> {
    type Value = WordOr<T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a string, an array or a table")
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<Self::Value, E> {
        Ok(WordOr::Word(word.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
        T::deserialize(SeqAccessDeserializer::new(seq)).map(WordOr::Value)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(WordOr::Value)
    }
}

impl<'de> Deserialize<'de> for RawRotation {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RotationVisitor)
    }
}

struct RotationVisitor;

impl<'de> Visitor<'de> for RotationVisitor {
    type Value = RawRotation;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("an array or a table")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(seq)).map(RawRotation::Quaternion)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        RawAxisAngle::deserialize(MapAccessDeserializer::new(map)).map(RawRotation::AxisAngle)
    }
}
