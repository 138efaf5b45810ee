//! What of a scene is left out of its smallest exact model, and why: as a user reads it.

use dvi::DiscreteLagrangian;
use lie::Vec3;
use serde::Serialize;

use crate::planar::{NotPlanar, Plane, rounded};
use crate::scene::{Scene, SceneBody};
use crate::tree::ArticulatedBody;
use crate::views::Rerooted;

/// What a model is made of; as a user reads it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Account {
    /// The configuration group, as `SO(3) x R^3 x SO(3)^2`.
    pub group: String,
    /// Its dimension.
    pub dimension: usize,
    /// The unknowns of the equations of a step of the discrete Lagrangian (22).
    pub unknowns: usize,
    /// The group of the scene without any reduction.
    pub full_group: String,
    /// Its dimension, and the unknowns with it.
    pub full_dimension: usize,
    /// What acts beside inertia, each with the names of what it acts on: `weight`, `drag on head`.
    pub acts: Vec<String>,
    /// What every motion keeps: `energy` or `energy less work`, `symplectic form`, linear and angular momentum.
    pub keeps: Vec<&'static str>,
    /// Every reduction that there is, taken or not.
    pub reductions: Vec<Reduction>,
}

/// One way to describe a scene with less.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reduction {
    /// `translation`, `joints`, `weight`, `root`, `drift` or `plane`.
    pub name: &'static str,
    /// Whether it is exact for the scene, and so was taken.
    pub taken: bool,
    /// What it leaves out.
    pub drops: String,
    /// Why it was taken, or why it cannot be.
    pub why: String,
}

impl Account {
    /// The names of the reductions that were taken.
    pub fn taken(&self) -> impl Iterator<Item = &'static str> {
        let taken = self.reductions.iter().filter(|reduction| reduction.taken);
        taken.map(|reduction| reduction.name)
    }
}

/// What was found of a scene's views.
pub(crate) struct Found<'a> {
    pub(crate) root: Option<&'a Rerooted>,
    /// Whether the motion is stepped in a frame that moves with the mass centre.
    pub(crate) drifts: bool,
    /// The model in space that is stepped, or restricted to the plane.
    pub(crate) model: &'a ArticulatedBody,
    pub(crate) plane: &'a Result<Plane, NotPlanar>,
}

impl Scene {
    /// The account of what was found.
    pub(crate) fn account(&self, found: &Found) -> Account {
        let bodies = self.bodies.len();
        let full = space(found.model);
        let ((group, dimension), unknowns) = match found.plane {
            Ok(_) => (flat(bodies), bodies),
            Err(_) => (full.clone(), full.1 - found.model.eliminated().len()),
        };
        Account {
            group,
            dimension,
            unknowns,
            full_group: full.0,
            full_dimension: full.1,
            acts: self.acts(found.model),
            keeps: found.model.keeps(),
            reductions: vec![
                translation(found.model),
                joints(bodies),
                self.weight_reduction(found),
                self.root_reduction(found),
                self.drift_reduction(found),
                self.plane_reduction(found),
            ],
        }
    }

    fn weight_reduction(&self, found: &Found) -> Reduction {
        let taken = found.model.gravity().is_none();
        let why = match self.worst(|body| body.net_mass.abs()) {
            _ if self.gravity == [0.0; 3] => "no gravity".to_owned(),
            None => "every body is neutrally buoyant".to_owned(),
            Some(_) if taken => "all bodies fall alike: see drift".to_owned(),
            Some(body) => format!(
                "{:?} is {:.3e} kg {} than what it displaces",
                body.name,
                body.net_mass.abs(),
                if body.net_mass > 0.0 {
                    "heavier"
                } else {
                    "lighter"
                },
            ),
        };
        Reduction {
            name: "weight",
            taken,
            drops: "its potential and its forces".to_owned(),
            why,
        }
    }

    fn root_reduction(&self, found: &Found) -> Reduction {
        let root = found.root;
        let why = match root {
            None if !found.model.has_views() => BALLS.to_owned(),
            Some(root) => format!(
                "{:?} is heavier than the first body, so the tree hangs on it",
                self.bodies[root.root()].name
            ),
            None => "the first body is the heaviest".to_owned(),
        };
        Reduction {
            name: "root",
            taken: root.is_some(),
            drops: "momenta of heavy bodies that cancel in the motion of a light first one"
                .to_owned(),
            why,
        }
    }

    fn drift_reduction(&self, found: &Found) -> Reduction {
        let taken = found.drifts;
        let why = match self.worst(|body| anisotropy(&body.total_mass)) {
            _ if !found.model.has_views() => BALLS.to_owned(),
            Some(body) => format!(
                "the mass of {:?} differs by direction, by {:.3e} of it",
                body.name,
                anisotropy(&body.total_mass)
            ),
            None if taken => {
                "every mass is the same in all directions: drift and fall turn no body".to_owned()
            }
            None => "the mass centre is at rest".to_owned(),
        };
        Reduction {
            name: "drift",
            taken,
            drops: "uniform motion and fall of the whole, which are computed exactly".to_owned(),
            why,
        }
    }

    /// The body with the most of a quantity, if any has some.
    fn worst(&self, quantity: impl Fn(&SceneBody) -> f64) -> Option<&SceneBody> {
        let some = self.bodies.iter().filter(|body| quantity(body) > 0.0);
        some.max_by(|a, b| quantity(a).total_cmp(&quantity(b)))
    }

    fn plane_reduction(&self, found: &Found) -> Reduction {
        let why = match found.plane {
            Ok(plane) => format!(
                "bodies, joints and motion are symmetric under the plane normal to {}, exactly",
                rounded(plane.normal())
            ),
            Err(refused) => {
                let listed = |root: &Rerooted| root.listed(refused.body);
                let body = found.root.map_or(refused.body, listed);
                refused.of(format_args!("{:?}", self.bodies[body].name))
            }
        };
        Reduction {
            name: "plane",
            taken: found.plane.is_ok(),
            drops: "turns and displacements out of the plane".to_owned(),
            why,
        }
    }
}

/// Why a view is not taken of other trees.
const BALLS: &str = "only of a free tree on ball joints, without coupled inertia and points of buoyancy, on which nothing acts but weight and springs";

fn translation(model: &ArticulatedBody) -> Reduction {
    let why = match model.is_free() {
        false => "the first body hangs on the world: there is no x",
        true => translated(model),
    };
    Reduction {
        name: "translation",
        taken: !model.eliminated().is_empty(),
        drops: "x and its momentum from the unknowns; x is rebuilt at each step".to_owned(),
        why: why.to_owned(),
    }
}

fn translated(model: &ArticulatedBody) -> &'static str {
    if model.loads.forces.act_on_bodies() {
        return "loads on bodies change the linear momentum, and need not be linear in the velocity";
    }
    match model.net_weight() == Vec3::zero() {
        true => "no force depends on where the bodies are: the linear momentum is constant",
        false => "the weight's impulse is constant, so the equation of x stays linear",
    }
}

fn joints(bodies: usize) -> Reduction {
    let alone = bodies == 1;
    Reduction {
        name: "joints",
        taken: alone,
        drops: "joints and what they couple".to_owned(),
        why: match alone {
            true => "one body, alone".to_owned(),
            false => format!("{bodies} bodies hang on each other"),
        },
    }
}

/// How much a mass differs by direction, relative to its largest entry; zero where it is a number exactly.
fn anisotropy(mass: &[[f64; 3]; 3]) -> f64 {
    let m = mass[0][0];
    let off = |i: usize, j: usize| mass[i][j] - if i == j { m } else { 0.0 };
    let entries = (0..9).map(|k| off(k / 3, k % 3).abs());
    let largest = mass.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
    entries.fold(0.0, f64::max) / largest
}

/// The group in space and its dimension.
fn space(model: &ArticulatedBody) -> (String, usize) {
    let (roots, hinges) = (model.joints.roots.len(), model.joints.hinges.len());
    if model.is_simple() {
        return (product("SO(3)", "R^3", roots), 3 * roots + 3);
    }
    let power = |group: &str, times: usize| match times {
        0 => None,
        1 => Some(group.to_owned()),
        _ => Some(format!("{group}^{times}")),
    };
    let translation = model.is_free().then(|| "R^3".to_owned());
    let parts = [power("SO(3)", roots), translation, power("R", hinges)];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    let group = match parts.is_empty() {
        true => "a point: all moves as told".to_owned(),
        false => parts.join(" x "),
    };
    (group, 3 * roots + model.translation().len() + hinges)
}

/// The group in a plane and its dimension.
fn flat(bodies: usize) -> (String, usize) {
    (product("SO(2)", "R^2", bodies), bodies + 2)
}

fn product(rotations: &str, translations: &str, bodies: usize) -> String {
    let first = format!("{rotations} x {translations}");
    match bodies {
        1 => first,
        2 => format!("{first} x {rotations}"),
        _ => format!("{first} x {rotations}^{}", bodies - 1),
    }
}
