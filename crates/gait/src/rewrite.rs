//! A scene's text with another stroke.

use core::f64::consts::TAU;

use toml_edit::{Array, DocumentMut, InlineTable, Item, TableLike, Value};

use crate::chain::Chain;
use crate::error::GaitError;
use crate::stroke::{Fourier, Stroke};
use crate::tree::Moving;

/// The text of a scene in which the joints of a chain do this stroke, which begins at the time `from`.
///
/// Each has a `motion` with `harmonics`, whatever moved it before. It starts without momentum. The rest of the text stays as it is, comments too.
///
/// # Errors
/// [`GaitError::Text`] where the text is not that of the chain's scene.
pub fn with_stroke(
    text: &str,
    chain: &Chain,
    stroke: &Fourier,
    from: f64,
) -> Result<String, GaitError> {
    let wrong = |what: String| GaitError::Text { what };
    let mut document: DocumentMut = text
        .parse()
        .map_err(|error: toml_edit::TomlError| wrong(error.to_string()))?;
    document.remove("gait");
    let start = document
        .entry("start")
        .or_insert_with(|| Item::Value(InlineTable::new().into()));
    let start = start.as_table_like_mut();
    let start = start.ok_or_else(|| wrong("start is no table".to_owned()))?;
    start.remove("velocity");
    start.insert("momentum", Item::Value("zero".into()));
    let mut joints = tables(document.get_mut("joint"));
    for moving in chain.joints() {
        let is_it = |table: &&mut &mut dyn TableLike| {
            let name = table.get("name").or_else(|| table.get("child"));
            name.and_then(Item::as_str) == Some(&moving.name)
        };
        let found = joints.iter_mut().find(is_it);
        let joint = found.ok_or_else(|| wrong(format!("no joint is named {:?}", moving.name)))?;
        joint.insert("motion", Item::Value(motion(moving, stroke, from).into()));
    }
    Ok(document.to_string())
}

/// The tables of a list, however it is written.
fn tables(item: Option<&mut Item>) -> Vec<&mut dyn TableLike> {
    match item {
        Some(Item::ArrayOfTables(tables)) => tables
            .iter_mut()
            .map(|table| table as &mut dyn TableLike)
            .collect(),
        Some(Item::Value(Value::Array(array))) => {
            let tables = array.iter_mut().filter_map(Value::as_inline_table_mut);
            tables.map(|table| table as &mut dyn TableLike).collect()
        }
        _ => vec![],
    }
}

/// $A_k \sin(k \omega t + \varphi_k) = a_k \cos k \omega t + b_k \sin k \omega t$.
fn motion(moving: &Moving, stroke: &Fourier, from: f64) -> InlineTable {
    let of_one = stroke.of_one();
    let own: Vec<&[f64]> = moving
        .coordinates
        .clone()
        .map(|j| &stroke.coefficients()[j * of_one..(j + 1) * of_one])
        .collect();
    let written = |of: &dyn Fn(&[f64]) -> f64| match &own[..] {
        [one] => Value::from(of(one)),
        several => Value::Array(several.iter().map(|own| of(own)).collect::<Array>()),
    };
    let harmonic = |k: usize| {
        let amplitude = written(&|own| own[2 * k + 1].hypot(own[2 * k + 2]));
        let passed = TAU * (k + 1) as f64 * from / stroke.period();
        let phase = written(&|own| own[2 * k + 1].atan2(own[2 * k + 2]) - passed);
        Value::Array([amplitude, phase].into_iter().collect::<Array>())
    };
    let mut motion = InlineTable::new();
    motion.insert("bias", written(&|own| own[0]));
    motion.insert("frequency", (1.0 / stroke.period()).into());
    let harmonics = (0..stroke.order()).map(harmonic).collect::<Array>();
    motion.insert("harmonics", Value::Array(harmonics));
    motion
}
