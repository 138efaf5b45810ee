//! What can stop a command, and the exit code that says so.

use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

use articulated_fluid::{ModelError, SceneError};
use dvi::{PilotError, StepError};
use figure::FigureError;
use study::stability::ParameterError;
use study::work_precision::UnknownReference;
use thiserror::Error;

use super::clock::TooManySteps;
use super::output::OutputError;
use super::schedule::TooManySamples;

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
    #[error(transparent)]
    TooManySteps(#[from] TooManySteps),
    #[error(transparent)]
    TooManySamples(#[from] TooManySamples),
    #[error("--out {} is the scene itself; give what is written another name", .0.display())]
    OutputIsScene(PathBuf),
    #[error(
        "--out -: stdout has the summary; give a file's name, or ./- for one that is called so"
    )]
    OutputIsDash,
    #[error("--out {}: {source}", path.display())]
    Output { path: PathBuf, source: OutputError },
    #[error(transparent)]
    Step(#[from] StepError),
    #[error("--accuracy: {0}")]
    Pilot(#[from] PilotError),
    #[error(
        "at t = {t} s the energy or a momentum is too large for a number; check the scene's velocities and inertia"
    )]
    NotFinite { t: f64 },
    #[error("interrupted at t = {t} s; nothing was written")]
    Interrupted { t: f64, signal: usize },
    #[error("interrupted; nothing was written")]
    Stopped { signal: usize },
    #[error(transparent)]
    Reference(#[from] UnknownReference),
    #[error("--parameter: {0}")]
    Parameter(#[from] ParameterError),
    #[error(transparent)]
    Figure(#[from] FigureError),
    #[error("signals cannot be handled: {0}")]
    Signals(#[source] io::Error),
    #[error("stdout cannot be written: {0}")]
    Stdout(#[source] io::Error),
}

impl CliError {
    /// The exit code that tells this error's kind.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Scene(_)
            | Self::Model { .. }
            | Self::TooManySteps(_)
            | Self::TooManySamples(_)
            | Self::Parameter(_)
            | Self::OutputIsScene(_)
            | Self::OutputIsDash => USAGE,
            Self::Interrupted { signal, .. } | Self::Stopped { signal } => {
                u8::try_from(SIGNALLED + signal).unwrap_or(FAILURE)
            }
            _ => FAILURE,
        })
    }
}
