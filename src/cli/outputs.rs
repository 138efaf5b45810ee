//! The files of a run, each in the format that its name's ending tells.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use articulated_fluid::Scene;
use sim::file::{AtomicFile, CompleteFile, FileError, is_same};
use sim::{Frame, Simulation, Table};
use view::{Arrays, Motion, NpzError, Recording, facts, glb, page};

use super::beside::Beside;
use super::error::CliError;
use super::output;
use super::scene::Loaded;

/// What a file of a run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Csv,
    Page,
    Gltf,
    Npz,
}

impl Format {
    const ALL: [(&str, Self, &str); 4] = [
        ("csv", Self::Csv, "CSV"),
        ("html", Self::Page, "page"),
        ("glb", Self::Gltf, "glTF"),
        ("npz", Self::Npz, "NumPy"),
    ];

    /// What a name promises.
    pub fn of(path: &Path) -> Result<Self, CliError> {
        let ending = path.extension();
        let is_it = |own: &str| ending.is_some_and(|ending| ending.eq_ignore_ascii_case(own));
        let known = Self::ALL.into_iter().find(|(own, ..)| is_it(own));
        let unknown = || CliError::OutputFormat(path.to_owned());
        Ok(known.ok_or_else(unknown)?.1)
    }

    /// What it is called in a summary.
    pub fn label(self) -> &'static str {
        let own = Self::ALL.into_iter().find(|(_, format, _)| *format == self);
        own.map_or("", |(.., label)| label)
    }

    /// Whether it moves before the eye.
    pub fn is_seen(self) -> bool {
        matches!(self, Self::Page | Self::Gltf)
    }
}

/// Where a file that may not be there is: its directory, whatever leads there, and its name.
fn place_of(path: &Path) -> (Option<PathBuf>, Option<&OsStr>) {
    let directory = match path.parent() {
        Some(parent) if parent.as_os_str().is_empty() => Path::new("."),
        Some(parent) => parent,
        None => path,
    };
    (directory.canonicalize().ok(), path.file_name())
}

/// What is written beside what the frames say.
#[derive(Clone, Copy)]
pub struct Extras {
    /// All columns of a table.
    pub all_columns: bool,
    /// A second motion on a page.
    pub beside: Option<Beside>,
}

/// The files of a run in the making.
pub struct Outputs(Vec<(PathBuf, Format, AtomicFile)>);

/// Files that are whole, and not yet in their places.
pub struct CompleteOutputs(Vec<(PathBuf, CompleteFile)>);

impl Outputs {
    /// Begins them: what is wrong with them shows before the run.
    pub fn begin(paths: &[PathBuf], scene: Option<&Path>) -> Result<Self, CliError> {
        let mut files: Vec<(PathBuf, Format, AtomicFile)> = vec![];
        for path in paths {
            let file = output::begin(path, scene)?;
            let format = Format::of(path)?;
            let is_twice = |(other, ..): &(PathBuf, _, _)| {
                place_of(other) == place_of(path) || is_same(other, path)
            };
            if files.iter().any(is_twice) {
                return Err(CliError::OutputTwice(path.clone()));
            }
            files.push((path.clone(), format, file));
        }
        Ok(Self(files))
    }

    /// What writes them, on a thread that may be given up.
    pub fn writers(
        &self,
        loaded: &Loaded,
        simulation: &Simulation,
        extras: Extras,
    ) -> Result<Writers, CliError> {
        let sink = |format: Format, file: &AtomicFile| -> io::Result<Sink> {
            let out = BufWriter::new(file.handle()?);
            Ok(match format {
                Format::Csv if extras.all_columns => {
                    Sink::Csv(Table::with_all_columns(out, &loaded.scene)?)
                }
                Format::Csv => Sink::Csv(Table::new(out, &loaded.scene)?),
                Format::Npz => Sink::Npz(Box::new(Arrays::new(&loaded.scene)), out),
                Format::Page => Sink::Page(out),
                Format::Gltf => Sink::Gltf(out),
            })
        };
        let begin = |(path, format, file): &(PathBuf, Format, AtomicFile)| {
            let sink = sink(*format, file);
            let sink = sink.map_err(|error| CliError::output(path, error.into()))?;
            Ok((path.clone(), sink))
        };
        let sinks: Result<Vec<_>, CliError> = self.0.iter().map(begin).collect();
        let is_seen = self.0.iter().any(|(_, format, _)| format.is_seen());
        Ok(Writers {
            scene: loaded.scene.clone(),
            title: loaded.title().to_owned(),
            beside: extras.beside,
            sinks: sinks?,
            recording: is_seen.then(|| Recording::new(simulation.model())),
        })
    }

    pub fn complete(self) -> Result<CompleteOutputs, CliError> {
        let complete = |(path, _, file): (PathBuf, Format, AtomicFile)| match file.complete() {
            Ok(file) => Ok((path, file)),
            Err(source) => Err(CliError::Output { path, source }),
        };
        let files: Result<_, _> = self.0.into_iter().map(complete).collect();
        Ok(CompleteOutputs(files?))
    }
}

impl CompleteOutputs {
    /// Puts them in their places.
    pub fn place(self) -> Result<(), CliError> {
        let place = |(path, file): (PathBuf, CompleteFile)| {
            file.place()
                .map_err(|source| CliError::Output { path, source })
        };
        self.0.into_iter().try_for_each(place)
    }
}

/// The frames on their way to the files.
pub struct Writers {
    scene: Scene,
    title: String,
    beside: Option<Beside>,
    sinks: Vec<(PathBuf, Sink)>,
    recording: Option<Recording>,
}

enum Sink {
    Csv(Table<BufWriter<File>>),
    Npz(Box<Arrays>, BufWriter<File>),
    Page(BufWriter<File>),
    Gltf(BufWriter<File>),
}

impl Writers {
    pub fn write(&mut self, frame: &Frame) -> Result<(), CliError> {
        if let Some(recording) = &mut self.recording {
            recording.add(frame);
        }
        for (path, sink) in &mut self.sinks {
            match sink {
                Sink::Csv(table) => {
                    let written = table.row(frame).map_err(FileError::from);
                    written.map_err(|source| CliError::output(path, source))?;
                }
                Sink::Npz(arrays, _) => arrays.add(frame),
                Sink::Page(_) | Sink::Gltf(_) => (),
            }
        }
        Ok(())
    }

    /// Writes what is known at the end alone, of a run that is done.
    pub fn end(self, simulation: &Simulation) -> Result<(), CliError> {
        let recording = match self.recording {
            Some(recording) => recording,
            None => Recording::new(simulation.model()),
        };
        for (path, sink) in self.sinks {
            let (mut out, text) = match sink {
                Sink::Csv(table) => (table.into_inner(), vec![]),
                Sink::Npz(arrays, mut out) => {
                    let written = arrays.write(&mut out);
                    written.map_err(|source| npz(&path, source))?;
                    (out, vec![])
                }
                Sink::Gltf(out) => (out, glb(&self.scene, &self.title, &recording)),
                Sink::Page(out) => {
                    let run = (simulation, &recording);
                    let page = whole_page(&self.scene, &self.title, run, self.beside)?;
                    (out, page.into_bytes())
                }
            };
            let written = out.write_all(&text).and_then(|()| out.flush());
            written.map_err(|source| CliError::output(&path, source.into()))?;
        }
        Ok(())
    }
}

fn npz(path: &Path, error: NpzError) -> CliError {
    match error {
        NpzError::Write(source) => CliError::output(path, source.into()),
        source => CliError::Npz {
            path: path.to_owned(),
            source,
        },
    }
}

fn whole_page(
    scene: &Scene,
    title: &str,
    (simulation, recording): (&Simulation, &Recording),
    beside: Option<Beside>,
) -> Result<String, CliError> {
    let facts = facts(&simulation.report());
    let first = Motion {
        name: simulation.method().name(),
        facts: &facts,
        recording,
    };
    let Some(beside) = beside else {
        return Ok(page(scene, title, &[first]));
    };
    let second = beside.record(scene, simulation, recording.times())?;
    let second_motion = Motion {
        name: beside.name(),
        facts: &second.facts,
        recording: &second.recording,
    };
    Ok(page(scene, title, &[first, second_motion]))
}
