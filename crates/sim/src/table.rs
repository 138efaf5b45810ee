//! A trajectory as a CSV table.

use std::io::{self, Write};

use articulated_fluid::Scene;
use lie::SO3;

use crate::frame::Frame;

/// Columns that belong together.
///
/// More of them are one more entry of [`COLUMNS`]; the table and what is told of it follow.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// A name for each number; of a body's, what follows the body's name and a dot.
    pub names: &'static [&'static str],
    /// What they are, with the unit.
    pub meaning: &'static str,
    read: Read,
}

/// How numbers are read of a frame, into where those of the row before still stand.
#[derive(Clone, Copy, Debug)]
enum Read {
    Whole(fn(&Frame, &mut [f64])),
    /// Of the body with this number; columns of bodies side by side are written body by body.
    Body(fn(&Frame, usize, &mut [f64])),
}

const fn whole(
    names: &'static [&'static str],
    meaning: &'static str,
    read: fn(&Frame, &mut [f64]),
) -> Column {
    let read = Read::Whole(read);
    Column {
        names,
        meaning,
        read,
    }
}

const fn body(
    names: &'static [&'static str],
    meaning: &'static str,
    read: fn(&Frame, usize, &mut [f64]),
) -> Column {
    let read = Read::Body(read);
    Column {
        names,
        meaning,
        read,
    }
}

/// The columns of a [`Table`], in its order.
#[rustfmt::skip]
pub const COLUMNS: &[Column] = &[
    whole(&["t"], "time, s", |frame, to| to.fill(frame.t())),
    whole(&["x", "y", "z"], "mass centre of the first body in the reference frame, m", |frame, to| {
        to.copy_from_slice(&frame.position().0);
    }),
    body(&["qw", "qx", "qy", "qz"], "unit quaternion from body to reference frame, its sign continuous", |frame, i, to| {
        let q = frame.attitudes().get(i).map_or([0.0; 4], SO3::to_quaternion);
        to.copy_from_slice(&nearer(q, to));
    }),
    body(&["wx", "wy", "wz"], "angular velocity of the body in its own frame, rad/s", |frame, i, to| {
        to.copy_from_slice(&frame.rates().nth(i).map_or([0.0; 3], |rate| rate.0));
    }),
    whole(&["energy"], "of bodies and fluid, kinetic and potential, J", |frame, to| to.fill(frame.sample.energy)),
    whole(&["px", "py", "pz"], "linear momentum from the velocities, in the reference frame, kg m/s", |frame, to| {
        to.copy_from_slice(&frame.sample.linear.0);
    }),
    whole(&["lx", "ly", "lz"], "angular momentum about the origin in the reference frame, kg m^2/s", |frame, to| {
        to.copy_from_slice(&frame.sample.angular.0);
    }),
    whole(&["orthogonality"], "largest ||I - R^T R||_F over the bodies", |frame, to| to.fill(frame.sample.orthogonality)),
];

/// The one of `q` and `-q`, which are the same attitude, that is nearer to `last`.
fn nearer(q: [f64; 4], last: &[f64]) -> [f64; 4] {
    let dot: f64 = q.iter().zip(last).map(|(a, b)| a * b).sum();
    if dot < 0.0 { q.map(|x| -x) } else { q }
}

impl Column {
    /// The names in short, as `x,y,z` and `NAME.qw,.qx,.qy,.qz`.
    pub fn label(&self) -> String {
        match self.read {
            Read::Whole(_) => self.names.join(","),
            Read::Body(_) => format!("NAME.{}", self.names.join(",.")),
        }
    }

    fn is_of_bodies(&self) -> bool {
        matches!(self.read, Read::Body(_))
    }
}

/// The columns in the order of the table, those of bodies with the number of the body.
fn columns(bodies: usize) -> impl Iterator<Item = (&'static Column, usize)> {
    let alike = |a: &Column, b: &Column| a.is_of_bodies() == b.is_of_bodies();
    COLUMNS.chunk_by(alike).flat_map(move |group| {
        let times = if group[0].is_of_bodies() { bodies } else { 1 };
        (0..times).flat_map(move |i| group.iter().map(move |column| (column, i)))
    })
}

/// Writes a row for each frame, with all digits, under a header.
pub struct Table<W> {
    out: W,
    bodies: usize,
    row: Vec<f64>,
    line: String,
}

impl<W: Write> Table<W> {
    /// Writes the header for the bodies of a scene.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn new(mut out: W, scene: &Scene) -> io::Result<Self> {
        let names = columns(scene.bodies.len()).flat_map(|(column, i)| {
            let name = move |name: &&str| match column.read {
                Read::Whole(_) => (*name).to_owned(),
                Read::Body(_) => format!("{}.{name}", scene.bodies[i].name),
            };
            column.names.iter().map(name)
        });
        let names: Vec<_> = names.collect();
        writeln!(out, "{}", names.join(","))?;
        Ok(Self {
            out,
            bodies: scene.bodies.len(),
            row: vec![0.0; names.len()],
            line: String::new(),
        })
    }

    /// Writes the row of a frame.
    ///
    /// # Errors
    /// Those of `out`; [`InvalidInput`](io::ErrorKind::InvalidInput) of a frame with another number of bodies.
    pub fn row(&mut self, frame: &Frame) -> io::Result<()> {
        if frame.bodies() != self.bodies {
            return Err(io::ErrorKind::InvalidInput.into());
        }
        let mut rest = &mut self.row[..];
        for (column, i) in columns(self.bodies) {
            let (to, after) = rest.split_at_mut(column.names.len());
            match column.read {
                Read::Whole(read) => read(frame, to),
                Read::Body(read) => read(frame, i, to),
            }
            rest = after;
        }
        self.write()
    }

    fn write(&mut self) -> io::Result<()> {
        use core::fmt::Write;
        self.line.clear();
        for (k, number) in self.row.iter().enumerate() {
            let comma = if k == 0 { "" } else { "," };
            // A string takes what is written to it.
            let _ = write!(self.line, "{comma}{number:.16e}");
        }
        self.line.push('\n');
        self.out.write_all(self.line.as_bytes())
    }

    /// What the rows were written to.
    pub fn into_inner(self) -> W {
        self.out
    }
}
