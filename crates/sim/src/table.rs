//! A trajectory as a CSV table.

use std::io::{self, Write};

use articulated_fluid::{BodyLoad, DriveKind, Scene};
use lie::{SO3, Vec3};

use crate::frame::{DriveSample, Frame};

/// Columns that belong together.
///
/// More of them are one more entry of [`COLUMNS`]; the table and what is told of it follow.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// A name for each number; of a body's, what follows the body's name and a dot.
    pub names: &'static [&'static str],
    /// What they are, with the unit.
    pub meaning: &'static str,
    /// Whether they are only in a table of [all columns](Table::with_all_columns).
    pub is_extra: bool,
    read: Read,
}

/// What the numbers of a row are read of.
struct Seen<'a> {
    frame: &'a Frame,
    /// The centre of mass, m.
    centre: Vec3,
}

/// How numbers are read, into where those of the row before still stand.
#[derive(Clone, Copy, Debug)]
enum Read {
    Whole(fn(&Seen, &mut [f64])),
    /// Of the body with this number; columns of bodies side by side are written body by body.
    Body(fn(&Seen, usize, &mut [f64])),
    /// Of the free hinge with this number, likewise.
    Hinge(fn(&Seen, usize, &mut [f64])),
    /// Of the drive with this number, likewise.
    Drive(fn(&DriveSample, &mut [f64])),
    /// Of the loads of one name on all bodies, likewise, with that name and `_` before.
    Load(fn(&DriveSample, &mut [f64])),
}

/// The bodies of a scene, the free hinges and the joints with drives, by their names, and the loads on bodies by theirs.
struct Names {
    bodies: Vec<String>,
    hinges: Vec<String>,
    drives: Vec<String>,
    loads: Vec<String>,
}

type Labels = &'static [&'static str];

const fn column(names: Labels, meaning: &'static str, read: Read) -> Column {
    Column {
        names,
        meaning,
        is_extra: false,
        read,
    }
}

const fn whole(names: Labels, meaning: &'static str, read: fn(&Seen, &mut [f64])) -> Column {
    column(names, meaning, Read::Whole(read))
}

const fn body(names: Labels, meaning: &'static str, read: fn(&Seen, usize, &mut [f64])) -> Column {
    column(names, meaning, Read::Body(read))
}

const fn hinge(names: Labels, meaning: &'static str, read: fn(&Seen, usize, &mut [f64])) -> Column {
    column(names, meaning, Read::Hinge(read))
}

const fn drive(names: Labels, meaning: &'static str, read: fn(&DriveSample, &mut [f64])) -> Column {
    column(names, meaning, Read::Drive(read))
}

const fn load(names: Labels, meaning: &'static str, read: fn(&DriveSample, &mut [f64])) -> Column {
    column(names, meaning, Read::Load(read))
}

const fn extra(column: Column) -> Column {
    Column {
        is_extra: true,
        ..column
    }
}

/// The columns of a [`Table`], in its order.
#[rustfmt::skip]
pub const COLUMNS: &[Column] = &[
    whole(&["t"], "time, s", |seen, to| to.fill(seen.frame.t())),
    whole(&["x", "y", "z"], "mass centre of the first body in the reference frame, m", |seen, to| {
        to.copy_from_slice(&seen.frame.position().0);
    }),
    extra(whole(&["vx", "vy", "vz"], "its velocity in the reference frame, m/s", |seen, to| {
        to.copy_from_slice(&seen.frame.bodies.velocity.0);
    })),
    body(&["qw", "qx", "qy", "qz"], "unit quaternion from body to reference frame, its sign continuous", |seen, i, to| {
        let q = seen.frame.bodies.attitudes.get(i).map_or([0.0; 4], SO3::to_quaternion);
        to.copy_from_slice(&nearer(q, to));
    }),
    body(&["wx", "wy", "wz"], "angular velocity of the body in its own frame, rad/s", |seen, i, to| {
        to.copy_from_slice(&seen.frame.bodies.rates.get(i).map_or([0.0; 3], |rate| rate.0));
    }),
    extra(body(&["x", "y", "z"], "mass centre of the body in the reference frame, m", |seen, i, to| {
        to.copy_from_slice(&seen.frame.bodies.centres.get(i).map_or([0.0; 3], |centre| centre.0));
    })),
    hinge(&["angle", "rate"], "angle of a free hinge, not wrapped, rad, and its rate, rad/s", |seen, k, to| {
        to.copy_from_slice(&seen.frame.hinge(k).unwrap_or([f64::NAN; 2]));
    }),
    drive(&["work"], "work of what moves a joint as told, and of its torque, damper and servo, since the start, J", |drive, to| to.fill(drive.work)),
    extra(drive(&["power"], "its mean power since the row before, W", |drive, to| to.fill(drive.power))),
    extra(drive(&["tx", "ty", "tz"], "its mean torque on the child since the row before, in the reference frame, N m", |drive, to| {
        to.copy_from_slice(&drive.torque.0);
    })),
    load(&["work"], "work of all such loads on bodies since the start, J, where there are some", |load, to| to.fill(load.work)),
    whole(&["energy"], "of bodies and fluid, kinetic and potential, J", |seen, to| to.fill(seen.frame.sample.energy)),
    whole(&["px", "py", "pz"], "linear momentum from the velocities, in the reference frame, kg m/s", |seen, to| {
        to.copy_from_slice(&seen.frame.sample.linear.0);
    }),
    whole(&["lx", "ly", "lz"], "angular momentum about the origin in the reference frame, kg m^2/s", |seen, to| {
        to.copy_from_slice(&seen.frame.sample.angular.0);
    }),
    extra(whole(&["cx", "cy", "cz"], "centre of mass in the reference frame, m; of which masses, see below", |seen, to| {
        to.copy_from_slice(&seen.centre.0);
    })),
    extra(whole(&["lcx", "lcy", "lcz"], "angular momentum of bodies and fluid about it, kg m^2/s", |seen, to| {
        to.copy_from_slice(&seen.frame.angular_about(seen.centre).0);
    })),
    whole(&["orthogonality"], "largest ||I - R^T R||_F over the bodies", |seen, to| to.fill(seen.frame.sample.orthogonality)),
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
            Read::Hinge(_) | Read::Drive(_) => format!("JOINT.{}", self.names.join(",.")),
            Read::Load(_) => {
                let names = BodyLoad::names().flat_map(|load| self.of(load));
                names.collect::<Vec<_>>().join(",")
            }
        }
    }

    /// The names of its numbers of one of a scene's bodies, joints or loads.
    fn of(&self, owner: &str) -> impl Iterator<Item = String> {
        let mark = match self.read {
            Read::Whole(_) => "",
            Read::Load(_) => "_",
            _ => ".",
        };
        let names = self.names.iter();
        names.map(move |name| format!("{owner}{mark}{name}"))
    }
}

impl Names {
    fn of(scene: &Scene) -> Self {
        Self {
            bodies: scene.bodies.iter().map(|body| body.name.clone()).collect(),
            hinges: scene.free_hinges().map(str::to_owned).collect(),
            drives: scene.driven_joints().map(str::to_owned).collect(),
            loads: scene.loads_on_bodies().map(str::to_owned).collect(),
        }
    }

    /// What columns are of.
    fn of_column(&self, column: &Column) -> &[String] {
        match column.read {
            Read::Whole(_) => &[],
            Read::Body(_) => &self.bodies,
            Read::Hinge(_) => &self.hinges,
            Read::Drive(_) => &self.drives,
            Read::Load(_) => &self.loads,
        }
    }
}

/// The numbers of a drive; not numbers where there is none.
fn read_drive(read: fn(&DriveSample, &mut [f64]), drive: Option<&DriveSample>, to: &mut [f64]) {
    match drive {
        Some(drive) => read(drive, to),
        None => to.fill(f64::NAN),
    }
}

/// The columns in the order of a table, those of bodies and hinges with their numbers.
fn columns(
    chosen: &[&'static Column],
    names: &Names,
) -> impl Iterator<Item = (&'static Column, usize)> {
    let kind = |column: &Column| core::mem::discriminant(&column.read);
    let groups = chosen.chunk_by(move |a, b| kind(a) == kind(b));
    groups.flat_map(move |group| {
        let times = match group[0].read {
            Read::Whole(_) => 1,
            _ => names.of_column(group[0]).len(),
        };
        (0..times).flat_map(move |i| group.iter().map(move |column| (*column, i)))
    })
}

/// The numbers of a [`Table`]: a row for each frame.
///
/// ```
/// use articulated_fluid::{Scene, scene};
/// use sim::table::Rows;
/// use sim::{Plan, Simulation};
///
/// let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
/// let mut rows = Rows::of_all(&scene);
/// let first = Simulation::new(&scene, &Plan::default())?.advance()?.ok_or("no frame")?;
/// let row = rows.row(&first).ok_or("another scene")?;
/// assert_eq!((row.len(), row[0], &rows.names()[0][..]), (rows.names().len(), 0.0, "t"));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct Rows {
    chosen: Vec<&'static Column>,
    /// What the bodies count in the centre of mass, kg.
    masses: Vec<f64>,
    names: Names,
    row: Vec<f64>,
}

impl Rows {
    /// The rows of all columns, the [extra](Column::is_extra) ones too, for the bodies of a scene.
    pub fn of_all(scene: &Scene) -> Self {
        Self::of(scene, |_| true)
    }

    fn of(scene: &Scene, is_chosen: fn(&Column) -> bool) -> Self {
        let chosen: Vec<_> = COLUMNS.iter().filter(|column| is_chosen(column)).collect();
        let names = Names::of(scene);
        let width = columns(&chosen, &names).map(|(column, _)| column.names.len());
        Self {
            row: vec![0.0; width.sum()],
            masses: scene.centre_masses(),
            chosen,
            names,
        }
    }

    /// The names of the numbers: that of a body or a joint before a dot, where they are of one.
    pub fn names(&self) -> Vec<String> {
        let names = columns(&self.chosen, &self.names).flat_map(|(column, i)| {
            let owner = self.names.of_column(column).get(i);
            column.of(owner.map_or("", |owner| owner))
        });
        names.collect()
    }

    /// The numbers of a frame; none of one with another number of bodies. A quaternion takes the sign that is nearer to the row before.
    pub fn row(&mut self, frame: &Frame) -> Option<&[f64]> {
        if frame.bodies.attitudes.len() != self.masses.len() {
            return None;
        }
        let centre = frame.centre_of(&self.masses);
        let seen = Seen { frame, centre };
        let mut rest = &mut self.row[..];
        for (column, i) in columns(&self.chosen, &self.names) {
            let (to, after) = rest.split_at_mut(column.names.len());
            match column.read {
                Read::Whole(read) => read(&seen, to),
                Read::Body(read) | Read::Hinge(read) => read(&seen, i, to),
                Read::Drive(read) => read_drive(read, frame.drives.get(i), to),
                Read::Load(read) => {
                    let is_load = |drive: &&DriveSample| matches!(drive.kind, DriveKind::Loads(_));
                    let load = frame.drives.iter().filter(is_load).nth(i);
                    read_drive(read, load, to);
                }
            }
            rest = after;
        }
        Some(&self.row)
    }
}

/// Writes a row for each frame, with all digits, under a header.
pub struct Table<W> {
    out: W,
    rows: Rows,
    line: String,
}

impl<W: Write> Table<W> {
    /// Writes the header for the bodies of a scene, without the [extra](Column::is_extra) columns.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn new(out: W, scene: &Scene) -> io::Result<Self> {
        Self::of(out, scene, |column| !column.is_extra)
    }

    /// Writes the header of all columns for the bodies of a scene.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn with_all_columns(out: W, scene: &Scene) -> io::Result<Self> {
        Self::of(out, scene, |_| true)
    }

    fn of(mut out: W, scene: &Scene, is_chosen: fn(&Column) -> bool) -> io::Result<Self> {
        let rows = Rows::of(scene, is_chosen);
        let header: Vec<_> = rows.names().into_iter().map(quoted).collect();
        writeln!(out, "{}", header.join(","))?;
        let line = String::new();
        Ok(Self { out, rows, line })
    }

    /// Writes the row of a frame.
    ///
    /// # Errors
    /// Those of `out`; [`InvalidInput`](io::ErrorKind::InvalidInput) of a frame with another number of bodies.
    pub fn row(&mut self, frame: &Frame) -> io::Result<()> {
        use core::fmt::Write;
        let row = self.rows.row(frame).ok_or(io::ErrorKind::InvalidInput)?;
        self.line.clear();
        for (k, number) in row.iter().enumerate() {
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

/// A name as a field of CSV: in quotes where it needs them, which no name of a scene file does.
fn quoted(name: String) -> String {
    match name.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", name.replace('"', "\"\"")),
        false => name,
    }
}
