//! What the error of a run's trajectory is, by two companions in longer steps.

use dvi::State;

use articulated_fluid::Configuration;

use crate::companion::{Companion, next_look};
use crate::distance::distance;
use crate::method::BoxedIntegrator;

/// Differences that grow by less, in steps twice as long, are not those of any order.
const HARDLY: f64 = 1.5;

/// Goes along with a run.
pub(crate) struct Estimator {
    order: u32,
    steps: u64,
    /// In steps twice as long, and four times.
    companions: [Option<Companion>; 2],
    /// The largest difference of the first from the run, and of the second from the first.
    worst: [f64; 2],
    next: u64,
}

impl Estimator {
    /// For a run of so many steps of a method of this order.
    pub(crate) fn new(
        make: impl Fn() -> BoxedIntegrator<Configuration>,
        start: &State<Configuration>,
        (until, steps, order): (f64, u64, u32),
    ) -> Self {
        let companion = |longer| {
            let fewer = steps / longer;
            (fewer > 0).then(|| Companion::new(make(), start.clone(), (until, fewer)))
        };
        Self {
            order,
            steps,
            companions: [companion(2), companion(4)],
            worst: [0.0; 2],
            next: next_look(0, steps),
        }
    }

    /// Goes on without companions: nothing is known.
    pub(crate) fn lost(self) -> Self {
        Self {
            companions: [None, None],
            ..self
        }
    }

    /// Compares the run, `done` steps on its way. A companion that a step was refused of is left behind.
    pub(crate) fn look(&mut self, done: u64, state: &State<Configuration>) {
        if done < self.next {
            return;
        }
        self.next = next_look(done, self.steps);
        let mut nearer = Some(state.clone());
        for (companion, worst) in self.companions.iter_mut().zip(&mut self.worst) {
            let there = companion
                .as_mut()
                .and_then(|companion| companion.at(state.t).ok());
            match (&there, &nearer) {
                (Some(there), Some(nearer)) => *worst = worst.max(distance(&there.g, &nearer.g)),
                _ => *companion = None,
            }
            nearer = there;
        }
    }

    /// The largest error so far, rad and m; `None` where the first companion was left behind.
    ///
    /// With the order $p$ the differences are $d_2 = 2^p d_1$, and the error is $d_1 / (2^p - 1)$. Where they grow by less, the error is
    /// $d_1 / (d_2 / d_1 - 1)$, and where they hardly grow, it may be as large as both. Where they grow by more, $d_1$ is small by luck, and
    /// $d_2 / 2^p$ takes its place. Without the second companion the order is not seen, and the error is $d_1$.
    pub(crate) fn error(&self) -> Option<f64> {
        self.companions[0].as_ref()?;
        let [near, far] = self.worst;
        let promised = 2.0_f64.powi(self.order as i32);
        let ratio = far / near;
        Some(match &self.companions[1] {
            None => near,
            Some(_) if far <= HARDLY * near => near + far,
            Some(_) => near.max(far / promised) / (ratio.min(promised) - 1.0),
        })
    }

    /// The steps that the companions took.
    pub(crate) fn steps(&self) -> u64 {
        let companions = self.companions.iter().flatten();
        companions.map(Companion::steps).sum()
    }
}
