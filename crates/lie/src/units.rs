//! Which coordinates of an algebra share a unit.

use core::ops::Range;

/// The coordinates of an algebra in blocks, each of one rotation or one vector, and the kind of unit of each block.
///
/// Sizes may be compared within a kind only: an angle is no length. All angles are of one kind; every factor
/// $\mathbb{R}^n$ is of a kind of its own, but the factors of a power share theirs.
///
/// ```
/// use lie::{LieGroup, Power, R3, SO3, Units};
///
/// let chain = (SO3::<f64>::identity(), R3::identity(), Power::new(vec![SO3::identity(); 2]));
/// let units = Units::of(&chain);
/// assert_eq!(units.kinds(), 2);
/// let blocks: Vec<_> = units.blocks().collect();
/// assert_eq!(blocks, [(0..3, 0), (3..6, 1), (6..9, 0), (9..12, 0)]);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Units {
    /// The coordinates of each block, and its kind.
    blocks: Vec<(Range<usize>, usize)>,
    /// The kind of angles, once there is one.
    angle: Option<usize>,
    kinds: usize,
}

impl Units {
    /// Appends a block of `n` angles.
    pub fn angles(&mut self, n: usize) {
        let kind = *self.angle.get_or_insert(self.kinds);
        self.kinds = self.kinds.max(kind + 1);
        self.push(n, kind);
    }

    /// Appends a block of `n` coordinates of a unit of their own.
    pub fn vector(&mut self, n: usize) {
        self.push(n, self.kinds);
        self.kinds += 1;
    }

    /// Appends so many equal factors, which share their kinds.
    pub(crate) fn repeat(&mut self, count: usize, append_first: impl FnOnce(&mut Self)) {
        if count == 0 {
            return;
        }
        let first = self.blocks.len();
        append_first(self);
        let last = self.blocks.len();
        for _ in 1..count {
            for block in first..last {
                let (coordinates, kind) = &self.blocks[block];
                self.push(coordinates.len(), *kind);
            }
        }
    }

    fn push(&mut self, n: usize, kind: usize) {
        let begin = self.blocks.last().map_or(0, |(before, _)| before.end);
        self.blocks.push((begin..begin + n, kind));
    }

    /// The number of kinds.
    pub fn kinds(&self) -> usize {
        self.kinds
    }

    /// The blocks in order: their coordinates and their kind.
    pub fn blocks(&self) -> impl ExactSizeIterator<Item = (Range<usize>, usize)> + '_ {
        self.blocks.iter().cloned()
    }

    /// Neighbouring blocks of one kind as one, in order.
    pub fn runs(&self) -> Vec<(Range<usize>, usize)> {
        let mut runs: Vec<(Range<usize>, usize)> = Vec::new();
        for (block, kind) in self.blocks() {
            match runs.last_mut() {
                Some((run, same)) if *same == kind => run.end = block.end,
                _ => runs.push((block, kind)),
            }
        }
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::Units;
    use crate::{Power, Rn, SE3, SO2, SO3};

    #[test]
    fn the_factors_of_a_power_share_their_kinds_and_others_do_not() {
        let beam = (
            Rn::<2>::identity(),
            Power::new(vec![SE3::<f64>::identity(); 2]),
            SO2::identity(),
        );
        let units = Units::of(&beam);
        let kinds = [
            (0..2, 0),
            (2..5, 1),
            (5..8, 2),
            (8..11, 1),
            (11..14, 2),
            (14..15, 1),
        ];
        assert_eq!(units.blocks().collect::<Vec<_>>(), kinds);
        assert_eq!((units.kinds(), units.runs().len()), (3, 6));
        let none = Units::of(&Power::<SO3>::new(vec![]));
        assert_eq!((none.kinds(), none.blocks().len()), (0, 0));
    }
}
