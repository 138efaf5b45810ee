//! What an integrator answers when it cannot step.

/// A step that was not taken. The state is as it was before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepError {
    /// Steps that this integrator has taken before.
    pub step: u64,
    /// Time at the start of the step, in seconds.
    pub t: f64,
    /// Step size, in seconds.
    pub h: f64,
    /// Why.
    pub cause: Cause,
}

/// Why a step was not taken.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Cause {
    /// The implicit equation was not solved.
    NotConverged {
        /// The smallest residual reached, relative to the momentum's size.
        residual: f64,
        /// Iterations done.
        iterations: u32,
        /// What to try.
        hint: Hint,
    },
    /// The step size is zero or not finite.
    InvalidStep,
    /// The configuration is not one of the model's.
    Misfit,
    /// The momentum has another number of factors than the configuration.
    Shape {
        /// Coordinates of the configuration's dual.
        expected: usize,
        /// Coordinates of the momentum.
        found: usize,
    },
    /// The kinetic energy has no inertia in some direction.
    Degenerate {
        /// Index of a coordinate of the algebra along which there is none, with the coordinates eliminated before it held free.
        coordinate: usize,
    },
    /// The state, the model or the state after the step has a number that is not finite.
    NotFinite,
}

impl core::error::Error for StepError {}

impl core::fmt::Display for StepError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { step, t, h, cause } = self;
        write!(f, "step {step} at t = {} s: ", nine_digits(*t))?;
        match cause {
            Cause::NotConverged {
                residual,
                iterations,
                hint,
            } => write!(
                f,
                "no solution found for h = {} s after {iterations} iterations (residual {residual:.1e} of the momentum); {hint}",
                nine_digits(*h)
            ),
            Cause::InvalidStep => write!(
                f,
                "the step size is {h} s; expected a finite number other than zero"
            ),
            Cause::Misfit => write!(
                f,
                "the configuration does not fit the model (another number of bodies?); make it from the model"
            ),
            Cause::Shape { expected, found } => write!(
                f,
                "the momentum does not have the configuration's shape ({expected} coordinates, found {found}); make it of `g.zero_dual()`"
            ),
            Cause::Degenerate { coordinate } => write!(
                f,
                "the kinetic energy has no inertia along coordinate {coordinate} of the velocity; give it one there (a Lagrangian that is linear in a velocity has none: such are not supported)"
            ),
            Cause::NotFinite => write!(
                f,
                "a number is not finite: in the state, in the velocity or the derivatives at it, or in the state after a step of {} s; check that the initial state is in the domain of the Lagrangian, the model's parameters, and whether the step leaves the domain",
                nine_digits(*h)
            ),
        }
    }
}

impl Cause {
    /// This cause at step number `step`, of size `h` from `t`.
    pub fn at(self, (step, t, h): (u64, f64, f64)) -> StepError {
        let cause = self;
        StepError { step, t, h, cause }
    }
}

impl StepError {
    /// The refusal of a part, told of the whole step of size `h` from `t` that it is a part of.
    pub(crate) fn of_whole(self, step: u64, t: f64, h: f64) -> Self {
        let whole = |part: f64| h * (part / self.h).abs();
        let cause = match self.cause {
            Cause::NotConverged {
                residual,
                iterations,
                hint,
            } => Cause::NotConverged {
                residual,
                iterations,
                hint: match hint {
                    Hint::SmallerStep { h } => Hint::SmallerStep { h: whole(h) },
                    Hint::AnotherBranch { h } => Hint::AnotherBranch { h: whole(h) },
                    hint => hint,
                },
            },
            cause => cause,
        };
        Self { step, t, h, cause }
    }
}
/// What to try after a step that did not converge.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Hint {
    /// The iteration diverged: the step is too long for the motion.
    SmallerStep {
        /// A step size to try, in seconds.
        h: f64,
    },
    /// The iteration led to a solution that is not the motion's: the equation of a long step has many.
    AnotherBranch {
        /// A step size to try, in seconds.
        h: f64,
    },
    /// The iteration stood still a little above the tolerance: rounding reaches no further.
    LooserTolerance {
        /// A relative tolerance to try.
        tolerance: f64,
    },
}

impl core::fmt::Display for Hint {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::SmallerStep { h } => {
                write!(f, "try a smaller step, such as {} s", two_digits(*h))
            }
            Self::AnotherBranch { h } => write!(
                f,
                "what was found is not the motion's: try a smaller step, such as {} s",
                two_digits(*h)
            ),
            Self::LooserTolerance { tolerance } => write!(
                f,
                "rounding reaches no further: try a tolerance of {tolerance:.0e}, or another step"
            ),
        }
    }
}

/// Rounded to two significant digits.
fn two_digits(x: f64) -> Printed {
    Printed(format!("{x:.1e}").parse().unwrap_or(x))
}

/// Without the digits that rounding has left of a sum of steps.
fn nine_digits(x: f64) -> Printed {
    Printed(format!("{x:.8e}").parse().unwrap_or(x))
}

/// With an exponent where there would be many zeros.
struct Printed(f64);

impl core::fmt::Display for Printed {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self(x) = self;
        if *x == 0.0 || (1e-4..1e12).contains(&x.abs()) {
            write!(f, "{x}")
        } else {
            write!(f, "{x:e}")
        }
    }
}
