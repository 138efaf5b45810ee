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

mod adaptive;
mod describe;
mod failure;
mod fixed;
mod piloted;
mod problem;

use core::fmt;
use core::str::FromStr;

use thiserror::Error;

pub use failure::Failure;
pub use problem::{Cost, Problem, Setting};

use sim::Method;

/// A way to integrate the continuous or the discrete model of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Contender {
    /// One that keeps the structure.
    Structure(Method),
    /// Variational Gauss collocation as a [pilot run](dvi::Pilot) chooses it for a wanted accuracy.
    Pilot,
    /// [Classical](crate::explicit::ClassicalRungeKutta) Runge–Kutta on raw matrix entries.
    Rk4,
    /// [`MuntheKaas`](crate::explicit::Scheme::MuntheKaas).
    Rkmk4,
    /// [`WithoutDexp`](crate::explicit::Scheme::WithoutDexp), the negative control.
    Rkmk4Plain,
    /// [`CommutatorFree`](crate::explicit::Scheme::CommutatorFree).
    Cf4,
    /// [`DormandPrince54`](crate::baseline::Pair::DormandPrince54) on raw matrix entries.
    Dp54,
    /// Dormand–Prince 8(5,3) on raw matrix entries, [inlined](crate::dop853).
    Dp853,
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

const OTHERS: [Contender; 7] = [
    Contender::Pilot,
    Contender::Rk4,
    Contender::Rkmk4,
    Contender::Rkmk4Plain,
    Contender::Cf4,
    Contender::Dp54,
    Contender::Dp853,
];

impl Contender {
    /// Every contender, those that keep the structure first.
    pub fn all() -> impl Iterator<Item = Self> + Clone {
        Method::all().map(Self::Structure).chain(OTHERS)
    }

    /// What it is called on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Structure(method) => method.name(),
            Self::Pilot => "pilot",
            Self::Rk4 => "rk4",
            Self::Rkmk4 => "rkmk4",
            Self::Rkmk4Plain => "rkmk4-plain",
            Self::Cf4 => "cf4",
            Self::Dp54 => "dp54",
            Self::Dp853 => "dp853",
        }
    }

    /// What it is, in a line.
    pub fn description(self) -> String {
        match self {
            Self::Structure(method) => return method.description().to_owned(),
            Self::Pilot => {
                "variational Gauss collocation, its stages and step chosen by a pilot run"
            }
            Self::Rk4 => "classical Runge–Kutta on raw rotation matrices",
            Self::Rkmk4 => "Runge–Kutta–Munthe-Kaas on the group",
            Self::Rkmk4Plain => "the same without dexp^-1, to show what that costs",
            Self::Cf4 => "commutator-free on the group (Celledoni, Marthinsen & Owren)",
            Self::Dp54 => "Dormand–Prince 5(4) on raw rotation matrices, adaptive",
            Self::Dp853 => "Dormand–Prince 8(5,3) on raw rotation matrices, adaptive",
        }
        .to_owned()
    }

    /// The order: the error at a fixed time falls as $h^{\text{order}}$; of the pilot's choice, the least.
    pub fn order(self) -> u32 {
        match self {
            Self::Structure(method) => method.order(),
            Self::Rk4 | Self::Rkmk4 | Self::Cf4 => 4,
            Self::Rkmk4Plain => 2,
            Self::Dp54 => 5,
            Self::Dp853 | Self::Pilot => 8,
        }
    }

    /// Whether it keeps the group, the symplectic form and the momentum maps.
    pub fn keeps_structure(self) -> bool {
        matches!(self, Self::Structure(_) | Self::Pilot)
    }

    /// What its accuracy is asked for with.
    pub fn control(self) -> Control {
        match self {
            Self::Pilot => Control::Accuracy,
            Self::Dp54 | Self::Dp853 => Control::Tolerance,
            _ => Control::Step,
        }
    }

    /// What it is made of.
    pub fn kind(self) -> Kind {
        use sim::method::Family;
        match self {
            Self::Structure(method) => match method.family() {
                Family::Gauss { .. } => Kind::Gauss,
                _ => Kind::Variational,
            },
            Self::Pilot => Kind::Gauss,
            Self::Rk4 => Kind::Raw,
            Self::Rkmk4 | Self::Rkmk4Plain | Self::Cf4 => Kind::Group,
            Self::Dp54 | Self::Dp853 => Kind::Adaptive,
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
