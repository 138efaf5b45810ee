//! Which setting to take for an error.

use std::time::Duration;

use super::{Curve, Measured, Point};
use crate::contender::{Contender, Control, Setting};

/// From one radian down.
const DECADES: i32 = 15;

/// The cheapest way to an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Which method.
    pub contender: Contender,
    /// In which steps, or to which tolerance.
    pub setting: Setting,
    /// What it is worth.
    pub measured: Measured,
}

impl Choice {
    /// s.
    pub fn time(&self) -> Duration {
        self.measured.cost.time
    }
}

impl Curve {
    /// The cheapest setting that keeps the attitude error within `error`, rad, together with all finer settings of this method: one that
    /// reaches it by luck does not count.
    pub fn cheapest(&self, error: f64) -> Option<Choice> {
        let reached = |point: &&Point| attitude(point) <= error;
        let safe = self.points.iter().rev().take_while(reached);
        let choices = safe.filter_map(|point| {
            Some(Choice {
                contender: self.contender,
                setting: point.setting,
                measured: point.outcome.clone().ok()?,
            })
        });
        choices.min_by_key(Choice::time)
    }
}

/// Infinite where the run failed.
fn attitude(point: &Point) -> f64 {
    let outcome = point.outcome.as_ref();
    outcome.map_or(f64::INFINITY, |measured| measured.errors.attitude)
}

/// The cheapest way to an attitude error, rad, among these methods. A pilot's is none of them: the run before its run is not in its time.
pub fn cheapest<'a>(curves: impl IntoIterator<Item = &'a Curve>, error: f64) -> Option<Choice> {
    let curves = curves.into_iter();
    let named = curves.filter(|curve| curve.contender.control() != Control::Accuracy);
    let choices = named.filter_map(|curve| curve.cheapest(error));
    choices.min_by_key(Choice::time)
}

/// The cheapest ways to ever smaller attitude errors, four to a decade, as far as there are any.
pub(super) fn frontier(curves: &[Curve]) -> Vec<Choice> {
    let errors = (0..4 * DECADES).map(|k| 10_f64.powf(-0.25 * f64::from(k)));
    let mut choices: Vec<_> = errors.map_while(|error| cheapest(curves, error)).collect();
    choices.dedup();
    choices
}
