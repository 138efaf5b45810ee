//! A run as arrays, one for each group of the table's columns.

use std::io::Write;

use articulated_fluid::Scene;
use lie::Vec3;
use sim::Frame;

use crate::npz::{Array, NpzError, write};

/// What is read of a frame, row by row; the shape of a row depends on the numbers of bodies, hinges and drives.
struct Column {
    name: &'static str,
    shape: fn([usize; 3]) -> Vec<usize>,
    read: fn(&Frame, &mut Vec<f64>),
}

fn vectors(all: &[Vec3], to: &mut Vec<f64>) {
    all.iter().for_each(|v| to.extend(v.0));
}

const COLUMNS: &[Column] = &[
    Column {
        name: "t",
        shape: |_| vec![],
        read: |frame, to| to.push(frame.t()),
    },
    Column {
        name: "position",
        shape: |_| vec![3],
        read: |frame, to| to.extend(frame.position().0),
    },
    Column {
        name: "velocity",
        shape: |_| vec![3],
        read: |frame, to| to.extend(frame.bodies.velocity.0),
    },
    Column {
        name: "attitude",
        shape: |[bodies, ..]| vec![bodies, 3, 3],
        read: |frame, to| {
            let matrices = frame.bodies.attitudes.iter().map(|r| r.matrix());
            matrices.for_each(|r| to.extend(r.0.as_flattened()));
        },
    },
    Column {
        name: "angular_velocity",
        shape: |[bodies, ..]| vec![bodies, 3],
        read: |frame, to| vectors(&frame.bodies.rates, to),
    },
    Column {
        name: "centre",
        shape: |[bodies, ..]| vec![bodies, 3],
        read: |frame, to| vectors(&frame.bodies.centres, to),
    },
    Column {
        name: "hinge",
        shape: |[_, hinges, _]| vec![hinges, 2],
        read: |frame, to| to.extend((0..).map_while(|k| frame.hinge(k)).flatten()),
    },
    Column {
        name: "work",
        shape: |[.., drives]| vec![drives],
        read: |frame, to| to.extend(frame.drives.iter().map(|drive| drive.work)),
    },
    Column {
        name: "energy",
        shape: |_| vec![],
        read: |frame, to| to.push(frame.sample.energy),
    },
    Column {
        name: "momentum",
        shape: |_| vec![3],
        read: |frame, to| to.extend(frame.sample.linear.0),
    },
    Column {
        name: "angular_momentum",
        shape: |_| vec![3],
        read: |frame, to| to.extend(frame.sample.angular.0),
    },
    Column {
        name: "orthogonality",
        shape: |_| vec![],
        read: |frame, to| to.push(frame.sample.orthogonality),
    },
];

/// All frames of a run as arrays of doubles, with a row for each frame. Units are those of the [table](sim::table::COLUMNS).
///
/// With $T$ frames of $N$ bodies, $H$ free hinges and $D$ drives: `t` $(T)$, `position` and `velocity` of the first body $(T, 3)$.
/// `attitude` $(T, N, 3, 3)$, `angular_velocity` and `centre` of the bodies $(T, N, 3)$. `hinge` $(T, H, 2)$ with angle and rate.
/// `work` $(T, D)$, `energy` $(T)$, `momentum` and `angular_momentum` $(T, 3)$, `orthogonality` $(T)$. The names are in `bodies`,
/// `hinges` and `drives`.
pub struct Arrays {
    names: [(&'static str, Vec<String>); 3],
    frames: usize,
    numbers: Vec<Vec<f64>>,
}

impl Arrays {
    /// Arrays without rows for the bodies of a scene.
    pub fn new(scene: &Scene) -> Self {
        let own = |names: Vec<&str>| names.into_iter().map(str::to_owned).collect();
        let bodies = scene.bodies.iter().map(|body| &body.name[..]).collect();
        let loads = scene.loads_on_bodies().map(|name| -> &str { name });
        let drives = scene.driven_joints().chain(loads);
        Self {
            names: [
                ("bodies", own(bodies)),
                ("hinges", own(scene.free_hinges().collect())),
                ("drives", own(drives.collect())),
            ],
            frames: 0,
            numbers: COLUMNS.iter().map(|_| vec![]).collect(),
        }
    }

    /// Adds the row of a frame.
    pub fn add(&mut self, frame: &Frame) {
        self.frames += 1;
        for (column, to) in COLUMNS.iter().zip(&mut self.numbers) {
            (column.read)(frame, to);
        }
    }

    /// Writes the archive.
    ///
    /// # Errors
    /// [`NpzError`].
    pub fn write(self, out: &mut impl Write) -> Result<(), NpzError> {
        let counts = [0, 1, 2].map(|k: usize| self.names[k].1.len());
        let columns = COLUMNS.iter().zip(self.numbers);
        let numbers = columns.map(|(column, numbers)| {
            let mut shape = vec![self.frames];
            shape.extend((column.shape)(counts));
            (column.name, Array::Numbers(shape, numbers))
        });
        let names = self
            .names
            .into_iter()
            .map(|(name, names)| (name, Array::Names(names)));
        let arrays: Vec<_> = numbers.chain(names).collect();
        write(out, &arrays)
    }
}
