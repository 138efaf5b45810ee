//! What is compared: the structure-keeping methods and the baselines, each under one name and run in one way.
//!
//! ```
//! use study::contender::{Contender, Control};
//!
//! let contender: Contender = "dp853".parse()?;
//! assert_eq!((contender.order(), contender.control()), (8, Control::Tolerance));
//! let error = "dp45".parse::<Contender>().unwrap_err();
//! assert!(error.to_string().contains("dp54") && error.to_string().contains("gauss-8"));
//! # Ok::<(), study::contender::UnknownContender>(())
//! ```

mod describe;
mod failure;
mod problem;
mod run;

use core::fmt;
use core::str::FromStr;

use thiserror::Error;

pub use failure::Failure;
pub use problem::{Cost, Problem, Setting};

use crate::baseline::{self, Baseline};
use sim::Method;
use sim::method::Family;

/// A way to integrate the continuous or the discrete model of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Contender {
    /// One that keeps the structure.
    Structure(Method),
    /// Variational Gauss collocation as a [pilot run](dvi::Pilot) chooses it for a wanted accuracy.
    Pilot,
    /// An explicit competitor, of [`baseline::ALL`].
    Baseline(&'static Baseline),
}

/// What a contender's accuracy is asked for with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Control {
    /// The size of all steps.
    Step,
    /// The error allowed in a step.
    Tolerance,
    /// The error allowed over the run.
    Accuracy,
}

/// What a contender is made of; one colour on a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Kind {
    /// The stepping map of the discrete Lagrangian, and its compositions.
    Variational,
    /// Variational Gauss collocation.
    Gauss,
    /// Explicit, on the group.
    Group,
    /// Explicit in steps of one size, on raw matrix entries.
    Raw,
    /// Explicit with step control, on raw matrix entries.
    Adaptive,
}

/// No contender has this name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no method is called `{name}`; expected one of {}", names())]
pub struct UnknownContender {
    /// What was asked for.
    pub name: String,
}

fn names() -> String {
    let names: Vec<_> = Contender::all().map(Contender::name).collect();
    names.join(", ")
}

impl Contender {
    /// Every contender, those that keep the structure first.
    pub fn all() -> impl Iterator<Item = Self> + Clone {
        let structure = Method::all().map(Self::Structure).chain([Self::Pilot]);
        structure.chain(baseline::ALL.iter().map(Self::Baseline))
    }

    /// What it is called on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Structure(method) => method.name(),
            Self::Pilot => "pilot",
            Self::Baseline(baseline) => baseline.name,
        }
    }

    /// What it is, in a line.
    pub fn description(self) -> String {
        match self {
            Self::Structure(method) => method.description().to_owned(),
            Self::Pilot => {
                "variational Gauss collocation, its stages and step chosen by a pilot run"
                    .to_owned()
            }
            Self::Baseline(baseline) => baseline.text.to_owned(),
        }
    }

    /// The order: the error at a fixed time falls as $h^{\text{order}}$; of the pilot's choice, the least.
    pub fn order(self) -> u32 {
        match self {
            Self::Structure(method) => method.order(),
            Self::Pilot => 8,
            Self::Baseline(baseline) => baseline.order(),
        }
    }

    /// Whether it keeps the group, the symplectic form and the momentum maps.
    pub fn keeps_structure(self) -> bool {
        !matches!(self, Self::Baseline(_))
    }

    /// What its accuracy is asked for with.
    pub fn control(self) -> Control {
        match (self, self.kind()) {
            (Self::Pilot, _) => Control::Accuracy,
            (_, Kind::Adaptive) => Control::Tolerance,
            _ => Control::Step,
        }
    }

    /// What it is made of.
    pub fn kind(self) -> Kind {
        match self {
            Self::Structure(method) => match method.family() {
                Family::Gauss { .. } => Kind::Gauss,
                _ => Kind::Variational,
            },
            Self::Pilot => Kind::Gauss,
            Self::Baseline(baseline) => match baseline.method {
                baseline::Method::Raw(_) => Kind::Raw,
                baseline::Method::Group(_) => Kind::Group,
                baseline::Method::Adaptive(_) => Kind::Adaptive,
            },
        }
    }
}

impl fmt::Display for Contender {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Contender {
    type Err = UnknownContender;

    fn from_str(name: &str) -> Result<Self, UnknownContender> {
        let unknown = || UnknownContender {
            name: name.to_owned(),
        };
        let mut all = Self::all();
        all.find(|contender| contender.name() == name)
            .ok_or_else(unknown)
    }
}
