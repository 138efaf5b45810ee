//! Sizes of vectors whose coordinates have different units: compared block by block, and kind by kind.

use core::ops::Range;

use lie::{LieGroup, Units, VectorSpace};

use crate::numbers::{larger, relative};

/// Digits of a number that may say which way it is moved.
const DIGITS: u32 = 8;
/// The part of the tolerance that a correction may be of the displacement, which is then the solution without it.
const SETTLED: f64 = 0.1;
/// Roundings of an evaluation may add up to so many times what shaking its arguments makes of it.
pub(crate) const NOISE: f64 = 16.0;

/// The kinds of unit of a group's coordinates, and how large numbers of each kind are.
#[derive(Clone)]
pub(crate) struct Kinds {
    /// Coordinates that stand together, and their kind.
    pub(crate) runs: Vec<(Range<usize>, usize)>,
    pub(crate) count: usize,
}

impl Kinds {
    pub(crate) fn of<G: LieGroup>(g: &G) -> Self {
        let units = Units::of(g);
        Self {
            runs: units.runs(),
            count: units.kinds(),
        }
    }

    /// The largest magnitude of each kind into `out`, where that is larger than what is there.
    pub(crate) fn raise(&self, out: &mut [f64], numbers: &[f64]) {
        for (run, kind) in &self.runs {
            out[*kind] = larger(out[*kind], largest(&numbers[run.clone()]));
        }
    }
}

/// The blocks of a group's coordinates, and how large a vector is in each.
pub(crate) struct Sizes {
    blocks: Vec<Block>,
    kinds: usize,
    numbers: Vec<f64>,
}

/// Coordinates of one unit that belong together.
struct Block {
    coordinates: Range<usize>,
    kind: usize,
    /// What is relative to [`scale`](Block::scale).
    size: f64,
    scale: f64,
    /// What rounding makes of nothing.
    noise: f64,
}

impl Sizes {
    /// For vectors of the shape of `g`, without the coordinates in `left_out`.
    pub(crate) fn new<G: LieGroup>(g: &G, left_out: Range<usize>) -> Self {
        let units = Units::of(g);
        let (before, after) = (0..left_out.start, left_out.end..usize::MAX);
        let parts = units.blocks().flat_map(|(block, kind)| {
            [&before, &after].map(|kept| {
                let start = block.start.max(kept.start);
                (start..block.end.min(kept.end).max(start), kind)
            })
        });
        let block = |(coordinates, kind)| Block {
            coordinates,
            kind,
            size: 0.0,
            scale: 0.0,
            noise: 0.0,
        };
        Self {
            blocks: parts
                .filter(|(part, _)| !part.is_empty())
                .map(block)
                .collect(),
            kinds: units.kinds(),
            numbers: vec![0.0; g.zero_dual().dim()],
        }
    }

    /// Takes the largest of these vectors for the scale of each block, and forgets the noise.
    pub(crate) fn set_scales<V: VectorSpace<Scalar = f64>>(&mut self, terms: [&V; 3]) {
        for block in &mut self.blocks {
            (block.scale, block.noise) = (0.0, 0.0);
        }
        for term in terms {
            self.measure(term);
            for block in &mut self.blocks {
                block.scale = larger(block.scale, block.size);
            }
        }
    }

    /// Whether all scales are zero.
    pub(crate) fn have_no_scale(&self) -> bool {
        self.blocks.iter().all(|block| block.scale == 0.0)
    }

    /// Takes the size of a vector in each block.
    #[inline(always)]
    fn measure<V: VectorSpace<Scalar = f64>>(&mut self, x: &V) {
        x.write(&mut self.numbers);
        for block in &mut self.blocks {
            block.size = largest(&self.numbers[block.coordinates.clone()]);
        }
    }

    /// How large a vector is relative to the scales: in each kind as a whole, and block by block; the largest of either.
    #[inline(always)]
    pub(crate) fn relative<V: VectorSpace<Scalar = f64>>(&mut self, x: &V) -> Relative {
        self.measure(x);
        let mut found = Relative::default();
        for kind in 0..self.kinds {
            let (mut size, mut scale) = (0.0, 0.0);
            for block in self.blocks.iter().filter(|block| block.kind == kind) {
                (size, scale) = (larger(size, block.size), larger(scale, block.scale));
                found.by_block = larger(found.by_block, relative(block.size, block.scale));
            }
            found.by_kind = larger(found.by_kind, relative(size, scale));
        }
        found
    }

    /// Takes the difference of two evaluations that are the same but for rounding for the noise of each block, where it is larger than before.
    pub(crate) fn raise_noise<V: VectorSpace<Scalar = f64>>(&mut self, difference: &V) {
        self.measure(difference);
        for block in &mut self.blocks {
            block.noise = larger(block.noise, block.size);
        }
    }

    /// Whether each block of the vector that was [measured](Self::relative) last is within the tolerance, or is noise, or asks for a correction
    /// that is no more than that of the whole displacement.
    pub(crate) fn are_settled<V: VectorSpace<Scalar = f64>>(
        &self,
        (correction, whole): (&V, &V),
        tolerance: f64,
    ) -> bool {
        let settled = |block: &Block| {
            block.size <= larger(tolerance * block.scale, NOISE * block.noise) || {
                let [part, all] = [correction, whole].map(|x| {
                    let numbers = block.coordinates.clone().map(|i| x.get(i).abs());
                    numbers.fold(0.0, larger)
                });
                part < SETTLED * tolerance * all
            }
        };
        self.blocks.iter().all(settled)
    }
}

/// Of a vector.
#[derive(Clone, Copy, Default)]
pub(crate) struct Relative {
    pub(crate) by_kind: f64,
    pub(crate) by_block: f64,
}

impl Relative {
    /// Of nothing known yet.
    pub(crate) const NONE: Self = Self {
        by_kind: f64::INFINITY,
        by_block: f64::INFINITY,
    };
}

#[inline(always)]
fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |max, x| larger(max, x.abs()))
}

/// Moves a number by two units of its last place, up or down as one of its digits says, every other time up: what cannot be told from it.
///
/// What the moved numbers do may cancel: the next time they are moved otherwise.
#[inline(always)]
pub(crate) fn shaken(x: f64, time: u32) -> f64 {
    let digit = x.to_bits() >> (time / 2 % DIGITS) & 1;
    let up = digit == 0 || time.is_multiple_of(2);
    let sign = if up { 1.0 } else { -1.0 };
    x + sign * 2.0 * f64::EPSILON * x
}

/// Shakes every coordinate.
pub(crate) fn shake<V: VectorSpace<Scalar = f64>>(x: &mut V, time: u32) {
    (0..x.dim()).for_each(|i| x.set(i, shaken(x.get(i), time)));
}
