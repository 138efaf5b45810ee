//! States in space, stepped in a plane.

use dvi::{Integrator, State, StepError, StepReport};
use lie::{RealGroup, VectorSpace};

use super::{PlanarConfiguration, Plane};
use crate::Configuration;

/// An integrator of states in space by one of states in a [`Plane`].
///
/// A step costs that of the inner integrator and the way to space; the bodies stay in the plane exactly. The state in the
/// plane is kept, with what the inner integrator knows of it, while the states given are those returned.
#[derive(Clone, Debug)]
pub struct InPlane<I> {
    plane: Plane,
    inner: I,
    planar: State<PlanarConfiguration>,
    /// The state in space that `planar` is, if any.
    lifted: Option<State<Configuration>>,
    steps: u64,
}

impl<I: Integrator<Group = PlanarConfiguration>> InPlane<I> {
    /// The integrator that steps in this plane by `inner`, made of the plane's [model](Plane::model).
    pub fn new(plane: Plane, inner: I) -> Self {
        Self {
            planar: plane.origin(),
            plane,
            inner,
            lifted: None,
            steps: 0,
        }
    }

    /// The plane.
    pub fn plane(&self) -> &Plane {
        &self.plane
    }

    /// The integrator in the plane.
    pub fn inner(&self) -> &I {
        &self.inner
    }

    fn knows(&self, state: &State<Configuration>) -> bool {
        let known = self.lifted.as_ref();
        known.is_some_and(|known| known.g == state.g && known.mu == state.mu)
    }

    /// # Errors
    /// The refusal of a state that is not of the plane.
    fn check(&self, state: &State<Configuration>) -> Result<(), StepError> {
        let (step, t) = (self.steps, state.t);
        if self.plane.contains(state) {
            Ok(())
        } else {
            Err(StepError::Misfit { step, t })
        }
    }

    /// Remembers the state in space that the planar one is.
    fn remember(&mut self, state: &State<Configuration>) {
        match &mut self.lifted {
            Some(lifted) => {
                lifted.g.copy_from(&state.g);
                lifted.mu.copy_from(&state.mu);
            }
            None => self.lifted = Some(state.clone()),
        }
    }
}

impl<I: Integrator<Group = PlanarConfiguration>> Integrator for InPlane<I> {
    type Group = Configuration;

    fn order(&self) -> u32 {
        self.inner.order()
    }

    fn is_symmetric(&self) -> bool {
        self.inner.is_symmetric()
    }

    fn is_symplectic(&self) -> bool {
        self.inner.is_symplectic()
    }

    /// Advances a state of the plane; one that leaves it by more than 1e-9 is refused as a misfit.
    fn step(&mut self, state: &mut State<Configuration>, h: f64) -> Result<StepReport, StepError> {
        if !self.knows(state) {
            self.check(state)?;
            self.plane.project_into(state, &mut self.planar);
            self.remember(state);
        }
        self.planar.t = state.t;
        let report = self.inner.step(&mut self.planar, h)?;
        self.plane.lift_into(&self.planar, state);
        self.remember(state);
        self.steps += 1;
        Ok(report)
    }

    fn peek(
        &mut self,
        state: &State<Configuration>,
        h: f64,
    ) -> Result<State<Configuration>, StepError> {
        let ahead = if self.knows(state) {
            self.planar.t = state.t;
            self.inner.peek(&self.planar, h)?
        } else {
            self.check(state)?;
            self.inner.peek(&self.plane.project(state), h)?
        };
        Ok(self.plane.lift(&ahead))
    }
    fn reset(&mut self) {
        (self.lifted, self.steps) = (None, 0);
        self.inner.reset();
    }
}
