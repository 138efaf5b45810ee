//! The integrators of the fish chain's model, each under one name.
//!
//! ```
//! use study::methods::Method;
//!
//! let method: Method = "gauss-4".parse()?;
//! assert_eq!((method.order(), method.to_string()), (8, "gauss-4".to_owned()));
//! let error = "gauss-9".parse::<Method>().unwrap_err();
//! assert!(error.to_string().contains("gauss-8"));
//! # Ok::<(), study::methods::UnknownMethod>(())
//! ```

use core::fmt;
use core::str::FromStr;

use articulated_fluid::planar::{PlanarBody, PlanarConfiguration};
use articulated_fluid::{ArticulatedBody, Configuration, Smallest};
use dvi::{Adjoint, Composition, Gauss, Integrator, Variational};
use thiserror::Error;

/// An integrator chosen at run time.
pub type BoxedIntegrator<G> = Box<dyn Integrator<Group = G> + Send>;

/// The integrator of a method for a model of any kind.
macro_rules! integrator {
    ($method:expr, $model:expr) => {
        match $method {
            Method::Lgvi => Box::new(Variational::with_inertia($model)),
            Method::LgviAdjoint => Box::new(Variational::new(Adjoint($model))),
            Method::Composition2 => Box::new(Composition::<_, 2>::new($model)),
            Method::Composition4 => Box::new(Composition::<_, 4>::new($model)),
            Method::Composition6 => Box::new(Composition::<_, 6>::new($model)),
            Method::Composition8 => Box::new(Composition::<_, 8>::new($model)),
            Method::Gauss1 => Box::new(Gauss::<_, 1>::new($model)),
            Method::Gauss2 => Box::new(Gauss::<_, 2>::new($model)),
            Method::Gauss3 => Box::new(Gauss::<_, 3>::new($model)),
            Method::Gauss4 => Box::new(Gauss::<_, 4>::new($model)),
            Method::Gauss5 => Box::new(Gauss::<_, 5>::new($model)),
            Method::Gauss6 => Box::new(Gauss::<_, 6>::new($model)),
            Method::Gauss7 => Box::new(Gauss::<_, 7>::new($model)),
            Method::Gauss8 => Box::new(Gauss::<_, 8>::new($model)),
        }
    };
}

/// An integrator of [`ArticulatedBody`], chosen at run time.
///
/// All of them stay on the group and are symplectic, and keep the momentum maps to rounding; they differ in order, in symmetry
/// and in cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Method {
    /// The paper's: the stepping map of its discrete Lagrangian (22), which looks at the start of the step; order 1.
    #[default]
    Lgvi,
    /// Its [adjoint](Adjoint), which looks at the end of the step; order 1.
    LgviAdjoint,
    /// Half a step of the paper's and half a step of its adjoint; order 2.
    Composition2,
    /// Five of these pairs; order 4.
    Composition4,
    /// Nine of these pairs; order 6.
    Composition6,
    /// Seventeen of these pairs; order 8.
    Composition8,
    /// Variational [`Gauss`] collocation of one stage; order 2.
    Gauss1,
    /// Of two stages; order 4.
    Gauss2,
    /// Of three stages; order 6.
    Gauss3,
    /// Of four stages; order 8.
    Gauss4,
    /// Of five stages; order 10.
    Gauss5,
    /// Of six stages; order 12.
    Gauss6,
    /// Of seven stages; order 14.
    Gauss7,
    /// Of eight stages; order 16.
    Gauss8,
}

/// How a method makes a step, and so what a [report](dvi::StepReport) of it counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Family {
    /// One implicit step of a discrete Lagrangian: an iteration evaluates its derivatives once.
    Variational,
    /// Implicit steps one after the other: an iteration evaluates the derivatives of one of them once.
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

/// No method has this name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no method is called `{name}`; expected one of {}", names())]
pub struct UnknownMethod {
    /// What was asked for.
    pub name: String,
}

fn names() -> String {
    Method::all()
        .map(Method::name)
        .collect::<Vec<_>>()
        .join(", ")
}

/// What is known of a method but for its construction.
struct Entry {
    method: Method,
    name: &'static str,
    order: u32,
    family: Family,
    /// s.
    default_step: f64,
    evaluations_per_step: u32,
}

/// The last are the default step in seconds and the evaluations in it.
const fn entry(
    method: Method,
    name: &'static str,
    order: u32,
    family: Family,
    (default_step, evaluations_per_step): (f64, u32),
) -> Entry {
    Entry {
        method,
        name,
        order,
        family,
        default_step,
        evaluations_per_step,
    }
}

const VARIATIONAL: Family = Family::Variational;

const fn composition(substeps: u32) -> Family {
    Family::Composition { substeps }
}

const fn gauss(stages: u32) -> Family {
    Family::Gauss { stages }
}

/// In the order of [`Method`]'s variants.
#[rustfmt::skip]
const TABLE: [Entry; 14] = [
    entry(Method::Lgvi,          "lgvi",            1, VARIATIONAL,      (0.001, 2)),
    entry(Method::LgviAdjoint,   "lgvi-adjoint",    1, VARIATIONAL,      (0.001, 6)),
    entry(Method::Composition2,  "composition-2",   2, composition(2),   (0.01, 19)),
    entry(Method::Composition4,  "composition-4",   4, composition(10),  (0.05, 120)),
    entry(Method::Composition6,  "composition-6",   6, composition(18),  (0.1, 200)),
    entry(Method::Composition8,  "composition-8",   8, composition(34),  (0.1, 380)),
    entry(Method::Gauss1,        "gauss-1",         2, gauss(1),         (0.01, 13)),
    entry(Method::Gauss2,        "gauss-2",         4, gauss(2),         (0.05, 37)),
    entry(Method::Gauss3,        "gauss-3",         6, gauss(3),         (0.1, 68)),
    entry(Method::Gauss4,        "gauss-4",         8, gauss(4),         (0.1, 72)),
    entry(Method::Gauss5,        "gauss-5",        10, gauss(5),         (0.2, 140)),
    entry(Method::Gauss6,        "gauss-6",        12, gauss(6),         (0.2, 130)),
    entry(Method::Gauss7,        "gauss-7",        14, gauss(7),         (0.2, 120)),
    entry(Method::Gauss8,        "gauss-8",        16, gauss(8),         (0.25, 160)),
];

const _: () = {
    let mut i = 0;
    while i < TABLE.len() {
        assert!(TABLE[i].method as usize == i, "TABLE is out of order");
        i += 1;
    }
};

impl Method {
    /// Every method, the default first.
    pub fn all() -> impl ExactSizeIterator<Item = Self> + Clone {
        TABLE.iter().map(|entry| entry.method)
    }

    fn entry(self) -> &'static Entry {
        &TABLE[self as usize]
    }

    /// What it is called on a command line.
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// What it is, in a line.
    pub fn description(self) -> String {
        match self.family() {
            Family::Variational if self == Self::Lgvi => {
                "the integrator of Lee, Leok & McClamroch (2009)".to_owned()
            }
            Family::Variational => "adjoint of lgvi: it looks at the end of a step".to_owned(),
            Family::Composition { substeps } => {
                format!("symmetric composition of lgvi and its adjoint, {substeps} substeps")
            }
            Family::Gauss { stages: 1 } => "variational Gauss collocation, 1 stage".to_owned(),
            Family::Gauss { stages } => format!("variational Gauss collocation, {stages} stages"),
        }
    }

    /// How it makes a step.
    pub fn family(self) -> Family {
        self.entry().family
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

    /// A step that is usable and sensible on the paper's scene, in seconds.
    pub fn default_step(self) -> f64 {
        self.entry().default_step
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

    /// The method for a model in space.
    pub fn integrator(self, model: ArticulatedBody) -> BoxedIntegrator<Configuration> {
        integrator!(self, model)
    }

    /// The method for a model in a plane.
    pub fn integrator_in_plane(self, model: PlanarBody) -> BoxedIntegrator<PlanarConfiguration> {
        integrator!(self, model)
    }

    /// The method for the smallest exact model of a scene: it steps that, and gives the scene's own states.
    pub fn integrator_of_smallest(self, smallest: &Smallest) -> BoxedIntegrator<Configuration> {
        smallest.integrator(
            |model| self.integrator(model),
            |model| self.integrator_in_plane(model),
        )
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
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
