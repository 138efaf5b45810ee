//! Explicit methods, which variational integrators are measured against, and by.
//!
//! * [`ALL`] — the competitors for a scene, each under one name;
//! * [`Motion`] — the bodies' motion by an adaptive [`Pair`], on raw matrix entries;
//! * [`RungeKutta`] — a [`Tableau`] in steps of one size, on raw matrix entries;
//! * [`GroupRungeKutta`] — methods of a fixed step that stay on the group;
//! * [`Trajectory`], [`integrate`] — an adaptive [`Pair`] for any right-hand side;
//! * [`on_group`] — an independent reference for any continuous system on a Lie group.
//!
//! The adaptive methods serve twice: at everyday tolerances as the competitor a variational integrator is measured against,
//! and at `1e-13` as the reference both are measured by.
//!
//! # How exact the samples are
//!
//! The step sequence does not depend on the sampling times: the method takes the
//! steps it wants. A sample that falls inside an accepted step `[a, b]` is *not*
//! interpolated. It comes from one more step of the same pair from `a` to the
//! sampling time, which is as exact as the step itself. The reason is a
//! measurement. On the harmonic oscillator (largest error made within one step,
//! over `t ∈ [0, 100]`, relative = absolute tolerance):
//!
//! | pair   | tolerance | accepted step | interpolant of the pair | shorter step |
//! |--------|-----------|---------------|-------------------------|--------------|
//! | 5(4)   | 1e-6      | 8.5e-8        | 3.7e-7                  | 8.3e-8       |
//! | 5(4)   | 1e-9      | 2.0e-11       | 3.3e-10                 | 2.0e-11      |
//! | 8(5,3) | 1e-9      | 7.7e-11       | 3.2e-9                  | 7.7e-11      |
//! | 8(5,3) | 1e-12     | 4.0e-14       | 3.4e-12                 | 3.4e-14      |
//! | 8(5,3) | 1e-13     | 9.5e-15       | 3.5e-13                 | 2.8e-15      |
//!
//! The interpolants have order 4 and 7 and lose up to two digits on a single
//! step; over a long run the accumulated error of the steps hides that. The
//! global errors at `t ≤ 100` of 8(5,3) at `1e-13` are 1.6e-12 both on the
//! oscillator and on a free rigid body with inertia (1, 2, 3).
//!
//! The evaluations spent on samples are counted apart
//! ([`Work::sampling_evaluations`]), so that [`Work::evaluations`] stays
//! the price of the method.

mod error;
mod motion;
mod munthe_kaas;
pub mod on_group;
mod raw;
mod runge_kutta;
mod samples;
mod stages;
mod stepper;
mod tableau;
mod tolerance;
mod trajectory;

pub use error::BaselineError;
pub use motion::Motion;
pub use munthe_kaas::{GroupRungeKutta, Scheme};
pub use runge_kutta::RungeKutta;
pub use samples::{Samples, integrate};
pub use stages::RightHandSide;
pub use stepper::{MAX_STEPS, Work};
pub use tableau::{Pair, Row, Tableau};
pub use tolerance::Tolerance;
pub use trajectory::Trajectory;

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{Integrator, State};

/// A competitor under one name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Baseline {
    /// What it is called on a command line.
    pub name: &'static str,
    /// What it is, in a line.
    pub text: &'static str,
    /// How it steps.
    pub method: Method,
}

/// How a competitor steps, and on what.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// In steps of one size, on raw matrix entries: [`RungeKutta`].
    Raw(&'static Tableau),
    /// In steps of one size, on the group: [`GroupRungeKutta`].
    Group(Scheme),
    /// With step control, on raw matrix entries: [`Motion`].
    Adaptive(&'static Pair),
}

/// Every competitor.
pub static ALL: [Baseline; 6] = [
    Baseline {
        name: "rk4",
        text: "classical Runge–Kutta on raw rotation matrices",
        method: Method::Raw(&Tableau::CLASSICAL),
    },
    Baseline {
        name: "rkmk4",
        text: "Runge–Kutta–Munthe-Kaas on the group",
        method: Method::Group(Scheme::MuntheKaas),
    },
    Baseline {
        name: "rkmk4-plain",
        text: "the same without dexp^-1, to show what that costs",
        method: Method::Group(Scheme::WithoutDexp),
    },
    Baseline {
        name: "cf4",
        text: "commutator-free on the group (Celledoni, Marthinsen & Owren)",
        method: Method::Group(Scheme::CommutatorFree),
    },
    Baseline {
        name: "dp54",
        text: "Dormand–Prince 5(4) on raw rotation matrices, adaptive",
        method: Method::Adaptive(&Pair::DP54),
    },
    Baseline {
        name: "dp853",
        text: "Dormand–Prince 8(5,3) on raw rotation matrices, adaptive",
        method: Method::Adaptive(&Pair::DP853),
    },
];

impl Baseline {
    /// The order: the error at a fixed time falls as $h^{\text{order}}$.
    #[must_use]
    pub fn order(&self) -> u32 {
        match self.method {
            Method::Raw(tableau) => tableau.order,
            Method::Group(scheme) => scheme.order(),
            Method::Adaptive(pair) => pair.tableau.order,
        }
    }

    /// Evaluations of the right-hand side in a step.
    #[must_use]
    pub fn stages(&self) -> usize {
        match self.method {
            Method::Raw(tableau) => tableau.stages(),
            Method::Group(_) => Tableau::CLASSICAL.stages(),
            Method::Adaptive(pair) => pair.tableau.stages(),
        }
    }

    /// The integrator for a model and states of the shape of `start`; none of an adaptive method, which is a [`Motion`].
    #[must_use]
    pub fn integrator(
        &self,
        model: &ArticulatedBody,
        start: &State<Configuration>,
    ) -> Option<Box<dyn Integrator<Group = Configuration> + Send>> {
        let model = model.clone();
        match self.method {
            Method::Raw(tableau) => Some(Box::new(RungeKutta::new(tableau, model, start))),
            Method::Group(scheme) => Some(Box::new(GroupRungeKutta::new(model, scheme))),
            Method::Adaptive(_) => None,
        }
    }

    /// The motion from `start` to the time `until`, s; none of a method of fixed steps, which is an [integrator](Self::integrator).
    pub fn motion(
        &self,
        model: &ArticulatedBody,
        start: &State<Configuration>,
        until: f64,
        tolerance: Tolerance,
    ) -> Option<Result<Motion, BaselineError>> {
        match self.method {
            Method::Adaptive(pair) => Some(Motion::new(pair, model, start, until, tolerance)),
            _ => None,
        }
    }
}
