//! The command line: a module for each command, and what they share.

mod args;
mod beside;
#[cfg(feature = "chart")]
mod chart;
#[cfg(feature = "chart")]
mod contenders;
mod error;
#[cfg(feature = "chart")]
mod files;
mod gait;
mod import;
mod inspect;
mod interrupt;
mod methods;
mod output;
mod outputs;
mod print;
mod progress;
mod run;
mod scene;
mod settings;
#[cfg(feature = "chart")]
mod stability;
mod summary;
mod view;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use error::CliError;

const EXPERIMENTS: &str = if cfg!(feature = "chart") {
    "
  lgvi chart boat.toml                  which method is the cheapest for which error
  lgvi stability boat.toml              in which steps each method fails, and how"
} else {
    ""
};

fn after_help() -> String {
    format!(
        "\
Examples:
  lgvi run                              the built-in scene for 100 s
  lgvi run --until 10 --out fish.csv    10 s of it, with the trajectory
  lgvi run boat.toml --step 0.01        a scene of one's own
  lgvi view boat.toml                   its moving picture, in the browser
  lgvi run --method gauss-4             another integrator, at its own default step{EXPERIMENTS}
  lgvi gait boat.toml                   what a stroke of its joints does, and the best one
  lgvi import robot.urdf > robot.toml   a robot as a scene
  lgvi inspect boat.toml                what it is modelled with, and why
  lgvi methods                          the integrators: orders, steps, costs
  lgvi run --help                       options, CSV columns, keys of a scene"
    )
}

/// Lie group variational integrators for rigid bodies on joints in a perfect fluid.
///
/// The motion is computed on the group of its configurations, so that rotations stay rotations, momenta stay
/// constant to rounding, and the energy error stays bounded. A scene is a TOML file; one is built in.
#[derive(Parser)]
#[command(name = "lgvi", version, arg_required_else_help = true, max_term_width = 100, after_help = after_help())]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Run(run::Args),
    View(view::Args),
    #[cfg(feature = "chart")]
    Chart(chart::Args),
    #[cfg(feature = "chart")]
    Stability(stability::Args),
    Gait(gait::Args),
    Import(import::Args),
    Inspect(inspect::Args),
    Methods(methods::Args),
}

impl Command {
    fn execute(&self) -> Result<(), CliError> {
        match self {
            Self::Run(args) => run::execute(args),
            Self::View(args) => view::execute(args),
            #[cfg(feature = "chart")]
            Self::Chart(args) => chart::execute(args),
            #[cfg(feature = "chart")]
            Self::Stability(args) => stability::execute(args),
            Self::Gait(args) => gait::execute(args),
            Self::Import(args) => import::execute(args),
            Self::Inspect(args) => inspect::execute(args),
            Self::Methods(args) => methods::execute(args),
        }
    }
}

/// Runs the command that the arguments ask for; its errors go to stderr and make the exit code.
pub fn main() -> ExitCode {
    let done = match Cli::try_parse() {
        Ok(cli) => cli.command.execute(),
        Err(answer) => {
            let text = print::escaped(&answer.render().to_string(), |c| c == '\n');
            if answer.use_stderr() {
                print::stderr(&text);
                return ExitCode::from(error::USAGE);
            }
            print::stdout(&text)
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            print::error(&error);
            error.exit_code()
        }
    }
}
