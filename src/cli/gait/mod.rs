//! `lgvi gait`: what a stroke does, and the best one.

mod best;
#[cfg(feature = "chart")]
mod maps;
mod tell;

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use articulated_fluid::Scene;
use articulated_fluid::scene::read_bounded;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use gait::{GaitError, Objective, Report};
use sim::number::{decimal, rounded};

use super::args;
use super::error::CliError;
use super::print;

/// Tell what a stroke of the joints does: its net motion, work and cost; or find the best stroke.
///
/// The joints of the scene repeat a motion. Without loads and momentum the shape alone leads: the net motion of a stroke is found from it,
/// whatever the speed. With drag, thrust or free joints it is the steady stroke that the swimmer comes to.
#[derive(clap::Args)]
#[command(after_long_help = AFTER_LONG_HELP)]
pub struct Args {
    /// The scene, a TOML file
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Tell where so many strokes lead
    #[arg(long, value_name = "N", default_value = "10", value_parser = args::count)]
    strokes: u64,
    /// Find the stroke that has most of this, from the scene's own and from random ones
    #[arg(long, value_name = "OBJECTIVE", value_parser = objective(), requires = "out")]
    best: Option<Objective>,
    /// Where the scene with the best stroke goes, a TOML file
    #[arg(long, value_name = "FILE", requires = "best")]
    out: Option<PathBuf>,
    /// Harmonics of the best stroke
    #[arg(long, value_name = "K", default_value = "2", value_parser = args::count, requires = "best")]
    order: u64,
    /// The largest angle of a hinge, or turn of a ball from rest, in rad
    #[arg(long, value_name = "ANGLE", default_value = "1", value_parser = args::angle, requires = "best")]
    angle: f64,
    /// The largest rate of a joint, in rad/s [default: any]
    #[arg(long, value_name = "RATE", value_parser = args::angle, requires = "best")]
    rate: Option<f64>,
    /// How many strokes the search starts from
    #[arg(long, value_name = "N", default_value = "10", value_parser = args::count, requires = "best")]
    starts: u64,
    /// Draw the height functions of two shape coordinates around the stroke: STEM.svg, STEM.png and STEM.csv
    #[cfg(feature = "chart")]
    #[arg(long, value_name = "STEM", conflicts_with = "best")]
    maps: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

const AFTER_LONG_HELP: &str = "\
Examples:
  lgvi gait scenes/swim/fish.toml
  lgvi gait scenes/swim/eel.toml --json | jq .cost_of_transport
  lgvi gait scenes/swim/fish.toml --best advance-per-length --out best.toml
  lgvi view best.toml --until 50
  lgvi gait scenes/swim/three-links.toml --maps heights

Net motion:
  After a period the first body has turned about an axis and advanced along it. Strokes in a row lead along a helix.
  Its geometric part is that of the shape alone, without momentum; the dynamic part is the rest.

Work:
  The positive work sums max(0, power) over drives and time: no drive gets back what another one gives. The cost of transport is
  that work over m g d, with the bodies' own mass and the displacement d of a stroke.

Best stroke:
  Each coordinate of the shape is a Fourier series, whose coefficients are the unknowns; the period stays the scene's. Bodies with
  semi-axes do not overlap, at several times of the stroke. Angles and rates are within their limits at all times.
  The gradient is exact, and the optimiser is SLSQP. With drag or thrust it is the best steady stroke. An interrupt keeps the best stroke so far.

Maps:
  A small loop in the plane of two shape coordinates moves the swimmer by its height times its area, and a larger one nearly so. The
  maps are in the body coordinates in which that holds best, those whose connection is least over the map; the CSV has all six.

Steady strokes:
  A swimmer with drag, thrust or free joints comes to a motion that after a stroke is as it was, but elsewhere. Small disturbances die
  out where all Floquet multipliers are smaller than 1. A weight would turn the swimmer: scenes with one are refused.

What is left out:
  The bodies disturb the fluid for each other, which the model leaves out. For strokes of three links, where it was computed, that is
  4 to 23 percent of the net motion.";

/// The hint that belongs to every net motion.
const COUPLING: &str = "the bodies' coupling through the fluid is left out: 4 to 23 percent of the net motion of three links";

fn objective() -> impl TypedValueParser<Value = Objective> {
    let value = |objective: Objective| PossibleValue::new(objective.name()).help(help(objective));
    PossibleValuesParser::new(Objective::ALL.map(value))
        .try_map(|name| Objective::named(&name).ok_or("no such objective"))
}

fn help(objective: Objective) -> &'static str {
    match objective {
        Objective::Advance => "the distance in a stroke, on a way of about ten body lengths",
        Objective::AdvancePerLength => {
            "that over the length of the stroke in the metric of the kinetic energy"
        }
        Objective::AdvancePerWork => "that over the positive work",
        Objective::Turn => "the turn of a stroke",
    }
}

/// Tells what the scene's stroke does, and finds a better one.
pub fn execute(args: &Args) -> Result<(), CliError> {
    // What is written is what was read, whatever happens to the file.
    let text = RefCell::new(Vec::new());
    let reads = |path: &Path| {
        let bytes = read_bounded(path)?;
        if path == args.scene {
            text.borrow_mut().clone_from(&bytes);
        }
        Ok(bytes)
    };
    let scene = Scene::load_by(&args.scene, &reads)?;
    let text = text.into_inner();
    #[cfg(feature = "chart")]
    if let Some(stem) = &args.maps {
        maps::draw(args, &scene, stem)?;
    }
    match (args.best, &args.out) {
        (Some(objective), Some(out)) => {
            let text = String::from_utf8_lossy(&text);
            best::search(args, (&scene, &text), objective, out)
        }
        _ => tell(args, &scene),
    }
}

fn failed(args: &Args, source: GaitError) -> CliError {
    CliError::Gait {
        file: args.scene.display().to_string(),
        source,
    }
}

fn tell(args: &Args, scene: &Scene) -> Result<(), CliError> {
    let strokes = u32::try_from(args.strokes).unwrap_or(u32::MAX);
    let report = Report::of(scene, strokes).map_err(|source| failed(args, source))?;
    match args.json {
        true => print::stdout(&print::json(&report)?),
        false => print::stdout(&(tell::text(&report) + &format!("\nnote: {COUPLING}\n"))),
    }
}

/// Eight digits.
fn digits(x: f64) -> String {
    decimal(rounded(x, 8))
}
