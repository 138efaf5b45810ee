//! `lgvi inspect`: what a scene is modelled with.

use std::path::PathBuf;

use articulated_fluid::Account;
use articulated_fluid::scene::{Note, Overlap};
use serde::Serialize;

use super::error::CliError;
use super::print;
use super::scene::load;

/// Tell what a scene is modelled with, and why: the smallest exact model.
///
/// Each scene is described by the smallest group and the fewest terms that describe it exactly. What a scene does not have is
/// not computed; a simplification that holds only approximately is not applied, and the reason tells how far off it is.
#[derive(clap::Args)]
#[command(after_long_help = AFTER_LONG_HELP)]
pub struct Args {
    /// The scene, a TOML file [default: three bodies, from Lee, Leok & McClamroch (2009)]
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

const AFTER_LONG_HELP: &str = "\
Examples:
  lgvi inspect
  lgvi inspect scenes/planar-fish.toml
  lgvi inspect boat.toml --json | jq -r '.reductions[] | select(.taken) | .name'

Keeps:
  What every motion of the scene keeps. With drives, or loads beside weight and springs, it is the energy less their work.

Reductions:
  translation   x leaves the unknowns: the linear momentum is constant, or grows by the weight's impulse
  joints        one body alone has none
  weight        no gravity, every body neutrally buoyant, or all bodies fall alike
  root          the tree hangs on its heaviest body, if that is not the first one
  drift         in a vacuum, or for spheres, uniform motion and fall are computed exactly
  plane         one coordinate plane is a mirror of all, exactly, and the motion stays in it: rotations in SO(2)
lgvi run takes what is exact, and lgvi run --full takes none of it: the motion is the same.

Notes:
  A matrix that is symmetric to 1e-3 of its largest entry is made symmetric, and a quaternion of
  length 1 to 1e-3 is normalised, as published numbers have few digits. A note tells where.";

/// What is told of a scene; units are in the names.
#[derive(Serialize)]
struct Inspection<'a> {
    title: Option<&'a str>,
    scene: &'a str,
    bodies: usize,
    #[serde(flatten)]
    account: &'a Account,
    /// The first of them.
    overlaps: Vec<OverlapObject<'a>>,
    more_overlaps: usize,
    notes: &'a [Note],
}

#[derive(Serialize)]
struct OverlapObject<'a> {
    bodies: [&'a str; 2],
    depth_metres: f64,
}

impl<'a> From<&'a Overlap> for OverlapObject<'a> {
    fn from(overlap: &'a Overlap) -> Self {
        let [a, b] = &overlap.names;
        Self {
            bodies: [a, b],
            depth_metres: overlap.depth,
        }
    }
}

/// Prints the account of the scene.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let loaded = load(args.scene.as_deref())?;
    let (account, overlaps) = (&loaded.smallest.account, &loaded.overlaps);
    loaded.warn_of_overlaps();
    let inspection = Inspection {
        title: loaded.scene.title.as_deref(),
        scene: &loaded.file,
        bodies: loaded.scene.bodies.len(),
        account,
        overlaps: overlaps.first.iter().map(OverlapObject::from).collect(),
        more_overlaps: overlaps.more,
        notes: &loaded.scene.notes,
    };
    match args.json {
        true => print::stdout(&print::json(&inspection)?),
        false => print::stdout(&text(&inspection)),
    }
}

/// With what is none as such.
fn listed<T: std::borrow::Borrow<str>>(items: &[T]) -> String {
    match items {
        [] => "nothing".to_owned(),
        items => items.join("; "),
    }
}

fn text(inspection: &Inspection) -> String {
    let account = inspection.account;
    let head = [
        [
            "scene".to_owned(),
            print::one_line(inspection.title.unwrap_or("untitled")),
        ],
        ["file".to_owned(), print::one_line(inspection.scene)],
        ["bodies".to_owned(), inspection.bodies.to_string()],
        ["acts".to_owned(), listed(&account.acts)],
        ["keeps".to_owned(), listed(&account.keeps)],
        [
            "group".to_owned(),
            format!("{}, dimension {}", account.group, account.dimension),
        ],
        [
            "without reductions".to_owned(),
            format!(
                "{}, dimension {}",
                account.full_group, account.full_dimension
            ),
        ],
        [
            "unknowns of a step".to_owned(),
            format!("{} of {}", account.unknowns, account.full_dimension),
        ],
    ];
    let lines = account.reductions.iter().flat_map(|reduction| {
        let (name, taken) = (
            reduction.name,
            if reduction.taken { "taken" } else { "not" },
        );
        let would = if reduction.taken {
            "leaves"
        } else {
            "would leave"
        };
        let drops = format!("{would} out {}", reduction.drops);
        [[name, taken, &reduction.why], ["", "", &drops]].map(|row| row.map(str::to_owned))
    });
    let notes = inspection.notes.iter();
    let notes = notes.map(|note| ["note".to_owned(), note.to_string()]);
    let blocks = [
        print::columns(&head),
        print::columns(&lines.collect::<Vec<_>>()),
        print::columns(&notes.collect::<Vec<_>>()),
    ];
    let told = blocks.into_iter().filter(|block| !block.is_empty());
    told.collect::<Vec<_>>().join("\n")
}
