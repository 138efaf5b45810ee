//! The smallest model that describes a scene exactly, and the account of what it leaves out.

use serde::Serialize;

use crate::planar::{NotPlanar, PlanarBody, Plane, rounded};
use crate::{ArticulatedBody, ModelError, Scene};

/// A model of a scene, no larger than the scene needs.
#[derive(Clone, Debug)]
pub enum SmallestModel {
    /// In space, with masses that are matrices.
    Fluid(ArticulatedBody),
    /// In space, with masses that are numbers.
    Dry(ArticulatedBody<f64>),
    /// In a plane, with the plane that leads back into space.
    Planar(PlanarBody, Plane),
}

/// The smallest exact model of a scene with the reasons for it.
#[derive(Clone, Debug)]
pub struct Smallest {
    /// The model.
    pub model: SmallestModel,
    /// What was left out, what was not, and why.
    pub account: Account,
}

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
    /// Every reduction that there is, taken or not.
    pub reductions: Vec<Reduction>,
}

/// One way to describe a scene with less.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reduction {
    /// `translation`, `joints`, `weight`, `fluid` or `plane`.
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

impl Scene {
    /// The smallest model that describes this scene exactly.
    ///
    /// Each reduction restricts or eliminates: the discrete Lagrangian is the same function, and the motion the same.
    /// What would hold only approximately is not taken, and the account says by how much it fails.
    ///
    /// ```
    /// use articulated_fluid::{Scene, SmallestModel, scene};
    ///
    /// let text = "
    ///     [fluid]
    ///     density = 0
    ///     [[body]]
    ///     name = 'stone'
    ///     semi_axes = [3, 2, 1]
    ///     mass = 5
    ///     angular_velocity = [1, 2, 0]
    /// ";
    /// let smallest = Scene::parse(text, "stone.toml")?.smallest()?;
    /// assert!(matches!(smallest.model, SmallestModel::Dry(_)));
    /// assert_eq!((smallest.account.dimension, smallest.account.unknowns), (6, 3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Scene::initial_state`].
    pub fn smallest(&self) -> Result<Smallest, ModelError> {
        let (model, state) = (self.model()?, self.initial_state()?);
        let plane = Plane::find(&model, &state);
        let reductions = vec![
            self.translation(),
            self.joint_reduction(),
            self.weight_reduction(),
            self.fluid_reduction(plane.is_ok()),
            self.plane_reduction(&plane),
        ];
        let bodies = self.bodies.len();
        let full = space(bodies);
        let (model, (group, dimension)) = match (plane, model.isotropic()) {
            (Ok(plane), _) => (SmallestModel::Planar(plane.model(), plane), flat(bodies)),
            (Err(_), Some(dry)) => (SmallestModel::Dry(dry), full.clone()),
            (Err(_), None) => (SmallestModel::Fluid(model), full.clone()),
        };
        let unknowns = match model {
            SmallestModel::Planar(..) => bodies,
            _ => 3 * bodies,
        };
        let account = Account {
            group,
            dimension,
            unknowns,
            full_group: full.0,
            full_dimension: full.1,
            reductions,
        };
        Ok(Smallest { model, account })
    }

    fn translation(&self) -> Reduction {
        let why = match self.has_weight() {
            false => "no force depends on where the bodies are: the linear momentum is constant",
            true => "the weight's impulse is constant, so the equation of x stays linear",
        };
        Reduction {
            name: "translation",
            taken: true,
            drops: "x and its momentum from the unknowns; x is rebuilt at each step".to_owned(),
            why: why.to_owned(),
        }
    }

    fn joint_reduction(&self) -> Reduction {
        let bodies = self.bodies.len();
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

    fn weight_reduction(&self) -> Reduction {
        let heaviest = self
            .bodies
            .iter()
            .max_by(|a, b| a.net_mass.abs().total_cmp(&b.net_mass.abs()));
        let why = match heaviest {
            _ if self.gravity == [0.0; 3] => "no gravity".to_owned(),
            Some(body) if body.net_mass != 0.0 => format!(
                "{:?} is {:.3e} kg {} than what it displaces",
                body.name,
                body.net_mass.abs(),
                if body.net_mass > 0.0 {
                    "heavier"
                } else {
                    "lighter"
                },
            ),
            _ => "every body is neutrally buoyant".to_owned(),
        };
        Reduction {
            name: "weight",
            taken: !self.has_weight(),
            drops: "its potential and its forces".to_owned(),
            why,
        }
    }

    fn fluid_reduction(&self, in_plane: bool) -> Reduction {
        let worst = self
            .bodies
            .iter()
            .map(|body| (anisotropy(&body.total_mass), &body.name));
        let worst = worst.max_by(|a, b| a.0.total_cmp(&b.0));
        let (taken, why) = match worst {
            Some((defect, name)) if defect > 0.0 => (
                false,
                format!("the mass of {name:?} differs by direction, by {defect:.3e} of it"),
            ),
            _ if in_plane => (false, "in a plane it would save nothing".to_owned()),
            _ => (true, "every mass is the same in all directions".to_owned()),
        };
        Reduction {
            name: "fluid",
            taken,
            drops: "the turning of masses and the forces M V x V; the total mass is constant"
                .to_owned(),
            why,
        }
    }

    fn plane_reduction(&self, plane: &Result<Plane, NotPlanar>) -> Reduction {
        let why = match plane {
            Ok(plane) => format!(
                "bodies, joints and motion are symmetric under the plane normal to {}",
                rounded(plane.normal())
            ),
            Err(refused) => {
                let index = format!("(body {})", refused.body);
                let name = self
                    .bodies
                    .get(refused.body)
                    .map(|body| format!("({:?})", body.name));
                refused
                    .to_string()
                    .replace(&index, &name.unwrap_or_default())
            }
        };
        Reduction {
            name: "plane",
            taken: plane.is_ok(),
            drops: "turns and displacements out of the plane".to_owned(),
            why,
        }
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
fn space(bodies: usize) -> (String, usize) {
    (product("SO(3)", "R^3", bodies), 3 * bodies + 3)
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
