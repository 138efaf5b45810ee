//! Whether every method runs at its default step: the scenes of the collection, and random ones, for 100 s.
//!
//! `cargo run --release -p lgvi-study --example defaults [SCENES]`: by default 20 random scenes beside the shipped ones.

#[path = "laws/random.rs"]
mod random;

use std::path::Path;

use articulated_fluid::Scene;
use rayon::prelude::*;
use sim::{Method, Plan, Schedule, Simulation};

const SEED: u64 = 22;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = std::env::args().nth(1).map_or(Ok(20), |n| n.parse())?;
    let mut scenes = Vec::new();
    let folder = |name| std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(name));
    for entry in folder("../../scenes")?.chain(folder("../../scenes/swim")?) {
        let path = entry?.path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            scenes.push((path.display().to_string(), Scene::load(&path)?));
        }
    }
    let shipped = scenes.len();
    scenes.extend((0..count).map(|case| (format!("random {case}"), random::scene(SEED, case))));
    let failures: Vec<Vec<String>> = scenes.par_iter().map(failures).collect();
    failures
        .iter()
        .flatten()
        .for_each(|failure| println!("{failure}"));
    let failed = |failures: &[Vec<String>]| failures.iter().filter(|some| !some.is_empty()).count();
    let (of_shipped, of_random) = (failed(&failures[..shipped]), failed(&failures[shipped..]));
    let methods = Method::all().len();
    println!(
        "{methods} methods: refused in {of_shipped} of {shipped} shipped scenes, in {of_random} of {count} random ones"
    );
    Ok(())
}

/// The methods that do not come to the end.
fn failures((name, scene): &(String, Scene)) -> Vec<String> {
    let failure = |method: Method| {
        let plan = Plan {
            choice: method.into(),
            schedule: Schedule::Steps(u64::MAX),
            ..Plan::default()
        };
        let ended = Simulation::new(scene, &plan).and_then(|run| run.last().transpose());
        ended
            .err()
            .map(|error| format!("{name}, {method}: {error}"))
    };
    Method::all().filter_map(failure).collect()
}
