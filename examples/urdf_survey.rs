//! What becomes of robots: every URDF below a folder is imported, and what makes a scene runs for a second.
//!
//! `cargo run --release --example urdf_survey -- DIR` lists each file with its outcome. A robot starts with its hinges at up to 1 rad/s, in a vacuum
//! and under gravity; a free one turns, too. Then a run in a fluid follows. The energy, with the work of dampers, must be kept to 1e-6 of the largest
//! kinetic energy. The momenta that the motion keeps must be kept to 1e-9 of their size.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

use lgvi::articulated_fluid::scene::StartVelocity;
use lgvi::articulated_fluid::{JointKind, Scene};
use lgvi::sim::{Choice, Method, Plan, Report, Schedule, Simulation};
use urdf::{Imported, Options};

/// kg/m³, of the fluid.
const WATER: f64 = 1000.0;
/// s, tried in turn.
const STEPS: [f64; 3] = [2e-3, 5e-4, 1e-4];
const ENERGY: f64 = 1e-6;
const MOMENTUM: f64 = 1e-9;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::args().nth(1);
    let folder = folder.ok_or("give the folder in which to look for .urdf files")?;
    let mut files = vec![];
    find(folder.as_ref(), &mut files)?;
    files.sort();
    let (mut whole, mut noted, mut refused, mut failed) = (0, 0, 0, 0);
    for file in &files {
        let name = file.strip_prefix(&folder).unwrap_or(file).display();
        let text = fs::read_to_string(file)?;
        let imported = match urdf::import(&text, &Options::default()) {
            Ok(imported) => imported,
            Err(error) => {
                refused += 1;
                println!("{name}\n  refused: {error}");
                continue;
            }
        };
        let outcome = match imported.notes.is_empty() {
            true => "whole",
            false => "with notes",
        };
        println!("{name}\n  {outcome}: {}", size(&imported));
        let wet = Options {
            density: WATER,
            ..Options::default()
        };
        let wet = urdf::import(&text, &wet)?;
        wet.notes.iter().for_each(|note| println!("  note: {note}"));
        match run("vacuum", imported.scene) & run("water", wet.scene) {
            true if outcome == "whole" => whole += 1,
            true => noted += 1,
            false => failed += 1,
        }
    }
    println!(
        "\n{} files: {whole} whole, {noted} with notes, {refused} refused, {failed} failed",
        files.len()
    );
    match failed {
        0 => Ok(()),
        _ => Err("not every run kept what it should".into()),
    }
}

/// The URDF files in a folder, at any depth.
fn find(folder: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        match path.is_dir() {
            true => find(&path, files)?,
            false if path.extension().is_some_and(|ending| ending == "urdf") => files.push(path),
            false => {}
        }
    }
    Ok(())
}

fn size(imported: &Imported) -> String {
    let scene = &imported.scene;
    let base = match &scene.mount {
        Some(_) => "held",
        None => "free",
    };
    let hinges = scene.free_hinges().count();
    format!(
        "{} bodies, {hinges} hinges, base {base}",
        scene.bodies.len()
    )
}

/// Runs a scene in the longest of the steps that keeps enough, tells what it kept, and whether one does.
fn run(place: &str, mut scene: Scene) -> bool {
    push(&mut scene);
    let mut told = String::new();
    for step in STEPS {
        told = match simulate(&scene, step) {
            Ok(report) => {
                let (energy, momentum) = (relative_energy(&report), relative_momentum(&report));
                let told = format!(
                    "1 s in {} steps, energy {energy:.0e}, momentum {momentum:.0e}",
                    report.steps
                );
                if energy < ENERGY && momentum < MOMENTUM {
                    println!("  {place}: {told}");
                    return true;
                }
                told
            }
            Err(error) => error.to_string(),
        };
    }
    println!("  {place}: NOT KEPT: {told}");
    false
}

/// Sets hinges and a free base moving, each at another rate.
fn push(scene: &mut Scene) {
    let mut rate = (1..).map(|k| (f64::from(k) * 1.618).sin());
    let mobilities = scene.mount.iter_mut().map(|mount| &mut mount.mobility);
    let joints = scene.joints.iter_mut().map(|joint| &mut joint.mobility);
    for mobility in mobilities.chain(joints) {
        if let (JointKind::Hinge(_), Some(rate)) = (&mobility.kind, rate.next()) {
            mobility.rate = rate;
        }
    }
    if scene.mount.is_none() {
        scene.bodies[0].angular_velocity = [0.3, -0.2, 0.5];
        scene.velocity = StartVelocity::Given([0.1, 0.2, -0.1]);
    }
}

fn simulate(scene: &Scene, step: f64) -> Result<Report, Box<dyn Error>> {
    let plan = Plan {
        choice: Choice::Method {
            method: "gauss-4".parse::<Method>()?,
            step: Some(step),
        },
        until: 1.0,
        schedule: Schedule::Steps(10),
        ..Plan::default()
    };
    let mut simulation = Simulation::new(scene, &plan)?;
    while !simulation.is_done() {
        simulation.advance()?;
    }
    Ok(simulation.report())
}

fn relative_energy(report: &Report) -> f64 {
    report.energy_error_max_relative.unwrap_or(0.0)
}

/// Of a free base; a held one takes what momentum it needs from the world.
fn relative_momentum(report: &Report) -> f64 {
    let angular = report.angular_momentum_deviation_max_relative;
    match report.momentum_is_kept {
        true => angular.unwrap_or(0.0),
        false => 0.0,
    }
}
