//! What can stop a command, and the exit code that says so.

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use articulated_fluid::{ModelError, SceneError};
#[cfg(feature = "chart")]
use figure::FigureError;
use gait::GaitError;
use sim::SimError;
use sim::file::FileError;
use sim::number::decimal;
#[cfg(feature = "chart")]
use study::{stability::ParameterError, work_precision::UnknownReference};
use thiserror::Error;
use urdf::UrdfError;
use view::NpzError;

/// The exit code of a run or a write that failed.
const FAILURE: u8 = 1;
/// The exit code of bad arguments and bad scenes.
pub const USAGE: u8 = 2;
/// What a shell adds to the number of the signal that ended a command.
const SIGNALLED: usize = 128;

/// Why a command did not do what it was asked.
#[derive(Debug, Error)]
pub enum CliError {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error("{file}: {source}")]
    Model { file: String, source: ModelError },
    #[error("{file}: {source}")]
    Gait { file: String, source: GaitError },
    #[error("{file}: {source}")]
    Robot { file: String, source: UrdfError },
    #[error("{}{}{}", option(.0), .0, advice(.0))]
    Sim(#[from] SimError),
    #[error("--out {} is the scene itself; give what is written another name", .0.display())]
    OutputIsScene(PathBuf),
    #[error(
        "--out -: stdout has the summary; give a file's name, or ./- for one that is called so"
    )]
    OutputIsDash,
    #[error(
        "--out {}: the name's ending tells no format; give a name that ends in .csv, .html, .glb or .npz", .0.display()
    )]
    OutputFormat(PathBuf),
    #[error("--out {} is given twice; give each file a name of its own", .0.display())]
    OutputTwice(PathBuf),
    #[error("--beside needs a page to be shown on; give --out a name that ends in .html")]
    BesideWithoutPage,
    #[cfg(feature = "chart")]
    #[error("--beside: {0}")]
    Beside(String),
    #[error("--out {}: {source}", path.display())]
    Npz { path: PathBuf, source: NpzError },
    #[error("--out {}: {source}", path.display())]
    Output { path: PathBuf, source: FileError },
    #[error("interrupted at t = {} s; nothing was written", decimal(*t))]
    Interrupted { t: f64, signal: usize },
    #[error("interrupted; the best stroke so far is written")]
    BestSoFar { signal: usize },
    #[error("interrupted; nothing was written")]
    Stopped { signal: usize },
    #[cfg(feature = "chart")]
    #[error("all bodies move as told: no method has anything to solve; lgvi run tells the work")]
    NothingToSolve,
    #[cfg(feature = "chart")]
    #[error(transparent)]
    Reference(#[from] UnknownReference),
    #[error("no thread can be started: {0}")]
    Thread(#[source] io::Error),
    #[cfg(feature = "chart")]
    #[error("--steps: a step of {} s is longer than the run; give shorter ones, or a longer --until than {} s", decimal(*step), decimal(*until))]
    StepBeyondEnd { step: f64, until: f64 },
    #[cfg(feature = "chart")]
    #[error("--parameter: {0}")]
    Parameter(#[from] ParameterError),
    #[cfg(feature = "chart")]
    #[error(transparent)]
    Figure(#[from] FigureError),
    #[error("signals cannot be handled: {0}")]
    Signals(#[source] io::Error),
    #[error("stdout cannot be written: {0}")]
    Stdout(#[source] io::Error),
}

/// The option that an error is of.
fn option(error: &SimError) -> &'static str {
    match error {
        SimError::Pilot(_)
        | SimError::NoAccuracy { .. }
        | SimError::AccuracyOutOfReach { .. }
        | SimError::Rehearsal { .. } => "--accuracy: ",
        _ => "",
    }
}

/// The options that help.
fn advice(error: &SimError) -> &'static str {
    match error {
        SimError::TooManySteps { .. } => "; take a longer --step or a shorter --until",
        SimError::TooManySamples { .. } => "; take a longer --every-seconds or a shorter --until",
        _ => "",
    }
}

impl CliError {
    /// What is wrong with the file that is to be written.
    pub fn output(path: &Path, source: FileError) -> Self {
        let path = path.to_owned();
        Self::Output { path, source }
    }

    /// The exit code that tells this error's kind.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Scene(_) | Self::Model { .. } | Self::Robot { .. } => USAGE,
            Self::OutputIsScene(_) | Self::OutputIsDash => USAGE,
            Self::OutputFormat(_) | Self::OutputTwice(_) | Self::BesideWithoutPage => USAGE,
            Self::Output { source, .. } if source.is_of_the_path() => USAGE,
            Self::Sim(error) => match error {
                SimError::Step { .. }
                | SimError::NotFinite { .. }
                | SimError::Pilot(_)
                | SimError::AccuracyOutOfReach { .. }
                | SimError::Rehearsal { .. } => FAILURE,
                _ => USAGE,
            },
            #[cfg(feature = "chart")]
            Self::Parameter(_) | Self::StepBeyondEnd { .. } | Self::NothingToSolve => USAGE,
            Self::Gait { source, .. } => match source {
                GaitError::Step(_) | GaitError::NotSteady { .. } | GaitError::NoStroke => FAILURE,
                _ => USAGE,
            },
            Self::BestSoFar { signal } => signalled(*signal),
            Self::Interrupted { signal, .. } => signalled(*signal),
            Self::Stopped { signal } => signalled(*signal),
            _ => FAILURE,
        })
    }
}

fn signalled(signal: usize) -> u8 {
    u8::try_from(SIGNALLED + signal).unwrap_or(FAILURE)
}
