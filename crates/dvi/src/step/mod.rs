//! The one interface of all integrators.

mod check;
mod error;
mod path;

use lie::RealGroup;

use crate::{Means, State};
pub(crate) use check::{check_call, check_shape, finite};
pub use check::{check_momentum, check_step};
pub use error::{Cause, Hint, StepError};
pub use path::Path;
pub(crate) use path::Rule;

/// Advances a [`State`] in time.
///
/// Traits of systems are generic over scalars, so they have no objects; an integrator is where a method is
/// chosen at run time: `Box<dyn Integrator<Group = G>>`.
pub trait Integrator {
    /// Where the configuration lives.
    type Group: RealGroup;

    /// The order: the error at a fixed time falls as $h^{\text{order}}$.
    fn order(&self) -> u32;

    /// Whether a step of $-h$ undoes a step of $h$.
    fn is_symmetric(&self) -> bool;

    /// Whether a step preserves the symplectic form.
    fn is_symplectic(&self) -> bool;

    /// Advances the state by `h` seconds.
    ///
    /// # Errors
    /// [`StepError`], and the state is as it was.
    fn step(&mut self, state: &mut State<Self::Group>, h: f64) -> Result<StepReport, StepError>;

    /// The state `h` seconds after `state`, at the method's order, without taking the step: for output between steps and for events.
    ///
    /// It is a step of its own from the same state, usually a shorter one; an interpolant through the stages is of half the order.
    /// Calling it does not change later steps, except for their initial guess.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    fn peek(
        &mut self,
        state: &State<Self::Group>,
        h: f64,
    ) -> Result<State<Self::Group>, StepError> {
        let mut ahead = state.clone();
        self.step(&mut ahead, h)?;
        Ok(ahead)
    }

    /// The [step](Self::step), and what it goes through, from part to part.
    ///
    /// # Errors
    /// As `step`; then what has been seen is not of the motion.
    fn step_along(
        &mut self,
        state: &mut State<Self::Group>,
        h: f64,
        see: &mut dyn FnMut(Path<Self::Group>),
    ) -> Result<StepReport, StepError> {
        let start = state.clone();
        let report = self.step(state, h)?;
        see(Path::between(&[start, state.clone()], h));
        Ok(report)
    }

    /// The [look ahead](Self::peek), and what it goes through.
    ///
    /// # Errors
    /// As [`step_along`](Self::step_along).
    fn peek_along(
        &mut self,
        state: &State<Self::Group>,
        h: f64,
        see: &mut dyn FnMut(Path<Self::Group>),
    ) -> Result<State<Self::Group>, StepError> {
        let ends = [state.clone(), self.peek(state, h)?];
        see(Path::between(&ends, h));
        let [_, ahead] = ends;
        Ok(ahead)
    }

    /// Forgets everything that earlier steps have left: the next step is as that of a new integrator, bit by bit.
    ///
    /// Call it before another trajectory.
    fn reset(&mut self);
}

/// What a step cost and how well it was solved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StepReport {
    /// Evaluations of the step's equation.
    pub iterations: u32,
    /// Evaluations of the system: of the discrete derivatives, or of velocity and force at a stage; none where an integrator does not
    /// count. Those of Newton's matrices are among them: one in dual numbers counts as one, and as one more for each derivative.
    pub evaluations: u32,
    /// The equation's residual relative to the momentum, in the unit of coordinates where that is largest.
    pub residual: f64,
    /// How the derivatives came about: by the system's own formulas, by a recording of its value, or by dual numbers.
    pub means: Means,
}

macro_rules! forward {
    ($pointer:ty) => {
        impl<I: Integrator + ?Sized> Integrator for $pointer {
            type Group = I::Group;

            fn order(&self) -> u32 {
                (**self).order()
            }

            fn is_symmetric(&self) -> bool {
                (**self).is_symmetric()
            }

            fn is_symplectic(&self) -> bool {
                (**self).is_symplectic()
            }

            fn step(
                &mut self,
                state: &mut State<I::Group>,
                h: f64,
            ) -> Result<StepReport, StepError> {
                (**self).step(state, h)
            }

            fn peek(
                &mut self,
                state: &State<I::Group>,
                h: f64,
            ) -> Result<State<I::Group>, StepError> {
                (**self).peek(state, h)
            }

            fn step_along(
                &mut self,
                state: &mut State<I::Group>,
                h: f64,
                see: &mut dyn FnMut(Path<I::Group>),
            ) -> Result<StepReport, StepError> {
                (**self).step_along(state, h, see)
            }

            fn peek_along(
                &mut self,
                state: &State<I::Group>,
                h: f64,
                see: &mut dyn FnMut(Path<I::Group>),
            ) -> Result<State<I::Group>, StepError> {
                (**self).peek_along(state, h, see)
            }

            fn reset(&mut self) {
                (**self).reset();
            }
        }
    };
}

forward!(Box<I>);
forward!(&mut I);
