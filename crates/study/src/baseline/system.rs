//! The right-hand side as the steppers want it, and one call of a stepper.

use std::cell::{Cell, RefCell};

use ode_solvers::dop_shared::{IntegrationError, Stats};
use ode_solvers::{DVector, Dop853, Dopri5, OutputType, System};

use super::{Pair, Tolerance};

/// The state of the steppers.
pub(super) type State = DVector<f64>;

/// Never: a baseline is to be slow on a stiff problem, not absent.
const STIFFNESS_TEST_EVERY: u32 = u32::MAX;

/// A right-hand side that counts its calls and remembers where it failed.
pub(super) struct Rhs<F> {
    call: RefCell<F>,
    pub(super) calls: Cell<usize>,
    /// Time of a non-finite answer since the last accepted step.
    pub(super) not_finite: Cell<Option<f64>>,
}

impl<F: FnMut(f64, &[f64], &mut [f64])> Rhs<F> {
    pub(super) fn new(call: F) -> Self {
        Self {
            call: RefCell::new(call),
            calls: Cell::new(0),
            not_finite: Cell::new(None),
        }
    }

    fn evaluate(&self, t: f64, y: &State, dy: &mut State) {
        // The buffer holds an old stage: an entry not written must not pass.
        dy.fill(f64::NAN);
        if !is_finite(y) {
            return;
        }
        self.calls.set(self.calls.get() + 1);
        (self.call.borrow_mut())(t, y.as_slice(), dy.as_mut_slice());
        if !is_finite(dy) {
            self.not_finite.set(Some(t));
        }
    }
}

pub(super) fn is_finite(y: &State) -> bool {
    y.iter().all(|v| v.is_finite())
}

/// What is told of every accepted step; `true` stops the run.
pub(super) trait Listener {
    fn accepted(&mut self, t: f64, y: &State, dy: &State) -> bool;
}

/// A right-hand side together with its listener.
pub(super) struct Listened<'a, F, L> {
    pub(super) rhs: &'a Rhs<F>,
    pub(super) listener: &'a mut L,
}

impl<F: FnMut(f64, &[f64], &mut [f64]), L: Listener> System<f64, State> for Listened<'_, F, L> {
    fn system(&self, t: f64, y: &State, dy: &mut State) {
        self.rhs.evaluate(t, y, dy);
    }

    fn solout(&mut self, t: f64, y: &State, dy: &State) -> bool {
        self.listener.accepted(t, y, dy)
    }
}

/// One call of a stepper.
pub(super) struct Leg {
    pub(super) pair: Pair,
    pub(super) tolerance: Tolerance,
    pub(super) from: f64,
    pub(super) to: f64,
    /// Length of the first step tried; zero lets the stepper choose.
    pub(super) first_step: f64,
    pub(super) max_steps: u32,
}

impl Leg {
    /// Steps from `y` at `from` to `to`.
    pub(super) fn run<S: System<f64, State>>(
        &self,
        system: S,
        y: State,
    ) -> Result<Stats, IntegrationError> {
        match self.pair {
            Pair::DormandPrince54 => self.run_54(system, y),
            Pair::DormandPrince853 => self.run_853(system, y),
        }
    }

    fn run_54<S: System<f64, State>>(&self, s: S, y: State) -> Result<Stats, IntegrationError> {
        let (rtol, atol) = (self.tolerance.relative, self.tolerance.absolute);
        let span = self.to - self.from;
        let (safety, beta, shrink, grow) = (0.9, 0.04, 0.2, 10.0);
        Dopri5::from_param(
            s,
            self.from,
            self.to,
            span,
            y,
            rtol,
            atol,
            safety,
            beta,
            shrink,
            grow,
            span,
            self.first_step,
            self.max_steps,
            STIFFNESS_TEST_EVERY,
            OutputType::Sparse,
        )
        .integrate()
    }

    fn run_853<S: System<f64, State>>(&self, s: S, y: State) -> Result<Stats, IntegrationError> {
        let (rtol, atol) = (self.tolerance.relative, self.tolerance.absolute);
        let span = self.to - self.from;
        let (safety, beta, shrink, grow) = (0.9, 0.0, 0.333, 6.0);
        Dop853::from_param(
            s,
            self.from,
            self.to,
            span,
            y,
            rtol,
            atol,
            safety,
            beta,
            shrink,
            grow,
            span,
            self.first_step,
            self.max_steps,
            STIFFNESS_TEST_EVERY,
            OutputType::Sparse,
        )
        .integrate()
    }
}
