//! Continuous systems in Hamiltonian form.

use lie::{AlgebraOver, DualOver, Over, Scalar};

use super::context::{Context, System};
use super::traced::{Recording, TracedError};

/// How the derivatives of a system come about.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Means {
    /// By the system's own formulas.
    #[default]
    Formulas,
    /// By a program: the system's value was recorded once.
    Recorded,
    /// By dual numbers.
    DualNumbers {
        /// Why the value is not recorded, where that was tried.
        why: Option<TracedError>,
    },
}

impl core::fmt::Display for Means {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Formulas => write!(f, "derivatives by the system's own formulas"),
            Self::Recorded => write!(f, "derivatives of a recorded value"),
            Self::DualNumbers { why: None } => write!(f, "derivatives by dual numbers"),
            Self::DualNumbers { why: Some(why) } => write!(f, "derivatives by dual numbers: {why}"),
        }
    }
}

/// Hamilton's equations on a left-trivialised cotangent bundle, (8)–(9):
/// $\dot g = g \xi$, $\dot\mu = \mathrm{ad}^\ast_\xi \mu + \tau$.
///
/// This is what explicit baselines and collocation methods integrate.
pub trait ContinuousSystem: System {
    /// Storage for an evaluation over the scalar `S`, empty at first and kept from call to call; `()` where none is needed.
    type Workspace<S: Scalar>: Default + Send + Sync;

    /// Whether [`velocity_and_force`](Self::velocity_and_force) and all that it calls is `#[inline(always)]`.
    ///
    /// Only then are several states evaluated side by side in SIMD [lanes](lie::lanes): a call that is left over would cost
    /// more than they save.
    const INLINE: bool = false;

    /// Whether there may be a [recording](Self::recorded).
    const IS_RECORDED: bool = false;

    /// At the time of the context: the velocity $\xi$ with $\mu = \mathbf D_\xi L(g, \xi)$, and the force $\tau = \mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L(g, \xi)$.
    ///
    /// Writes every coordinate of `xi` and `tau`; where there is no velocity, they are not finite.
    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Self::Group, S>,
        mu: &DualOver<Self::Group, S>,
        work: &mut Self::Workspace<S>,
        xi: &mut AlgebraOver<Self::Group, S>,
        tau: &mut DualOver<Self::Group, S>,
    );

    /// Whether `g` is in the domain of the system: a step whose end is not is refused.
    fn is_defined(&self, _t: f64, _g: &Self::Group) -> bool {
        true
    }

    /// A coordinate along which the kinetic energy has no inertia, if there is one: a momentum there has no velocity.
    ///
    /// Integrators ask for it before their first step.
    fn without_inertia(&self, _t: f64, _g: &Self::Group) -> Option<usize> {
        None
    }

    /// How velocity and force come about, for steps from `g` at the time `t`.
    ///
    /// Integrators tell it in their [reports](crate::StepReport::means).
    fn means(&self, _t: f64, _g: &Self::Group) -> Means {
        Means::Formulas
    }

    /// What is recorded of the system, for steps from `g` at the time `t`.
    ///
    /// Integrators ask for it before their first step where [`IS_RECORDED`](Self::IS_RECORDED), and step the [`TracedSystem`](crate::TracedSystem) of it. That runs in lanes.
    ///
    /// # Errors
    /// How the rates come about where there is no recording.
    fn recorded(&self, t: f64, g: &Self::Group) -> Result<Recording<Self::Group>, Means> {
        Err(self.means(t, g))
    }
}

impl<C: ContinuousSystem> ContinuousSystem for &C {
    type Workspace<S: Scalar> = C::Workspace<S>;
    const INLINE: bool = C::INLINE;
    const IS_RECORDED: bool = C::IS_RECORDED;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<C::Group, S>,
        mu: &DualOver<C::Group, S>,
        work: &mut C::Workspace<S>,
        xi: &mut AlgebraOver<C::Group, S>,
        tau: &mut DualOver<C::Group, S>,
    ) {
        C::velocity_and_force(self, at, g, mu, work, xi, tau);
    }
    fn is_defined(&self, t: f64, g: &C::Group) -> bool {
        C::is_defined(self, t, g)
    }
    fn without_inertia(&self, t: f64, g: &C::Group) -> Option<usize> {
        C::without_inertia(self, t, g)
    }
    fn means(&self, t: f64, g: &C::Group) -> Means {
        C::means(self, t, g)
    }
    fn recorded(&self, t: f64, g: &C::Group) -> Result<Recording<C::Group>, Means> {
        C::recorded(self, t, g)
    }
}
