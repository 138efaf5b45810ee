//! `lgvi view`: a run as a moving picture.

use std::path::{Path, PathBuf};

use super::beside::{Beside, beside};
use super::error::CliError;
use super::interrupt::Interrupt;
use super::outputs::{Extras, Outputs};
use super::print;
use super::run::{seen, simulate};
use super::scene::load;
use super::settings::Settings;

/// Simulate a scene, and open the run as a moving picture in the browser.
///
/// Writes one page, which needs no network, into the current directory: SCENE.html.
#[derive(clap::Args)]
#[command(after_long_help = AFTER_LONG_HELP)]
pub struct Args {
    #[command(flatten)]
    settings: Settings,
    /// Show the same scene by a second method, too; see `lgvi run --help`
    #[arg(long, value_name = "METHOD", value_parser = beside(), hide_possible_values = true)]
    beside: Option<Beside>,
}

const AFTER_LONG_HELP: &str = "\
Examples:
  lgvi view scenes/eel.toml --until 20
  lgvi view --beside dp54                the built-in scene, and what a usual method makes of it
  lgvi run --out fish.html               the same page under another name, not opened";

/// Simulates the scene, writes the page and opens it.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let scene = args.settings.scene.as_deref();
    let loaded = load(scene)?;
    loaded.warn_of_overlaps();
    let until = args.settings.until;
    if let Some(beside) = args.beside {
        beside.check(&loaded, until)?;
    }
    let simulation = args.settings.simulation(&loaded, seen(until), false)?;
    let interrupt = Interrupt::listen().map_err(CliError::Signals)?;
    let page = page_of(scene);
    let outputs = Outputs::begin(std::slice::from_ref(&page), scene)?;
    let extras = Extras {
        all_columns: false,
        beside: args.beside,
    };
    let writers = outputs.writers(&loaded, &simulation, extras)?;
    simulate(simulation, writers, &interrupt)?;
    outputs.complete()?.place()?;
    let name = print::one_line(&page.display().to_string());
    print::stdout(&format!("written: {name}\n"))?;
    // The page is there, whether or not a browser is.
    if let Err(error) = open::that_detached(&page) {
        print::warning(&format!(
            "no browser can be started ({error}); open the page yourself"
        ));
    }
    Ok(())
}

/// The scene's name with another ending, in the current directory.
fn page_of(scene: Option<&Path>) -> PathBuf {
    let stem = scene.and_then(Path::file_stem);
    let mut name = stem.unwrap_or("fish-chain".as_ref()).to_owned();
    name.push(".html");
    name.into()
}
