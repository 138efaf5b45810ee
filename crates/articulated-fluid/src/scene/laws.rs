//! Time laws of a scene: sinusoids, tables, and gaits, which are waves over many joints.

use std::collections::HashMap;
use std::sync::Arc;

use super::entry::{Table, Value};
use super::error::{MOST_BYTES, SceneError};
use super::source::Reads;
use crate::motion::{Ends, Law, Sinusoid, Spline, SplineError};

/// A law that may be shared.
pub(crate) type Shared<const N: usize> = Arc<dyn Law<N>>;

/// A gait, as one of its joints sees it.
#[derive(Clone)]
pub(super) struct Gait<'a> {
    table: Table<'a>,
    pub line: usize,
    /// Place of the joint in the list.
    place: usize,
}

/// The gait of each joint that has one, by the joint's name.
pub(super) type Gaits<'a> = HashMap<&'a str, Gait<'a>>;

/// Reads which joints the gaits move.
pub(super) fn gaits<'a>(tables: &[Table<'a>], names: &[&str]) -> Result<Gaits<'a>, SceneError> {
    let mut gaits = Gaits::new();
    for table in tables {
        let list = table.require("joints")?;
        let joints = list.elements()?;
        if joints.is_empty() {
            return Err(list.wrong("has 0 elements"));
        }
        for (place, joint) in joints.iter().enumerate() {
            let name = joint.text()?;
            if !names.contains(&name) {
                let what = format!("no joint is named {name:?}; expected names of joints");
                return Err(list.fail(&what));
            }
            let gait = Gait {
                table: table.clone(),
                line: list.line(),
                place,
            };
            if let Some(other) = gaits.insert(name, gait) {
                let line = other.line;
                let what = format!(
                    "{name:?} has the gait in line {line} already; expected one gait for each joint"
                );
                return Err(list.fail(&what));
            }
        }
    }
    Ok(gaits)
}

/// The motion of a joint, its own or its gait's.
pub(super) fn of_joint<const N: usize>(
    table: &Table,
    gait: Option<&Gait>,
) -> Result<Shared<N>, SceneError>
where
    Sinusoid<N>: Law<N>,
{
    if let Some(gait) = gait {
        return Ok(Arc::new(gait.law::<N>()?));
    }
    law(&table.require("motion")?.table()?)
}

/// A sinusoid, or a spline through the rows of a table.
pub(crate) fn law<const N: usize>(table: &Table) -> Result<Shared<N>, SceneError>
where
    Sinusoid<N>: Law<N>,
{
    match table.get("file") {
        Some(file) => measured(table, &file),
        None => {
            for key in ["columns", "repeat"] {
                if let Some(value) = table.get(key) {
                    return Err(value.fail("given without file; expected both, or neither"));
                }
            }
            Ok(Arc::new(sinusoid(table)?))
        }
    }
}

impl Gait<'_> {
    /// The law of this joint: its phase lags behind by as many `phase_lag` as joints stand before it.
    fn law<const N: usize>(&self) -> Result<Sinusoid<N>, SceneError> {
        let mut law = sinusoid::<N>(&self.table)?;
        let lag = self.table.read("phase_lag", 0.0, Value::finite)?;
        let behind = lag * self.place as f64;
        law.phase = law.phase.map(|phase| phase - behind);
        Ok(law)
    }
}

/// A sinusoid.
pub(super) fn sinusoid<const N: usize>(table: &Table) -> Result<Sinusoid<N>, SceneError> {
    let zero = [0.0; N];
    let harmonics = table.read("harmonics", vec![], |value| {
        value
            .elements()?
            .iter()
            .map(|one| wave(value, one))
            .collect()
    })?;
    let waves = !harmonics.is_empty() || table.get("amplitude").is_some();
    let frequency = match waves {
        true => table.require("frequency")?.finite()?,
        false => table.read("frequency", 0.0, Value::finite)?,
    };
    Ok(Sinusoid {
        bias: table.read("bias", zero, numbers)?,
        amplitude: table.read("amplitude", zero, numbers)?,
        frequency,
        phase: table.read("phase", zero, numbers)?,
        harmonics,
        ramp: table.read("ramp", 0.0, Value::not_negative)?,
    })
}

/// A pair of an amplitude and a phase.
fn wave<const N: usize>(all: &Value, one: &Value) -> Result<[[f64; N]; 2], SceneError> {
    match &one.elements()?[..] {
        [amplitude, phase] => Ok([numbers(amplitude)?, numbers(phase)?]),
        other => Err(all.wrong(&format!("a harmonic has {} elements", other.len()))),
    }
}

/// One number for a hinge, three for a ball or a place.
fn numbers<const N: usize>(value: &Value) -> Result<[f64; N], SceneError> {
    if N > 1 {
        return value.array();
    }
    let number = value.finite()?;
    Ok([number; N])
}

/// A spline through the rows of a CSV file.
fn measured<const N: usize>(motion: &Table, file: &Value) -> Result<Shared<N>, SceneError> {
    for key in [
        "amplitude",
        "frequency",
        "phase",
        "bias",
        "ramp",
        "harmonics",
    ] {
        if let Some(value) = motion.get(key) {
            return Err(value.fail("given together with file; expected one of them"));
        }
    }
    let ends = match motion.read("repeat", false, Value::boolean)? {
        true => Ends::Periodic,
        false => Ends::Natural,
    };
    let columns = motion.get("columns");
    let names = columns.as_ref().map(column_names).transpose()?;
    if let (Some(columns), Some(names)) = (&columns, &names)
        && names.len() != N + 1
    {
        let what = format!("has {} elements", names.len());
        return Err(columns.wrong(&what));
    }
    let path = file.beside_the_scene()?;
    let rows = rows::<N>(&path, names.as_deref(), file.reads()).map_err(|what| file.fail(&what))?;
    let (lines, points): (Vec<u64>, Vec<_>) = rows.into_iter().unzip();
    let spline = Spline::new(&points, ends).map_err(|error| {
        let what = match error {
            SplineError::Order { row, .. } => format!(
                "{}:{}: the time does not come after the one before, or a number is not finite; expected increasing times and finite numbers",
                path.display(),
                lines[row]
            ),
            error => error.to_string(),
        };
        file.fail(&what)
    })?;
    Ok(Arc::new(spline))
}

fn column_names<'a>(columns: &Value<'a>) -> Result<Vec<&'a str>, SceneError> {
    columns.elements()?.iter().map(Value::text).collect()
}

/// A row of a table: its line, its time, and its numbers.
type Row<const N: usize> = (u64, (f64, [f64; N]));

/// The time and `N` numbers of each row; without names, of the first columns.
fn rows<const N: usize>(
    path: &std::path::Path,
    names: Option<&[&str]>,
    reads: &Reads,
) -> Result<Vec<Row<N>>, String> {
    let shown = path.display();
    let bytes = reads(path).map_err(|error| format!("{shown} cannot be read: {error}"))?;
    if bytes.len() > MOST_BYTES {
        let most = MOST_BYTES / 1_000_000;
        return Err(format!(
            "{shown} has more than {most} MB; expected a table of fewer rows"
        ));
    }
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(&bytes[..]);
    let header = reader
        .headers()
        .map_err(|error| format!("{shown}: {error}"))?;
    if header.iter().all(|name| name.parse::<f64>().is_ok()) {
        return Err(format!(
            "the first row of {shown} has numbers; expected names of the columns"
        ));
    }
    let places: Vec<usize> = match names {
        None => (0..=N).collect(),
        Some(names) => {
            let place = |name: &&str| {
                let found = header.iter().position(|column| column == *name);
                found.ok_or_else(|| format!("{shown} has no column {name:?} in its first row"))
            };
            names.iter().map(place).collect::<Result<_, _>>()?
        }
    };
    let mut points = vec![];
    for record in reader.records() {
        let record = record.map_err(|error| format!("{shown}: {error}"))?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |place: usize| {
            let text = record.get(place).unwrap_or_default();
            text.parse::<f64>()
                .map_err(|_| format!("{shown}:{line}: {text:?} is no number"))
        };
        let mut values = [0.0; N];
        for (value, place) in values.iter_mut().zip(&places[1..]) {
            *value = number(*place)?;
        }
        points.push((line, (number(places[0])?, values)));
    }
    Ok(points)
}
