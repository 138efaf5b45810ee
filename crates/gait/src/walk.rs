//! The way of an optimiser from one start: sequential quadratic programming (SLSQP).
//!
//! The gradients are exact. The limits are many: they hold at several times of a stroke. D. Kraft's method takes both. It needs
//! some tens of evaluations, where methods without gradients need thousands.

use core::cell::{Cell, RefCell};
use std::rc::Rc;

use slsqp::{Func, StopTols};

use crate::error::GaitError;

/// A limit may be exceeded by so much of it.
const SLACK: f64 = 1e-6;
/// Evaluations, at most.
const MOST: usize = 500;

/// An evaluation, with all that hangs on it.
#[derive(Clone)]
pub(crate) struct Evaluated {
    pub(crate) x: Vec<f64>,
    pub(crate) value: f64,
    pub(crate) gradient: Vec<f64>,
    /// Each at most 0, with its gradient.
    pub(crate) limits: Vec<(f64, Vec<f64>)>,
}

impl Evaluated {
    fn is_allowed(&self) -> bool {
        self.limits.iter().all(|(value, _)| *value <= SLACK)
    }

    /// The same where nothing changes.
    fn at_an_end(&self) -> Self {
        let mut end = self.clone();
        end.gradient.fill(0.0);
        end
    }

    /// One elsewhere that is worse.
    fn worse(&self, x: &[f64]) -> Self {
        Self {
            x: x.to_vec(),
            value: self.value - 1.0 - self.value.abs(),
            ..self.clone()
        }
    }
}

/// What is evaluated at each place.
type Evaluate<'a> = &'a dyn Fn(&[f64]) -> Result<Evaluated, GaitError>;

/// A way, and the best that was met on it.
pub(crate) struct Walk<'a> {
    first: Rc<Evaluated>,
    evaluate: Evaluate<'a>,
    go_on: &'a dyn Fn() -> bool,
    last: RefCell<Option<Rc<Evaluated>>>,
    best: RefCell<Option<Rc<Evaluated>>>,
    count: Cell<usize>,
}

/// Where a way ended.
pub(crate) struct Ended {
    /// The best that was met within the limits.
    pub(crate) best: Option<Vec<f64>>,
    pub(crate) evaluations: usize,
}

impl<'a> Walk<'a> {
    /// A way from `first`, for as long as `go_on` says so.
    pub(crate) fn new(
        first: Evaluated,
        evaluate: Evaluate<'a>,
        go_on: &'a dyn Fn() -> bool,
    ) -> Self {
        Self {
            first: Rc::new(first),
            evaluate,
            go_on,
            last: RefCell::new(None),
            best: RefCell::new(None),
            count: Cell::new(0),
        }
    }

    /// Looks for the largest value, with all numbers within the bounds; values below `least` count as nothing.
    ///
    /// # Errors
    /// [`GaitError::TooLarge`].
    pub(crate) fn climb(self, (bound, least): (f64, f64)) -> Result<Ended, GaitError> {
        let (unknowns, limits) = (self.first.x.len(), self.first.limits.len());
        check_size(unknowns, limits)?;
        let scale = 1.0 / self.first.value.abs().max(least);
        let objective = |x: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
            let found = self.at(x);
            if let Some(gradient) = gradient {
                let slopes = gradient.iter_mut().zip(&found.gradient);
                slopes.for_each(|(to, slope)| *to = -scale * slope);
            }
            -scale * found.value
        };
        let limit = |k: usize| {
            let walk = &self;
            move |x: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
                let found = walk.at(x);
                let (value, slopes) = &found.limits[k];
                if let Some(gradient) = gradient {
                    gradient.copy_from_slice(slopes);
                }
                *value
            }
        };
        let limits: Vec<_> = (0..limits).map(limit).collect();
        let limits: Vec<&dyn Func<()>> =
            limits.iter().map(|limit| limit as &dyn Func<()>).collect();
        let bounds = vec![(-bound, bound); unknowns];
        let stop = StopTols {
            ftol_rel: 1e-10,
            ..StopTols::default()
        };
        // Whether it ended well or gave up: the best that was met counts.
        let _ = slsqp::minimize(
            objective,
            &self.first.x,
            &bounds,
            &limits,
            (),
            MOST,
            Some(stop),
        );
        let best = self.best.borrow();
        Ok(Ended {
            best: best.as_ref().map(|best| best.x.clone()),
            evaluations: self.count.get(),
        })
    }

    /// The evaluation here, which the objective and all limits share.
    fn at(&self, x: &[f64]) -> Rc<Evaluated> {
        let last = self.last.borrow().clone();
        let known = last.as_ref().filter(|last| last.x == x);
        if let Some(known) = known {
            return known.clone();
        }
        let found = match &last {
            None if x == self.first.x => self.first.clone(),
            // Nothing changes any more, which ends the search.
            Some(last) if !(self.go_on)() => return Rc::new(last.at_an_end()),
            // No steady stroke so far away: worse than the last, so that the search comes back.
            _ => {
                let before = last.as_ref().unwrap_or(&self.first);
                let found = (self.evaluate)(x).unwrap_or_else(|_| before.worse(x));
                Rc::new(found)
            }
        };
        self.count.set(self.count.get() + 1);
        *self.last.borrow_mut() = Some(found.clone());
        let before = self.best.borrow().as_ref().map(|best| best.value);
        if found.is_allowed() && before.is_none_or(|before| found.value > before) {
            *self.best.borrow_mut() = Some(found.clone());
        }
        found
    }
}

/// Refuses what the optimiser's memory, whose size it counts in 32 bits, would not hold.
fn check_size(unknowns: usize, limits: usize) -> Result<(), GaitError> {
    let (n, m) = (unknowns as f64, limits as f64);
    let memory = (3.0 * (n + 1.0) + m) * (n + 2.0)
        + (n + 2.0) * (m + 2.0 * n + 4.0)
        + (m + 3.0 * n + 3.0) * (n + 1.0)
        + m * (n + 1.0);
    match memory < 1e8 {
        true => Ok(()),
        false => Err(GaitError::TooLarge { limits, unknowns }),
    }
}
