//! The right-hand side as the steppers want it, and one call of a stepper.

use std::cell::{Cell, RefCell};

use ode_solvers::dop_shared::{IntegrationError, Stats};
use ode_solvers::{DVector, Dop853, Dopri5, OutputType, System};

use super::{Pair, Tolerance};

/// The state of the steppers.
pub(super) type State = DVector<f64>;

/// Never: a baseline is to be slow on a stiff problem, not absent.
const STIFFNESS_TEST_EVERY: u32 = u32::MAX;

/// What is integrated, its type forgotten: so the steppers are compiled once, and not for every system again.
pub(super) type Call<'c> = &'c mut dyn FnMut(f64, &[f64], &mut [f64]);

/// A right-hand side that counts its calls and remembers where it failed.
pub(super) struct Rhs<'c> {
    call: RefCell<Call<'c>>,
    pub(super) calls: Cell<usize>,
    /// Time of a non-finite answer since the last accepted step.
    pub(super) not_finite: Cell<Option<f64>>,
}

impl<'c> Rhs<'c> {
    pub(super) fn new(call: Call<'c>) -> Self {
        Self {
            call: RefCell::new(call),
            calls: Cell::new(0),
            not_finite: Cell::new(None),
        }
    }

    fn evaluate(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        // The buffer holds an old stage: an entry not written must not pass.
        dy.fill(f64::NAN);
        if !y.iter().all(|v| v.is_finite()) {
            return;
        }
        self.calls.set(self.calls.get() + 1);
        (self.call.borrow_mut())(t, y, dy);
        if !dy.iter().all(|v| v.is_finite()) {
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
pub(super) struct Listened<'a, 'c, L> {
    pub(super) rhs: &'a Rhs<'c>,
    pub(super) listener: &'a mut L,
}

impl<L: Listener> System<f64, State> for Listened<'_, '_, L> {
    fn system(&self, t: f64, y: &State, dy: &mut State) {
        self.rhs.evaluate(t, y.as_slice(), dy.as_mut_slice());
    }

    fn solout(&mut self, t: f64, y: &State, dy: &State) -> bool {
        self.listener.accepted(t, y, dy)
    }
}

/// A second in [`Clocked`]'s last component, $2^{-300}$: so small that no step depends on it, and exact.
const CLOCK: f64 = f64::from_bits((0x3ff - 300) << 52);

/// A system whose time is its last component, for a stepper whose own stage times are not to be trusted.
///
/// The 8(5,3) stepper of `ode_solvers` up to 0.6.2 has $c_{12} = 0$ where the pair has 1: autonomous systems do not see it,
/// of all others it makes a method of order 3.
struct Clocked<S>(S);

impl<L: Listener> System<f64, State> for Clocked<Listened<'_, '_, L>> {
    fn system(&self, _: f64, y: &State, dy: &mut State) {
        let n = y.len() - 1;
        let (y, time) = y.as_slice().split_at(n);
        let (dy, clock) = dy.as_mut_slice().split_at_mut(n);
        clock.fill(CLOCK);
        self.0.rhs.evaluate(time[0] / CLOCK, y, dy);
    }

    fn solout(&mut self, t: f64, y: &State, dy: &State) -> bool {
        let without_time = |x: &State| State::from_column_slice(&x.as_slice()[..x.len() - 1]);
        let listener = &mut *self.0.listener;
        listener.accepted(t, &without_time(y), &without_time(dy))
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
    pub(super) fn run<L: Listener>(
        &self,
        system: Listened<'_, '_, L>,
        y: State,
    ) -> Result<Stats, IntegrationError> {
        match self.pair {
            Pair::DormandPrince54 => self.run_54(system, y),
            Pair::DormandPrince853 => self.run_853(Clocked(system), self.clocked(y)),
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

    fn clocked(&self, y: State) -> State {
        let n = y.len();
        y.insert_row(n, CLOCK * self.from)
    }

    fn run_853<S: System<f64, State>>(&self, s: S, y: State) -> Result<Stats, IntegrationError> {
        // The mean square error is over one component more, which has none.
        let components = y.len() as f64;
        let scale = ((components - 1.0) / components).sqrt();
        let (rtol, atol) = (
            scale * self.tolerance.relative,
            scale * self.tolerance.absolute,
        );
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
