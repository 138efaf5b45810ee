//! A change of coordinates, and the integrator that steps in it.

use core::fmt::Debug;

use dvi::{Cause, Integrator, State, StepError, StepReport};
use lie::{LieGroup, RealGroup, VectorSpace};

use crate::tree::Configuration;

/// How far apart two times may be to count as one, relative: the rounding of some ten thousand steps.
const SAME_TIME: f64 = 1e-12;

/// A symplectic change of coordinates, from the scene's to those in which a motion is stepped.
pub trait View: Clone {
    /// Where the inner configuration lives.
    type Inner: RealGroup;

    /// What a state decides of the change, as the velocity of a frame that moves with it.
    type Frame: Clone + Debug;

    /// The state in the inner coordinates, with the frame that it decides; `None` of a state that does not fit.
    fn enter(&self, outer: &State<Configuration>) -> Option<(Self::Frame, State<Self::Inner>)>;

    /// The inverse of [`enter`](Self::enter) in this frame, into a state of as many bodies.
    fn leave(
        &self,
        frame: &Self::Frame,
        inner: &State<Self::Inner>,
        outer: &mut State<Configuration>,
    );
}

/// An integrator of a scene's own states by one of the states of a [`View`].
///
/// The inner state is kept with all its digits while the caller hands back the state that was given out. So is what the inner
/// integrator knows of it. The time may have been reset by rounding.
#[derive(Clone, Debug)]
pub struct Viewed<V: View, I> {
    view: V,
    inner: I,
    /// The start of the scene, if any.
    start: Option<Known<V>>,
    /// The last state that was given out.
    last: Option<Known<V>>,
    steps: u64,
}

/// A state in both coordinates.
#[derive(Clone, Debug)]
struct Known<V: View> {
    outer: State<Configuration>,
    frame: V::Frame,
    inner: State<V::Inner>,
}

impl<V: View> Known<V> {
    fn is(&self, state: &State<Configuration>) -> bool {
        let largest = self.outer.t.abs().max(state.t.abs());
        let same_time = (self.outer.t - state.t).abs() <= SAME_TIME * largest;
        same_time && self.outer.g == state.g && self.outer.mu == state.mu
    }

    /// This pair at the state's own time.
    fn at(mut self, t: f64) -> Self {
        self.inner.t = t;
        self
    }
}

impl<V: View, I: Integrator<Group = V::Inner>> Viewed<V, I> {
    /// The integrator that steps by `inner`, made of the view's inner model.
    pub fn new(view: V, inner: I) -> Self {
        Self {
            view,
            inner,
            start: None,
            last: None,
            steps: 0,
        }
    }

    /// The same with a start that is known in both coordinates: `inner` may have digits that `outer` does not show.
    ///
    /// A start that does not fit the view is not taken.
    #[must_use]
    pub fn starting(mut self, outer: &State<Configuration>, inner: &State<V::Inner>) -> Self {
        self.start = self.view.enter(outer).map(|(frame, _)| Known {
            outer: outer.clone(),
            frame,
            inner: inner.clone(),
        });
        self
    }

    /// The change of coordinates.
    pub fn view(&self) -> &V {
        &self.view
    }

    /// The integrator in the inner coordinates.
    pub fn inner(&self) -> &I {
        &self.inner
    }

    /// The state in both coordinates.
    fn known(&self, state: &State<Configuration>, h: f64) -> Result<Known<V>, StepError> {
        let mut pairs = [&self.last, &self.start].into_iter().flatten();
        if let Some(known) = pairs.find(|pair| pair.is(state)) {
            return Ok(known.clone().at(state.t));
        }
        let entered = self.view.enter(state);
        let (frame, inner) = entered.ok_or(Cause::Misfit.at((self.steps, state.t, h)))?;
        Ok(Known {
            outer: state.clone(),
            frame,
            inner,
        })
    }

    /// The state that was given out last in both coordinates: this one from now on.
    fn meet(&mut self, state: &State<Configuration>, h: f64) -> Result<Known<V>, StepError> {
        match self.last.take_if(|last| last.is(state)) {
            Some(last) => Ok(last.at(state.t)),
            None => self.known(state, h),
        }
    }

    /// The inner state of `known` in the scene's coordinates, into `state`.
    ///
    /// # Errors
    /// The state is as it was where a number of the new one is not finite.
    fn give_out(
        &self,
        known: &mut Known<V>,
        h: f64,
        state: &mut State<Configuration>,
    ) -> Result<(), StepError> {
        let outer = &mut known.outer;
        self.view.leave(&known.frame, &known.inner, outer);
        if !(outer.g.is_finite() && outer.mu.max_magnitude().is_finite()) {
            return Err(Cause::NotFinite.at((self.steps, state.t, h)));
        }
        state.t = outer.t;
        state.g.copy_from(&outer.g);
        state.mu.copy_from(&outer.mu);
        Ok(())
    }
}

impl<V: View, I: Integrator<Group = V::Inner>> Integrator for Viewed<V, I> {
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

    fn step(&mut self, state: &mut State<Configuration>, h: f64) -> Result<StepReport, StepError> {
        let mut known = self.meet(state, h)?;
        match self.inner.step(&mut known.inner, h) {
            Ok(report) => {
                self.give_out(&mut known, h, state)?;
                self.last = Some(known);
                self.steps += 1;
                Ok(report)
            }
            Err(error) => {
                self.last = Some(known);
                Err(error)
            }
        }
    }

    fn peek(
        &mut self,
        state: &State<Configuration>,
        h: f64,
    ) -> Result<State<Configuration>, StepError> {
        let mut known = self.known(state, h)?;
        known.inner = self.inner.peek(&known.inner, h)?;
        let mut ahead = state.clone();
        self.give_out(&mut known, h, &mut ahead)?;
        Ok(ahead)
    }

    fn reset(&mut self) {
        (self.last, self.steps) = (None, 0);
        self.inner.reset();
    }
}
