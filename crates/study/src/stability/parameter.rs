//! What of a scene is varied.
//!
//! A place for another one: a variant, its names, and what it changes of a [`Scene`].

use core::fmt;
use core::str::FromStr;

use articulated_fluid::scene::{Form, SceneBody, StartVelocity};
use articulated_fluid::{BodyLoad, Ellipsoid, EllipsoidError, ModelError, Scene};
use serde::Serialize;
use sim::number::decimal;
use thiserror::Error;

use crate::contender::Problem;

/// What of a scene is varied: all but the stiffness in multiples of the scene's own, where 1 is the scene as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Parameter {
    /// All initial velocities.
    ///
    /// Where no force acts, this is a change of the unit of time: a spin of $s$ in steps of $h$ is the scene itself in steps of $s h$.
    Spin,
    /// The longest semi-axis of each body and, with it, the joints on the body: at constant density.
    Aspect,
    /// Mass and inertia, own and added, of all bodies but the head.
    MassRatio,
    /// N m, added to the stiffness $k$ of each joint, of the potential $k (1 - \cos\theta)$ of the angle between its bodies.
    Stiffness,
}

/// No parameter has this name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no parameter is called `{name}`; expected one of {}", names())]
pub struct UnknownParameter {
    /// What was asked for.
    pub name: String,
}

/// Why a scene cannot be varied so.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ParameterError {
    /// The value is no positive number, nor the zero that a stiffness may be.
    #[error(
        "{parameter} has the value {}; expected a finite number > 0{}", decimal(*value), if parameter.may_be_zero() { ", or 0" } else { "" }
    )]
    Value {
        /// What was to be varied.
        parameter: Parameter,
        /// The value.
        value: f64,
    },
    /// A body's masses do not follow from semi-axes.
    #[error(
        "body {body:?} is not given by its semi-axes, which alone tell the inertia of another aspect ratio; give it semi_axes and mass, as \
         scenes/fish-chain-from-semi-axes.toml does, or vary another parameter"
    )]
    NotAnEllipsoid {
        /// Its name.
        body: String,
    },
    /// There is nothing but a head.
    #[error(
        "the scene has one body alone, and {parameter} is of tails and joints; vary another parameter"
    )]
    NoTail {
        /// What was to be varied.
        parameter: Parameter,
    },
    /// The stretched axes are no ellipsoid's.
    #[error("body {body:?} stretched {} times: {source}", decimal(*value))]
    Ellipsoid {
        /// Its name.
        body: String,
        /// The value.
        value: f64,
        /// Why not.
        source: EllipsoidError,
    },
    /// What comes of it is no model.
    #[error("at {parameter} = {}: {source}", decimal(*value))]
    Model {
        /// What was varied.
        parameter: Parameter,
        /// The value.
        value: f64,
        /// Why not.
        source: ModelError,
    },
}

fn names() -> String {
    let names: Vec<_> = Parameter::all().map(Parameter::name).collect();
    names.join(", ")
}

impl Parameter {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> + Clone {
        [Self::Spin, Self::Aspect, Self::MassRatio, Self::Stiffness].into_iter()
    }

    /// What it is called on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Spin => "spin",
            Self::Aspect => "aspect",
            Self::MassRatio => "mass-ratio",
            Self::Stiffness => "stiffness",
        }
    }

    /// What it varies, in a line.
    pub fn description(self) -> &'static str {
        match self {
            Self::Spin => "all initial velocities",
            Self::Aspect => {
                "the longest semi-axis of each body, with the joints on it, at constant density"
            }
            Self::MassRatio => "mass and inertia, own and added, of all bodies but the head",
            Self::Stiffness => "N m, added to the stiffness of each joint",
        }
    }

    /// The values that tell most of it, unless others are asked for.
    pub fn default_values(self) -> &'static [f64] {
        match self {
            Self::Aspect => &[0.5, 0.7, 1.0, 1.4, 2.0],
            Self::Stiffness => &[0.1, 1.0, 10.0, 100.0, 1000.0],
            _ => &[0.25, 0.5, 1.0, 2.0, 4.0],
        }
    }

    /// Whether zero is a value of it: what is added may be nothing, and nothing times as much is no scene.
    fn may_be_zero(self) -> bool {
        self == Self::Stiffness
    }

    /// Its name on an axis.
    pub fn label(self) -> &'static str {
        match self {
            Self::Spin => "spin [× the scene's own]",
            Self::Aspect => "aspect ratio [× the scene's own]",
            Self::MassRatio => "mass of tails to head [× the scene's own]",
            Self::Stiffness => "stiffness of joints [N m]",
        }
    }

    /// The scene with `value` times its own of this, or with so much more.
    ///
    /// # Errors
    /// [`ParameterError`].
    pub fn vary(self, scene: &Scene, value: f64) -> Result<Scene, ParameterError> {
        let parameter = self;
        let valid = value > 0.0 || (value == 0.0 && self.may_be_zero());
        if !(value.is_finite() && valid) {
            return Err(ParameterError::Value { parameter, value });
        }
        let of_tails = matches!(self, Self::MassRatio | Self::Stiffness);
        if of_tails && scene.bodies.len() < 2 {
            return Err(ParameterError::NoTail { parameter });
        }
        let mut scene = scene.clone();
        match self {
            Self::Spin => spin(&mut scene, value),
            Self::Aspect => stretch(&mut scene, value)?,
            Self::MassRatio => weigh(&mut scene, value),
            Self::Stiffness => scene
                .joints
                .iter_mut()
                .for_each(|joint| joint.mobility.stiffness += value),
        }
        Ok(scene)
    }

    /// The model of the varied scene, where it starts and how long it runs.
    ///
    /// # Errors
    /// [`ParameterError`].
    pub fn problem(self, scene: &Scene, value: f64, until: f64) -> Result<Problem, ParameterError> {
        let scene = self.vary(scene, value)?;
        let refused = |source| ParameterError::Model {
            parameter: self,
            value,
            source,
        };
        Problem::of(&scene, until).map_err(refused)
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Parameter {
    type Err = UnknownParameter;

    fn from_str(name: &str) -> Result<Self, UnknownParameter> {
        let unknown = || UnknownParameter {
            name: name.to_owned(),
        };
        Self::all()
            .find(|parameter| parameter.name() == name)
            .ok_or_else(unknown)
    }
}

fn spin(scene: &mut Scene, value: f64) {
    for body in &mut scene.bodies {
        body.angular_velocity = body.angular_velocity.map(|rate| value * rate);
    }
    if let StartVelocity::Given(velocity) = &mut scene.velocity {
        *velocity = velocity.map(|v| value * v);
    }
}

fn weigh(scene: &mut Scene, value: f64) {
    let scaled = |matrix: [[f64; 3]; 3]| matrix.map(|row| row.map(|x| value * x));
    for body in scene.bodies.iter_mut().skip(1) {
        body.total_mass = scaled(body.total_mass);
        body.total_inertia = scaled(body.total_inertia);
        body.net_mass *= value;
        // No longer that of its shape.
        body.form = Form::Given {
            shape: body.semi_axes(),
            mass: body.mass().map(|mass| value * mass),
            inertia: match body.form {
                Form::Given { inertia, .. } => inertia.map(scaled),
                Form::Ellipsoid { .. } => None,
            },
        };
    }
}

fn stretch(scene: &mut Scene, value: f64) -> Result<(), ParameterError> {
    let density = scene.density;
    let mut longest = vec![];
    for body in &mut scene.bodies {
        longest.push(stretch_body(body, density, value)?);
    }
    for joint in &mut scene.joints {
        joint.at_parent[longest[joint.parent]] *= value;
        joint.at_child[longest[joint.child]] *= value;
    }
    Ok(())
}

/// Stretches a body along its longest axis, whose index is returned.
fn stretch_body(body: &mut SceneBody, density: f64, value: f64) -> Result<usize, ParameterError> {
    let name = body.name.clone();
    let Form::Ellipsoid {
        mut semi_axes,
        mass,
    } = body.form
    else {
        return Err(ParameterError::NotAnEllipsoid { body: name });
    };
    let longest = (0..3).max_by(|i, j| semi_axes[*i].total_cmp(&semi_axes[*j]));
    let longest = longest.unwrap_or(0);
    semi_axes[longest] *= value;
    match Ellipsoid::new(semi_axes) {
        Ok(stretched) => {
            let made = SceneBody::ellipsoid(&name, &stretched, value * mass, density);
            body.form = made.form;
            body.total_mass = made.total_mass;
            body.total_inertia = made.total_inertia;
            body.net_mass = made.net_mass;
            body.buoyancy_at[longest] *= value;
            for point in body.loads.iter_mut().filter_map(BodyLoad::point_mut) {
                point.0[longest] *= value;
            }
            Ok(longest)
        }
        Err(source) => Err(ParameterError::Ellipsoid {
            body: name,
            value,
            source,
        }),
    }
}
