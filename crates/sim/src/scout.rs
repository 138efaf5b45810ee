//! How fast a motion is, found by a rough run before the real one.

use dvi::{Gauss, Integrator, State};

use crate::method::Model;

/// Of the rough run: its error does not matter, only which steps are solved easily.
const STAGES: usize = 4;
const TOLERANCE: f64 = 1e-6;
/// A step that takes more iterations is too long, and one that takes fewer may be longer.
const MOST: u32 = 16;
const FEWEST: u32 = 10;
/// Steps, at most: what comes after is not seen.
const LONGEST: u32 = 20_000;

/// What a rough run has found.
pub(crate) struct Scout<M: Model> {
    /// The longest step that is solved easily where the motion is fastest, s; none where every step was.
    pub(crate) step: Option<f64>,
    /// The state there.
    pub(crate) fastest: State<M::Group>,
    /// Steps taken.
    pub(crate) steps: u64,
}

impl<M: Model> Scout<M> {
    /// Goes from `start` for `until` seconds, in steps of Gauss collocation as long as its sweeps contract well.
    pub(crate) fn run(model: &M, start: &State<M::Group>, until: f64) -> Self {
        let gauss = Gauss::with_stages(model.clone(), STAGES)
            .map(|g| g.with_tolerance(TOLERANCE).by_sweeps_only());
        let mut integrator = gauss.expect("so many stages");
        let (mut state, mut h, mut is_limited) = (start.clone(), 0.125 * until, false);
        let mut found = Self {
            step: None,
            fastest: start.clone(),
            steps: 0,
        };
        for _ in 0..LONGEST {
            if state.t - start.t >= until || h < f64::EPSILON * until {
                break;
            }
            let before = state.clone();
            let report = integrator.step(&mut state, h);
            found.steps += 1;
            let Some(iterations) = report
                .ok()
                .map(|report| report.iterations)
                .filter(|n| *n <= MOST)
            else {
                (state, h, is_limited) = (before, 0.5 * h, true);
                continue;
            };
            if is_limited && found.step.is_none_or(|step| h < step) {
                (found.step, found.fastest) = (Some(h), before);
            }
            if iterations < FEWEST {
                (h, is_limited) = (1.5 * h, false);
            }
        }
        found
    }
}
