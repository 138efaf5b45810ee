//! One problem in each lane.

use crate::Batch;

/// A number of each of several problems: one problem a lane.
///
/// To a formula it is one number, as it would be for one problem alone. So what is written over any [`Batch`] solves as many problems as there are lanes.
pub trait PerLane: Batch<Item = Self> {
    /// How many problems.
    const LANES: usize;

    /// The numbers, one for each problem.
    fn lanes(&self) -> &[f64];

    /// The same, to be changed.
    fn lanes_mut(&mut self) -> &mut [f64];

    /// The number that each problem has.
    #[inline(always)]
    fn from_lanes(number: impl FnMut(usize) -> f64) -> Self {
        let (mut all, mut number) = (Self::zero(), number);
        for (lane, x) in all.lanes_mut().iter_mut().enumerate() {
            *x = number(lane);
        }
        all
    }
}

impl PerLane for f64 {
    const LANES: usize = 1;

    #[inline(always)]
    fn lanes(&self) -> &[f64] {
        core::slice::from_ref(self)
    }

    #[inline(always)]
    fn lanes_mut(&mut self) -> &mut [f64] {
        core::slice::from_mut(self)
    }
}
