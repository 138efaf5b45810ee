//! The integrators of a scene's model, each under one name.
//!
//! ```
//! use sim::Method;
//!
//! let method: Method = "gauss-4".parse()?;
//! assert_eq!((method.order(), method.to_string()), (8, "gauss-4".to_owned()));
//! let error = "gauss-9".parse::<Method>().unwrap_err();
//! assert!(error.to_string().contains("gauss-8"));
//! # Ok::<(), sim::method::UnknownMethod>(())
//! ```

use core::fmt;
use core::str::FromStr;

use articulated_fluid::{Configuration, Smallest};
use dvi::{
    Adjoint, Composition, ContinuousSystem, DiscreteLagrangian, Gauss, Integrator, Variational,
};
use serde::{Serialize, Serializer};
use thiserror::Error;

/// An integrator chosen at run time.
pub type BoxedIntegrator<G> = Box<dyn Integrator<Group = G> + Send>;

/// A model in both forms, discrete and continuous: every method steps it.
pub trait Model: DiscreteLagrangian + ContinuousSystem + Clone + Send + 'static {}

impl<M: DiscreteLagrangian + ContinuousSystem + Clone + Send + 'static> Model for M {}

/// An integrator of a [`Model`], chosen at run time by its name; the default is the paper's.
///
/// All of them stay on the group, are symplectic, and keep the momentum maps to rounding. They differ in order, in symmetry and in cost.
/// As serialised, a method is all that is known of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Method(usize);

/// How a method makes a step, and so what a [report](dvi::StepReport) of it counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Family {
    /// One implicit step of a discrete Lagrangian: an iteration evaluates its derivatives once.
    Variational,
    /// The same of its [adjoint](dvi::Adjoint).
    Adjoint,
    /// Steps of both in turn: an iteration evaluates the derivatives of one of them once.
    Composition {
        /// How many.
        substeps: u32,
    },
    /// Collocation: an iteration is a sweep, which evaluates the continuous model once at each stage.
    Gauss {
        /// How many.
        stages: u32,
    },
}

/// What is known of a method: a new one is a new entry of [`TABLE`].
struct Entry {
    name: &'static str,
    order: u32,
    family: Family,
    /// s.
    default_step: f64,
    evaluations_per_step: u32,
    description: &'static str,
}

const fn entry(
    name: &'static str,
    order: u32,
    family: Family,
    default_step: f64,
    evaluations_per_step: u32,
    description: &'static str,
) -> Entry {
    Entry {
        name,
        order,
        family,
        default_step,
        evaluations_per_step,
        description,
    }
}

const VARIATIONAL: Family = Family::Variational;
const ADJOINT: Family = Family::Adjoint;

const fn composition(substeps: u32) -> Family {
    Family::Composition { substeps }
}

const fn gauss(stages: u32) -> Family {
    Family::Gauss { stages }
}

/// Name, order, family, default step, evaluations in it, description.
#[rustfmt::skip]
const TABLE: &[Entry] = &[
    entry("lgvi",            1, VARIATIONAL,     0.001,   2, "the integrator of Lee, Leok & McClamroch (2009)"),
    entry("lgvi-adjoint",    1, ADJOINT,         0.001,   6, "adjoint of lgvi: it looks at the end of a step"),
    entry("composition-2",   2, composition(2),   0.01,  19, "symmetric composition of lgvi and its adjoint, 2 substeps"),
    entry("composition-4",   4, composition(10),  0.05, 120, "symmetric composition of lgvi and its adjoint, 10 substeps"),
    entry("composition-6",   6, composition(18),   0.1, 200, "symmetric composition of lgvi and its adjoint, 18 substeps"),
    entry("composition-8",   8, composition(34),   0.1, 380, "symmetric composition of lgvi and its adjoint, 34 substeps"),
    entry("gauss-1",         2, gauss(1),         0.01,  13, "variational Gauss collocation, 1 stage"),
    entry("gauss-2",         4, gauss(2),         0.05,  37, "variational Gauss collocation, 2 stages"),
    entry("gauss-3",         6, gauss(3),          0.1,  68, "variational Gauss collocation, 3 stages"),
    entry("gauss-4",         8, gauss(4),          0.1,  72, "variational Gauss collocation, 4 stages"),
    entry("gauss-5",        10, gauss(5),          0.2, 140, "variational Gauss collocation, 5 stages"),
    entry("gauss-6",        12, gauss(6),          0.2, 130, "variational Gauss collocation, 6 stages"),
    entry("gauss-7",        14, gauss(7),          0.2, 120, "variational Gauss collocation, 7 stages"),
    entry("gauss-8",        16, gauss(8),         0.25, 160, "variational Gauss collocation, 8 stages"),
];

impl Method {
    /// Every method, the default first.
    pub fn all() -> impl ExactSizeIterator<Item = Self> + Clone {
        (0..TABLE.len()).map(Self)
    }

    /// Gauss collocation of this many stages, if there is such a method.
    ///
    /// ```
    /// use sim::Method;
    ///
    /// assert_eq!(Method::gauss(8).map(Method::order), Some(16));
    /// assert_eq!(Method::gauss(9), None);
    /// ```
    pub const fn gauss(stages: u32) -> Option<Self> {
        let mut i = 0;
        while i < TABLE.len() {
            if let Family::Gauss { stages: found } = TABLE[i].family
                && found == stages
            {
                return Some(Self(i));
            }
            i += 1;
        }
        None
    }

    fn entry(self) -> &'static Entry {
        &TABLE[self.0]
    }

    /// What it is called on a command line.
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// What it is, in a line.
    pub fn description(self) -> &'static str {
        self.entry().description
    }

    /// How it makes a step.
    pub fn family(self) -> Family {
        self.entry().family
    }

    /// The stages of Gauss collocation; none of other methods.
    pub fn stages(self) -> Option<u32> {
        match self.family() {
            Family::Gauss { stages } => Some(stages),
            _ => None,
        }
    }

    /// The order: the error at a fixed time falls as $h^{\text{order}}$.
    pub fn order(self) -> u32 {
        self.entry().order
    }

    /// Whether a step of $-h$ undoes a step of $h$.
    pub fn is_symmetric(self) -> bool {
        matches!(self.family(), Family::Composition { .. })
    }

    /// Whether a step preserves the symplectic form.
    pub fn is_symplectic(self) -> bool {
        true
    }

    /// What it keeps.
    pub fn conserved(self) -> &'static [Conserved] {
        const ALL: [Conserved; 4] = [
            Conserved::Group,
            Conserved::SymplecticForm,
            Conserved::MomentumMaps,
            Conserved::Reversibility,
        ];
        if self.is_symmetric() { &ALL } else { &ALL[..3] }
    }

    /// A step that is usable and sensible on the paper's scene, in seconds; on another, a run takes it by a power of two longer or shorter.
    pub fn default_step(self) -> f64 {
        self.entry().default_step
    }

    /// The longest step of a model, s, that keeps its steps back in time at half the distance to the pole of a damper that brakes at
    /// `rate`, 1/s. Methods that take none have no such limit.
    pub(crate) fn longest_with_dampers<M: Model>(self, model: M, rate: f64) -> f64 {
        let back = match self.family() {
            Family::Composition { .. } => Composition::with_order(model, self.order()),
            _ => None,
        };
        0.5 / (back.map_or(0.0, |made| made.longest_step_back()) * rate)
    }

    /// What a step evaluates.
    pub fn evaluation(self) -> Evaluation {
        match self.family() {
            Family::Gauss { .. } => Evaluation::VelocityAndForce,
            _ => Evaluation::DiscreteDerivatives,
        }
    }

    /// How many [evaluations](Self::evaluation) an iteration of a [step's report](dvi::StepReport) stands for.
    pub fn evaluations_per_iteration(self) -> u32 {
        match self.family() {
            Family::Gauss { stages } => stages,
            _ => 1,
        }
    }

    /// About how many [evaluations](Self::evaluation) a [default step](Self::default_step) takes, measured on the paper's scene.
    ///
    /// The stages of a Gauss sweep are counted one by one. Newton's matrices, which are kept over many steps, are not counted.
    pub fn evaluations_per_step(self) -> u32 {
        self.entry().evaluations_per_step
    }

    /// The method for a model, in space or in a plane.
    pub fn integrator<M: Model>(self, model: M) -> BoxedIntegrator<M::Group> {
        self.make(model, false)
    }

    /// The same with all coordinates among the unknowns of a step, and none eliminated.
    pub fn integrator_in_full<M: Model>(self, model: M) -> BoxedIntegrator<M::Group> {
        self.make(model, true)
    }

    fn make<M: Model>(self, model: M, in_full: bool) -> BoxedIntegrator<M::Group> {
        match self.family() {
            Family::Variational => {
                let made = Variational::new(model);
                Box::new(if in_full {
                    made.with_all_unknowns()
                } else {
                    made
                })
            }
            Family::Adjoint => {
                let made = Variational::new(Adjoint(model));
                Box::new(if in_full {
                    made.with_all_unknowns()
                } else {
                    made
                })
            }
            Family::Composition { .. } => {
                let made = Composition::with_order(model, self.order());
                let made = made.expect("an order of the table");
                Box::new(if in_full {
                    made.with_all_unknowns()
                } else {
                    made
                })
            }
            Family::Gauss { stages } => {
                let made = Gauss::with_stages(model, stages as usize);
                Box::new(made.expect("as many stages as in the table"))
            }
        }
    }

    /// The method for the smallest exact model of a scene: it steps that, and gives the scene's own states.
    pub fn integrator_of_smallest(self, smallest: &Smallest) -> BoxedIntegrator<Configuration> {
        smallest.integrator(
            |model| self.integrator(model),
            |model| self.integrator(model),
        )
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// No method has this name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no method is called `{name}`; expected one of {}", names())]
pub struct UnknownMethod {
    /// What was asked for.
    pub name: String,
}

fn names() -> String {
    let names: Vec<_> = Method::all().map(Method::name).collect();
    names.join(", ")
}

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        let unknown = || UnknownMethod {
            name: name.to_owned(),
        };
        Self::all()
            .find(|method| method.name() == name)
            .ok_or_else(unknown)
    }
}

impl Serialize for Method {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Object {
            name: &'static str,
            description: &'static str,
            order: u32,
            symmetric: bool,
            symplectic: bool,
            conserved: &'static [Conserved],
            default_step_seconds: f64,
            evaluations_per_step: u32,
            evaluation: Evaluation,
            substeps: Option<u32>,
            stages: Option<u32>,
        }
        let substeps = match self.family() {
            Family::Composition { substeps } => Some(substeps),
            _ => None,
        };
        let stages = self.stages();
        let object = Object {
            name: self.name(),
            description: self.description(),
            order: self.order(),
            symmetric: self.is_symmetric(),
            symplectic: self.is_symplectic(),
            conserved: self.conserved(),
            default_step_seconds: self.default_step(),
            evaluations_per_step: self.evaluations_per_step(),
            evaluation: self.evaluation(),
            substeps,
            stages,
        };
        object.serialize(serializer)
    }
}

/// What a step evaluates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Evaluation {
    /// The two derivatives of the discrete Lagrangian, (29)–(33).
    DiscreteDerivatives,
    /// The velocity and the force of the continuous model, (8)–(20).
    VelocityAndForce,
}

impl fmt::Display for Evaluation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::DiscreteDerivatives => "derivatives of the discrete Lagrangian",
            Self::VelocityAndForce => "velocity and force of the continuous model",
        })
    }
}

impl Serialize for Evaluation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// What a method keeps beside its order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Conserved {
    /// The configuration stays on its group.
    Group,
    /// The symplectic form; the energy's error stays bounded with it.
    SymplecticForm,
    /// The momentum maps of the symmetries: linear and angular momentum, to rounding.
    MomentumMaps,
    /// A step of `-h` undoes a step of `h`.
    Reversibility,
}

impl fmt::Display for Conserved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Group => "group",
            Self::SymplecticForm => "symplectic form",
            Self::MomentumMaps => "momentum maps",
            Self::Reversibility => "reversibility",
        })
    }
}

impl Serialize for Conserved {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
