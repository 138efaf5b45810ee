//! `lgvi import`: a robot as a scene.

use std::path::PathBuf;

use clap::ValueEnum;
use urdf::Options;

use super::args;
use super::error::CliError;
use super::print;

/// Print the scene of a robot that a URDF file describes, with comments.
///
/// Links that are fixed to each other become one body, and joints that turn become hinges. The scene starts at rest in the robot's zero pose.
#[derive(clap::Args)]
#[command(after_long_help = AFTER_LONG_HELP)]
pub struct Args {
    /// The robot, a URDF file; of a xacro file, what xacro makes of it
    #[arg(value_name = "URDF")]
    robot: PathBuf,
    /// Density of the fluid, in kg/m^3: 1000 of water
    #[arg(long, value_name = "DENSITY", default_value = "0", value_parser = args::density, allow_hyphen_values = true)]
    fluid: f64,
    /// What holds the root link [default: the world where the link is named world or has, with what is fixed to it, no mass; else free]
    #[arg(long, value_enum, value_name = "BASE")]
    base: Option<Base>,
    /// What the ellipsoids are made from that stand for the links in the fluid
    #[arg(long, value_enum, value_name = "SHAPE", default_value = "collision")]
    shape_from: ShapeFrom,
}

#[derive(Clone, Copy, ValueEnum)]
enum Base {
    /// Nothing: the robot floats
    Free,
    /// The world
    World,
}

#[derive(Clone, Copy, ValueEnum)]
enum ShapeFrom {
    /// Boxes, cylinders, spheres and capsules, each an ellipsoid of its volume and proportions; of a link that has none, the inertia
    Collision,
    /// The inertia: the uniform ellipsoid that has it
    Inertia,
}

const AFTER_LONG_HELP: &str = "\
Examples:
  lgvi import arm.urdf --base world > arm.toml
  lgvi import turtle.urdf --fluid 1000 > turtle.toml
  lgvi view turtle.toml --until 10

What a scene does not have is refused by its name: prismatic and planar joints, joints that mimic others, loops, and links that move
without a mass. Limits of joints and dry friction are left out, and a note on stderr says so. Meshes are not read.";

impl Args {
    fn options(&self) -> Options {
        Options {
            density: self.fluid,
            base: self.base.map(|base| match base {
                Base::Free => urdf::Base::Free,
                Base::World => urdf::Base::World,
            }),
            shape_from: match self.shape_from {
                ShapeFrom::Collision => urdf::ShapeFrom::Collision,
                ShapeFrom::Inertia => urdf::ShapeFrom::Inertia,
            },
        }
    }
}

/// Prints the scene, and what is left out of it to stderr.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let imported = urdf::load(&args.robot, &args.options());
    let imported = imported.map_err(|source| CliError::Robot {
        file: args.robot.display().to_string(),
        source,
    })?;
    imported.notes.iter().for_each(print::note);
    print::stdout(&imported.text)
}
